//! How much lumps that are near each other exchange.

use glam::Vec2;

/// Reach h of the exchange, d.
pub(super) const REACH: f32 = 2.5;
/// W of the weight, so that on the lattice `½ Σ w x² = 1`.
pub(super) const WEIGHT: f32 = 0.392_341_5;

/// The weights of a run of lumps around a place.
pub(super) struct Weights<'a> {
    pub at: Vec2,
    pub x: &'a [f32],
    pub y: &'a [f32],
}

impl Weights<'_> {
    /// That of lump `j` of the run.
    #[inline(always)]
    pub fn of(&self, j: usize) -> f32 {
        let (dx, dy) = (self.x[j] - self.at.x, self.y[j] - self.at.y);
        let left = 1.0 - (dx * dx + dy * dy) * (1.0 / (REACH * REACH));
        let left = if left > 0.0 { left } else { 0.0 };
        WEIGHT * (left * left)
    }
}
