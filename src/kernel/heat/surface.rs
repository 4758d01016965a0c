//! How much of a lump's surface is open.

use crate::simd::Lanes;

/// Length of surface, d, for a share of missing neighbours beyond [`UNEVEN`]: at a plane surface of the lattice those of the
/// first row come to 1. A lump by itself has 3.6, about its outline.
pub(super) const SURFACE: f32 = 4.026;
/// Σ w over the other sites of the lattice.
const WHOLE: f32 = 2.161_9;
/// Share of [`WHOLE`] that may be missing inside: neighbours never stand quite evenly.
const UNEVEN: f32 = 0.1;

/// Length of a lump's surface that is open, d, by the sum of the weights of its neighbours.
#[inline(always)]
pub(super) fn open_length<L: Lanes>(neighbours: L) -> L {
    let missing = L::splat(1.0 - UNEVEN) - neighbours / L::splat(WHOLE);
    L::splat(SURFACE) * missing.max(L::splat(0.0))
}
