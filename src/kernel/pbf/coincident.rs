//! Particles at one point are set apart.

use crate::kernel::{
    params::Domain,
    pbf::{mix, unit},
    simd::{InstructionSet, Lanes, Pass},
    solids::Solids,
};
use glam::Vec2;

/// Closer than this in both coordinates counts as one point, d.
const COINCIDENT: f32 = 1e-4;
/// Largest offset in each coordinate, d.
const APART: f32 = 0.05;
/// Particles before it that each is compared with.
const LOOK_BACK: usize = 4;
/// Particles that are compared side by side.
const BLOCK: usize = 64;

/// Particles at one point have no direction to part in (the spiky gradient is 0/0 there); equal ones among the last few
/// of the sorted order are set apart by a small offset that only depends on the id. Rock and walls stop it.
pub(super) fn separate_coincident(
    id: &[u32],
    x: &mut [f32],
    y: &mut [f32],
    instructions: InstructionSet,
    domain: &Domain,
    solids: &Solids,
) {
    instructions.run(Separate { id, x, y, domain, solids });
}

struct Separate<'a> {
    id: &'a [u32],
    x: &'a mut [f32],
    y: &'a mut [f32],
    domain: &'a Domain,
    solids: &'a Solids,
}

impl Pass for Separate<'_> {
    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        for first in (0..self.x.len()).step_by(BLOCK) {
            let end = self.x.len().min(first + BLOCK);
            if first == 0 || self.any_near(first, end) {
                (first.max(1)..end).for_each(|i| self.separate(i));
            }
        }
    }
}

impl Separate<'_> {
    /// Whether any of the particles `first … end` is at the point of one before it.
    #[inline(always)]
    fn any_near(&self, first: usize, end: usize) -> bool {
        let mut any = false;
        for back in 1..=LOOK_BACK {
            let own = self.x[first..end].iter().zip(&self.y[first..end]);
            let before = self.x[first - back..].iter().zip(&self.y[first - back..]);
            for ((x, y), (x_before, y_before)) in own.zip(before) {
                any |= ((x - x_before).abs() < COINCIDENT) & ((y - y_before).abs() < COINCIDENT);
            }
        }
        any
    }

    fn separate(&mut self, i: usize) {
        let Self { id, x, y, domain, solids } = self;
        let near = |j: usize| (x[i] - x[j]).abs() < COINCIDENT && (y[i] - y[j]).abs() < COINCIDENT;
        if (i.saturating_sub(LOOK_BACK)..i).any(near) {
            let mixed = mix(id[i]);
            let (from, offset) = (Vec2::new(x[i], y[i]), APART * Vec2::new(unit(mixed), unit(mixed >> 16)));
            let to = solids.sweep(from, domain.keep_inside(from + offset));
            (x[i], y[i]) = (to.x, to.y);
        }
    }
}
