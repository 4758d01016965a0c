//! Particles at one point are set apart.

use crate::{
    bins::Strip,
    params::Domain,
    random::{mix, unit},
    simd::{InstructionSet, Lanes, Pass},
    solids::Solids,
};
use glam::Vec2;
use std::sync::atomic::{AtomicU64, Ordering};

/// Closer than this in both coordinates counts as one point, d.
const COINCIDENT: f32 = 1e-3;
/// Largest offset in each coordinate, d.
const APART: f32 = 0.05;
/// Particles before it that each is compared with.
const LOOK_BACK: usize = 4;
/// Particles that are compared side by side.
const BLOCK: usize = 64;

/// Particles at one point have no direction to part in (the spiky gradient is 0/0 there); equal ones among the last few
/// of the sorted order are set apart by a small offset that only depends on the id and stays in the cell. Where it would
/// end in rock or beyond a wall it is turned round: in a corner, those that it drove into the corner would stay at one
/// point for ever, and what came after would push them in further. `count` gains the number of those that were set apart.
pub(super) fn separate_coincident(
    strip: Strip,
    instructions: InstructionSet,
    domain: &Domain,
    solids: &Solids,
    count: &AtomicU64,
) {
    instructions.run(Separate { strip, domain, solids, count });
}

struct Separate<'a> {
    strip: Strip<'a>,
    domain: &'a Domain,
    solids: &'a Solids,
    /// Counts the particles that were set apart.
    count: &'a AtomicU64,
}

impl Pass for Separate<'_> {
    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let count = self.strip.x.len();
        (1..count.min(LOOK_BACK)).for_each(|i| self.separate(i));
        for first in (LOOK_BACK..count).step_by(BLOCK) {
            let end = count.min(first + BLOCK);
            if self.any_near(first, end) {
                (first..end).for_each(|i| self.separate(i));
            }
        }
    }
}

impl Separate<'_> {
    /// Whether any of the particles `first … end` is at the point of one before it.
    #[inline(always)]
    fn any_near(&self, first: usize, end: usize) -> bool {
        let Strip { x, y, .. } = &self.strip;
        let mut any = false;
        for back in 1..=LOOK_BACK {
            let own = x[first..end].iter().zip(&y[first..end]);
            let before = x[first - back..].iter().zip(&y[first - back..]);
            for ((x, y), (x_before, y_before)) in own.zip(before) {
                any |= ((x - x_before).abs() < COINCIDENT) & ((y - y_before).abs() < COINCIDENT);
            }
        }
        any
    }

    fn separate(&mut self, i: usize) {
        let Self { strip, domain, solids, count } = self;
        let near =
            |j: usize| (strip.x[i] - strip.x[j]).abs() < COINCIDENT && (strip.y[i] - strip.y[j]).abs() < COINCIDENT;
        if (i.saturating_sub(LOOK_BACK)..i).any(near) {
            let mixed = mix(strip.id(i));
            let from = Vec2::new(strip.x[i], strip.y[i]);
            let free = |to: Vec2| domain.keep_inside(to) == to && !solids.is_solid(Solids::cell_of(to));
            let offset = strip.turn_inwards(i, APART * Vec2::new(unit(mixed), unit(mixed >> 16)), free);
            let to = solids.sweep(from, from + offset);
            (strip.x[i], strip.y[i]) = (to.x, to.y);
            count.fetch_add(1, Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::LOOK_BACK;
    use crate::{
        element::ElementId,
        params::{Domain, Preset, WALL_GAP},
        particles::Particles,
        pbf::Solver,
        solids::Solids,
    };
    use glam::{IVec2, Vec2};

    /// How many of 40 particles at one point are still there once they were binned.
    fn left_at(corner: Vec2, solids: &Solids) -> usize {
        let (mut particles, mut solver) = (Particles::default(), Solver::default());
        (0..40).for_each(|id| particles.push(id, ElementId(0), corner, Vec2::ZERO));
        let domain = Domain { size: Vec2::splat(20.0), gravity: Vec2::ZERO };
        solver.bin(&mut particles, solids, &domain, &Preset::Fast.quality(), 1.0, 1);
        (0..particles.len()).filter(|&i| particles.position(i).distance(corner) < 1e-3).count()
    }

    #[test]
    fn particles_in_a_corner_are_set_apart_whatever_their_ids() {
        let mut solids = Solids::new(20, 20);
        for cell in [IVec2::new(8, 7), IVec2::new(7, 7), IVec2::new(8, 8), IVec2::new(7, 9), IVec2::new(8, 9)] {
            solids.insert(cell, ElementId(1), 0);
        }
        // The first stays, and so does each that has looked back on none but those that have gone.
        for corner in [Vec2::new(7.996, 8.004), Vec2::new(7.996, 8.996), Vec2::splat(WALL_GAP), Vec2::new(19.75, 0.25)]
        {
            let left = left_at(corner, &solids);
            assert!(left <= 40 / (LOOK_BACK + 1) + 1, "{left} of 40 are left in the corner at {corner}");
        }
    }
}
