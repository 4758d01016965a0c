//! A Taylor–Green vortex in the air.

use crate::{
    kernel::{
        params::AirAdvection,
        sources::{Rect, Wind},
    },
    lab::{
        exam::{
            case::{
                ExamCase, Finding, Over, Setting, Size,
                Tolerance::{Share, Within},
            },
            world::{CaseSimulation, Stopwatch, own},
        },
        stats,
    },
    scene::SceneError,
    sim::state::Sources,
};
use glam::Vec2;
use std::f64::consts::PI;

pub(super) const VORTEX: ExamCase = ExamCase {
    name: "vortex",
    title: "Taylor–Green vortex",
    setup: "`u = U sin(k x) cos(k y)`, `v = −U cos(k x) sin(k y)` in a closed box of 12 m without rock, k = π/12 m, \
            U = 5 m/s = c/8. A fan in every cell brings the air to that speed in one tick; then the fans are taken away \
            (assets/exam/vortex.ron). Its energy is followed for 2.4 s: on cells of the quality, and for the order on cells of 8 d and of 4 d.",
    answer: "Without viscosity the vortex would last. First-order advection is an upwind scheme: along each axis it diffuses \
             with ½ |u| Δx. Averaged over the vortex, `dE/dt = −Δx U³ k² (⟨|s|c²⟩⟨|c|³⟩ + ⟨|s|³⟩⟨|c|s²⟩) = −0.180 Δx U³ k²`, \
             which a viscosity `ν = 0.180 U Δx` would do, too (`dE/dt = −4 ν k² E`, E = ¼ U²). It falls with U: \
             `√(E₀/E) = 1 + 2 ν₀ k² t`. Half the cell has half the viscosity: order 1. \
             With second-order advection none of it is left. What is, comes from mass, which is shared out to first order \
             and which the faces' filter κ evens out: mass that creeps along the vortex's own pressure `U²/4c²` does \
             the work `κ Δx k² U⁴/4c`, a viscosity of `κ U/4c · U Δx = 0.002 U Δx`, and its shares half as much again; and \
             from limited slopes at the peaks, which fall with the square of Δx or faster. From 8 d to 4 d the slopes are most \
             of it, and the order is 2. On finer cells what mass leaves takes over (1.5 from 4 d to 2 d, 1.0 from 1 d to \
             0.5 d), so the order is judged on the coarse ones.",
    tolerance: "First order: viscosity 10 %; the terms of second order, `½ u² Δt`, take 4 % off at this Courant number, sound \
                and walls take a little energy; order 0.15. Second order: a tenth of the viscosity of the first; an \
                order of 2 ± 0.5, which a scheme of first order misses.",
    over: Over::Air,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(vortex(setting, stopwatch)),
};

/// Speed U, m/s, and edge of the box, m.
const SPEED: f64 = 5.0;
const EDGE: f64 = 12.0;
/// Time over which it is followed, s: that in which U crosses the box.
const SECONDS: f64 = EDGE / SPEED;
/// Edge of the cells from which the order is judged, to half of it, d.
const COARSE: f32 = 8.0;

async fn vortex(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let (cell, own) = viscosity(setting.preset.quality().air_cell, &setting, &stopwatch).await?;
    let (_, coarse) = viscosity(COARSE, &setting, &stopwatch).await?;
    let (_, half) = viscosity(0.5 * COARSE, &setting, &stopwatch).await?;
    let shares = 2.0 * (2.0 / (3.0 * PI)) * (4.0 / (3.0 * PI));
    let upwind = shares * SPEED * cell;
    let (viscosity, order) = match setting.preset.quality().air_advection {
        AirAdvection::FirstOrder => ((upwind, Share(0.10)), (1.0, Within(0.15))),
        AirAdvection::SecondOrder => ((0.0, Within(0.10 * upwind)), (2.0, Within(0.5))),
    };
    let finding = |quantity, unit, (expected, tolerance), got| Finding { quantity, unit, expected, got, tolerance };
    Ok(vec![
        finding("numerical viscosity", "m²/s", viscosity, own),
        finding("order from 8 d to 4 d", "", order, (coarse / half).log2()),
    ])
}

/// Edge of a cell, m, and viscosity on it, m²/s, with cells of `air_cell` d.
async fn viscosity(air_cell: f32, setting: &Setting, stopwatch: &Stopwatch) -> Result<(f64, f64), SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/vortex.ron"));
    let mut blueprint = own("vortex", text, &[], setting)?;
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
            let fan = Wind { area: Rect { min, max: min + cell }, velocity: velocity * speed, rate: 1e6 };
            blueprint.winds.push(fan);
        }
    }
    let d = f64::from(blueprint.scale.spacing);
    let mut simulation = CaseSimulation::new(blueprint, stopwatch);
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
