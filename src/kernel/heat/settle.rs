//! What lumps gain in a step, and what the air takes of them.

use super::units::ROOM;
use crate::simd::{Lanes, MOST_LANES, Pass};
use std::sync::atomic::{AtomicI64, Ordering};

/// Gives lumps what they gain in a step, and the air what it takes of them.
pub(super) struct Settle<'a> {
    pub kelvin: &'a [f32],
    pub once: &'a [f32],
    pub surface: &'a [f32],
    pub held: &'a [f32],
    pub gained: &'a [i32],
    /// Quanta for each K of a length d of surface in a step.
    pub air: f32,
    /// How many steps' exchange what takes all at once has in this step beside its own.
    pub more: f32,
    /// Whether anything can change among [`MOST_LANES`] lumps that follow each other, an entry for so many; all can if it is empty.
    pub changes: &'a [bool],
    /// The first lump of those that are written.
    pub base: usize,
    /// In and out: heat, quanta.
    pub heat: &'a mut [i32],
    /// Out: what the air gets, quanta.
    pub to_air: &'a AtomicI64,
}

impl Pass for Settle<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { kelvin, once, surface, held, gained, air, more, changes, base, heat, to_air } = self;
        let (one, mut all) = (L::splat(1.0), 0);
        for (first, heat) in (base..).step_by(L::WIDTH).zip(heat.chunks_mut(L::WIDTH)) {
            if !changes.get(first / MOST_LANES).is_none_or(|changes| *changes) {
                continue;
            }
            let lumps = first..first + heat.len();
            let [kelvin, once, surface, held] =
                [kelvin, once, surface, held].map(|field| L::load(&field[lumps.clone()]));
            let open = L::splat(air) * (one + L::splat(more) * once) * surface;
            let given = open / (one + open / held) * (kelvin - L::splat(ROOM));
            let given = L::sums(given.add_rounded(L::no_sums()));
            for ((heat, gained), given) in heat.iter_mut().zip(&gained[lumps]).zip(given) {
                *heat = heat.saturating_add(gained.saturating_sub(given));
                all += i64::from(given);
            }
        }
        // A sum of whole numbers is the same in any order.
        to_air.fetch_add(all, Ordering::Relaxed);
    }
}
