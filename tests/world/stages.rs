//! Each stage does its job, in its order, and only when it is called for.

use crate::support::{Furnish, ROCK, SimulationExt, WATER, blueprint, empty_box};
use bevy::{
    ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel, Schedules},
    prelude::{FixedUpdate, ResMut},
};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::OpenSides,
        sources::{Drain, Emitter, Rect, Wind},
    },
    scene::{
        blueprint::{Blueprint, PressurePatch},
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{
        control,
        effects::Effects,
        intent::Intent,
        pace::Pace,
        simulation::Simulation,
        stages::{Substep, TickPlan},
        state::{AirGrid, Clock},
    },
};

fn dab(x: f32, y: f32, radius: f32) -> Stroke {
    Stroke::dab(BrushShape::Disc, Vec2::new(x, y), radius)
}

/// Substeps that a tick of the puddle takes.
const SUBSTEPS: u64 = 2;

/// A puddle that falls, in still air, with gravity.
fn puddle() -> Blueprint {
    let mut blueprint = empty_box(30, 20);
    blueprint.quality.substeps = SUBSTEPS as u32;
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.pool((5, 3), (15, 8));
    blueprint
}

fn area(low: (f32, f32), high: (f32, f32)) -> Rect {
    Rect { min: low.into(), max: high.into() }
}

/// Makes an open order an error in the schedule and looks for one.
fn ambiguity(simulation: &mut Simulation, label: impl ScheduleLabel + Clone) -> Option<String> {
    let world = simulation.world_mut();
    let mut schedules = world.resource_mut::<Schedules>();
    let Some(schedule) = schedules.get_mut(label.clone()) else { panic!("no schedule of the tick") };
    schedule.set_build_settings(ScheduleBuildSettings {
        ambiguity_detection: LogLevel::Error,
        ..ScheduleBuildSettings::default()
    });
    world.schedule_scope(label, |world, schedule| schedule.initialize(world).err().map(|error| format!("{error:?}")))
}

#[test]
fn no_two_systems_of_a_tick_leave_their_order_open() {
    let mut simulation = Simulation::of(puddle());
    assert_eq!(ambiguity(&mut simulation, FixedUpdate), None);
    assert_eq!(ambiguity(&mut simulation, Substep), None);
}

#[test]
fn an_open_order_would_be_found() {
    fn write(_: ResMut<Clock>) {}
    let mut simulation = Simulation::of(puddle());
    simulation.get_mut::<Schedules>().add_systems(FixedUpdate, write);
    assert!(
        ambiguity(&mut simulation, FixedUpdate).is_some(),
        "a system that writes the clock at any time is not noticed"
    );
}

#[test]
fn a_simulation_begins_before_its_first_tick() {
    let mut simulation = Simulation::of(puddle());
    assert_eq!(simulation.get::<Clock>().tick, 0);
    simulation.run(3);
    assert_eq!(simulation.get::<Clock>().tick, 3);
    assert_eq!(simulation.get::<powder_master::sim::ledger::PassLedger>().tick().calls, 3);
}

#[test]
fn a_tick_calls_each_stage_as_often_as_the_plan_says() {
    let mut simulation = Simulation::of(puddle());
    simulation.run(10);
    assert_eq!(u64::from(simulation.get::<TickPlan>().substeps), SUBSTEPS);
    for pass in [Pass::Gravity, Pass::Pressure, Pass::Predict, Pass::Bin, Pass::Solve, Pass::Velocity] {
        assert_eq!(simulation.calls(pass), 10 * SUBSTEPS, "{}", pass.name());
    }
    for pass in [Pass::Sources, Pass::Measure] {
        assert_eq!(simulation.calls(pass), 10, "{}", pass.name());
    }
    assert_eq!(simulation.calls(Pass::Edit), 0, "edits ran without an intent");
}

#[test]
fn gravity_pulls_and_the_floor_holds() {
    let mut simulation = Simulation::of(puddle());
    simulation.run(1);
    assert!(simulation.particles().vy.iter().all(|&vy| vy < 0.0), "something does not fall");
    simulation.run(720);
    let particles = simulation.particles();
    let (low, high) = particles.y.iter().fold((f32::MAX, 0.0_f32), |(low, high), &y| (low.min(y), high.max(y)));
    assert!(low >= 0.25 && high < 5.0, "50 particles on a floor of 30 d stand from {low} to {high}");
}

