//! `auto` leaves out only what would do nothing, to the bit, and what does not run is not called.
//!
//! **Nothing to do** is what the table of effects says, tick by tick, and no list kept here. `auto` runs an effect where
//! the world calls for it (`called_for`); where it does not, forcing the effect on may still act, and the table knows from
//! the same facts whether it may (`differs_from_on`): the predictor in `classic`, sleep in `reference`, and `air_feedback`
//! near any particle that feels the air, since forced on it rouses air that `auto` leaves asleep. A run in which no tick is
//! of that kind must be the same with `on`; one in which the effect never ran, with `off`. Only what is dug out of rock far from
//! any air differs: it is a vacuum, which is as still as air, and air that is switched off knows nothing of it.

use super::random::seed;
use crate::support::SimulationExt;
use powder_master::{
    kernel::params::Preset,
    lab::{
        gauntlet::random::{Case, World},
        jobs::pool,
    },
    scene::{
        self,
        blueprint::Blueprint,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        effects::Effects,
        intent::Intent,
        recording::{Entry, Input},
        simulation::Simulation,
        stages::TickPlan,
        state::{AirGrid, Rock},
    },
};
use std::thread::available_parallelism;

/// Ticks of a built-in scene.
const SCENE_TICKS: u32 = 60;
/// Random worlds, of each one effect.
const CASES: u32 = if cfg!(debug_assertions) { 48 } else { 256 };
/// Ticks of a random run at most.
const TICKS: u32 = 24;

/// What a run with an effect in some mode came to.
#[derive(Clone, Copy, Debug)]
struct Outcome {
    hash: u64,
    /// Ticks in which it ran.
    active: u64,
    /// Ticks in which `auto` and `on` may differ.
    differing: u64,
    /// Calls of its passes.
    calls: u64,
    /// Whether there is a vacuum at the end.
    vacuum: bool,
}

/// Runs `case` with `effect` in `mode`.
fn run(blueprint: &Blueprint, case: &Case, effect: Effect, mode: Mode) -> Result<Outcome, String> {
    let mut blueprint = blueprint.clone();
    blueprint.effects.insert(effect, mode);
    Ok(watch(blueprint, case, &[effect])?[0])
}

/// Runs `case` and watches some effects; what is said of them in its input is left out. What is not called for is not called in
/// any tick.
fn watch(blueprint: Blueprint, case: &Case, effects: &[Effect]) -> Result<Vec<Outcome>, String> {
    let mut simulation = Simulation::of(blueprint);
    let keeps = |entry: &&Entry| !matches!(&entry.intent, Intent::Effect { effect, .. } if effects.contains(effect));
    let mut input = Input::new(case.input.iter().filter(keeps).cloned().collect());
    let calls = |simulation: &Simulation, effect: Effect| {
        effect.row().passes.iter().map(|pass| simulation.calls(*pass)).sum::<u64>()
    };
    for tick in 0..case.ticks {
        input.give(simulation.world_mut());
        let before: Vec<u64> = effects.iter().map(|effect| calls(&simulation, *effect)).collect();
        simulation.run(1);
        // A stage of a substep is called once in each at most; sleep has four of them, and a look at either end.
        let most_of_one = 4 * u64::from(simulation.get::<TickPlan>().substeps) + 2;
        for (effect, before) in effects.iter().zip(before) {
            let (added, state) = (calls(&simulation, *effect) - before, simulation.get::<Effects>().get(*effect));
            let most = if state.running { most_of_one } else { 0 };
            if added > most {
                let (name, mode) = (effect.name(), state.mode);
                return Err(format!("{name} {mode:?}: {added} calls in tick {tick}, {most} allowed"));
            }
        }
    }
    let (air, rock) = (simulation.get::<AirGrid>(), simulation.get::<Rock>());
    let air = air.with_grid(rock);
    let mut cells = (0..air.rows()).flat_map(|row| (0..air.columns()).map(move |column| (column, row)));
    let vacuum = cells.any(|(x, y)| !air.is_solid_cell(x, y) && air.pressure_at_cell(x, y) == 0.0);
    let hash = simulation.hash();
    let outcome = |effect: &Effect| {
        let state = simulation.get::<Effects>().get(*effect);
        let (active, differing) = (state.active_ticks, state.differing_ticks);
        Outcome { hash, active, differing, calls: calls(&simulation, *effect), vacuum }
    };
    Ok(effects.iter().map(outcome).collect())
}

/// Which of the two claims a case was good for.
#[derive(Clone, Copy, Debug, Default)]
struct Held {
    /// `auto` and `on` were one.
    on: bool,
    /// They were, and `auto` left something out.
    on_idle: bool,
    /// `auto` and `off` were one.
    off: bool,
}

/// Compares the modes of an effect with what came of `auto`.
fn judge(blueprint: &Blueprint, case: &Case, effect: Effect, auto: Outcome) -> Result<Held, String> {
    let off = run(blueprint, case, effect, Mode::Off)?;
    let fault = |what: &str| Err(format!("{}: {what}; {auto:?}", effect.name()));
    if off.calls > 0 || off.active > 0 {
        return fault(&format!("off, and {} calls in {} ticks", off.calls, off.active));
    }
    if auto.active == 0 && auto.calls > 0 {
        return fault("not called for, and called");
    }
    let differs = auto.vacuum && effect == Effect::Air;
    if auto.active == 0 && off.hash != auto.hash && !differs {
        return fault("it never ran, and without it the world is another one");
    }
    let mut held = Held { off: auto.active == 0, ..Held::default() };
    if auto.differing == 0 {
        let on = run(blueprint, case, effect, Mode::On)?;
        if on.hash != auto.hash {
            return fault("auto left it out where it had something to do");
        }
        if on.active != u64::from(case.ticks) {
            return fault("on, and it did not run in every tick");
        }
        (held.on, held.on_idle) = (true, auto.active < on.active);
    }
    Ok(held)
}

