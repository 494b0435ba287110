// Dunes: sand in waves across the wind, gentle before the crest and steep behind it, with ripples on their backs. All of it
// travels as one; the ripples at their own speed. Composed after field/noise.wgsl. Specification: src/reference/noise_dunes.rs.

struct NoiseDunes {
    turns: vec2f,         // phase a texel, turns
    phase: f32,           // at the field's upper left corner, turns
    crest: f32,
    meander: f32,
    variety: f32,
    ripple_turns: vec2f,
    ripple_phase: f32,
    ripple_height: f32,
}

@group(1) @binding(2) var<storage, read> dunes: NoiseDunes;
// Where crests wander, in the large and in the small; how high they are; where ripples wander.
@group(1) @binding(3) var<storage, read> lattices: array<NoiseLattice>;

// How much the two sides differ where the rounded crest begins.
const DUNE_BRINK: f32 = 0.12;

// From the trough, where it is level, to the crest, where it breaks off.
fn dune_side(q: f32) -> f32 {
    return q * q * (2.0 - q);
}

// The lower of the two sides, rounded where they meet: a crest narrower than a few texels would show them as steps.
fn dune_crest(up: f32, down: f32) -> f32 {
    let share = clamp(0.5 + 0.5 * (down - up) / DUNE_BRINK, 0.0, 1.0);
    return mix(down, up, share) - DUNE_BRINK * share * (1.0 - share);
}

fn pattern(texel: vec2f) -> f32 {
    let wander = noise_still(lattices[0], texel) + 0.3 * noise_still(lattices[1], texel);
    let along = fract(dot(dunes.turns, texel) + dunes.phase + dunes.meander * wander);
    let up = along / dunes.crest;
    let down = (1.0 - along) / (1.0 - dunes.crest);
    let height = 1.0 - dunes.variety * clamp(0.5 + noise_still(lattices[2], texel), 0.0, 1.0);
    let dune = height * dune_side(dune_crest(up, down));

    let ripple_along = fract(dot(dunes.ripple_turns, texel) + dunes.ripple_phase + 0.9 * noise_still(lattices[3], texel));
    let ripple = dune_side(min(ripple_along / 0.65, (1.0 - ripple_along) / 0.35));
    // They die away toward the crest, and there are none where sand slides.
    let grown = clamp(3.0 * up, 0.0, 1.0) * clamp(6.0 * (1.0 - up), 0.0, 1.0);
    return dune * (1.0 - dunes.ripple_height) + dunes.ripple_height * grown * ripple;
}