#[test]
fn an_intent_is_done_in_the_tick_after_it_in_order() {
    let mut simulation = Simulation::of(empty_box(30, 20));
    simulation.push(Intent::Stamp { element: WATER, stroke: dab(10.0, 10.0, 3.0) });
    simulation.push(Intent::Stamp { element: ROCK, stroke: dab(20.0, 10.0, 2.0) });
    simulation.push(Intent::Erase { stroke: dab(20.0, 10.0, 0.0) });
    assert!(simulation.particles().is_empty());
    simulation.run(1);
    assert!((25..=32).contains(&simulation.particles().len()), "{} particles", simulation.particles().len());
    let rock = simulation.rock().count();
    assert!((10..=15).contains(&rock), "{rock} cells of rock");
    assert!(!simulation.rock().is_solid(glam::IVec2::new(20, 10)), "erasing did not come after placing");
    assert_eq!(simulation.get::<Clock>().edits, 3);
    assert_eq!(simulation.calls(Pass::Edit), 1);
    let census = simulation.census();
    assert_eq!(census.by_element[..2], [rock as u32, simulation.particles().len() as u32]);
    assert_eq!(census.total as usize, rock + simulation.particles().len());
    simulation.run(5);
    assert_eq!(simulation.calls(Pass::Edit), 1, "an intent was done twice");
}

#[test]
fn emitters_flow_and_drains_take() {
    let mut blueprint = puddle();
    blueprint.emitters.push(Emitter {
        element: WATER,
        area: area((2.0, 15.0), (8.0, 18.0)),
        velocity: Vec2::new(0.0, -20.0),
        rate: 120.0,
        total: Some(60),
        start: 10,
        given: 0,
        due: 0.0,
    });
    blueprint.drains.push(Drain { area: area((0.0, 0.0), (30.0, 2.0)) });
    let mut simulation = Simulation::of(blueprint);
    simulation.run(10);
    assert_eq!(simulation.particles().len(), 50, "the emitter flowed early, or the drain took what is above it");
    simulation.run(15);
    assert!(simulation.particles().id.iter().any(|&id| id >= 50), "the emitter is dry");
    simulation.run(600);
    let left = simulation.particles().len();
    assert!(left < 20, "{left} of 110 particles are left beside a drain");
    assert!(simulation.particles().y.iter().all(|&y| y < 4.0));
}

#[test]
fn a_pause_stops_time_but_not_edits_and_single_steps_count() {
    let mut simulation = Simulation::of(puddle());
    simulation.run(5);
    simulation.get_mut::<Pace>().paused = true;
    let before = simulation.hash();
    simulation.run(20);
    assert_eq!(simulation.hash(), before, "the world moved during the pause");
    assert_eq!(simulation.get::<Clock>().tick, 5);
    simulation.push(Intent::Stamp { element: WATER, stroke: dab(25.0, 15.0, 1.5) });
    simulation.run(1);
    let count = simulation.particles().len();
    assert!(count > 50, "an edit during the pause was not done");
    assert_eq!(simulation.census().total as usize, count, "the count lags behind an edit during the pause");
    simulation.get_mut::<Pace>().steps_due = 3;
    simulation.run(10);
    assert_eq!(
        (simulation.get::<Clock>().tick, simulation.get::<Pace>().steps_due),
        (8, 0),
        "three steps are three ticks"
    );
    simulation.get_mut::<Pace>().paused = false;
    simulation.run(2);
    assert_eq!(simulation.get::<Clock>().tick, 10);
}

#[test]
fn a_pause_leaves_no_trace() {
    let (mut straight, mut paused) = (Simulation::of(puddle()), Simulation::of(puddle()));
    straight.run(40);
    paused.run(13);
    paused.get_mut::<Pace>().paused = true;
    paused.run(7);
    paused.get_mut::<Pace>().steps_due = 2;
    paused.run(5);
    paused.get_mut::<Pace>().paused = false;
    paused.run(25);
    assert_eq!(paused.hash(), straight.hash());
}

#[test]
fn an_effect_that_is_off_has_no_call_and_one_that_is_on_has_all() {
    for effect in Effect::ALL {
        for (mode, ticks) in [(Mode::Off, 0), (Mode::On, 10)] {
            let mut blueprint = puddle();
            blueprint.effects.insert(effect, mode);
            let mut simulation = Simulation::of(blueprint);
            simulation.run(10);
            let state = simulation.get::<Effects>().get(effect);
            assert_eq!((state.mode, state.active_ticks), (mode, ticks), "{}", effect.name());
            assert!(!state.why.is_empty());
            // Sleep has none: it looks now and then.
            for pass in effect.row().passes.iter().filter(|pass| pass.row().each_substep) {
                assert_eq!(simulation.calls(*pass), SUBSTEPS * ticks, "{}: {mode:?}", effect.name());
            }
        }
    }
}

