//! Air alone: a Taylor–Green vortex, a pulse of pressure, warm air that rises and warm air that is shut in.

use crate::{
    kernel::{
        heat::units::ROOM,
        params::AirAdvection,
        sources::{Rect, Wind},
        units::TICK_SECONDS,
    },
    lab::{
        exam::{
            finding::{Finding, Findings, Run, found},
            set_up::{CaseSimulation, GRAVITY, SetUp},
        },
        stats,
    },
    scene::{
        SceneError,
        blueprint::{Blueprint, PressurePatch},
    },
    sim::{numbers::figure, state::Sources},
};
use glam::Vec2;
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] = &[
    ("vortex", |set_up| Box::pin(vortex(set_up))),
    ("pulse", |set_up| Box::pin(pulse(set_up))),
    ("thermal", |set_up| Box::pin(thermal(set_up))),
    ("shut_in", |set_up| Box::pin(shut_in(set_up))),
];

/// Speed U, m/s, and edge of the box, m.
const VORTEX_SPEED: f64 = 5.0;
const VORTEX_BOX: f64 = 12.0;
/// Time over which it is followed, s: that in which U crosses the box.
const VORTEX_SECONDS: f64 = VORTEX_BOX / VORTEX_SPEED;
/// Edge of the cells from which the order is judged, to half of it, d.
const COARSE_CELL: f32 = 8.0;

async fn vortex(set_up: SetUp) -> Findings {
    let quality = set_up.setting.preset.quality();
    let (cell, own) = viscosity(quality.air_cell, &set_up).await?;
    let (_, coarse) = viscosity(COARSE_CELL, &set_up).await?;
    let (_, half) = viscosity(0.5 * COARSE_CELL, &set_up).await?;
    let shares = 2.0 * (2.0 / (3.0 * PI)) * (4.0 / (3.0 * PI));
    let upwind = shares * VORTEX_SPEED * cell;
    let order = (coarse / half).log2();
    let note = format!("{} m²/s over {} m²/s.", figure(own), figure(upwind));
    Ok(match quality.air_advection {
        AirAdvection::FirstOrder => vec![
            Finding { note, ..found("viscosity over an upwind scheme's, first order", 1.0, own / upwind) },
            found("order from 8 d to 4 d, first order", 1.0, order),
        ],
        AirAdvection::SecondOrder => vec![
            Finding { note, ..found("viscosity over an upwind scheme's, second order", 0.0, own / upwind) },
            found("order from 8 d to 4 d, second order", 2.0, order),
        ],
    })
}

/// Edge of a cell, m, and viscosity on it, m²/s, with cells of `air_cell` d.
async fn viscosity(air_cell: f32, set_up: &SetUp) -> Result<(f64, f64), SceneError> {
    let mut blueprint = set_up.blueprint("vortex", &[])?;
    blueprint.quality.air_cell = air_cell;
    let (cell, size) = (blueprint.quality.air_cell, blueprint.domain.size);
    let speed = blueprint.scale.to_kernel(VORTEX_SPEED as f32);
    let cells = (size / cell).round().as_ivec2();
    for row in 0..cells.y {
        for column in 0..cells.x {
            let min = Vec2::new(column as f32, row as f32) * cell;
            let place = (min + 0.5 * cell).as_dvec2() / size.as_dvec2() * PI;
            let velocity = Vec2::new((place.x.sin() * place.y.cos()) as f32, -(place.x.cos() * place.y.sin()) as f32);
            // So strong that the air is at its speed after one tick.
            let wind = Wind { area: Rect { min, max: min + cell }, velocity: velocity * speed, rate: 1e6 };
            blueprint.winds.push(wind);
        }
    }
    let d = f64::from(blueprint.scale.spacing);
    let mut simulation = set_up.simulation(blueprint);
    simulation.tick().await;
    simulation.world_mut().resource_mut::<Sources>().winds.clear();
    let start = simulation.air().kinetic_energy();
    let (begun, wave) = (simulation.seconds(), PI / VORTEX_BOX);
    let mut curve = vec![(0.0, 0.0)];
    while simulation.seconds() - begun < VORTEX_SECONDS {
        simulation.tick().await;
        curve.push((simulation.seconds() - begun, (start / simulation.air().kinetic_energy()).sqrt() - 1.0));
    }
    let slope = stats::line(&curve).map_or(f64::NAN, |(slope, _)| slope);
    Ok((f64::from(cell) * d, slope / (2.0 * wave * wave)))
}

/// Speed of sound, m/s.
const SOUND: f64 = 40.0;

