// Sky: what lies around everything, as surfaces mirror and refract it and as a background shows it.
//
// Overhead a gradient from a pale horizon to a deep zenith, below the horizon the ground, from haze to what lies under the feet.
// A level surface receives from it exactly what the scene calls its sky, and one that faces down exactly its ground: with the
// square root of the sine of the elevation as the place in a gradient, the mean over the cosine is a fifth of its end at the
// horizon and four fifths of the other. So the two colours that light matt surfaces (sky_mean) and the picture of the sky agree.
//
// Each light stands in it as a disc three times as wide as the sun, with a glow about it. The discs are not part of `sky`: what
// light does on a surface is its highlight, and would count twice.
//
// Specification: src/reference/sky.rs. Needs common/view.

// How much paler the horizon is than the sky's mean, and how much of its colour it keeps.
const SKY_HORIZON: f32 = 1.8;
const SKY_HORIZON_HUE: f32 = 0.55;
// How much of the ground's own colour is left in the haze.
const SKY_HAZE: f32 = 0.5;
// Half the height of the horizon's soft edge, as a sine: half a degree.
const SKY_EDGE: f32 = 0.009;

// Radiance from a unit direction, lights apart.
fn sky(direction: vec3f) -> vec3f {
    let pale = vec3f(dot(view.sky, vec3f(0.2126, 0.7152, 0.0722)));
    // The zenith is what is left of the mean, and never less than nothing.
    let horizon = min(SKY_HORIZON * mix(pale, view.sky, SKY_HORIZON_HUE), 5.0 * view.sky);
    let zenith = 1.25 * view.sky - 0.25 * horizon;
    let haze = min(mix(horizon, view.ground, SKY_HAZE), 5.0 * view.ground);
    let nadir = 1.25 * view.ground - 0.25 * haze;
    let place = sqrt(min(abs(direction.y), 1.0));
    let above = mix(horizon, zenith, place);
    let below = mix(haze, nadir, place);
    return mix(below, above, smoothstep(-SKY_EDGE, SKY_EDGE, direction.y));
}

// Mean radiance upon a surface, over the cosine: half of the sky and half of the ground where it stands upright.
fn sky_mean(normal: vec3f) -> vec3f {
    return mix(view.ground, view.sky, 0.5 + 0.5 * normal.y);
}

// What a surface of this roughness mirrors, in the direction that a smooth one would show.
fn sky_blurred(direction: vec3f, roughness: f32) -> vec3f {
    return mix(sky(direction), sky_mean(direction), saturate(roughness));
}

// Radiance of the lights' discs and their glow.
fn sky_suns(direction: vec3f) -> vec3f {
    var radiance = vec3f(0.0);
    for (var i = 0u; i < LIGHTS; i++) {
        let source = view_light(i);
        let toward = max(dot(direction, source.toward), 0.0);
        // A lobe 5.5° wide: wide enough to glitter, and as bright as a screen can show anyway.
        radiance += 9.0 * pow(toward, 420.0) * source.radiance;
    }
    return radiance;
}

// Whether the sky is behind everything, or a studio. Fixed when the pipeline is built: a software adapter would look up the sky, and
// the pixel's direction, for both.
override SKY_BEHIND: bool = true;

// What is behind everything, in the pixel at `position`.
fn background(position: vec2f) -> vec3f {
    if SKY_BEHIND {
        let direction = pixel_direction(position);
        return sky(direction) + select(vec3f(0.0), sky_suns(direction), direction.y > 0.0);
    }
    // A dim studio, brighter behind the middle of the picture.
    let size = vec2f(view.image_size);
    let from_middle = (position - 0.5 * size) / size.y;
    let falloff = exp(-1.6 * dot(from_middle, from_middle));
    return mix(vec3f(0.010, 0.012, 0.016), vec3f(0.060, 0.068, 0.080), falloff);
}
