//! The autopilot in real scenes: for how long error and time are over their bound, how often the quality changes, and
//! what it costs. The time is counted work, so that it is the same on every machine.

use crate::{
    kernel::units::{TICK_SECONDS, TICKS_PER_SECOND},
    lab::{
        autopilot::{Autopilot, Goal, controller::Verdict, plugin, steer},
        dial,
        live::{
            LivePlugin,
            accuracy::{LiveError, SAMPLE_EVERY, Watched},
        },
    },
    scene::{self, effects::EffectModes, passes::Pass},
    sim::{
        checkpoint::Checkpoint,
        ledger::{Extent, PassLedger},
        simulation::Simulation,
        state::Setup,
        workers::Workers,
    },
};
use bevy::prelude::{App, FixedUpdate, IntoScheduleConfigs, Res, ResMut, Resource, resource_exists};
use std::{collections::VecDeque, sync::Arc, time::Duration};

/// Ticks of a minute.
const MINUTE: u64 = 3600;
/// Ticks that it is given to begin: the first second.
const BEGUN: u64 = 60;
/// What a substep of an air cell takes, in iterations of a particle: 0.15 by the ledger in `waterfall` and
/// `wind_tunnel`.
const AIR_CELL: f32 = 0.15;
/// ms that the bound on a tick's work stands for.
const BOUND_MS: f32 = 8.0;

/// What came of a run under the autopilot.
#[derive(Debug)]
struct Held {
    /// Share of the samples after the first second whose mean over half a second is over the bound.
    over: f32,
    /// The longest time over the bound without a break, s.
    longest: f32,
    /// Moves a minute in the second half.
    late_moves: f32,
    /// Mean work of the quality in force, in units of an iteration (see [`dial::work`]).
    work: f32,
    /// The mean of what is held in the second half, as a share of the bound.
    used: f32,
}

/// A scene at its start, watched, under an autopilot that holds `goal`.
fn begin(scene: &str, goal: Goal) -> Simulation {
    let blueprint = scene::load(scene).unwrap().build(&[], None, &EffectModes::new()).unwrap();
    let start = Checkpoint::of_scene(Arc::new(blueprint));
    let mut simulation = Simulation::with_plugins(&start, Workers::single(), |app: &mut App| {
        app.add_plugins((LivePlugin, plugin));
        let count_work = count_work.after(Pass::Measure).before(steer);
        app.add_systems(FixedUpdate, count_work.run_if(resource_exists::<CountedWork>));
    });
    simulation.get_mut::<Watched>().0 = true;
    simulation.get_mut::<Autopilot>().hold(Some(goal));
    simulation
}

/// Holds `goal` for so many minutes; `shown` is what is held, over the bound above 1, at each sample.
fn hold(mut simulation: Simulation, minutes: u64, shown: impl Fn(&Simulation) -> Option<f32>) -> Held {
    let ticks = minutes * MINUTE;
    let mut held = Held { over: 0.0, longest: 0.0, late_moves: 0.0, work: 0.0, used: 0.0 };
    let (mut samples, mut over, mut in_a_row, mut early_moves) = (0, 0, 0, 0);
    for tick in 1..=ticks {
        simulation.tick();
        held.work += dial::work(&simulation.get::<Setup>().quality) / ticks as f32;
        if tick == ticks / 2 {
            early_moves = simulation.get::<Autopilot>().moves();
        }
        if tick <= BEGUN || !tick.is_multiple_of(SAMPLE_EVERY) {
            continue;
        }
        let share = shown(&simulation).unwrap_or(0.0);
        if tick > ticks / 2 {
            held.used += share * SAMPLE_EVERY as f32 / (ticks / 2) as f32;
        }
        in_a_row = if share > 1.0 { in_a_row + 1 } else { 0 };
        samples += 1;
        over += u32::from(share > 1.0);
        held.longest = held.longest.max(in_a_row as f32 * SAMPLE_EVERY as f32 * TICK_SECONDS);
    }
    let autopilot = simulation.get::<Autopilot>();
    assert_ne!(autopilot.verdict(), Verdict::Beyond, "the last level holds this bound all the time");
    held.over = over as f32 / samples as f32;
    held.late_moves = 2.0 * (autopilot.moves() - early_moves) as f32 / minutes as f32;
    held
}

