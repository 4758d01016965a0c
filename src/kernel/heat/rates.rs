//! How fast heat flows, by spacing and step.

use super::{surface::SURFACE, units::QUANTUM, weights::WEIGHT};

/// Exchange with the air h′, W/m²K: a thousand times life's, as the spacing is.
const TO_AIR: f32 = 1e4;
/// Part of that which warms the air of the picture; the rest goes to what is not in it. Changing this affects how strongly warm air
/// rises from what is warm.
const OF_AIR: f32 = 0.05;
/// How many times as much a gas gives to the air: a lump of it stands for wisps that mix with it.
pub(super) const OF_GAS: f32 = 5.0;

/// What depends on spacing and step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rates {
    /// Quanta for each W/mK K of a pair's `k′ w ΔT`.
    pub pairs: f32,
    /// Quanta for each K of a length d of surface.
    pub air: f32,
}

impl Rates {
    /// For a spacing (m) and a step (s).
    pub fn new(spacing: f32, dt: f32) -> Self {
        Self { pairs: dt / (spacing * spacing * QUANTUM), air: TO_AIR * dt / (spacing * QUANTUM) }
    }

    /// Whether a difference of temperatures (K) could give half a quantum to a pair of lumps of at most this √k′, or to the air.
    pub fn may_flow(&self, difference: f32, conduction: f32) -> bool {
        difference * (self.pairs * WEIGHT * conduction * conduction) >= 0.5
            || difference * (self.air * SURFACE * OF_GAS) >= 0.5
    }

    /// Quanta that the air of the picture gets for each K of a length d of surface.
    pub fn of_air(&self) -> f32 {
        OF_AIR * self.air
    }

    /// Those of each of so many steps.
    pub fn over(self, steps: f32) -> Self {
        Self { pairs: self.pairs / steps, air: self.air / steps }
    }
}
