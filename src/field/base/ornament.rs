//! A carved panel that continues itself: a rosette in a square frame with leaves in its corners, one tile to the whole field.

use std::f64::consts::{FRAC_PI_4, PI, TAU};

use super::noise::{fractal_noise, smoothstep};

/// Height at texture coordinates. Mirror and quarter turns leave it as it is, but for the chisel's marks.
pub(super) fn height(u: f64, v: f64) -> f64 {
    // From the middle, the border at ±1; one eighth of the square stands for all.
    let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let border = x.abs().max(y.abs());
    let radius = x.hypot(y);
    let angle = y.atan2(x);

    // A groove between tiles, then a band with two fillets.
    let groove = 0.72 + 0.28 * smoothstep(0.99, 0.955, border);
    let band = hump(border, 0.885, 0.055);
    let fillet = hump(border, 0.795, 0.022);
    let field: f64 = 0.30;
    let mut height: f64 = field.max(0.92 * band).max(0.62 * fillet);

    // Sixteen petals in two rings of eight, each a ridge with a vein.
    for (ring, (tip, count, lift)) in [(0.66, 8.0, 0.72), (0.45, 8.0, 0.90)].into_iter().enumerate() {
        let turned = angle + if ring == 0 { 0.0 } else { PI / count };
        let off = (turned * count / TAU + 0.5).rem_euclid(1.0) - 0.5;
        // Half the petal's width along it: a teardrop.
        let along = radius / tip;
        let half = 0.46 * (1.0 - along.powi(3)).max(0.0).sqrt() * smoothstep(0.0, 0.35, along);
        let across = off.abs() / half.max(1e-6);
        if along < 1.0 && across < 1.0 {
            let vein = 0.10 * (1.0 - smoothstep(0.0, 0.14, across)) * smoothstep(0.95, 0.5, along);
            let petal = lift * (1.0 - across * across).sqrt() * (0.75 + 0.25 * smoothstep(1.0, 0.55, along)) - vein;
            height = height.max(petal);
        }
    }
    // The boss.
    let boss = 1.0 - (radius / 0.14).powi(2);
    if boss > 0.0 {
        height = height.max(0.80 + 0.18 * boss.sqrt());
    }
    let collar = hump(radius, 0.165, 0.028);
    height = height.max(0.86 * collar);

    // A leaf of five lobes in each corner, pointing outward.
    let (cx, cy) = (x.abs() - 0.52, y.abs() - 0.52);
    let (leaf_radius, leaf_angle) = (cx.hypot(cy), cy.atan2(cx) - FRAC_PI_4);
    let lobes = 0.205 * (0.62 + 0.38 * (2.5 * leaf_angle).cos().abs()) * smoothstep(PI, 1.6, leaf_angle.abs());
    let leaf = 1.0 - (leaf_radius / lobes.max(1e-6)).powi(2);
    if leaf > 0.0 {
        height = height.max(0.32 + 0.42 * leaf.sqrt());
    }

    // Tool marks. They end before the border, where the next tile begins.
    let marks = fractal_noise(u * 46.0, v * 46.0, 61, 3) - 0.5;
    (height * groove + 0.05 * marks * smoothstep(0.99, 0.93, border) * (1.0 - 0.5 * band)).clamp(0.0, 1.0)
}

/// A rounded moulding of this half width round `middle`: 1 on its crest, 0 beside it.
fn hump(at: f64, middle: f64, half: f64) -> f64 {
    (1.0 - ((at - middle) / half).powi(2)).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::height;

    #[test]
    fn it_continues_itself() {
        for step in 0..100 {
            let along = f64::from(step) / 100.0;
            assert!(height(0.0, along) == height(1.0, along) && height(along, 0.0) == height(along, 1.0));
        }
    }
}
