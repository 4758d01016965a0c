//! Where particles of another size find their places: the density constraint alone, without time.

use crate::{
    params::{Domain, FluidParams, Preset},
    particles::Particles,
    pbf::{SolveParams, Solver},
    solids::Solids,
};
use glam::Vec2;

/// Rounds of binning and solving. The error falls to a third in each of the first; after three it is that of a running
/// liquid (docs/detail.md).
const ROUNDS: u32 = 3;

/// Moves particles that were just cut or joined apart, as the solver does between prediction and velocity, and leaves
/// their velocities as they are: so the error of their places does not become speed. Corrections are mutual, so away
/// from walls and rock the mean of their places stays, which is the centre of mass where all are as heavy.
pub fn settle(particles: &mut Particles, solids: &Solids, domain: &Domain, fluid: &FluidParams) {
    let quality = Preset::Fine.quality();
    let params =
        SolveParams { domain, fluid, quality: &quality, tension: false, predicted: true, masses: None, threads: 1 };
    let mut solver = Solver::default();
    for _ in 0..ROUNDS {
        solver.bin(particles, solids, domain, &quality, fluid.rest_density, 1);
        solver.solve(particles, &params);
        for i in 0..particles.len() {
            let target = domain.keep_inside(Vec2::new(solver.x[i], solver.y[i]));
            let at = solids.sweep(particles.position(i), target);
            (particles.x[i], particles.y[i]) = (at.x, at.y);
        }
    }
}
