//! A Taylor–Green vortex in the air.

use crate::{
    kernel::{
        params::AirAdvection,
        sources::{Rect, Wind},
    },
    lab::{
        exam::{
            case::{Findings, share, within},
            set_up::SetUp,
        },
        stats,
    },
    scene::SceneError,
    sim::state::Sources,
};
use glam::Vec2;
use std::f64::consts::PI;

/// Speed U, m/s, and edge of the box, m.
const SPEED: f64 = 5.0;
const EDGE: f64 = 12.0;
/// Time over which it is followed, s: that in which U crosses the box.
const SECONDS: f64 = EDGE / SPEED;
/// Edge of the cells from which the order is judged, to half of it, d.
const COARSE: f32 = 8.0;

pub(super) async fn vortex(set_up: SetUp) -> Findings {
    let quality = set_up.setting.preset.quality();
    let (cell, own) = viscosity(quality.air_cell, &set_up).await?;
    let (_, coarse) = viscosity(COARSE, &set_up).await?;
    let (_, half) = viscosity(0.5 * COARSE, &set_up).await?;
    let shares = 2.0 * (2.0 / (3.0 * PI)) * (4.0 / (3.0 * PI));
    let upwind = shares * SPEED * cell;
    let (name, unit) = ("numerical viscosity", "m²/s");
    let (viscosity, order, off) = match quality.air_advection {
        AirAdvection::FirstOrder => (share(name, unit, upwind, own, 0.10), 1.0, 0.15),
        AirAdvection::SecondOrder => (within(name, unit, 0.0, own, 0.10 * upwind), 2.0, 0.5),
    };
    Ok(vec![viscosity, within("order from 8 d to 4 d", "", order, (coarse / half).log2(), off)])
}

/// Edge of a cell, m, and viscosity on it, m²/s, with cells of `air_cell` d.
async fn viscosity(air_cell: f32, set_up: &SetUp) -> Result<(f64, f64), SceneError> {
    let mut blueprint = set_up.blueprint("vortex", &[])?;
    blueprint.quality.air_cell = air_cell;
    let (cell, size) = (blueprint.quality.air_cell, blueprint.domain.size);
    let speed = blueprint.scale.to_kernel(SPEED as f32);
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
    let (begun, wave) = (simulation.seconds(), PI / EDGE);
    let mut curve = vec![(0.0, 0.0)];
    while simulation.seconds() - begun < SECONDS {
        simulation.tick().await;
        curve.push((simulation.seconds() - begun, (start / simulation.air().kinetic_energy()).sqrt() - 1.0));
    }
    let slope = stats::line(&curve).map_or(f64::NAN, |(slope, _)| slope);
    Ok((f64::from(cell) * d, slope / (2.0 * wave * wave)))
}
