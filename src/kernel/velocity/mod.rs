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

/// Correction of a substep that goes into the velocity by half, d, where the pressure predictor ran. Its velocities are
/// nearly right; the small corrections that are left are the particles finding their places, and to take them for motion
/// would make a still pool simmer.
const QUIET_CORRECTION: f32 = 0.05;

/// Moves the particles to their corrected positions, stopped by rock, and sets `v = (x* − x)/Δt` (Macklin & Müller 2013,
/// algorithm 1, line 21), as the predicted velocity and the correction's: `v + (x* − (x + v Δt))/Δt`. In f32 that is not the
/// same: a free particle keeps its velocity to the last bit, where the difference of two large positions would round it
/// to whole ulps of the position over Δt (at 2,048 d and 16 substeps a tick that swallows gravity). Where the pressure
/// predictor ran (`predicted`), the velocity follows a correction a by the share `a²/(a² + QUIET_CORRECTION²)`.
pub fn update_velocities(
    particles: &mut Particles,
    solver: &mut Solver,
    solids: &Solids,
    quality: &Quality,
    predicted: bool,
    dt: f32,
) -> MoveReport {
    let mut report = MoveReport::default();
    let per_dt = 1.0 / dt;
    let quiet = QUIET_CORRECTION * per_dt;
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
        let mut change = (to - anchor) * per_dt;
        if predicted {
            let (change2, quiet2) = (change.length_squared(), quiet * quiet);
            change *= change2 / (change2 + quiet2);
        }
        let velocity = particles.velocity(i) + change;
        (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
        (particles.x[i], particles.y[i]) = (to.x, to.y);
        (solver.x[i], solver.y[i]) = (to.x, to.y);
    }
    report
}
