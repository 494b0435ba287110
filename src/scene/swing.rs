//! Swing: how a camera looks at something from either side, and never from behind.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// A sinusoidal turn of the eye about the vertical through the target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Swing {
    /// How far it turns to either side, degrees.
    pub degrees: f64,
    /// From one side to the other and back, seconds.
    pub period_seconds: f64,
}

impl Swing {
    /// The turn at a time, degrees: at 0 none, and as fast as it becomes.
    pub fn at(&self, time_seconds: f64) -> f64 {
        self.degrees * (TAU * time_seconds / self.period_seconds).sin()
    }
}
