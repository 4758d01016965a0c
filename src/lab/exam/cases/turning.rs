//! Drops that turn, without gravity.

use crate::lab::exam::{
    case::{Findings, share, within},
    set_up::{CaseSimulation, SetUp},
};
use glam::DVec2;

/// Angular speed, 1/s.
const TURN: f32 = 2.0;

pub(super) async fn rotating_drop(set_up: SetUp) -> Findings {
    let mut blueprint = set_up.blueprint("rotating_drop", &[])?;
    let centre = blueprint.domain.size * 0.5;
    let particles = &mut blueprint.particles;
    for i in 0..particles.len() {
        let velocity = (particles.position(i) - centre).perp() * TURN;
        (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
    }
    let mut simulation = set_up.simulation(blueprint);
    let start = angular_momentum(&simulation);
    simulation.run(1.0).await;
    Ok(vec![share("angular momentum after 1 s", "t m²/s", start, angular_momentum(&simulation), 0.01)])
}

pub(super) async fn collision(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("collision", &[])?;
    let (start, impetus) = (angular_momentum(&simulation), simulation.matter().balance().impetus);
    simulation.run(2.0).await;
    Ok(vec![
        share("angular momentum after 2 s", "t m²/s", start, angular_momentum(&simulation), 0.07),
        within(
            "momentum as a share of Σ m |v|",
            "",
            0.0,
            simulation.matter().balance().momentum.length() / impetus,
            0.01,
        ),
    ])
}

/// Angular momentum of the particles about the middle of the box, t m²/s for each metre of depth.
fn angular_momentum(simulation: &CaseSimulation) -> f64 {
    let (matter, d) = (simulation.matter(), simulation.spacing());
    let (particles, mass) = (matter.particles, f64::from(matter.scale.particle_mass()) / 1000.0);
    let centre = matter.domain.size.as_dvec2() * 0.5;
    let of = |i: usize| -> f64 {
        let arm: DVec2 = particles.position(i).as_dvec2() - centre;
        arm.perp_dot(particles.velocity(i).as_dvec2())
    };
    (0..particles.len()).map(of).sum::<f64>() * mass * d * d
}