/// Holds the error of a scene; the work may be `most_work` on average.
fn check(scene: &str, percent: f32, minutes: u64, most_work: f32) {
    let bound = percent / 100.0;
    let simulation = begin(scene, Goal::Error(bound));
    let held = hold(simulation, minutes, |simulation| Some(simulation.get::<LiveError>().mean()? / bound));
    println!("{scene} at {percent} %: {held:?}");
    assert!(held.over <= 0.02, "{held:?}");
    assert!(held.longest <= 0.5 + 1e-3, "{held:?}");
    assert!(held.late_moves <= 6.0, "{held:?}");
    assert!(held.work <= most_work, "{held:?}");
}

// The bounds lie between what `draft` and `fine` leave in these scenes (docs/accuracy.md). The level above `fine`, three
// substeps of four iterations, takes a work of 10.8: a tenth more is given for what it takes to find that it is enough.
// The waterfall's is held by the command (tests/cli).
#[test]
fn the_error_of_the_dam_break_is_held() {
    check("dam_break", 0.6, 1, 11.9);
}

#[test]
fn nothing_is_spent_on_the_error_of_the_wind_tunnels_droplets() {
    // There are a few particles inside of them at a time, and no error to speak of. From `balanced`, of a work of 6, it
    // may go down once the budget holds the price of a failure, half a second at 1.5 % of the time: after 33 s; two
    // levels at a time, and so in two moves to `draft`, of 3. Of two minutes that makes 3.9 at most.
    check("wind_tunnel", 0.6, 2, 3.9);
}

/// Work of the last ticks as the ledger counts it: half a second of them.
#[derive(Resource)]
struct CountedWork {
    /// The bound, iterations of a particle a tick.
    bound: f32,
    /// Shares of it.
    recent: VecDeque<f32>,
}

/// Puts the counted work in the place of the time that a tick took.
fn count_work(setup: Res<Setup>, mut counted: ResMut<CountedWork>, mut ledger: ResMut<PassLedger>) {
    let each = dial::work(&setup.quality) / setup.quality.substeps as f32;
    let touched = |pass| ledger.record(pass).last.touched as f32;
    let share = (each * touched(Pass::Solve) + AIR_CELL * touched(Pass::Air)) / counted.bound;
    ledger.end_tick(Extent::default(), Duration::from_secs_f32(BOUND_MS / 1000.0 * share));
    if counted.recent.len() == TICKS_PER_SECOND as usize / 2 {
        counted.recent.pop_front();
    }
    counted.recent.push_back(share);
}

/// Holds a scene's work, in iterations of a particle a tick, for two minutes.
fn check_time(scene: &str, bound: f32) {
    let mut simulation = begin(scene, Goal::Time(BOUND_MS));
    simulation.world_mut().insert_resource(CountedWork { bound, recent: VecDeque::new() });
    let held = hold(simulation, 2, |simulation| {
        let recent = &simulation.get::<CountedWork>().recent;
        Some(recent.iter().sum::<f32>() / recent.len() as f32)
    });
    println!("{scene} at {bound} iterations of a particle: {held:?}");
    assert!(held.over <= 0.02, "{held:?}");
    // Half a second until it is met, and half a second until the mean over as much shows that.
    assert!(held.longest <= 1.0 + 1e-3, "{held:?}");
    assert!(held.late_moves <= 6.0, "{held:?}");
    // It moves to what is expected below 0.7 of the bound, and the levels are apart by 1.67 at most.
    assert!(held.used >= 0.7 / 1.67, "the time is not used: {held:?}");
}

// The bounds of the time lie between what `draft` and `fine` take, so that there are levels on both sides. In the dam
// break, 10,082 particles, that is 30,000 and 73,000, and the scene's own `balanced`, 60,000, is over the bound at
// once.
#[test]
fn the_time_of_the_dam_break_is_held() {
    check_time("dam_break", 50_000.0);
}

// Its water comes in the course of a minute: 10,400 particles, with the air 32,000 at `draft` and 84,000 at `fine`.
#[test]
fn the_time_of_the_waterfall_is_held_while_it_fills() {
    check_time("waterfall", 80_000.0);
}

// Some 1,240 droplets in much air: 3,900 at `draft` and 11,500 at `fine`, of which the air takes a fifth.
#[test]
fn the_time_of_the_wind_tunnel_is_held() {
    check_time("wind_tunnel", 9_000.0);
}