async fn pulse(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("pulse", &[])?;
    let mass = simulation.air().mass();
    simulation.run(0.2).await;
    let (begun, from) = (simulation.seconds(), centre(&simulation));
    simulation.run(0.4).await;
    let speed = (centre(&simulation) - from) / (simulation.seconds() - begun);
    Ok(vec![found("speed", SOUND, speed), found("air that is left", 1.0, simulation.air().mass() / mass)])
}

/// Centre of mass of what is above pressure 1 in the right half of the tube, m.
fn centre(simulation: &CaseSimulation) -> f64 {
    let air = simulation.air();
    let cell = f64::from(air.cell()) * simulation.spacing();
    let (mut sum, mut moment) = (0.0, 0.0);
    for row in 0..air.rows() {
        for (column, p) in air.pressure_row(row).iter().enumerate().skip(air.columns() / 2) {
            sum += f64::from(*p) - 1.0;
            moment += (f64::from(*p) - 1.0) * (column as f64 + 0.5) * cell;
        }
    }
    moment / sum
}

/// Time within which warm air cools by a factor of e, s.
const COOLING: f64 = 10.0;
/// Radius of the cylinder, m. It is followed over a quarter of that.
const CYLINDER: f64 = 3.0;

/// How much warmer than its surroundings air of a temperature (K) is, as a share.
fn warmth(kelvin: f32) -> f64 {
    f64::from(kelvin / ROOM) - 1.0
}

async fn thermal(set_up: SetUp) -> Findings {
    let mut findings = Vec::new();
    for (quantity, kelvin) in [
        ("rise of air of 308 K", 308.0),
        ("rise of air of 586 K", 586.0),
        ("rise of air of 1,172 K", 1172.0),
        ("rise of air of 147 K", 147.0),
    ] {
        let mut simulation = set_up.simulation(with_cylinder(&set_up, kelvin)?);
        let begun = middle(&simulation);
        let (mut expected, mut speed, dt) = (0.0_f64, 0.0, f64::from(TICK_SECONDS));
        while expected.abs() < 0.25 * CYLINDER {
            simulation.tick().await;
            let tau = warmth(kelvin) * (-(simulation.seconds() - 0.5 * dt) / COOLING).exp();
            let pull = tau / (2.0 + tau) * GRAVITY;
            expected += (speed + 0.5 * pull * dt) * dt;
            speed += pull * dt;
        }
        findings.push(found(quantity, expected, middle(&simulation) - begun));
    }
    Ok(findings)
}

/// A box with a cylinder of air of a temperature (K) in its middle, at the pressure of the air around it.
fn with_cylinder(set_up: &SetUp, kelvin: f32) -> Result<Blueprint, SceneError> {
    let mut blueprint = set_up.blueprint("thermal", &[])?;
    let (cell, size) = (blueprint.quality.air_cell, blueprint.domain.size);
    let radius = blueprint.scale.to_kernel(CYLINDER as f32);
    // A strip for each row of cells.
    for row in 0..(size.y / cell).ceil() as u32 {
        let low = row as f32 * cell;
        let above = low + 0.5 * cell - 0.5 * size.y;
        let half = (radius * radius - above * above).max(0.0).sqrt();
        let [min, max] = [-half, half].map(|x| 0.5 * size.x + x);
        let area = Rect { min: Vec2::new(min, low), max: Vec2::new(max, low + cell) };
        blueprint.pressures.push(PressurePatch { area, pressure: 1.0, kelvin });
    }
    Ok(blueprint)
}

/// Height of the middle of what is warm, weighed by what it lacks or has too much of mass, m; 0 where all is cold.
fn middle(simulation: &CaseSimulation) -> f64 {
    let air = simulation.air();
    let cell = f64::from(air.cell()) * simulation.spacing();
    let (mut sum, mut moment) = (0.0, 0.0);
    for row in 0..air.rows() {
        for warmth in air.warmth_row(row) {
            let lacks = f64::from(warmth / (1.0 + warmth));
            sum += lacks;
            moment += lacks * (row as f64 + 0.5) * cell;
        }
    }
    if sum == 0.0 { 0.0 } else { moment / sum }
}

/// Temperature of what is heated of the air that is shut in, K, and which part that is.
const HEATED: f32 = 586.0;
const HEATED_PART: f64 = 0.25;

async fn shut_in(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("shut_in", &[])?;
    simulation.run(2.0).await;
    let expected = 1.0 + HEATED_PART * warmth(HEATED) * (-simulation.seconds() / COOLING).exp();
    let air = simulation.air();
    let cells = (0..air.rows()).flat_map(|row| (0..air.columns()).map(move |column| (column, row)));
    let pressures = cells.map(|(column, row)| f64::from(air.pressing_at_cell(column, row)));
    let mean = stats::mean(pressures).unwrap_or(f64::NAN);
    Ok(vec![found("pressure over that before it was heated", expected, mean)])
}
