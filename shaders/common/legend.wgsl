// Legend: a bar of heat with numbers beside it, drawn over the upper right corner of a view of numbers.
//
// Needs common/heat.

// Digits 0 to 9 and a point, three columns by five rows of bits, the upper left one the highest of fifteen.
const LEGEND_GLYPHS = array<u32, 11>(
    0x7b6fu, 0x2c97u, 0x73e7u, 0x73cfu, 0x5bc9u, 0x79cfu, 0x79efu, 0x7249u, 0x7befu, 0x7bcfu, 0x0002u,
);
const LEGEND_POINT: u32 = 10u;

// The bar's edges, dots from the right and from above. Four numbers, not a vector: naga 30 finds a function invalid that takes constant
// vectors apart, once a pipeline has constants of its own.
const LEGEND_BAR_RIGHT: i32 = 6;
const LEGEND_BAR_LEFT: i32 = 14;
const LEGEND_BAR_TOP: i32 = 10;
const LEGEND_BAR_BOTTOM: i32 = 74;

// What is drawn, and how much of what is beneath it covers.
struct LegendInk {
    colour: vec3f,
    cover: f32,
}

fn legend_glyph(glyph: u32, dot: vec2i) -> bool {
    if any(dot < vec2i(0)) || dot.x > 2 || dot.y > 4 {
        return false;
    }
    let glyphs = LEGEND_GLYPHS;
    return ((glyphs[glyph] >> u32(14 - 3 * dot.y - dot.x)) & 1u) == 1u;
}

// Whether a number, written in three significant digits and ending at x = 0, has ink on this dot. Whole numbers of three digits
// and more stand without a point.
fn legend_number(value: f32, dot: vec2i) -> bool {
    let rounded = max(value, 0.0);
    var decimals = 0;
    if rounded > 0.0 {
        decimals = clamp(2 - i32(floor(log2(rounded) / log2(10.0) + 1e-4)), 0, 4);
    }
    var digits = u32(round(rounded * pow(10.0, f32(decimals))));
    // Noughts behind the point say nothing.
    while decimals > 0 && digits % 10u == 0u {
        digits /= 10u;
        decimals -= 1;
    }
    var place = 0;
    var right = 0;
    var inked = false;
    while !inked && place <= 9 {
        if place == decimals && decimals > 0 {
            inked = legend_glyph(LEGEND_POINT, dot - vec2i(right - 3, 0));
            right -= 3;
        }
        inked = inked || legend_glyph(digits % 10u, dot - vec2i(right - 3, 0));
        digits /= 10u;
        right -= 4;
        place += 1;
        if digits == 0u && place > decimals {
            break;
        }
    }
    return inked;
}

// The legend at a pixel of an area so many pixels wide and high, from whose upper left corner the pixel is counted; `top` is the
// number that the brightest heat stands for.
fn legend(pixel: vec2i, size: vec2i, top: f32) -> LegendInk {
    let none = LegendInk(vec3f(0.0), 0.0);
    // Two pixels a dot at 300 lines, three at 490. An area that it would fill has none.
    let dot_pixels = max((size.y + 80) / 190, 1);
    let dot = (vec2i(size.x, 0) - pixel) * vec2i(1, -1) / dot_pixels;
    if size.x < 96 * dot_pixels || size.y < 96 * dot_pixels {
        return none;
    }
    let left = 38;
    if dot.x > left || dot.y > 82 || dot.x < 2 || dot.y < 2 {
        return none;
    }
    let share = f32(LEGEND_BAR_BOTTOM - dot.y) / f32(LEGEND_BAR_BOTTOM - LEGEND_BAR_TOP);
    if dot.x >= LEGEND_BAR_RIGHT && dot.x < LEGEND_BAR_LEFT && dot.y >= LEGEND_BAR_TOP && dot.y <= LEGEND_BAR_BOTTOM {
        return LegendInk(heat(share), 1.0);
    }
    for (var mark = 0; mark <= 2; mark++) {
        let at = mix(f32(LEGEND_BAR_BOTTOM), f32(LEGEND_BAR_TOP), 0.5 * f32(mark));
        let origin = vec2i(LEGEND_BAR_LEFT + 2, i32(at) - 2);
        if legend_number(top * 0.5 * f32(mark), vec2i(origin.x - dot.x, dot.y - origin.y)) {
            return LegendInk(vec3f(0.9), 1.0);
        }
    }
    return LegendInk(vec3f(0.012), 0.8);
}
