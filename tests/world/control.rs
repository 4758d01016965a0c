//! What is done to a world as a whole: load, reset, freeze and thaw, change of quality.

use crate::support::{Furnish, ROCK, Sandbox, WATER, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
        sources::{Emitter, Rect},
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode, Pass},
    },
    sim::{
        control,
        effects::Effects,
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        pace::Pace,
        state::{AirGrid, Clock, Counters, Setup},
    },
};
use std::sync::Arc;

/// A dam of water under a tap, with a rock that stands at `rock`.
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

fn pour(sandbox: &mut Sandbox) {
    sandbox.push(Intent::Draw { element: WATER, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(40.0, 20.0), 4.0) });
    sandbox.push(Intent::Stamp { element: ROCK, stroke: Stroke::dab(BrushShape::Square, Vec2::new(30.0, 2.0), 2.0) });
}

#[test]
fn reset_is_a_fresh_start_to_the_bit() {
    let mut fresh = Sandbox::of(scene((20, 0)));
    let start = fresh.hash();
    let mut reset = Sandbox::of(scene((20, 0)));
    pour(reset.tick(70));
    reset.tick(30);
    reset.get_mut::<IntentQueue>().push(Intent::ClearAir);
    reset.get_mut::<Effects>().get_mut(Effect::Viscosity).mode = Mode::On;
    control::reset(reset.app.world_mut());
    assert_eq!(reset.hash(), start, "reset does not go back to the start");
    assert_eq!(*reset.get::<Clock>(), *fresh.get::<Clock>());
    assert_eq!(reset.counters(), Counters::default());
    assert_eq!(reset.get::<PassLedger>().tick().calls, 0, "the books go on after a reset");
    assert!(reset.get::<IntentQueue>().is_empty(), "an intent of before the reset is still waiting");
    let effects = reset.get::<Effects>();
    assert_eq!(effects.get(Effect::Viscosity).mode, Mode::On, "reset forgets what the player switched");
    assert!(Effect::ALL.iter().all(|&effect| effects.get(effect).active_ticks == 0), "effects count on after a reset");
    assert_eq!(reset.tick(100).hash(), fresh.tick(100).hash(), "a world goes another way after a reset");
}

#[test]
fn a_thawed_world_goes_on_to_the_bit() {
    let mut sandbox = Sandbox::of(scene((20, 0)));
    pour(sandbox.tick(40));
    sandbox.tick(10);
    let frozen = control::freeze(sandbox.app.world());
    assert_eq!(frozen.hash(), sandbox.hash());
    let straight = sandbox.tick(60).hash();
    control::thaw(sandbox.app.world_mut(), &frozen);
    assert_eq!(sandbox.hash(), frozen.hash(), "thawing changes the state");
    assert_eq!(control::freeze(sandbox.app.world()), frozen, "a snapshot of a thawed world is another");
    assert_eq!(sandbox.tick(60).hash(), straight, "a thawed world goes another way");
    let mut other = Sandbox::of(scene((20, 0)));
    control::thaw(other.app.world_mut(), &frozen);
    assert_eq!(other.tick(60).hash(), straight, "a world thawed elsewhere goes another way");
}

#[test]
fn the_rock_of_another_scene_is_not_taken_for_this_ones() {
    // Same box, same number of changes to the rock: only the places differ.
    let mut fresh = Sandbox::of(scene((30, 0)));
    let mut loaded = Sandbox::of(scene((20, 0)));
    loaded.tick(20);
    control::load(loaded.app.world_mut(), Arc::new(scene((30, 0))));
    assert_eq!(loaded.tick(60).hash(), fresh.tick(60).hash());
}

#[test]
fn rock_that_was_changed_after_an_undo_is_seen() {
    let mut sandbox = Sandbox::of(scene((20, 0)));
    sandbox.tick(5);
    sandbox.get_mut::<Pace>().paused = true;
    let frozen = control::freeze(sandbox.app.world());
    let stamp = |x: f32| Intent::Stamp { element: ROCK, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(x, 4.5), 0.0) };
    sandbox.push(stamp(13.5)).tick(1);
    sandbox.get_mut::<Pace>().steps_due = 1;
    sandbox.tick(1);
    control::thaw(sandbox.app.world_mut(), &frozen);
    sandbox.push(stamp(14.5)).tick(1);
    sandbox.get_mut::<Pace>().paused = false;
    let mut other = Sandbox::of(scene((20, 0)));
    control::thaw(other.app.world_mut(), &frozen);
    other.push(stamp(14.5));
    assert_eq!(sandbox.tick(40).hash(), other.tick(40).hash(), "rock that was undone still pushes water");
}

#[test]
fn a_change_of_quality_keeps_the_world() {
    let mut sandbox = Sandbox::of(scene((20, 0)));
    pour(sandbox.tick(20));
    sandbox.push(Intent::Press { stroke: Stroke::dab(BrushShape::Disc, Vec2::new(30.0, 20.0), 6.0), amount: 0.5 });
    sandbox.tick(5);
    let (before, mass) = (control::freeze(sandbox.app.world()), sandbox.get::<AirGrid>().mass());
    for preset in Preset::ALL {
        control::set_quality(sandbox.app.world_mut(), preset, preset.quality());
        let after = control::freeze(sandbox.app.world());
        assert_eq!(after.particles, before.particles, "{}", preset.name());
        assert_eq!((after.solids, after.clock), (before.solids.clone(), before.clock), "{}", preset.name());
        let air = sandbox.get::<AirGrid>();
        assert_eq!(air.cell(), preset.quality().air_cell);
        assert!((air.mass() / mass - 1.0).abs() < 1e-4, "{}: air {} instead of {mass}", preset.name(), air.mass());
        let rock = (air.cell() / 2.0 + 20.0) / air.cell();
        assert!(air.is_solid_cell(rock as usize, 0), "{}: the air has lost sight of the rock", preset.name());
        assert_eq!(sandbox.get::<Setup>().preset, preset);
    }
    sandbox.tick(5);
    assert_eq!(sandbox.counters().non_finite, 0);
}

#[test]
fn reset_keeps_the_quality_that_the_player_chose() {
    let mut sandbox = Sandbox::of(scene((20, 0)));
    sandbox.tick(5);
    control::set_quality(sandbox.app.world_mut(), Preset::Draft, Preset::Draft.quality());
    control::reset(sandbox.app.world_mut());
    assert_eq!(sandbox.get::<Setup>().quality, Preset::Draft.quality());
    assert_eq!(sandbox.get::<AirGrid>().cell(), Preset::Draft.quality().air_cell);
    let mut fresh = scene((20, 0));
    (fresh.preset, fresh.quality) = (Preset::Draft, Preset::Draft.quality());
    // The air on other cells keeps its mass, not its pressure: only the particles can be compared.
    assert_eq!(sandbox.tick(30).particles(), Sandbox::of(fresh).tick(30).particles());
}

#[test]
fn edits_go_on_after_a_load() {
    let mut sandbox = Sandbox::of(scene((20, 0)));
    pour(&mut sandbox);
    control::load(sandbox.app.world_mut(), Arc::new(scene((30, 0))));
    sandbox.tick(1);
    assert_eq!(sandbox.calls(Pass::Edit), 0, "an intent for the old scene was done in the new one");
    pour(&mut sandbox);
    sandbox.tick(1);
    assert_eq!(sandbox.calls(Pass::Edit), 1);
}
