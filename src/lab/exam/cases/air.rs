//! Air alone: a Taylor–Green vortex, and a pulse of pressure.

use crate::{
    kernel::{
        params::AirAdvection,
        sources::{Rect, Wind},
    },
    lab::{
        exam::{
            finding::{Finding, Findings, Run, found},
            set_up::{CaseSimulation, SetUp},
        },
        stats,
    },
    scene::SceneError,
    sim::{numbers::figure, state::Sources},
};
use glam::Vec2;
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] =
    &[("vortex", |set_up| Box::pin(vortex(set_up))), ("pulse", |set_up| Box::pin(pulse(set_up)))];

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
