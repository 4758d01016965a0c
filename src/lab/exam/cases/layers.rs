//! Liquids that lie on one another.

use crate::{
    kernel::element::ElementId,
    lab::exam::{
        finding::{Findings, Run, found},
        fit::{half_period, rises_to},
        set_up::{CaseSimulation, GRAVITY, SetUp},
    },
};
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] = &[
    ("u_tube", |set_up| Box::pin(u_tube(set_up))),
    ("internal_wave", |set_up| Box::pin(internal_wave(set_up))),
    ("overturning", |set_up| Box::pin(overturning(set_up))),
];

/// Density of a liquid, kg/m².
fn density(simulation: &CaseSimulation, name: &str) -> f64 {
    let elements = simulation.matter().elements;
    element(simulation, name).map_or(f64::NAN, |id| f64::from(elements.get(id).density))
}

fn element(simulation: &CaseSimulation, name: &str) -> Option<ElementId> {
    simulation.matter().elements.find(name)
}

/// Where the particles of a liquid are, m.
fn places(simulation: &CaseSimulation, name: &str) -> Vec<[f64; 2]> {
    let (particles, wanted, d) = (simulation.particles(), element(simulation, name), simulation.spacing());
    let of = |i: &usize| Some(particles.element[*i]) == wanted;
    (0..particles.len()).filter(of).map(|i| [particles.x[i], particles.y[i]].map(|at| f64::from(at) * d)).collect()
}

/// Width of the arms, and from where on right of the wall the right one is, m.
const ARM: (f64, f64) = (1.0, 2.0);

async fn u_tube(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("u_tube", &[])?;
    simulation.run(10.0).await;
    let (mut height, mut balance) = (Vec::new(), Vec::new());
    for _ in 0..20 {
        simulation.run(0.5).await;
        let particle = simulation.spacing() * simulation.spacing();
        let oil = places(&simulation, "oil");
        let column = oil.len() as f64 * particle / ARM.0;
        let middle = oil.iter().map(|[_, y]| y).sum::<f64>() / oil.len() as f64;
        // Half of the oil is above its middle, whatever its shape.
        let surface = middle - 0.5 * column;
        let above = places(&simulation, "water").iter().filter(|[x, y]| *x > ARM.1 && *y > surface).count();
        height.push(above as f64 * particle / ARM.0);
        balance.push(density(&simulation, "oil") / density(&simulation, "water") * column);
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    Ok(vec![found("height of the water that holds the oil", mean(&balance), mean(&height))])
}

/// Length of the tank, and depth of each layer, m.
pub(in crate::lab::exam) const LENGTH: f64 = 6.0;
pub(in crate::lab::exam) const DEPTH: f64 = 1.5;

/// ω of the slower of the two waves of a wave number (1/m) in layers of these densities: Lamb 1932, §231, with both as deep, so that
/// coth is the same in both.
pub(in crate::lab::exam) fn slower_root(wave: f64, light: f64, heavy: f64) -> f64 {
    let coth = 1.0 / (wave * DEPTH).tanh();
    let gk = GRAVITY * wave;
    let [a, b, c] = [heavy * coth * coth + light, -2.0 * heavy * coth * gk, (heavy - light) * gk * gk];
    ((-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt()
}

async fn internal_wave(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("layers", &[])?;
    let (wave, light, heavy) = (PI / LENGTH, density(&simulation, "oil"), density(&simulation, "brine"));
    let omega = slower_root(wave, light, heavy);
    let mut curve = Vec::new();
    for _ in 0..30 * 60 {
        simulation.tick().await;
        let brine = places(&simulation, "brine");
        let centre = brine.iter().map(|[x, _]| x).sum::<f64>() / brine.len() as f64;
        curve.push((simulation.seconds(), centre - 0.5 * LENGTH));
    }
    let period = half_period(&curve).map_or(f64::NAN, |half| 2.0 * half);
    Ok(vec![found("period", 2.0 * PI / omega, period)])
}

/// How many times as high the wave is taken to have grown.
const GROWTH: f64 = 2.0;

async fn overturning(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("overturning", &[])?;
    let (wave, light, heavy) = (PI / LENGTH, density(&simulation, "oil"), density(&simulation, "brine"));
    let rate = (GRAVITY * wave * (heavy - light) / (heavy + light) * (wave * DEPTH).tanh()).sqrt();
    let height = |simulation: &CaseSimulation| {
        let particle = simulation.spacing() * simulation.spacing();
        let sum: f64 = places(simulation, "brine").iter().map(|[x, _]| (wave * x).cos()).sum();
        // The brine lies above: where its surface is lower there is more of it.
        -2.0 / LENGTH * particle * sum
    };
    let start = height(&simulation);
    let mut curve = Vec::new();
    for _ in 0..10 * 60 {
        simulation.tick().await;
        curve.push((simulation.seconds(), height(&simulation) / start));
    }
    let time = rises_to(&curve, GROWTH).unwrap_or(f64::NAN);
    Ok(vec![found("time to twice its height", GROWTH.acosh() / rate, time)])
}
