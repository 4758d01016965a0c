//! The autopilot in real scenes: for how long the error is over its bound, how often the quality changes, and what it costs.

use crate::{
    kernel::units::TICK_SECONDS,
    lab::{
        autopilot::{Autopilot, Goal, controller::Verdict, ladder, plugin},
        live::{
            LivePlugin,
            accuracy::{LiveError, SAMPLE_EVERY, Watched},
        },
    },
    scene::{self, effects::EffectModes},
    sim::{checkpoint::Checkpoint, simulation::Simulation, state::Setup, workers::Workers},
};
use std::sync::Arc;

/// Ticks of a minute.
const MINUTE: u64 = 3600;
/// Ticks that it is given to begin: the first second.
const BEGUN: u64 = 60;

/// What came of a run under the autopilot.
#[derive(Debug)]
struct Held {
    /// Share of the samples after the first second whose shown error, the mean over half a second, is over the bound.
    over: f32,
    /// The longest time over the bound without a break, s.
    longest: f32,
    /// Moves a minute in the second half.
    late_moves: f32,
    /// Mean work of a tick, in units of an iteration (see [`ladder::work`]).
    work: f32,
}

/// Holds `percent` of density error in a scene from its start on, for so many minutes.
fn hold(scene: &str, percent: f32, minutes: u64) -> Held {
    let ticks = minutes * MINUTE;
    let bound = percent / 100.0;
    let blueprint = scene::load(scene).unwrap().build(&[], None, &EffectModes::new()).unwrap();
    let start = Checkpoint::of_scene(Arc::new(blueprint));
    let mut simulation = Simulation::with_plugins(&start, Workers::single(), (LivePlugin, plugin));
    simulation.get_mut::<Watched>().0 = true;
    simulation.get_mut::<Autopilot>().hold(Some(Goal::Error(bound)));
    let mut held = Held { over: 0.0, longest: 0.0, late_moves: 0.0, work: 0.0 };
    let (mut samples, mut over, mut in_a_row, mut early_moves) = (0, 0, 0, 0);
    for tick in 1..=ticks {
        simulation.tick();
        held.work += ladder::work(&simulation.get::<Setup>().quality) / ticks as f32;
        if tick == ticks / 2 {
            early_moves = simulation.get::<Autopilot>().moves();
        }
        if tick <= BEGUN || !tick.is_multiple_of(SAMPLE_EVERY) {
            continue;
        }
        let is_over = simulation.get::<LiveError>().mean().is_some_and(|error| error > bound);
        in_a_row = if is_over { in_a_row + 1 } else { 0 };
        samples += 1;
        over += u32::from(is_over);
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
    let held = hold(scene, percent, minutes);
    println!("{scene} at {percent} %: {held:?}");
    assert!(held.over <= 0.02, "{held:?}");
    assert!(held.longest <= 0.5 + 1e-3, "{held:?}");
    assert!(held.late_moves <= 6.0, "{held:?}");
    assert!(held.work <= most_work, "{held:?}");
}

// The bounds lie between what `draft` and `fine` leave in these scenes (docs/accuracy.md): 0.77 and 0.44 % in the waterfall, 0.63
// and 0.46 % in the dam break. The level above `fine`, three substeps of four iterations, takes a work of 10.8: a tenth more is
// given for what it takes to find that it is enough.
#[test]
fn the_error_of_the_waterfall_is_held_at_a_tight_bound() {
    check("waterfall", 0.6, 1, 11.9);
}

#[test]
fn the_error_of_the_dam_break_is_held() {
    check("dam_break", 0.6, 1, 11.9);
}

#[test]
fn the_error_of_the_wind_tunnel_is_held_at_a_bound_that_droplets_can_keep() {
    // There is little inside of droplets, and what there is stands a few per cent too thin at any quality. A twentieth can't be
    // seen in a droplet, and no more than the dearest preset in real time, `fine` of a work of 7.2, may be spent on it.
    check("wind_tunnel", 5.0, 2, 7.2);
}
