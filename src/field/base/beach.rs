//! A beach: sand that rises from the sea in the south to dunes in the north.

use super::noise::{gradient_octaves, hash_u32, smoothstep};

/// Height at a position in sizes of the plane. The middle of its depth is reached a third of the way down.
pub(super) fn height(u: f64, v: f64, seed: u64) -> f64 {
    let salt = hash_u32(seed as u32 ^ hash_u32((seed >> 32) as u32));
    let noise = |scale: f64, offset: u32, octaves| gradient_octaves(u * scale, v * scale, salt.wrapping_add(offset), octaves);
    // A shore that swings to and fro.
    let down = v + 0.07 * (5.1 * u + 0.6).sin() + 0.03 * noise(3.0, 1, 3);
    let slope = 0.74 - 0.58 * smoothstep(-0.12, 1.0, down) - 0.12 * smoothstep(0.25, 0.8, down);
    // The bar on which waves break first.
    let bar = 0.05 * (-((down - 0.60) / 0.07).powi(2)).exp();
    let dunes = (0.16 + 0.10 * noise(4.0, 20, 4)) * (1.0 - smoothstep(0.02, 0.22, down));
    slope + bar + dunes.max(0.0) + 0.006 * noise(24.0, 40, 3)
}
