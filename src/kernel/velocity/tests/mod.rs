//! Velocities after the solve.

mod update;
mod viscosity;
mod vorticity;

use crate::{
    params::Preset,
    particles::Particles,
    pbf::tests::{Bench, random_numbers},
};
use glam::Vec2;

/// A square of 20 × 20 particles on the lattice, `jitter` d off it at random, with velocities from `velocity`.
fn square(jitter: f32, velocity: impl Fn(Vec2) -> Vec2) -> Bench {
    let mut bench = Bench::new(60, 60, Preset::Balanced);
    let mut random = random_numbers(9);
    for k in 0..400 {
        let site = Vec2::new(20.5 + (k % 20) as f32, 20.5 + (k / 20) as f32);
        let at = site + jitter * (2.0 * Vec2::new(random(), random()) - 1.0);
        bench.add(at, velocity(at));
    }
    bench
}

fn kinetic_energy(particles: &Particles) -> f64 {
    (0..particles.len()).map(|i| 0.5 * f64::from(particles.velocity(i).length_squared())).sum()
}