#[test]
fn an_effect_changes_the_world_when_it_has_something_to_do() {
    let run = |effect: Effect, mode: Mode| {
        let mut blueprint = puddle();
        blueprint.effects.insert(effect, mode);
        for vx in &mut blueprint.particles.vx[..20] {
            *vx = 60.0;
        }
        blueprint.winds.push(Wind { area: area((0.0, 0.0), (30.0, 20.0)), velocity: Vec2::new(50.0, 0.0), rate: 10.0 });
        Simulation::of(blueprint).run(20).hash()
    };
    for effect in [Effect::Drag, Effect::Viscosity, Effect::Vorticity, Effect::Tension] {
        assert_ne!(run(effect, Mode::On), run(effect, Mode::Off), "{} does nothing", effect.name());
    }
}

#[test]
fn auto_runs_an_effect_only_where_something_calls_for_it() {
    let mut simulation = Simulation::of(empty_box(30, 20));
    simulation.run(5);
    for effect in Effect::ALL {
        let state = simulation.get::<Effects>().get(effect);
        assert_eq!(state.active_ticks, 0, "{} ran in an empty box: {}", effect.name(), state.why);
    }
    simulation.push(Intent::Stamp { element: WATER, stroke: dab(10.0, 10.0, 3.0) });
    simulation.run(1);
    for effect in [Effect::Drag, Effect::Viscosity, Effect::Vorticity, Effect::Tension] {
        let state = simulation.get::<Effects>().get(effect);
        assert!(state.running, "{} does not run on water: {}", effect.name(), state.why);
    }
    assert!(!simulation.get::<Effects>().get(Effect::Air).running, "still air is moved");
    simulation.push(Intent::Erase { stroke: Stroke::rectangle(Vec2::ZERO, Vec2::new(30.0, 20.0)) });
    simulation.run(1);
    for effect in Effect::ALL {
        assert!(!simulation.get::<Effects>().get(effect).running, "{} runs on nothing", effect.name());
    }
}

#[test]
fn auto_is_on_bit_for_bit_where_there_is_nothing_to_do() {
    // Still air, nothing viscous, nothing that keeps eddies or feels the air: every effect has nothing to do.
    for effect in [Effect::Air, Effect::Drag, Effect::Viscosity, Effect::Vorticity, Effect::Tension] {
        let run = |mode| {
            let mut blueprint = puddle();
            let mut rows: Vec<_> = blueprint.elements.iter().map(|(_, element)| element.clone()).collect();
            let water = &mut rows[WATER.index()];
            (water.drag, water.viscosity, water.smoothing, water.vorticity) = (0.0, 0.0, 0.0, 0.0);
            blueprint.elements = std::sync::Arc::new(powder_master::kernel::element::ElementTable::new(rows));
            blueprint.fluid.tension_strength = 0.0;
            blueprint.effects.insert(effect, mode);
            let mut simulation = Simulation::of(blueprint);
            let hash = simulation.run(100).hash();
            (simulation.get::<Effects>().get(effect).active_ticks, hash)
        };
        let (auto, on, off) = (run(Mode::Auto), run(Mode::On), run(Mode::Off));
        assert!(auto.0 == 0 && on.0 == 100 && off.0 == 0, "{}: {auto:?} {on:?} {off:?}", effect.name());
        assert!(auto.1 == on.1 && auto.1 == off.1, "{} changes a world that it has no part in", effect.name());
    }
}

#[test]
fn modes_can_be_switched_while_it_runs() {
    let mut simulation = Simulation::of(puddle());
    simulation.run(3);
    simulation.get_mut::<Effects>().get_mut(Effect::Viscosity).mode = Mode::Off;
    let calls = simulation.calls(Pass::Viscosity);
    simulation.run(3);
    assert_eq!(simulation.calls(Pass::Viscosity), calls);
}

