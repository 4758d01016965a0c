//! What two lumps exchange in a step.

use crate::simd::Lanes;

/// What the flows of a step go by. The fields have an entry a lump.
#[derive(Clone, Copy)]
pub(super) struct Exchanged<'a> {
    /// Quanta for each W/mK K of a pair's `k′ w ΔT` in a step.
    pub pairs: f32,
    pub kelvin: &'a [f32],
    /// √k′, √(W/mK).
    pub conduction: &'a [f32],
    pub allowance: &'a [f32],
    /// 1 for lumps that take a whole tick's exchange at once, else 0.
    pub once: &'a [f32],
    /// How many steps' exchange two of those have in this step beside its own: that of all others in the first, −1 in the others, 0
    /// where a tick is one step.
    pub more: f32,
}

/// Those of the lumps in lanes.
#[derive(Clone, Copy)]
pub(super) struct Own<L> {
    kelvin: L,
    conduction: L,
    allowance: L,
    more: L,
}

impl Exchanged<'_> {
    /// Those of lumps that `load` finds in a field.
    #[inline(always)]
    pub fn own<L: Lanes>(&self, load: impl Fn(&[f32]) -> L) -> Own<L> {
        Own {
            kelvin: load(self.kelvin),
            conduction: load(self.conduction),
            allowance: load(self.allowance),
            more: load(self.once) * L::splat(self.more),
        }
    }
}

impl<L: Lanes> Own<L> {
    /// What flows to the lumps from others with these weights, which `load` finds in a field, quanta.
    #[inline(always)]
    pub fn flow(self, exchanged: &Exchanged, weights: L, load: impl Fn(&[f32]) -> L) -> L {
        let share = load(exchanged.allowance).min(self.allowance);
        // The product of both comes first, so that the other lump finds the same to the bit.
        let mut rate = self.conduction * load(exchanged.conduction) * L::splat(exchanged.pairs) * share;
        if exchanged.more != 0.0 {
            rate = rate * (L::splat(1.0) + self.more * load(exchanged.once));
        }
        rate * weights * (load(exchanged.kelvin) - self.kelvin)
    }
}
