//! XSPH viscosity: `v_i += c Σ (m/ρ_j) (v_j − v_i) W` (Macklin & Müller 2013, eq. 17, with the volume m/ρ_j that makes
//! the sum an average).
//!
//! c is the share of a tick: a substep takes its part `c Δt/tick`, so that a liquid is as thick at many substeps as at one.
//! The kinematic viscosity is `c h²/20` a tick (`∫ y² W = h²/10` for poly6).
//!
//! **The bound.** With the positive weights `w_j = c m/ρ_j W` a new velocity is `(1 − Σ w_j) v_i + Σ w_j v_j`. While
//! `Σ w_j ≤ 1` it is an average of old ones, so no speed can rise; differences shrink up to `Σ w_j ≤ 2` and grow past it.
//! As `Σ m/ρ_j W ≈ 1`, the bound is **`c Δt/tick ≤ 1`**. What is more viscous takes as many passes as that asks for, each with
//! its part of c, 16 at most: a coefficient beyond is cut to what they can do, and counted.
//!
//! **Only where it is so viscous.** Where masses differ, a pair whose mean c is within the bound of one pass takes all of it in the first,
//! and only the others go on: beside a drop of honey a lake costs one pass. Each kind of pair is held to the same bound, and as the
//! weights of all neighbours add up to one, so is the sum of both. After the first pass what goes on is brought together, if it is
//! not most of all ([`Thick`]).
//!
//! Between particles of different masses m each weight is `2 m_j/(m_i + m_j)` times as much, and of two coefficients that of a
//! pair is their harmonic mean (Morris, Fox & Zhu 1997, "Modeling low Reynolds number incompressible flows using SPH": the
//! stress is the same on both sides of a surface), so that one of a pair takes on the momentum that the other gives off. The
//! first is up to 2, and the bound half as much.
//!
//! **Surfaces.** The volumes m/ρ_j of a pair differ where the density does: at a surface, where it is 0.7, each row would drag
//! the one below more than that holds it, and a film of six rows run by a tenth too fast. What has a viscosity of its own takes the
//! smaller of both, so that one of a pair gets what the other gives, and the bound holds.
//!
//! **Walls**, of the box and of rock, hold what has a viscosity of its own: `v / (1 + c g)` with the weight g of the wall
//! ([`Grip`]), solved for the end of the pass, so that nothing is turned round by a wall however thick it is. c is that of the
//! element's viscosity alone. What only has a smoothing slips: that of water is of the particles' size and none of the liquid's,
//! whose layer at a wall would be a millimetre thick.

mod grip;
mod matter;
mod pass;
mod thick;
mod walls;

pub(super) use matter::share_of;
pub(crate) use thick::Thick;

use crate::{
    element::{ElementId, ElementParams},
    parallel::Team,
    params::Domain,
    particles::Particles,
    pbf::Solver,
    units::TICK_SECONDS,
    velocity::StrengthReport,
};
use grip::Grip;
use matter::{LEAST_DENSITY, Matter};
use pass::{Once, Setting};
use walls::Walls;

/// Largest share of its difference to its neighbours that a particle may give up in a pass: the bound.
const MOST_SHARE: f32 = 1.0;

/// Most passes of a substep. What asks for more is as viscous as that leaves it, and counted.
const MOST_PASSES: f32 = 16.0;

/// Applies viscosity over `dt` s between particles, and between them and the walls of the box and rock; c is the elements'.
pub fn apply_viscosity(
    particles: &mut Particles,
    solver: &mut Solver,
    domain: &Domain,
    elements: &ElementParams,
    threads: usize,
    dt: f32,
) -> StrengthReport {
    let coefficients = &elements.viscosity[..];
    let part = dt / TICK_SECONDS;
    let most = if solver.masses.is_empty() { MOST_SHARE } else { 0.5 * MOST_SHARE } / part;
    let report = StrengthReport::of(&particles.element, coefficients, most * MOST_PASSES);
    let passes = (strongest(&particles.element, coefficients, most) / most).ceil().clamp(1.0, MOST_PASSES);
    // Volumes live in the array of λ, what particles bring to a pair in those of corrected positions: all are free between two
    // solves.
    let Solver {
        bins,
        smoothing,
        instructions,
        density,
        lambda,
        masses,
        x: shares,
        y: loads,
        next_x,
        next_y,
        thick,
        ..
    } = solver;
    let sticks = strongest(&particles.element, &elements.stickiness, 0.0) > 0.0;
    let walls = sticks.then(|| Walls {
        smoothing,
        domain,
        rock: bins.rock(),
        strengths: &elements.stickiness,
        grip: Grip::new(smoothing),
    });
    let team = Team { instructions: *instructions, threads };
    let setting = Setting { smoothing, coefficients, walls, most: most * passes, part: part / passes, passes, team };
    if !sticks {
        lambda.iter_mut().zip(&*density).for_each(|(volume, density)| *volume = 1.0 / density.max(LEAST_DENSITY));
    }
    if !masses.is_empty() {
        for (k, element) in particles.element.iter().enumerate() {
            shares[k] = coefficients[element.index()].min(setting.most) * (smoothing.density_scale * setting.part);
            loads[k] = 4.0 * shares[k] * masses[k];
        }
    }
    if passes == 1.0 {
        thick.clear();
    }
    for turn in 0..passes as u32 {
        let once = Once { most, times: if turn == 0 { passes } else { 0.0 } };
        let Particles { element, x, y, vx, vy, .. } = &*particles;
        let matter = Matter { element, x, y, vx, vy, density, volumes: lambda, masses, shares, loads };
        let takes_all = |element: ElementId| once.is_beyond(coefficients[element.index()]);
        if turn == 1 && !masses.is_empty() && thick.gather(matter, bins.groups(), takes_all) {
            (1..passes as u32).for_each(|_| thick.pass(&setting, once));
            thick.hand_back(particles);
            break;
        }
        setting.pass(matter, bins.groups(), once, [next_x, next_y]);
        std::mem::swap(&mut particles.vx, next_x);
        std::mem::swap(&mut particles.vy, next_y);
    }
    report
}

/// The largest coefficient of the particles' elements, if any is above `most`; else 0.
fn strongest(particles: &[ElementId], coefficients: &[f32], most: f32) -> f32 {
    if coefficients.iter().all(|coefficient| *coefficient <= most) {
        return 0.0;
    }
    particles.iter().map(|element| coefficients[element.index()]).fold(0.0, f32::max)
}
