//! The ledger counts what the stages worked on and what they were spared.

use crate::support::{Furnish, SimulationExt, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::brush::{BrushShape, Stroke},
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{
        effects::{
            Effects,
            status::{self, Activity, EffectStatus, Sleepers},
        },
        intent::Intent,
        ledger::{PassLedger, PassRecord},
        simulation::Simulation,
        stages::TickPlan,
        state::AirGrid,
    },
};

/// Particles of the pool.
const POOL: u64 = 200;

/// A pool that falls asleep, in air that is off.
fn pool() -> Blueprint {
    let mut blueprint = empty_box(40, 40);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.effects.extend([(Effect::Air, Mode::Off), (Effect::Drag, Mode::Off)]);
    blueprint.pool((0, 0), (40, 5));
    blueprint
}

fn ledger(simulation: &Simulation) -> &PassLedger {
    simulation.get()
}

fn account(simulation: &Simulation, effect: Effect) -> EffectStatus {
    EffectStatus::of(effect, simulation.get(), Sleepers::in_world(simulation.world()))
}

fn saving(simulation: &Simulation, effect: Effect) -> Option<f64> {
    status::saving(effect, simulation.get::<Effects>(), ledger(simulation), PassRecord::saved_last)
}

#[test]
fn who_is_awake_is_worked_on_and_who_sleeps_is_spared() {
    let mut simulation = Simulation::of(pool());
    simulation.run(10);
    let substeps = u64::from(simulation.get::<TickPlan>().substeps);
    for pass in [Pass::Gravity, Pass::Pressure, Pass::Predict, Pass::Bin, Pass::Solve, Pass::Velocity] {
        let record = ledger(&simulation).record(pass);
        assert_eq!((record.last.touched, record.spared), (substeps * POOL, 0), "{}", pass.name());
        assert!(record.each().is_some_and(|each| each > 0.0), "{}", pass.name());
    }
    assert_eq!(ledger(&simulation).record(Pass::Measure).touched, 10 * POOL);
    assert_eq!(account(&simulation, Effect::Viscosity).text(), "runs: a viscous liquid is there");
    assert_eq!(saving(&simulation, Effect::Sleep), Some(0.0));
    assert_eq!(saving(&simulation, Effect::Drag), None, "nobody knows what drag would take here");

    for _ in 0..2000 {
        simulation.run(1);
        if account(&simulation, Effect::Viscosity).activity == Activity::Asleep {
            break;
        }
    }
    simulation.run(1);
    assert_eq!(account(&simulation, Effect::Viscosity).text(), "asleep: all 200 particles");
    assert!(!account(&simulation, Effect::Predictor).works && account(&simulation, Effect::Sleep).works);
    let substeps = u64::from(simulation.get::<TickPlan>().substeps);
    let record = ledger(&simulation).record(Pass::Solve);
    assert_eq!((record.last.calls, record.last.touched, record.last.spared), (0, 0, substeps * POOL));
    let saved: f64 = [Pass::Gravity, Pass::Pressure, Pass::Predict, Pass::Bin, Pass::Solve, Pass::Velocity]
        .into_iter()
        .chain([Pass::Viscosity, Pass::Vorticity])
        .map(|pass| ledger(&simulation).record(pass).saved_last().unwrap_or(f64::NAN))
        .sum();
    assert!(saved > 0.0);
    assert!(
        (saving(&simulation, Effect::Sleep).unwrap_or(f64::NAN) - saved).abs() < 1e-9 * saved,
        "sleep saves it all"
    );

    simulation.push(Intent::Effect { effect: Effect::Viscosity, mode: Mode::Off });
    simulation.run(2);
    assert_eq!(account(&simulation, Effect::Viscosity).text(), "off: switched off");
    assert!(saving(&simulation, Effect::Viscosity).is_some_and(|saved| saved > 0.0), "it ran, and its price is known");
}

#[test]
fn tiles_that_sleep_are_spared_and_said_to() {
    let mut simulation = Simulation::of(empty_box(1024, 512));
    let cells = {
        let air = simulation.get::<AirGrid>();
        (air.columns() * air.rows()) as u64
    };
    simulation.run(1);
    let still = ledger(&simulation).record(Pass::Air);
    assert_eq!((still.calls, still.touched, still.last.spared % cells), (0, 0, 0));
    assert!(still.last.spared >= cells && still.saved().is_none(), "air that never moved has no price");
    assert_eq!(account(&simulation, Effect::Air).text(), "off: the air is still");

    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(60.0, 60.0), 10.0);
    simulation.push(Intent::Blow { stroke, velocity: Vec2::new(40.0, 0.0) });
    simulation.run(1);
    let work = ledger(&simulation).record(Pass::Air).last;
    assert!(work.touched > 0 && work.touched < work.spared, "a gust in a corner: {work:?}");
    assert_eq!((work.touched + work.spared) % cells, 0, "not every cell is worked on or spared");
    let (asleep, tiles) = simulation.get::<AirGrid>().sleeping_tiles();
    assert!(asleep > tiles / 2 && asleep < tiles);
    assert_eq!(account(&simulation, Effect::Air).text(), format!("asleep: {asleep} of {tiles} tiles"));
    assert!(saving(&simulation, Effect::Sleep).is_some_and(|saved| saved > 0.0));
}
