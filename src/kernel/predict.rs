//! Prediction: where the velocities alone would take the particles, without passing through rock or walls.

use crate::kernel::{
    params::{Domain, Quality},
    particles::Particles,
    pbf::Solver,
    solids::Solids,
};

/// Longest move of a substep, in kernel radii. Collision with rock is exact at any speed; what this bounds is how deep
/// two streams can enter each other before the density constraint sees them: up to two kernel diameters each.
const MOVE_RADII: f32 = 4.0;
/// Substeps that a fast tick may take, as a multiple of the quality's.
const SUBSTEP_GROWTH: u32 = 4;

/// What the limiters of the prediction did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PredictReport {
    /// Particles whose speed was cut to the longest move.
    pub speed_clamps: u64,
}

/// Substeps for a tick of `tick` s: the quality's, more if the fastest particle would move too far in one, up to four
/// times the quality's.
pub fn substeps(particles: &Particles, domain: &Domain, quality: &Quality, tick: f32) -> u32 {
    let speed2 = |(vx, vy): (&f32, &f32)| vx * vx + vy * vy;
    let fastest = particles.vx.iter().zip(&particles.vy).map(speed2).fold(0.0_f32, f32::max).sqrt();
    let fastest = fastest + domain.gravity.length() * tick;
    let wanted = (fastest * tick / (MOVE_RADII * quality.kernel_radius)).ceil();
    // A cast saturates, so that any speed gives a number.
    (wanted as u32).clamp(quality.substeps, quality.substeps * SUBSTEP_GROWTH)
}

/// Removes particles whose position or velocity is not a number or beyond all bounds; returns how many.
pub fn remove_non_finite(particles: &mut Particles) -> usize {
    /// Beyond this, in d or d/s, a value is a fault and not a motion.
    const ABSURD: f32 = 1e9;
    let sound = |value: f32| value.abs() < ABSURD;
    let is_sound = |particles: &Particles, i: usize| {
        sound(particles.x[i]) && sound(particles.y[i]) && sound(particles.vx[i]) && sound(particles.vy[i])
    };
    if (0..particles.len()).all(|i| is_sound(particles, i)) {
        return 0;
    }
    particles.retain(is_sound)
}

/// Predicts `x + v Δt` into the solver, cut to the longest move and swept against rock and box. Where that changed the
/// move, the velocity becomes that of the move that is left.
pub fn predict(
    particles: &mut Particles,
    solver: &mut Solver,
    solids: &Solids,
    domain: &Domain,
    quality: &Quality,
    dt: f32,
) -> PredictReport {
    let mut report = PredictReport::default();
    let longest = MOVE_RADII * quality.kernel_radius;
    let has_rock = solids.count() > 0;
    solver.x.clear();
    solver.y.clear();
    for i in 0..particles.len() {
        let from = particles.position(i);
        let mut way = particles.velocity(i) * dt;
        let length2 = way.x * way.x + way.y * way.y;
        if length2 > longest * longest {
            way *= longest / length2.sqrt();
            (particles.vx[i], particles.vy[i]) = (way.x / dt, way.y / dt);
            report.speed_clamps += 1;
        }
        let free = from + way;
        let mut to = domain.keep_inside(free);
        if has_rock {
            to = solids.sweep(from, to);
        }
        if to != free {
            let velocity = (to - from) / dt;
            (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
        }
        solver.x.push(to.x);
        solver.y.push(to.y);
    }
    report
}