#[test]
fn air_that_is_switched_off_stands_whatever_moved_it() {
    let wind = || Intent::Blow { stroke: dab(10.0, 10.0, 8.0), velocity: Vec2::new(300.0, 0.0) };
    let patch = PressurePatch { area: Rect { min: Vec2::ZERO, max: Vec2::splat(9.0) }, pressure: 3.0, kelvin: 293.0 };
    let mut never = puddle();
    never.effects.insert(Effect::Air, Mode::Off);
    let positions = |simulation: &Simulation| (simulation.particles().x.clone(), simulation.particles().y.clone());
    let quiet = positions(Simulation::of(never.clone()).run(30));
    never.pressures.push(patch);
    let mut never = Simulation::of(never);
    assert_eq!(positions(never.push(wind()).run(30)), quiet, "wind and pressure move what is in air that stands");
    assert!(!never.get::<AirGrid>().is_built(), "a grid for air that stands");
    let mut simulation = Simulation::of(puddle());
    simulation.push(wind()).run(2);
    assert!(!simulation.get::<AirGrid>().is_quiet());
    let before = control::freeze(simulation.world());
    for _ in 0..2 {
        simulation.push(Intent::Effect { effect: Effect::Air, mode: Mode::Off }).run(1);
        assert!(simulation.get::<AirGrid>().is_quiet(), "the wind stays for ever");
        // A state from when it blew is put back.
        control::thaw(simulation.world_mut(), &before);
    }
}

#[test]
fn a_tool_that_moves_no_air_moves_no_water() {
    let run = |blown: Option<Vec2>| {
        let mut blueprint = puddle();
        blueprint.rock((0, 0), (30, 3));
        let mut simulation = Simulation::of(blueprint);
        simulation.run(3);
        if let Some(velocity) = blown {
            simulation.push(Intent::Blow { stroke: dab(10.0, 5.0, 8.0), velocity });
        }
        simulation.run(3).particles().clone()
    };
    let left = run(None);
    assert_eq!(run(Some(Vec2::ZERO)), left, "a tool that blows with nothing slows water");
    assert_ne!(run(Some(Vec2::X)), left, "nothing was blown at");
}

#[test]
fn faster_water_takes_more_substeps_up_to_the_bound_and_is_slowed_past_it() {
    let run = |speed: f32| {
        let mut blueprint = empty_box(200, 20);
        blueprint.quality.substeps = 4;
        blueprint.effects.insert(Effect::Drag, Mode::Off);
        blueprint.water(Vec2::new(10.0, 10.0), Vec2::new(speed, 0.0));
        let mut simulation = Simulation::of(blueprint);
        simulation.run(1);
        (simulation.get::<TickPlan>().substeps, simulation.counters())
    };
    // A substep moves at most 4 h = 10 d; 4 substeps at rest, 12 at most.
    let (slow, counters) = run(600.0);
    assert_eq!((slow, counters.speed_clamps, counters.substeps_max), (4, 0, 4));
    let (fast, counters) = run(3000.0);
    assert_eq!((fast, counters.speed_clamps), (6, 0));
    let (fastest, counters) = run(60_000.0);
    assert_eq!((fastest, counters.substeps_max), (12, 12));
    assert!(counters.speed_clamps > 0, "a speed past the bound was neither cut nor counted");
}

#[test]
fn a_full_world_stops_politely() {
    let mut blueprint = blueprint("empty", &[("particle_limit", "40")]);
    blueprint.domain.gravity = Vec2::ZERO;
    let mut simulation = Simulation::of(blueprint);
    simulation.push(Intent::Stamp { element: WATER, stroke: dab(50.0, 50.0, 6.0) });
    simulation.run(1);
    assert_eq!(simulation.particles().len(), 40);
    assert!(simulation.census().full && simulation.counters().refused > 0);
    simulation.push(Intent::Draw { element: ROCK, stroke: dab(100.0, 50.0, 2.0) });
    simulation.run(1);
    assert_eq!(simulation.rock().count(), 0, "rock went past the limit");
    assert!(simulation.census().full);
    simulation.push(Intent::Erase { stroke: dab(50.0, 50.0, 20.0) });
    simulation.push(Intent::Stamp { element: WATER, stroke: dab(50.0, 50.0, 2.0) });
    simulation.run(1);
    assert!(!simulation.census().full, "full although there is room again");
}

#[test]
fn a_wind_drives_the_air_and_the_air_carries_water() {
    let mut blueprint = empty_box(60, 20);
    blueprint.air.open = OpenSides { left: true, right: true, ..OpenSides::default() };
    blueprint.winds.push(Wind { area: area((0.0, 0.0), (60.0, 20.0)), velocity: Vec2::new(80.0, 0.0), rate: 20.0 });
    blueprint.water(Vec2::new(5.0, 10.0), Vec2::ZERO);
    let mut simulation = Simulation::of(blueprint);
    simulation.run(30);
    assert!(simulation.calls(Pass::Air) > 0, "no air moves although a wind blows");
    assert!(!simulation.get::<AirGrid>().is_quiet());
    assert!(simulation.particles().vx[0] > 1.0, "the wind does not take water along");
}
