// Fractal noise: octaves of gradient noise, plain (fBm), billowing or ridged. Composed after field/noise.wgsl.
// Specification: src/reference/noise_fractal.rs.

const NOISE_PLAIN: u32 = 0u;
const NOISE_BILLOW: u32 = 1u;
const NOISE_RIDGED: u32 = 2u;

struct NoiseFractal {
    contrast: f32,
    fold: u32,            // one of the above
}

@group(1) @binding(2) var<storage, read> fractal: NoiseFractal;
@group(1) @binding(3) var<storage, read> lattices: array<NoiseLattice>;

fn pattern(texel: vec2f) -> f32 {
    var sum = 0.0;
    // How much of an octave of ridges is left by the one before it.
    var share = 1.0;
    for (var octave = 0u; octave < params.count; octave++) {
        let lattice = lattices[octave];
        let n = noise_moving(lattice, texel);
        if fractal.fold == NOISE_RIDGED {
            let crest = 1.0 - min(abs(n), 1.0);
            let signal = share * crest * crest;
            sum += lattice.weight * signal;
            share = clamp(2.0 * signal, 0.0, 1.0);
        } else if fractal.fold == NOISE_BILLOW {
            sum += lattice.weight * abs(n);
        } else {
            sum += lattice.weight * n;
        }
    }
    let height = select(fractal.contrast * sum, 0.5 + 0.5 * fractal.contrast * sum, fractal.fold == NOISE_PLAIN);
    return clamp(height, 0.0, 1.0);
}
