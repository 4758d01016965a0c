//! Velocities after the solve: what the moves imply, then viscosity and vorticity confinement.

mod energy;
mod follow;
#[cfg(test)]
mod tests;
mod update;
mod viscosity;
mod vorticity;

pub use energy::energy;
pub use update::{MoveReport, update_velocities};
pub(crate) use viscosity::Thick;
pub use viscosity::apply_viscosity;
pub use vorticity::apply_vorticity;

use crate::element::ElementId;

/// What viscosity or vorticity confinement had to leave out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StrengthReport {
    /// Particles of elements whose strength was cut to what a substep can take.
    pub clamps: u64,
}

impl StrengthReport {
    /// Counts the particles of elements whose strength is above `most`. Costs nothing as long as no element's is.
    fn of(particles: &[ElementId], strengths: &[f32], most: f32) -> Self {
        if strengths.iter().all(|strength| *strength <= most) {
            return Self::default();
        }
        let cut = |element: &&ElementId| strengths[element.index()] > most;
        Self { clamps: particles.iter().filter(cut).count() as u64 }
    }
}
