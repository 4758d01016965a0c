//! How crowded matter is, as far as it makes passes over neighbours dearer.

use crate::particles::Particles;
use glam::Vec2;

/// Edge of the cells that neighbours are counted in, d: as far as the widest kernel of a quality reaches.
const REACH: f32 = 3.0;

/// Counts neighbours. Keeps its buffer.
#[derive(Clone, Debug, Default)]
pub struct Crowding {
    counts: Vec<u32>,
}

impl Crowding {
    /// Particles in the nine cells around each, as a multiple of those of the lattice, on the mean; 1 at least. Matter that is
    /// heaped to twice its density has twice as many neighbours. `size`: the box, d.
    pub fn of(&mut self, particles: &Particles, size: Vec2) -> f32 {
        let (columns, rows) = ((size.x / REACH) as usize + 3, (size.y / REACH) as usize + 3);
        self.counts.clear();
        self.counts.resize(columns * rows, 0);
        let place = |i: usize| {
            let along = |x: f32, cells: usize| ((x / REACH) as usize + 1).min(cells - 2);
            along(particles.y[i], rows) * columns + along(particles.x[i], columns)
        };
        (0..particles.len()).for_each(|i| self.counts[place(i)] += 1);
        let around = |k: usize| -> u64 {
            let row = |k: usize| self.counts[k - 1..=k + 1].iter().map(|count| u64::from(*count)).sum::<u64>();
            row(k - columns) + row(k) + row(k + columns)
        };
        let pairs: u64 = (0..particles.len()).map(|i| around(place(i))).sum();
        (pairs as f32 / (9.0 * REACH * REACH * particles.len().max(1) as f32)).max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Crowding;
    use crate::{element::ElementId, particles::Particles};
    use glam::Vec2;

    #[test]
    fn crowding_is_counted_in_neighbours_of_the_lattice() {
        let size = Vec2::new(90.0, 60.0);
        let mut particles = Particles::default();
        let mut crowding = Crowding::default();
        assert_eq!(crowding.of(&particles, size), 1.0, "nothing is no crowd");
        // Cells at the walls have fewer around them.
        let within = |cells: f32| (3.0 * cells - 2.0) / (3.0 * cells);
        let layer = within(30.0) * within(20.0);
        for layers in 1..=3_u16 {
            for k in 0..90 * 60 {
                let at = Vec2::new((k % 90) as f32 + 0.5, (k / 90) as f32 + 0.5);
                particles.push(particles.len() as u32, ElementId(0), at, Vec2::ZERO);
            }
            let (found, expected) = (crowding.of(&particles, size), (f32::from(layers) * layer).max(1.0));
            assert!((found - expected).abs() < 1e-3, "{found} and not {expected} in {layers} layers");
        }
    }
}
