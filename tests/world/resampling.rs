//! A running world at another detail: the same matter, and no worse a liquid ten ticks later.

use crate::support::*;
use glam::DVec2;
use powder_master::{
    lab::density::DensityError,
    sim::{intent::Intent, simulation::Simulation, state::*, workers::Workers},
};

/// Area (m²), energy (J, of water a metre deep), kinetic energy, momentum (kg m/s) of the particles.
fn totals(simulation: &Simulation) -> (f64, f64, f64, DVec2) {
    let Setup { blueprint, domain, .. } = simulation.get::<Setup>();
    let (d, particles) = (f64::from(blueprint.scale.spacing), simulation.particles());
    let mass = 1000.0 * d * d;
    let (mut kinetic, mut potential, mut momentum) = (0.0, 0.0, DVec2::ZERO);
    for i in 0..particles.len() {
        let velocity = particles.velocity(i).as_dvec2() * d;
        momentum += mass * velocity;
        kinetic += 0.5 * mass * velocity.length_squared();
        potential -= mass * d * d * domain.gravity.as_dvec2().dot(particles.position(i).as_dvec2());
    }
    (particles.len() as f64 * d * d, kinetic + potential, kinetic, momentum)
}

fn figures(simulation: &Simulation) -> String {
    let error = DensityError::of_world(simulation.world());
    let (area, energy, kinetic, momentum) = totals(simulation);
    format!(
        "area {area:.3} error {:?} energy {energy:.1} kin {kinetic:.1} momentum {momentum:.2} clamps {:?}",
        error.map(|e| [e.mean, e.p99, e.max, e.density].map(|e| (e * 1e4).round() / 1e4)),
        simulation.get::<Counters>().position_clamps
    )
}

#[test]
fn measure() {
    for (scene, ticks) in [("dam_break", 90), ("hydrostatic", 200), ("waterfall", 240)] {
        let mut base = Simulation::scene(scene, &[]);
        base.run(ticks);
        let checkpoint = powder_master::sim::checkpoint::Checkpoint::of(base.world());
        println!("{scene} before   {}", figures(&base));
        base.run(10);
        println!("{scene} plain 10 {}", figures(&base));
        base.run(20);
        println!("{scene} plain 30 {}", figures(&base));
        for detail in [2.0, 1.3, 0.7, 0.5, 0.25] {
            let mut world = Simulation::resume(&checkpoint, Workers::default());
            world.push(Intent::Detail { detail });
            world.apply_edits();
            println!("{scene} {detail} after {}", figures(&world));
            for k in [1, 4, 5, 20] {
                world.run(k);
                println!("{scene} {detail} +{k} {}", figures(&world));
            }
        }
    }
}
