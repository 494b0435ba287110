//! What is known of shallow water in closed form.

use std::f64::consts::{PI, TAU};

/// Gravity of the closed forms, m/s².
pub const GRAVITY: f64 = 9.81;

/// A dam of depth 1 m that broke at time 0, over ground that is dry or under water.
#[derive(Clone, Copy, Debug)]
pub struct Dam {
    /// Depth in front of it, metres; 0: dry.
    pub front: f64,
    /// Depth between the rarefaction and the shock (Stoker 1957).
    pub middle: f64,
    /// Velocity there, m/s.
    pub velocity: f64,
    /// Speed of the shock, or on dry ground of the tip (Ritter 1892), m/s.
    pub fastest: f64,
}

impl Dam {
    /// A dam in front of which there is so much water.
    pub fn new(front: f64) -> Self {
        let celerity = GRAVITY.sqrt();
        if front == 0.0 {
            return Self { front, middle: 0.0, velocity: 2.0 * celerity, fastest: 2.0 * celerity };
        }
        // The rarefaction's velocity at a depth falls with it, the shock's grows: they meet once.
        let through_fan = |depth: f64| 2.0 * (celerity - (GRAVITY * depth).sqrt());
        let through_shock = |depth: f64| (depth - front) * (0.5 * GRAVITY * (depth + front) / (depth * front)).sqrt();
        let (mut low, mut high) = (front, 1.0);
        for _ in 0..100 {
            let depth = 0.5 * (low + high);
            if through_fan(depth) > through_shock(depth) {
                low = depth;
            } else {
                high = depth;
            }
        }
        let velocity = through_fan(low);
        Self { front, middle: low, velocity, fastest: low * velocity / (low - front) }
    }

    /// Depth where the way from the dam, toward the front, over the time is so fast.
    pub fn depth(&self, metres_per_second: f64) -> f64 {
        let celerity = GRAVITY.sqrt();
        if metres_per_second <= -celerity {
            1.0
        } else if metres_per_second <= self.velocity - (GRAVITY * self.middle).sqrt() {
            (2.0 * celerity - metres_per_second).powi(2) / (9.0 * GRAVITY)
        } else if metres_per_second < self.fastest {
            self.middle
        } else {
            self.front
        }
    }
}

/// Thacker's paraboloid of water that swells and shrinks in a paraboloid basin (J. Fluid Mech. 107, 1981).
#[derive(Clone, Copy, Debug)]
pub struct Thacker {
    /// Radius of the basin at its rest level, metres.
    pub basin: f64,
    /// Radius of the water at its narrowest, metres.
    pub narrowest: f64,
    /// Depth of the basin's middle under the rest level, metres.
    pub middle: f64,
}

impl Thacker {
    fn rate(&self) -> f64 {
        (8.0 * GRAVITY * self.middle).sqrt() / self.basin
    }

    /// Seconds from narrowest to narrowest.
    pub fn period(&self) -> f64 {
        TAU / self.rate()
    }

    /// Height of the bed at a distance from the middle, metres.
    pub fn bed(&self, distance: f64) -> f64 {
        -self.middle * (1.0 - (distance / self.basin).powi(2))
    }

    /// Depth at a distance and a time.
    pub fn depth(&self, distance: f64, seconds: f64) -> f64 {
        let [basin, narrow] = [self.basin, self.narrowest].map(|radius| radius * radius);
        let amplitude = (basin - narrow) / (basin + narrow);
        let swing = 1.0 - amplitude * (self.rate() * seconds).cos();
        let squared = 1.0 - amplitude * amplitude;
        let surface =
            self.middle * (squared.sqrt() / swing - 1.0 - (distance / self.basin).powi(2) * (squared / (swing * swing) - 1.0));
        (surface - self.bed(distance)).max(0.0)
    }
}

/// Seconds of the longest standing wave between two walls.
pub fn seiche_period(metres: f64, depth: f64) -> f64 {
    2.0 * metres / (GRAVITY * depth).sqrt()
}

/// Its shape between the walls, 1 to −1.
pub fn seiche(share: f64) -> f64 {
    (PI * share).cos()
}
