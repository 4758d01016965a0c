//! Thick liquid: a film that runs down a slope, and shear that dies away.

use crate::lab::exam::{
    finding::{Findings, Run, found},
    set_up::{CaseSimulation, GRAVITY, SetUp},
};
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] =
    &[("honey_film", |set_up| Box::pin(honey_film(set_up))), ("shear_decay", |set_up| Box::pin(shear_decay(set_up)))];

/// Kinematic viscosity of honey, m²/s.
fn viscosity(simulation: &CaseSimulation) -> f64 {
    let elements = simulation.matter().elements;
    elements.find("honey").map_or(f64::NAN, |honey| f64::from(elements.get(honey).viscosity))
}

/// Slope of the floor, degrees.
const SLOPE: f64 = 3.0;
/// Between which places the film is looked at, m, and when, s.
const LOOKED_AT: [f64; 2] = [36.0, 42.0];
const RUNS_FOR: f64 = 8.0;
const LOOKS: u32 = 30;

async fn honey_film(set_up: SetUp) -> Findings {
    let (sine, cosine) = SLOPE.to_radians().sin_cos();
    let mut simulation = set_up.open("honey_film", &[("along", GRAVITY * sine), ("onto", GRAVITY * cosine)])?;
    simulation.run(RUNS_FOR).await;
    let (mut depth, mut flow) = (0.0, 0.0);
    for _ in 0..LOOKS {
        simulation.tick().await;
        let [deep, flows] = film(&simulation);
        depth += deep / f64::from(LOOKS);
        flow += flows / f64::from(LOOKS);
    }
    let known = GRAVITY * sine * depth.powi(3) / (3.0 * viscosity(&simulation));
    Ok(vec![found("flow for each metre of width", known, flow)])
}

/// Mean depth of the film where it is looked at (m), and its flow (m²/s).
fn film(simulation: &CaseSimulation) -> [f64; 2] {
    let (particles, d) = (simulation.particles(), simulation.spacing());
    let among = |i: &usize| (LOOKED_AT[0]..LOOKED_AT[1]).contains(&(f64::from(particles.x[*i]) * d));
    let each = d * d / (LOOKED_AT[1] - LOOKED_AT[0]);
    let add = |[depth, flow]: [f64; 2], i: usize| [depth + each, flow + each * d * f64::from(particles.vx[i])];
    (0..particles.len()).filter(among).fold([0.0; 2], add)
}

/// Height of the channel, m, and the speed at the start, m/s.
const CHANNEL: f64 = 2.0;
const SPEED: f64 = 0.1;
/// Simulated time, s.
const DECAYS_FOR: f64 = 1.0;

async fn shear_decay(set_up: SetUp) -> Findings {
    let mut blueprint = set_up.blueprint("shear_decay", &[])?;
    let d = f64::from(blueprint.scale.spacing);
    let particles = &mut blueprint.particles;
    for i in 0..particles.len() {
        particles.vx[i] = (SPEED / d * wave(f64::from(particles.y[i]) * d)) as f32;
    }
    let mut simulation = set_up.simulation(blueprint);
    let start = amplitude(&simulation);
    simulation.run(DECAYS_FOR).await;
    let number = 2.0 * PI / CHANNEL;
    let known = (-viscosity(&simulation) * number * number * DECAYS_FOR).exp();
    Ok(vec![found("share of the speed after 1 s", known, amplitude(&simulation) / start)])
}

/// The shear at a height, m: as much flows one way as the other, and at the walls nothing.
fn wave(height: f64) -> f64 {
    (2.0 * PI * height / CHANNEL).sin()
}

/// How fast the middle third of the channel runs in that shear, m/s.
fn amplitude(simulation: &CaseSimulation) -> f64 {
    let (particles, d) = (simulation.particles(), simulation.spacing());
    let width = f64::from(simulation.matter().domain.size.x);
    let (mut sum, mut norm) = (0.0, 0.0);
    for i in (0..particles.len()).filter(|i| (width / 3.0..width * 2.0 / 3.0).contains(&f64::from(particles.x[*i]))) {
        let wave = wave(f64::from(particles.y[i]) * d);
        sum += f64::from(particles.vx[i]) * d * wave;
        norm += wave * wave;
    }
    sum / norm
}
