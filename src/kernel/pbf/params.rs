//! What the solver is told.

use crate::params::{Domain, FluidParams, Quality};

/// Least relaxation ε where the pressure predictor ran, for each substep of a tick, 1/d²: with as many more substeps
/// the constraint pushes as much less in each, so that it does not expand the liquid the more the finer the time. A
/// Jacobi step corrects each particle as if its neighbours stood still, so where all are too dense at once, as in a
/// vessel without a free surface, the finest waves of the error are corrected by more than twice what they are: they
/// change sign from iteration to iteration and grow until the correction limit holds them, and the liquid boils. With
/// this much relaxation they die out. The bulk of the pressure is the predictor's by then, so that softening the
/// constraint costs no accuracy (docs/accuracy.md, "Relaxation"); without the predictor it would.
pub const PREDICTED_RELAXATION: f32 = 0.2;

/// What `Solver::solve` is told besides the particles.
#[derive(Clone, Copy, Debug)]
pub struct SolveParams<'a> {
    /// Box and gravity.
    pub domain: &'a Domain,
    /// Liquid parameters.
    pub fluid: &'a FluidParams,
    /// Accuracy.
    pub quality: &'a Quality,
    /// Whether the tensile correction is added.
    pub tension: bool,
    /// Whether the pressure predictor ran: then the constraint is relaxed, and pairs that are too close are set apart.
    pub predicted: bool,
    /// Masses of the elements, as shares of the heaviest; none where all are alike.
    pub masses: Option<&'a [f32]>,
    /// Threads to use.
    pub threads: usize,
}

impl SolveParams<'_> {
    /// Density that the constraint aims at, 1 on the lattice.
    pub(super) fn rest_density(&self) -> f32 {
        self.fluid.rest_density
    }

    /// Density from which on liquid is iterated again, 1 on the lattice; `None`: whatever it is.
    pub(super) fn iterate_above(&self) -> Option<f32> {
        self.quality.iterate_above().filter(|_| self.predicted).map(|error| self.rest_density() * (1.0 + error))
    }

    /// ε of eq. 11 in force, 1/d².
    pub(super) fn relaxation(&self) -> f32 {
        let least = if self.predicted { PREDICTED_RELAXATION * self.quality.substeps as f32 } else { 0.0 };
        self.fluid.relaxation.max(least)
    }
}
