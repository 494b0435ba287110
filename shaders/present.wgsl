// Present: from the radiance of the traced picture to what a screen or a file shows.
//
//   radiance  rgba16float  read   linear, unbounded; `supersampling` pixels along each side of a shown one
//   target    sRGB         write  the format converts from linear, or the shader does where a window has no such format
//
// Where the picture is split, each side is mapped as what it shows asks for, and the divider stands between them. Legend and
// divider belong to the shown picture: no channel has them. Composed after common/legend.wgsl.

struct PresentParams {
    supersampling: u32,
    encode: u32,        // 1: the target stores what is written; encode to sRGB here
    divider: u32,       // the first shown column on the right side; 0: the picture is not split, all of it is the left side
    pad: u32,
    left: PresentSide,
    right: PresentSide,
}

struct PresentSide {
    tone_map: u32,      // 0: show the numbers as they are
    legend: f32,        // what the brightest heat stands for; 0: it has no legend
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

@fragment
fn present(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(radiance) / params.supersampling);
    let pixel = vec2i(position.xy);
    let splits = params.divider > 0u;
    var side = params.left;
    var corner = 0;
    var width = select(size.x, i32(params.divider), splits);
    if splits && pixel.x >= width {
        side = params.right;
        corner = width;
        width = size.x - corner;
    }
    let first = vec2u(position.xy) * params.supersampling;
    var colour = vec3f(0.0);
    for (var y = 0u; y < params.supersampling; y++) {
        for (var x = 0u; x < params.supersampling; x++) {
            let sample = textureLoad(radiance, first + vec2u(x, y), 0).rgb;
            // Mapped before the mean, or one bright highlight decides the pixel.
            colour += select(clamp(sample, vec3f(0.0), vec3f(1.0)), tone_map(sample), side.tone_map == 1u);
        }
    }
    colour /= f32(params.supersampling * params.supersampling);
    if side.legend > 0.0 {
        let ink = legend(pixel - vec2i(corner, 0), vec2i(width, size.y), side.legend);
        colour = mix(colour, ink.colour, ink.cover);
    }
    if splits {
        let ink = divider(pixel, size.y);
        colour = mix(colour, ink.colour, ink.cover);
    }
    return vec4f(select(colour, srgb(colour), params.encode == 1u), 1.0);
}
