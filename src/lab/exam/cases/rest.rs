//! Water at rest in a tank.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{
        density::surroundings,
        exam::{
            case::{Findings, share, within},
            set_up::{CaseSimulation, SetUp},
        },
        stats,
    },
    sim::state::Rock,
};

/// Particles along the width and the depth.
const SIZE: (u32, u32) = (40, 60);

pub(super) async fn hydrostatic(set_up: SetUp) -> Findings {
    let (columns, depth) = (f64::from(SIZE.0), f64::from(SIZE.1));
    let blueprint = set_up.blueprint("hydrostatic", &[("columns", columns), ("depth", depth)])?;
    let mut simulation = set_up.simulation(blueprint);
    simulation.run(8.0).await;
    let (mut surface, mut motion, mut low, mut high) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for _ in 0..12 {
        simulation.run(1.0 / 6.0).await;
        let matter = simulation.matter();
        surface.push(matter.surface().unwrap_or(f64::NAN));
        let balance = matter.balance();
        motion.push((2.0 * balance.kinetic / balance.mass).sqrt() / simulation.spacing() / f64::from(TICKS_PER_SECOND));
        low.push(density(&simulation, 0.0, depth / 3.0));
        high.push(density(&simulation, depth * 2.0 / 3.0, depth));
    }
    let mean = |values: &[f64]| stats::mean(values).unwrap_or(f64::NAN);
    Ok(vec![
        share("height of the surface", "m", depth * simulation.spacing(), mean(&surface), 0.02),
        share("density, lowest third", "", 1.0, mean(&low), 0.02),
        share("density, highest third", "", 1.0, mean(&high), 0.02),
        within("rms speed", "d/tick", 0.0, mean(&motion), 0.02),
    ])
}

/// Mean density of the particles inside the liquid between two heights, d.
fn density(simulation: &CaseSimulation, from: f64, to: f64) -> f64 {
    let matter = simulation.matter();
    let locals = surroundings(matter.particles, simulation.world().resource::<Rock>(), matter.domain.size);
    let inside = (locals.iter().zip(&matter.particles.y))
        .filter(|(local, y)| local.interior && (from..to).contains(&f64::from(**y)))
        .map(|(local, _)| local.density);
    stats::mean(inside).unwrap_or(f64::NAN)
}
