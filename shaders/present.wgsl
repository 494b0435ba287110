// Present: from the radiance of the traced picture to what a screen or a file shows.
//
//   radiance  rgba16float  read   linear, unbounded; `supersampling` pixels along each side of a shown one
//   target    sRGB         write  the format converts from linear, or the shader does where a window has no such format

struct PresentParams {
    supersampling: u32,
    encode: u32,        // 1: the target stores what is written; encode to sRGB here
    tone_map: u32,      // 0: show the numbers as they are
    pad: u32,
}

@group(1) @binding(0) var<storage, read> params: PresentParams;
@group(1) @binding(1) var radiance: texture_2d<f32>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return vec4f(corner, 0.0, 1.0);
}

// Khronos PBR Neutral (2024): leaves colours below 0.8 as they are, and desaturates highlights instead of shifting their hue.
fn tone_map(colour: vec3f) -> vec3f {
    let start = 0.8 - 0.04;
    let lowest = min(colour.r, min(colour.g, colour.b));
    let offset = select(0.04, lowest - 6.25 * lowest * lowest, lowest < 0.08);
    let shifted = colour - offset;
    let peak = max(shifted.r, max(shifted.g, shifted.b));
    if peak < start {
        return shifted;
    }
    let room = 1.0 - start;
    let compressed = 1.0 - room * room / (peak + room - start);
    let whiteness = 1.0 - 1.0 / (0.15 * (peak - compressed) + 1.0);
    return mix(shifted * (compressed / peak), vec3f(compressed), whiteness);
}

fn srgb(linear: vec3f) -> vec3f {
    return select(1.055 * pow(linear, vec3f(1.0 / 2.4)) - 0.055, 12.92 * linear, linear <= vec3f(0.0031308));
}

@fragment
fn present(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let first = vec2u(position.xy) * params.supersampling;
    var colour = vec3f(0.0);
    for (var y = 0u; y < params.supersampling; y++) {
        for (var x = 0u; x < params.supersampling; x++) {
            let sample = textureLoad(radiance, first + vec2u(x, y), 0).rgb;
            // Mapped before the mean, or one bright highlight decides the pixel.
            colour += select(clamp(sample, vec3f(0.0), vec3f(1.0)), tone_map(sample), params.tone_map == 1u);
        }
    }
    colour /= f32(params.supersampling * params.supersampling);
    return vec4f(select(colour, srgb(colour), params.encode == 1u), 1.0);
}
