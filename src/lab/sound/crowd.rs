//! Who is among others: a lump by itself, in the air, has nothing to rub against.

use crate::kernel::particles::Particles;
use glam::Vec2;

/// Edge of a cell, d: a full one has four.
const CELL: f32 = 2.0;

/// Lumps of a cell from which on each has company.
const COMPANY: u8 = 3;

/// Number of lumps on a coarse grid.
#[derive(Clone, Debug, Default)]
pub(super) struct Crowd {
    columns: usize,
    counts: Vec<u8>,
}

impl Crowd {
    /// Counts those in a box of `size` (d).
    pub(super) fn count(&mut self, particles: &Particles, size: Vec2) {
        let [columns, rows] = (size / CELL).to_array().map(|cells| cells.ceil().max(1.0) as usize);
        self.columns = columns;
        self.counts.clear();
        self.counts.resize(columns * rows, 0);
        for (x, y) in particles.x.iter().zip(&particles.y) {
            let cell = self.cell(Vec2::new(*x, *y));
            self.counts[cell] = self.counts[cell].saturating_add(1);
        }
    }

    /// Whether one at a point (d) is among others.
    pub(super) fn has_company(&self, at: Vec2) -> bool {
        self.counts[self.cell(at)] >= COMPANY
    }

    #[inline(always)]
    fn cell(&self, at: Vec2) -> usize {
        let column = ((at.x * (1.0 / CELL)) as usize).min(self.columns - 1);
        (((at.y * (1.0 / CELL)) as usize) * self.columns + column).min(self.counts.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::testing::{lattice, world};

    #[test]
    fn those_of_a_heap_have_company_and_one_that_flies_has_none() {
        let (mut crowd, flies) = (Crowd::default(), Vec2::new(17.3, 9.0));
        let mut places = lattice(6, 6, 1.0);
        places.push(flies);
        crowd.count(&world(places), Vec2::new(20.0, 10.0));
        assert!(crowd.has_company(Vec2::splat(3.0)) && !crowd.has_company(flies));
        assert!(!crowd.has_company(Vec2::new(1e9, f32::NAN)), "what is beyond the box counts as at its edge");
    }
}
