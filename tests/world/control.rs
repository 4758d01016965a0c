//! What is done to a world as a whole: load, reset, freeze and thaw, change of quality.

use crate::support::{Furnish, ROCK, SimulationExt, WATER, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
        sources::{Emitter, Rect},
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{
        checkpoint::Checkpoint,
        control,
        effects::Effects,
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        pace::Pace,
        simulation::Simulation,
        state::{AirGrid, Clock, Counters, Setup},
    },
};
use std::sync::Arc;

/// A dam of water under an emitter, with a rock that stands at `rock`.
fn scene(rock: (i32, i32)) -> Blueprint {
    let mut blueprint = empty_box(48, 32);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.rock(rock, (rock.0 + 3, rock.1 + 6));
    blueprint.pool((0, 0), (12, 16));
    blueprint.emitters.push(Emitter {
        element: WATER,
        area: Rect { min: Vec2::new(20.0, 26.0), max: Vec2::new(26.0, 30.0) },
        velocity: Vec2::ZERO,
        rate: 60.0,
        total: None,
        start: 0,
        given: 0,
        due: 0.0,
    });
    blueprint
}

fn pour(simulation: &mut Simulation) {
    simulation.push(Intent::Draw { element: WATER, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(40.0, 20.0), 4.0) });
    simulation
        .push(Intent::Stamp { element: ROCK, stroke: Stroke::dab(BrushShape::Square, Vec2::new(30.0, 2.0), 2.0) });
}

#[test]
fn reset_is_a_fresh_start_to_the_bit() {
    let mut fresh = Simulation::of(scene((20, 0)));
    let start = fresh.hash();
    let mut reset = Simulation::of(scene((20, 0)));
    pour(reset.run(70));
    reset.run(30);
    reset.get_mut::<IntentQueue>().push(Intent::ClearAir);
    reset.get_mut::<Effects>().get_mut(Effect::Viscosity).mode = Mode::On;
    control::reset(reset.world_mut());
    assert_eq!(reset.hash(), start, "reset does not go back to the start");
    assert_eq!(*reset.get::<Clock>(), *fresh.get::<Clock>());
    assert_eq!(reset.counters(), Counters::default());
    assert_eq!(reset.get::<PassLedger>().tick().calls, 0, "the books go on after a reset");
    assert!(reset.get::<IntentQueue>().is_empty(), "an intent of before the reset is still waiting");
    let effects = reset.get::<Effects>();
    assert_eq!(effects.get(Effect::Viscosity).mode, Mode::On, "reset forgets what the player switched");
    assert!(Effect::ALL.iter().all(|&effect| effects.get(effect).active_ticks == 0), "effects count on after a reset");
    assert_eq!(reset.run(100).hash(), fresh.run(100).hash(), "a world goes another way after a reset");
}

#[test]
fn a_thawed_world_goes_on_to_the_bit() {
    let mut simulation = Simulation::of(scene((20, 0)));
    pour(simulation.run(40));
    simulation.run(10);
    let frozen = control::freeze(simulation.world());
    assert_eq!(frozen.hash(), simulation.hash());
    let straight = simulation.run(60).hash();
    control::thaw(simulation.world_mut(), &frozen);
    assert_eq!(simulation.hash(), frozen.hash(), "thawing changes the state");
    assert_eq!(control::freeze(simulation.world()), frozen, "a snapshot of a thawed world is another");
    assert_eq!(simulation.run(60).hash(), straight, "a thawed world goes another way");
    let mut other = Simulation::of(scene((20, 0)));
    control::thaw(other.world_mut(), &frozen);
    assert_eq!(other.run(60).hash(), straight, "a world thawed elsewhere goes another way");
}

#[test]
fn the_rock_of_another_scene_is_not_taken_for_this_ones() {
    // Same box, same number of changes to the rock: only the places differ.
    let mut fresh = Simulation::of(scene((30, 0)));
    let mut loaded = Simulation::of(scene((20, 0)));
    loaded.run(20);
    Checkpoint::of_scene(Arc::new(scene((30, 0)))).restore(loaded.world_mut());
    assert_eq!(loaded.run(60).hash(), fresh.run(60).hash());
}

