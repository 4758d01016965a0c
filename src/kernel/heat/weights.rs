//! How much lumps that are near each other exchange.

use crate::simd::Lanes;
use glam::Vec2;

/// Reach h of the exchange, d.
pub(super) const REACH: f32 = 2.5;
/// W of the weight, so that on the lattice `½ Σ w x² = 1`.
pub(super) const WEIGHT: f32 = 0.392_341_5;

/// The weight of lumps that are so far apart along x and y, d.
#[inline(always)]
pub(super) fn weight<L: Lanes>(dx: L, dy: L) -> L {
    let left = L::splat(1.0) - (dx * dx + dy * dy) * L::splat(1.0 / (REACH * REACH));
    let left = left.max(L::splat(0.0));
    L::splat(WEIGHT) * (left * left)
}

/// That of lumps at two places, d.
pub(super) fn weight_between(one: Vec2, other: Vec2) -> f32 {
    let left = (1.0 - (other - one).length_squared() * (1.0 / (REACH * REACH))).max(0.0);
    WEIGHT * (left * left)
}
