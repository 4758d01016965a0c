//! What a substep does to a row of warm air (`warmth`).

use super::pressure::VACUUM;
use crate::simd::{Lanes, lane_starts};
use glam::Vec2;

/// Faint warmth that is none: far below f32's resolution of the pressure that it would cause, far above denormals, even when
/// shares multiply it.
const COLD: f32 = 1.0e-9;

/// What a substep does to the velocity of warm air.
#[derive(Clone, Copy)]
pub(super) struct Lift {
    /// `−2 g dt`, d/s.
    pub(super) pull: Vec2,
}

impl Lift {
    /// Adds to the momentum of a row.
    #[inline(always)]
    pub(super) fn run(&self, pressure: &[f32], warmth: &[f32], [x, y]: [&mut [f32]; 2]) {
        // No lanes, which may overlap: what is added to would be added to twice.
        for (((x, y), p), warmth) in x.iter_mut().zip(y).zip(pressure).zip(warmth) {
            let mass = p * (warmth / (warmth + 2.0));
            *x += mass * self.pull.x;
            *y += mass * self.pull.y;
        }
    }
}

/// Warmth of a row, of mass times warmth and mass, both with a column more on either side that stays as cold as the surroundings.
#[inline(always)]
pub(super) fn share_out<L: Lanes>(carried: &[f32], mass: &[f32], warmth: &mut [f32]) {
    let n = warmth.len();
    for i in lane_starts::<L>(n) {
        let (mass, zero) = (L::of(mass, i), L::splat(0.0));
        let shared = L::of(carried, i) / mass;
        let shared = mass.if_less(L::splat(VACUUM), zero, shared);
        shared.abs().if_less(L::splat(COLD), zero, shared).put(warmth, i);
    }
    (warmth[0], warmth[n - 1]) = (0.0, 0.0);
}

/// Highest e of a row.
pub(super) fn highest(pressure: &[f32], warmth: &[f32]) -> f32 {
    pressure.iter().zip(warmth).map(|(p, warmth)| p + p * warmth).fold(0.0, f32::max)
}
