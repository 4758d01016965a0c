//! Velocities after the solve: what the moves imply, then viscosity and vorticity confinement.

#[cfg(test)]
mod tests;
mod viscosity;
mod vorticity;

pub use viscosity::apply_viscosity;
pub use vorticity::apply_vorticity;

use crate::{
    element::ElementId,
    forces::held,
    parallel::{WORTH_A_PIECE, spread},
    particles::Particles,
    pbf::{CorrectionLimit, Solver},
    simd::{Lanes, Pass},
    solids::Solids,
};
use glam::Vec2;
use std::sync::atomic::{AtomicU64, Ordering};

/// What the limiters of the solve did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MoveReport {
    /// Particles whose correction was cut to the correction limit.
    pub position_clamps: u64,
}

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

/// Correction of a substep that goes into the velocity by half, d, where the pressure predictor ran. Its velocities are
/// nearly right; the small corrections that are left are the particles finding their places, and to take them for motion
/// would make a still pool simmer.
const QUIET_CORRECTION: f32 = 0.2;

/// Share of its limit from which on a correction counts as cut: less the rounding of (anchor + limit) − anchor.
const CUT: f32 = 0.999;

/// Moves the particles to their corrected positions, stopped by rock, and sets `v = (x* − x)/Δt` (Macklin & Müller 2013,
/// algorithm 1, line 21), as the predicted velocity and the correction's: `v + (x* − (x + v Δt))/Δt`. In f32 that is not the
/// same: a free particle keeps its velocity to the last bit, where the difference of two large positions would round it
/// to whole ulps of the position over Δt (at 2,048 d and 16 substeps a tick that swallows gravity). Where the pressure
/// predictor ran (`predicted`), the velocity follows a correction a by the share `a²/(a² + QUIET_CORRECTION²)`.
///
/// Then the second half of the kick that [`begin_kick`](crate::forces::begin_kick) began: gravity (d/s²) and what
/// pressure and contact add. Where corrections hold a particle up they hold it against the kick, too ([`held`]).
pub fn update_velocities(
    particles: &mut Particles,
    solver: &mut Solver,
    solids: &Solids,
    gravity: Vec2,
    predicted: bool,
    threads: usize,
    dt: f32,
) -> MoveReport {
    let Solver { instructions, x: to_x, y: to_y, density, limit, .. } = solver;
    let clamps = AtomicU64::new(0);
    let Particles { x, y, vx, vy, push_x, push_y, .. } = particles;
    let arrays = [&mut vx[..], vy, push_x, push_y, to_x, to_y];
    spread(arrays, WORTH_A_PIECE, threads, &|base, [vx, vy, push_x, push_y, to_x, to_y]| {
        let anchor = [&*x, &*y].map(|anchor| &anchor[base..base + vx.len()]);
        instructions.run(Move {
            rock: (solids.count() > 0).then_some(solids),
            limit: limit.map(|limit| (limit, &density[base..base + vx.len()])),
            quiet: if predicted { QUIET_CORRECTION } else { 0.0 },
            half: 0.5 * dt * gravity,
            dt,
            anchor,
            corrected: [to_x, to_y],
            velocity: [vx, vy],
            push: [push_x, push_y],
            clamps: &clamps,
        });
    });
    std::mem::swap(x, to_x);
    std::mem::swap(y, to_y);
    MoveReport { position_clamps: clamps.into_inner() }
}

/// Moves a piece of the particles.
struct Move<'a> {
    /// Rock, if there is any.
    rock: Option<&'a Solids>,
    /// Limit of the corrections and the densities that it goes by, if there were any.
    limit: Option<(CorrectionLimit, &'a [f32])>,
    /// Correction that goes into the velocity by half, d.
    quiet: f32,
    /// What gravity adds in the second half of the substep, d/s.
    half: Vec2,
    dt: f32,
    /// Predicted positions, d.
    anchor: [&'a [f32]; 2],
    /// In and out: corrected positions, d; stopped by rock.
    corrected: [&'a mut [f32]; 2],
    /// In and out: velocities, d/s.
    velocity: [&'a mut [f32]; 2],
    /// In and out: what is added besides gravity, d/s.
    push: [&'a mut [f32]; 2],
    /// Counts the corrections that were cut.
    clamps: &'a AtomicU64,
}

impl Pass for Move<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { rock, limit, quiet, half, dt, anchor: [from_x, from_y], clamps, .. } = self;
        let ([to_x, to_y], [vx, vy], [push_x, push_y]) = (self.corrected, self.velocity, self.push);
        let per_dt = 1.0 / dt;
        let quiet = quiet * per_dt;
        if let Some((limit, density)) = limit {
            let mut cuts = 0_u32;
            for k in 0..from_x.len() {
                let cut = limit.at(density[k]) * CUT;
                let (far_x, far_y) = ((to_x[k] - from_x[k]).abs() >= cut, (to_y[k] - from_y[k]).abs() >= cut);
                cuts += u32::from(far_x | far_y);
            }
            clamps.fetch_add(u64::from(cuts), Ordering::Relaxed);
        }
        if let Some(rock) = rock {
            for k in 0..from_x.len() {
                let to = rock.sweep(Vec2::new(from_x[k], from_y[k]), Vec2::new(to_x[k], to_y[k]));
                (to_x[k], to_y[k]) = (to.x, to.y);
            }
        }
        for k in 0..from_x.len() {
            let (change_x, change_y) = ((to_x[k] - from_x[k]) * per_dt, (to_y[k] - from_y[k]) * per_dt);
            let change2 = change_x * change_x + change_y * change_y;
            let share = if quiet > 0.0 { change2 / (change2 + quiet * quiet) } else { 1.0 };
            let (change_x, change_y) = (change_x * share, change_y * share);
            let kick = held(Vec2::new(half.x + push_x[k], half.y + push_y[k]), Vec2::new(change_x, change_y));
            (vx[k], vy[k]) = (vx[k] + change_x + kick.x, vy[k] + change_y + kick.y);
            (push_x[k], push_y[k]) = (kick.x - half.x, kick.y - half.y);
        }
    }
}
