// Present: from the radiance of the traced picture to what a screen or a file shows.
//
//   radiance  rgba16float  read   linear, unbounded; `supersampling` pixels along each side of a shown one
//   target    sRGB         write  the format converts from linear, or the shader does where a window has no such format
//
// Where the picture is split, each side is mapped as what it shows asks for, and the divider stands between them. Legend and
// divider belong to the shown picture: no channel has them. Composed after common/legend.wgsl.

// Whether the target stores what is written: it is encoded to sRGB here.
override ENCODES: bool;
// Whether there are legends or a divider. A software adapter runs both sides of a branch: with the digits of legends that nobody sees a
// pass took 19 ms in place of 7 (1024×768 on lavapipe).
override ANNOTATED: bool;

struct PresentParams {
    supersampling: u32,
    divider: u32,       // the first shown column on the right side; 0: the picture is not split, all of it is the left side
    left: PresentSide,
    right: PresentSide,
}

struct PresentSide {
    tone_map: u32,      // 0: show the numbers as they are
    legend: f32,        // what the brightest heat stands for; 0: it has no legend
}

@group(1) @binding(0) var<storage, read> params: PresentParams;
@group(1) @binding(1) var radiance: texture_2d<f32>;

// What every pixel needs comes along: a software adapter reads a buffer lane by lane.
struct PresentVaryings {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) supersampling: u32,
    @location(1) @interpolate(flat) tone_maps: vec2u,   // of the left side and of the right
}

@vertex
fn cover(@builtin(vertex_index) index: u32) -> PresentVaryings {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    let tone_maps = vec2u(params.left.tone_map, params.right.tone_map);
    return PresentVaryings(vec4f(corner, 0.0, 1.0), params.supersampling, tone_maps);
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

// The divider: a line, and on it a handle to take it by.
fn divider(pixel: vec2i, height: i32) -> LegendInk {
    let from_line = pixel.x - i32(params.divider);
    let width = max(height / 600, 1);
    let handle = max(height / 60, 5);
    let from_middle = vec2f(f32(from_line) + 0.5, f32(pixel.y - height / 2) + 0.5);
    let inside = saturate(f32(handle) - length(from_middle) + 0.5);
    if inside > 0.0 {
        // Two arrowheads, pointing apart.
        let arrow = abs(from_middle) / f32(handle);
        let ink = arrow.x > 0.22 && arrow.x + arrow.y < 0.68;
        return LegendInk(select(vec3f(0.75), vec3f(0.05), ink), inside);
    }
    return LegendInk(vec3f(0.75), select(0.0, 0.9, from_line >= -width && from_line < width));
}

// What stands over a shown pixel: the legend of its side, and the divider.
fn annotated(colour: vec3f, pixel: vec2i, size: vec2i) -> vec3f {
    let splits = params.divider > 0u;
    let is_right = splits && pixel.x >= i32(params.divider);
    let corner = select(0, i32(params.divider), is_right);
    let width = select(select(size.x, i32(params.divider), splits), size.x - corner, is_right);
    let top = select(params.left.legend, params.right.legend, is_right);
    var shown = colour;
    if top > 0.0 {
        let ink = legend(pixel - vec2i(corner, 0), vec2i(width, size.y), top);
        shown = mix(shown, ink.colour, ink.cover);
    }
    if splits {
        let ink = divider(pixel, size.y);
        shown = mix(shown, ink.colour, ink.cover);
    }
    return shown;
}

@fragment
fn present(varyings: PresentVaryings) -> @location(0) vec4f {
    let pixel = vec2i(varyings.position.xy);
    let supersampling = varyings.supersampling;
    let is_right = ANNOTATED && params.divider > 0u && pixel.x >= i32(params.divider);
    let maps = select(varyings.tone_maps.x, varyings.tone_maps.y, is_right) == 1u;
    let first = vec2u(pixel) * supersampling;
    var colour = vec3f(0.0);
    for (var y = 0u; y < supersampling; y++) {
        for (var x = 0u; x < supersampling; x++) {
            let sample = textureLoad(radiance, first + vec2u(x, y), 0).rgb;
            // Mapped before the mean, or one bright highlight decides the pixel.
            colour += select(clamp(sample, vec3f(0.0), vec3f(1.0)), tone_map(sample), maps);
        }
    }
    colour /= f32(supersampling * supersampling);
    if ANNOTATED {
        colour = annotated(colour, pixel, vec2i(textureDimensions(radiance) / supersampling));
    }
    return vec4f(select(colour, srgb(colour), ENCODES), 1.0);
}
