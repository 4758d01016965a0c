//! Water in a tank: at rest, and sloshing.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::{
        density::surroundings,
        exam::{
            finding::{Findings, Run, found},
            fit::half_period,
            set_up::{CaseSimulation, GRAVITY, SetUp},
        },
        stats,
    },
    sim::state::Rock,
};
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] =
    &[("hydrostatic", |set_up| Box::pin(hydrostatic(set_up))), ("sloshing", |set_up| Box::pin(sloshing(set_up)))];

/// Particles of the scene's own spacing along the width and the depth.
const COLUMN_SIZE: (u32, u32) = (40, 60);

async fn hydrostatic(set_up: SetUp) -> Findings {
    let (columns, depth) = (f64::from(COLUMN_SIZE.0), f64::from(COLUMN_SIZE.1));
    let blueprint = set_up.blueprint("hydrostatic", &[("columns", columns), ("depth", depth)])?;
    let mut simulation = set_up.simulation(blueprint);
    simulation.run(8.0).await;
    let (mut surface, mut middle, mut motion, mut low, mut high) =
        <(Vec<_>, Vec<_>, Vec<_>, Vec<_>, Vec<_>)>::default();
    for _ in 0..12 {
        simulation.run(1.0 / 6.0).await;
        let matter = simulation.matter();
        surface.push(matter.surface().unwrap_or(f64::NAN));
        let balance = matter.balance();
        // The middle of a full tank stands at half its height.
        middle.push(2.0 * balance.potential / (balance.mass * GRAVITY));
        motion.push((2.0 * balance.kinetic / balance.mass).sqrt() / simulation.spacing() / f64::from(TICKS_PER_SECOND));
        let top = depth * simulation.own_spacing() / simulation.spacing();
        low.push(density(&simulation, 0.0, top / 3.0));
        high.push(density(&simulation, top * 2.0 / 3.0, top));
    }
    let mean = |values: &[f64]| stats::mean(values).unwrap_or(f64::NAN);
    Ok(vec![
        found("height of the surface", depth * simulation.own_spacing(), mean(&surface)),
        found("height by the centre of mass", depth * simulation.own_spacing(), mean(&middle)),
        found("density, lowest third", 1.0, mean(&low)),
        found("density, highest third", 1.0, mean(&high)),
        found("rms speed", 0.0, mean(&motion)),
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

/// Length of the tank, m.
pub(in crate::lab::exam) const SLOSHING_LENGTH: f64 = 6.0;

async fn sloshing(set_up: SetUp) -> Findings {
    let mut findings = Vec::new();
    for (quantity, depth, tilt) in
        [("period, 3 m deep", 3.0, 0.3), ("period, 1 m deep", 1.0, 0.15), ("period, 1.1 m deep", 1.1, 0.15)]
    {
        let wave = PI / SLOSHING_LENGTH;
        let omega = (GRAVITY * wave * (wave * depth).tanh()).sqrt();
        let mut simulation = set_up.open("sloshing", &[("depth", depth), ("tilt", tilt)])?;
        let mut curve = Vec::new();
        for _ in 0..12 * 60 {
            simulation.tick().await;
            let x = &simulation.particles().x;
            let centre = x.iter().map(|x| f64::from(*x)).sum::<f64>() / x.len() as f64 * simulation.spacing();
            curve.push((simulation.seconds(), centre - 0.5 * SLOSHING_LENGTH));
        }
        let period = half_period(&curve).map_or(f64::NAN, |half| 2.0 * half);
        findings.push(found(quantity, 2.0 * PI / omega, period));
    }
    Ok(findings)
}
