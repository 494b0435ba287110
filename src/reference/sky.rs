//! The sky. Specification of `shaders/surface/sky.wgsl`.

use glam::DVec3;

/// What a sky is made of: mean radiance from above and from below the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// From above.
    pub above: DVec3,
    /// From below.
    pub below: DVec3,
}

impl Sky {
    /// Radiance from a unit direction, lights apart.
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let luminance = self.above.dot(DVec3::new(0.2126, 0.7152, 0.0722));
        let horizon = (1.8 * (0.45 * luminance + 0.55 * self.above)).min(5.0 * self.above);
        // The mean over the cosine of horizon + (zenith − horizon) √y is a fifth of the one and four fifths of the other.
        let zenith = (self.above - 0.2 * horizon) / 0.8;
        let haze = (0.5 * horizon + 0.5 * self.below).min(5.0 * self.below);
        let nadir = (self.below - 0.2 * haze) / 0.8;
        let place = direction.y.abs().min(1.0).sqrt();
        let overhead = horizon + (zenith - horizon) * place;
        let underneath = haze + (nadir - haze) * place;
        let edge = ((direction.y / 0.009 + 1.0) / 2.0).clamp(0.0, 1.0);
        underneath + (overhead - underneath) * (edge * edge * (3.0 - 2.0 * edge))
    }

    /// Mean radiance upon a surface, over the cosine.
    pub fn mean(&self, normal: DVec3) -> DVec3 {
        self.below + (self.above - self.below) * (0.5 + 0.5 * normal.y)
    }
}