/// A built-in scene as it is, as a case in which nothing is done.
fn still(ticks: u32) -> Case {
    Case { scene: String::new(), input: Vec::new(), ticks }
}

/// Compares the modes of all effects in a built-in scene. Those that it leaves to `auto` share that run.
fn judge_scene(name: &str) -> Vec<Result<Held, String>> {
    let file = scene::load(name).unwrap_or_else(|error| panic!("{error}"));
    let blueprint = file.build(&[], Some(Preset::Draft), &EffectModes::new()).unwrap_or_else(|error| panic!("{error}"));
    let case = still(SCENE_TICKS);
    let is_auto = |effect: &Effect| blueprint.effects.get(effect).is_none_or(|mode| *mode == Mode::Auto);
    let (shared, own): (Vec<Effect>, Vec<Effect>) = Effect::ALL.into_iter().partition(is_auto);
    let outcomes = match watch(blueprint.clone(), &case, &shared) {
        Ok(outcomes) => outcomes,
        Err(fault) => return vec![Err(fault)],
    };
    let shared = shared.into_iter().zip(outcomes.into_iter().map(Ok));
    let own = own.into_iter().map(|effect| (effect, run(&blueprint, &case, effect, Mode::Auto)));
    shared.chain(own).map(|(effect, auto)| judge(&blueprint, &case, effect, auto?)).collect()
}

#[test]
#[cfg_attr(debug_assertions, ignore = "heavy: in release only")]
fn in_every_scene_auto_leaves_out_only_what_does_nothing() {
    let mut faults = Vec::new();
    let (mut on, mut idle, mut off) = (0, 0, 0);
    let (names, threads) = (scene::builtin_names(), available_parallelism().map_or(1, usize::from));
    let judged = pool::run(&names, threads, |_| 1, |_, _| {}, |name| judge_scene(name));
    for (name, all) in names.iter().zip(judged) {
        for held in all {
            match held {
                Ok(held) => {
                    on += u32::from(held.on);
                    idle += u32::from(held.on_idle);
                    off += u32::from(held.off);
                }
                Err(fault) => faults.push(format!("{name}: {fault}")),
            }
        }
    }
    println!("{on} pairs are the same with on, {idle} of them left something out; {off} are the same with off");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    // Only air_feedback, where something feels the air, is not told of.
    assert!(on >= 7 * 8 && idle >= 8 && off >= 8, "hardly anything was compared: {on}, {idle}, {off}");
}

#[test]
fn in_random_scenes_auto_leaves_out_only_what_does_nothing() {
    let seed = seed();
    let (mut on, mut idle, mut off) = (0, 0, 0);
    for index in 0..CASES {
        let world = World::new(seed, u64::from(index), &Preset::ALL).case();
        let ticks = world.ticks.min(TICKS);
        let case = Case { ticks, ..world };
        let file = scene::from_text("case", case.scene.clone());
        // Whether a scene is refused as it should be is another test's.
        let Ok(blueprint) = file.and_then(|file| file.build(&[], None, &EffectModes::new())) else { continue };
        let effect = Effect::ALL[index as usize % Effect::ALL.len()];
        let auto = run(&blueprint, &case, effect, Mode::Auto);
        let held = auto.and_then(|auto| judge(&blueprint, &case, effect, auto)).unwrap_or_else(|fault| {
            panic!("world {seed}/{index}, {fault}\n{}\n{:?}", case.scene, case.input);
        });
        (on, idle, off) = (on + u32::from(held.on), idle + u32::from(held.on_idle), off + u32::from(held.off));
    }
    println!("of {CASES} cases {on} are the same with on, {idle} of them left something out; {off} with off");
    assert!(on > CASES / 3 && idle > CASES / 32 && off > CASES / 32, "hardly anything was compared: {on} {idle} {off}");
}

#[test]
fn what_acts_where_nothing_calls_for_it_is_told_by_the_table() {
    // One case of each kind: the world is another one, and the facts said that it may be.
    for (effect, preset) in
        [(Effect::Predictor, Preset::Classic), (Effect::Sleep, Preset::Reference), (Effect::AirFeedback, Preset::Draft)]
    {
        let mut blueprint = crate::support::empty_box(24, 20);
        (blueprint.preset, blueprint.quality) = (preset, preset.quality());
        crate::support::Furnish::pool(&mut blueprint, (0, 0), (24, 6));
        if effect == Effect::AirFeedback {
            blueprint.particles.vx.fill(0.01);
        }
        let case = still(100);
        let outcome = |mode| run(&blueprint, &case, effect, mode).unwrap_or_else(|fault| panic!("{fault}"));
        let (auto, on) = (outcome(Mode::Auto), outcome(Mode::On));
        assert!(auto.differing > 0, "{} at {}: nobody was told", effect.name(), preset.name());
        assert_ne!(auto.hash, on.hash, "{} at {}: it does nothing", effect.name(), preset.name());
    }
}
