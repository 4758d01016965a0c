//! How far iterating may move a particle from where it was predicted to be.

use crate::{pbf::params::SolveParams, simd::Lanes};

/// From this density on, as a multiple of the one aimed at, a correction may be longer, and from the second on the longest.
const CROWDED: [f32; 2] = [1.5, 2.0];

/// The correction limit of each particle, by its density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CorrectionLimit {
    /// Of a particle that is not crowded, d along each axis.
    usual: f32,
    /// What the most crowded may go further, d.
    further: f32,
    /// Density from which on a particle is crowded, 1 on the lattice.
    crowded: f32,
    /// 1 over the density from there to the most crowded.
    per_crowding: f32,
}

impl CorrectionLimit {
    pub(super) fn new(params: &SolveParams) -> Self {
        let ([from, to], rest_density) = (CROWDED, params.rest_density());
        Self {
            usual: params.quality.correction_limit,
            further: params.quality.longest_correction() - params.quality.correction_limit,
            crowded: from * rest_density,
            per_crowding: 1.0 / ((to - from) * rest_density),
        }
    }

    /// That of particles of `density`, d along each axis.
    #[inline(always)]
    pub(super) fn lanes<L: Lanes>(&self, density: L) -> L {
        let over = (density - L::splat(self.crowded)) * L::splat(self.per_crowding);
        let crowding = over.max(L::splat(0.0)).min(L::splat(1.0));
        L::splat(self.usual) + crowding * L::splat(self.further)
    }

    /// That of a particle of `density`, d along each axis.
    #[inline(always)]
    pub(crate) fn at(&self, density: f32) -> f32 {
        self.usual + ((density - self.crowded) * self.per_crowding).clamp(0.0, 1.0) * self.further
    }
}
