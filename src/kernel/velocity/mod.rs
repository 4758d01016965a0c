//! Velocities after the solve: what the moves imply, then viscosity and vorticity confinement.

#[cfg(test)]
mod tests;
mod viscosity;
mod vorticity;

pub use viscosity::apply_viscosity;
pub use vorticity::apply_vorticity;

use crate::kernel::{params::Quality, particles::Particles, pbf::Solver, solids::Solids};
use glam::Vec2;

/// What the limiters of the solve did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MoveReport {
    /// Particles whose correction was cut to the correction limit.
    pub position_clamps: u64,
}

/// Moves the particles to their corrected positions, stopped by rock, and sets `v = (x* − x)/Δt` (Macklin & Müller 2013,
/// algorithm 1, line 21), as the predicted velocity and the correction's: `v + (x* − (x + v Δt))/Δt`. In f32 that is not the
/// same: a free particle keeps its velocity to the last bit, where the difference of two large positions would round it
/// to whole ulps of the position over Δt (at 2,048 d and 16 substeps a tick that swallows gravity).
pub fn update_velocities(
    particles: &mut Particles,
    solver: &mut Solver,
    solids: &Solids,
    quality: &Quality,
    dt: f32,
) -> MoveReport {
    let mut report = MoveReport::default();
    let per_dt = 1.0 / dt;
    let has_rock = solids.count() > 0;
    // The limit itself, less the rounding of (anchor + limit) − anchor.
    let cut = quality.correction_limit * 0.999;
    for i in 0..particles.len() {
        let anchor = Vec2::new(solver.anchor_x[i], solver.anchor_y[i]);
        let mut to = solver.position(i);
        let correction = (to - anchor).abs();
        report.position_clamps += u64::from(correction.max_element() >= cut);
        if has_rock {
            to = solids.sweep(anchor, to);
        }
        let velocity = particles.velocity(i) + (to - anchor) * per_dt;
        (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
        (particles.x[i], particles.y[i]) = (to.x, to.y);
        (solver.x[i], solver.y[i]) = (to.x, to.y);
    }
    report
}
