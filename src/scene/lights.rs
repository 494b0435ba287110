//! Lights: the scene's own, and up to three beside it.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Light, Scene, exactly};

/// How many lights there may be in all. Each that casts shadows costs a shadow ray a pixel.
pub const LIGHTS_MAX: usize = 4;

/// A directional light beside the scene's own, `[[lights]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DirectionalLight {
    /// Direction toward the light: degrees from +x toward +z.
    pub azimuth_degrees: f32,
    /// Direction toward the light: degrees above the plane.
    pub elevation_degrees: f32,
    /// Its colour, linear.
    #[serde(deserialize_with = "exactly")]
    pub colour: [f32; 3],
    /// Its irradiance over π: a white surface that faces it has this radiance.
    pub intensity: f32,
    /// Degrees a second that the light travels round the vertical.
    pub turn_degrees_per_second: f32,
    /// Whether the relief hides it from itself.
    pub casts_shadow: bool,
}

/// What is behind everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum Background {
    /// A dim studio.
    #[default]
    Studio = 0,
    /// The sky that surfaces mirror, with its suns.
    Sky = 1,
}

impl Background {
    /// Both.
    pub const ALL: &'static [Self] = &[Self::Studio, Self::Sky];

    /// What the panel calls it.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Studio => "A dim studio",
            Self::Sky => "The sky",
        }
    }
}

impl DirectionalLight {
    /// The scene's own light, as one of several.
    pub fn of(light: &Light) -> Self {
        Self {
            azimuth_degrees: light.azimuth_degrees,
            elevation_degrees: light.elevation_degrees,
            colour: light.colour,
            intensity: light.intensity,
            turn_degrees_per_second: light.turn_degrees_per_second,
            casts_shadow: light.casts_shadow,
        }
    }

    /// The unit direction toward it at a time, in the world.
    pub fn direction(&self, time_seconds: f64) -> DVec3 {
        let turned = f64::from(self.turn_degrees_per_second) * time_seconds;
        let azimuth = (f64::from(self.azimuth_degrees) + turned).to_radians();
        let elevation = f64::from(self.elevation_degrees).to_radians();
        DVec3::new(elevation.cos() * azimuth.cos(), elevation.sin(), elevation.cos() * azimuth.sin())
    }
}

impl Scene {
    /// Every light, the scene's own first.
    pub fn all_lights(&self) -> Vec<DirectionalLight> {
        std::iter::once(DirectionalLight::of(&self.light)).chain(self.lights.iter().cloned()).take(LIGHTS_MAX).collect()
    }
}

impl Default for DirectionalLight {
    /// A cool light from the other side, to fill the shadows of the scene's own.
    fn default() -> Self {
        Self {
            azimuth_degrees: 35.0,
            elevation_degrees: 30.0,
            colour: [0.62, 0.78, 1.0],
            intensity: 0.6,
            turn_degrees_per_second: 0.0,
            casts_shadow: true,
        }
    }
}
