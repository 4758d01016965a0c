//! The ledger counts what the stages worked on and what they were spared.

use crate::support::{Furnish, Sandbox, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::brush::{BrushShape, Stroke},
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode, Pass},
    },
    sim::{
        effects::{
            Effects,
            status::{self, Activity, EffectStatus, Sleepers},
        },
        intent::Intent,
        ledger::{PassLedger, PassRecord},
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

fn ledger(sandbox: &Sandbox) -> &PassLedger {
    sandbox.get()
}

fn account(sandbox: &Sandbox, effect: Effect) -> EffectStatus {
    EffectStatus::of(effect, sandbox.get(), Sleepers::in_world(sandbox.app.world()))
}

fn saving(sandbox: &Sandbox, effect: Effect) -> Option<f64> {
    status::saving(effect, sandbox.get::<Effects>(), ledger(sandbox), PassRecord::saved_last)
}

#[test]
fn who_is_awake_is_worked_on_and_who_sleeps_is_spared() {
    let mut sandbox = Sandbox::of(pool());
    sandbox.tick(10);
    let substeps = u64::from(sandbox.get::<TickPlan>().substeps);
    for pass in [Pass::Gravity, Pass::Pressure, Pass::Predict, Pass::Bin, Pass::Solve, Pass::Velocity] {
        let record = ledger(&sandbox).record(pass);
        assert_eq!((record.last.touched, record.spared), (substeps * POOL, 0), "{}", pass.name());
        assert!(record.each().is_some_and(|each| each > 0.0), "{}", pass.name());
    }
    assert_eq!(ledger(&sandbox).record(Pass::Measure).touched, 10 * POOL);
    assert_eq!(account(&sandbox, Effect::Viscosity).text(), "runs: a viscous liquid is there");
    assert_eq!(saving(&sandbox, Effect::Sleep), Some(0.0));
    assert_eq!(saving(&sandbox, Effect::Drag), None, "nobody knows what drag would take here");

    for _ in 0..2000 {
        sandbox.tick(1);
        if account(&sandbox, Effect::Viscosity).activity == Activity::Asleep {
            break;
        }
    }
    sandbox.tick(1);
    assert_eq!(account(&sandbox, Effect::Viscosity).text(), "asleep: all 200 particles");
    assert!(!account(&sandbox, Effect::Predictor).works && account(&sandbox, Effect::Sleep).works);
    let substeps = u64::from(sandbox.get::<TickPlan>().substeps);
    let record = ledger(&sandbox).record(Pass::Solve);
    assert_eq!((record.last.calls, record.last.touched, record.last.spared), (0, 0, substeps * POOL));
    let saved: f64 = [Pass::Gravity, Pass::Pressure, Pass::Predict, Pass::Bin, Pass::Solve, Pass::Velocity]
        .into_iter()
        .chain([Pass::Viscosity, Pass::Vorticity])
        .map(|pass| ledger(&sandbox).record(pass).saved_last().unwrap_or(f64::NAN))
        .sum();
    assert!(saved > 0.0);
    assert!((saving(&sandbox, Effect::Sleep).unwrap_or(f64::NAN) - saved).abs() < 1e-9 * saved, "sleep saves it all");

    sandbox.push(Intent::Effect { effect: Effect::Viscosity, mode: Mode::Off });
    sandbox.tick(2);
    assert_eq!(account(&sandbox, Effect::Viscosity).text(), "off: switched off");
    assert!(saving(&sandbox, Effect::Viscosity).is_some_and(|saved| saved > 0.0), "it ran, and its price is known");
}

#[test]
fn tiles_that_sleep_are_spared_and_said_to() {
    let mut sandbox = Sandbox::of(empty_box(1024, 512));
    let cells = {
        let air = sandbox.get::<AirGrid>();
        (air.columns() * air.rows()) as u64
    };
    sandbox.tick(1);
    let still = ledger(&sandbox).record(Pass::Air);
    assert_eq!((still.calls, still.touched, still.last.spared % cells), (0, 0, 0));
    assert!(still.last.spared >= cells && still.saved().is_none(), "air that never moved has no price");
    assert_eq!(account(&sandbox, Effect::Air).text(), "off: the air is still");

    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(60.0, 60.0), 10.0);
    sandbox.push(Intent::Blow { stroke, velocity: Vec2::new(40.0, 0.0) });
    sandbox.tick(1);
    let work = ledger(&sandbox).record(Pass::Air).last;
    assert!(work.touched > 0 && work.touched < work.spared, "a gust in a corner: {work:?}");
    assert_eq!((work.touched + work.spared) % cells, 0, "not every cell is worked on or spared");
    let (asleep, tiles) = sandbox.get::<AirGrid>().sleeping_tiles();
    assert!(asleep > tiles / 2 && asleep < tiles);
    assert_eq!(account(&sandbox, Effect::Air).text(), format!("asleep: {asleep} of {tiles} tiles"));
    assert!(saving(&sandbox, Effect::Sleep).is_some_and(|saved| saved > 0.0));
}
