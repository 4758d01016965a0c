//! What the exchange asks of every lump, by its element, in one place: its curve where no change has begun, as of most.

use super::{
    curve::Change,
    table::HeatTable,
    units::{HOTTEST, QUANTUM, ROOM},
};
use crate::{element::ElementId, simd::MOST_LANES};

/// An element between its changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope {
    /// Heats between which no change has begun, quanta.
    below: i32,
    above: i32,
    /// Heat at [`ROOM`], quanta.
    base: i32,
    /// K.
    per_quantum: f32,
    /// √k′, √(W/mK).
    pub conduction: f32,
    /// Heat that makes it a degree warmer, at least, quanta.
    pub held: f32,
    /// How many times as much its surface gives to the air as that of liquids and solids does.
    pub openness: f32,
}

impl Slope {
    /// Whether no change has begun at a heat.
    #[inline(always)]
    fn has(&self, heat: i32) -> bool {
        (self.below < heat) & (heat < self.above)
    }

    /// Temperature at a heat of it, K.
    #[inline(always)]
    pub fn temperature(&self, heat: i32) -> f32 {
        let kelvin = ROOM + heat.saturating_sub(self.base) as f32 * self.per_quantum;
        kelvin.clamp(0.0, HOTTEST)
    }
}

/// Those of all elements.
#[derive(Clone, Debug, Default)]
pub(super) struct Slopes(Vec<Slope>);

impl Slopes {
    /// Follows a table.
    pub fn follow(&mut self, table: &HeatTable) {
        self.0.clear();
        self.0.extend(table.curves().iter().map(|curve| {
            let begin = |change: &Option<Change>, never| change.as_ref().map_or(never, |change| change.plateau[0]);
            Slope {
                below: begin(&curve.below, i32::MIN),
                above: begin(&curve.above, i32::MAX),
                base: curve.base,
                per_quantum: QUANTUM / curve.capacity,
                conduction: curve.conduction[0],
                held: curve.least_capacity() / QUANTUM,
                openness: curve.openness(),
            }
        }));
    }

    /// That of an element.
    #[inline(always)]
    pub fn of(&self, element: ElementId) -> &Slope {
        &self.0[element.index()]
    }

    /// Whether no change of an element has begun at any of some heats.
    #[inline(always)]
    pub fn are_on(&self, element: ElementId, heats: &[i32; MOST_LANES]) -> bool {
        let slope = self.of(element);
        heats.iter().fold(true, |all, heat| all & slope.has(*heat))
    }

    /// Temperature (K) and √k′ (√(W/mK)) of a lump by its heat, as its curve has them.
    #[inline(always)]
    pub fn state(&self, table: &HeatTable, element: ElementId, heat: i32) -> (f32, f32) {
        let slope = self.of(element);
        if slope.has(heat) {
            return (slope.temperature(heat), slope.conduction);
        }
        let curve = table.curve(element);
        (curve.temperature(heat).clamp(0.0, HOTTEST), curve.conduction(heat))
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<Slope>() * self.0.capacity()
    }
}
