//! What box walls stand for in the exchange: a lattice of matter as warm as the lump, so that nothing passes them and nothing is
//! exposed to them.

use super::weights::{REACH, WEIGHT};
use glam::Vec2;

/// Entries of the table.
const ENTRIES: usize = 32;

/// The weights of the lattice beyond a wall, by the distance to it.
#[derive(Clone, Debug)]
pub(super) struct Walls([f32; ENTRIES + 1]);

impl Default for Walls {
    fn default() -> Self {
        // A row of it: ∫ (1 − (x² + y²)/h²)² dx = 16/15 h (1 − y²/h²)^(5/2).
        let h = f64::from(REACH);
        let row = |y: f64| {
            let left = (1.0 - y * y / (h * h)).max(0.0);
            f64::from(WEIGHT) * (16.0 / 15.0) * h * left * left * left.sqrt()
        };
        // The first of them stands half a spacing behind the wall.
        let beyond = |k: usize| {
            let distance = h * k as f64 / ENTRIES as f64 + 0.5;
            (0..3).map(|m| row(distance + f64::from(m))).sum::<f64>() as f32
        };
        Self(std::array::from_fn(beyond))
    }
}

impl Walls {
    /// The weights beyond the walls of a box of a size (d), for a lump at a place.
    #[inline(always)]
    pub fn around(&self, at: Vec2, size: Vec2) -> f32 {
        let far = size - at;
        [at.x, at.y, far.x, far.y].map(|distance| self.beyond(distance)).iter().sum()
    }

    /// The weights beyond a wall at `distance` d.
    #[inline(always)]
    fn beyond(&self, distance: f32) -> f32 {
        if distance >= REACH {
            return 0.0;
        }
        let at = distance.max(0.0) * (ENTRIES as f32 / REACH);
        let k = (at as usize).min(ENTRIES - 1);
        self.0[k] + (self.0[k + 1] - self.0[k]) * (at - k as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_stands_for_the_lattice_beyond_it() {
        let walls = Walls::default();
        // A lump half a spacing before it misses the rows at 1 and 2 d.
        let row = |y: i32| -> f32 {
            let weight = |x: i32| (1.0 - (x * x + y * y) as f32 / (REACH * REACH)).max(0.0);
            (-3..=3).map(|x| WEIGHT * weight(x) * weight(x)).sum()
        };
        let missing = row(1) + row(2);
        assert!((walls.beyond(0.5) / missing - 1.0).abs() < 0.03, "{} for {missing}", walls.beyond(0.5));
        assert!((walls.beyond(1.5) / row(2) - 1.0).abs() < 0.03, "{} for {}", walls.beyond(1.5), row(2));
        assert_eq!(walls.beyond(REACH), 0.0);
    }
}