#[test]
fn rock_that_was_changed_after_an_undo_is_seen() {
    let mut simulation = Simulation::of(scene((20, 0)));
    simulation.run(5);
    simulation.get_mut::<Pace>().paused = true;
    let frozen = control::freeze(simulation.world());
    let stamp = |x: f32| Intent::Stamp { element: ROCK, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(x, 4.5), 0.0) };
    simulation.push(stamp(13.5)).run(1);
    simulation.get_mut::<Pace>().steps_due = 1;
    simulation.run(1);
    control::thaw(simulation.world_mut(), &frozen);
    simulation.push(stamp(14.5)).run(1);
    simulation.get_mut::<Pace>().paused = false;
    let mut other = Simulation::of(scene((20, 0)));
    control::thaw(other.world_mut(), &frozen);
    other.push(stamp(14.5));
    assert_eq!(simulation.run(40).hash(), other.run(40).hash(), "rock that was undone still pushes water");
}

#[test]
fn a_change_of_quality_keeps_the_world() {
    let mut simulation = Simulation::of(scene((20, 0)));
    pour(simulation.run(20));
    simulation.push(Intent::Press { stroke: Stroke::dab(BrushShape::Disc, Vec2::new(30.0, 20.0), 6.0), amount: 0.5 });
    simulation.run(5);
    let (before, mass) = (control::freeze(simulation.world()), simulation.get::<AirGrid>().mass());
    // One of another detail makes other particles of it: `resampling`.
    for preset in Preset::ALL.into_iter().filter(|preset| preset.detail() == 1.0) {
        simulation.set_quality(preset, preset.quality()).unwrap();
        let after = control::freeze(simulation.world());
        assert_eq!(after.particles, before.particles, "{}", preset.name());
        assert_eq!((after.solids, after.clock), (before.solids.clone(), before.clock), "{}", preset.name());
        let air = simulation.get::<AirGrid>();
        assert_eq!(air.cell(), preset.quality().air_cell);
        assert!((air.mass() / mass - 1.0).abs() < 1e-4, "{}: air {} instead of {mass}", preset.name(), air.mass());
        let rock = (air.cell() / 2.0 + 20.0) / air.cell();
        assert!(air.is_solid_cell(rock as usize, 0), "{}: the air has lost sight of the rock", preset.name());
        assert_eq!(simulation.get::<Setup>().preset, preset);
    }
    simulation.run(5);
    assert_eq!(simulation.counters().non_finite, 0);
}

#[test]
fn reset_keeps_the_quality_that_the_player_chose() {
    let mut simulation = Simulation::of(scene((20, 0)));
    simulation.run(5);
    simulation.set_quality(Preset::Draft, Preset::Draft.quality()).unwrap();
    control::reset(simulation.world_mut());
    assert_eq!(simulation.get::<Setup>().quality, Preset::Draft.quality());
    assert_eq!(simulation.get::<AirGrid>().cell(), Preset::Draft.quality().air_cell);
    let mut fresh = scene((20, 0));
    (fresh.preset, fresh.quality) = (Preset::Draft, Preset::Draft.quality());
    // The air on other cells keeps its mass, not its pressure: only the particles can be compared.
    assert_eq!(simulation.run(30).particles(), Simulation::of(fresh).run(30).particles());
}

#[test]
fn edits_go_on_after_a_load() {
    let mut simulation = Simulation::of(scene((20, 0)));
    pour(&mut simulation);
    Checkpoint::of_scene(Arc::new(scene((30, 0)))).restore(simulation.world_mut());
    simulation.run(1);
    assert_eq!(simulation.calls(Pass::Edit), 0, "an intent for the old scene was done in the new one");
    pour(&mut simulation);
    simulation.run(1);
    assert_eq!(simulation.calls(Pass::Edit), 1);
}
