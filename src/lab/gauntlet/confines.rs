//! Where the particles of a case may be.

use glam::DVec2;
use serde::Deserialize;

/// Where particles may be, m.
#[derive(Clone, Debug, Deserialize)]
pub(super) enum Confines {
    /// In a rectangle.
    Inside { min: (f64, f64), max: (f64, f64) },
    /// Not inside a rectangle.
    Outside { min: (f64, f64), max: (f64, f64) },
    /// Where `a x + b y ≥ c` for each of these (a, b, c).
    Sides(Vec<(f64, f64, f64)>),
}

impl Confines {
    /// Whether a particle may be there.
    pub fn hold(&self, at: DVec2) -> bool {
        match self {
            Self::Inside { min, max } => (min.0..=max.0).contains(&at.x) && (min.1..=max.1).contains(&at.y),
            Self::Outside { min, max } => at.x <= min.0 || at.x >= max.0 || at.y <= min.1 || at.y >= max.1,
            Self::Sides(sides) => sides.iter().all(|(a, b, c)| a * at.x + b * at.y >= *c),
        }
    }
}
