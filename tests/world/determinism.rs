//! The same inputs give the same bits: on every instruction set, on any number of threads, however neighbours are found.

use crate::support::{Furnish, ROCK, Random, SimulationExt, WATER, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        bins::Neighbours,
        brush::{BrushShape, Stroke},
        params::{GradientKernel, Preset},
        pbf::Solver,
        simd::InstructionSet,
    },
    scene::{
        self,
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{intent::Intent, simulation::Simulation, state::AirGrid},
};
use std::{panic::resume_unwind, thread};

/// A column of water that falls over a rock, with every effect on.
fn busy(columns: i32) -> Blueprint {
    let mut blueprint = empty_box(4 * columns as u32, 3 * columns as u32);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.rock((2 * columns, 0), (2 * columns + 2, columns / 3));
    blueprint.pool((0, 0), (columns, 2 * columns));
    blueprint.effects = Effect::ALL.into_iter().map(|effect| (effect, Mode::On)).collect();
    blueprint
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    for gradient in [GradientKernel::Rational, GradientKernel::Spiky] {
        let run = |set| {
            let mut blueprint = busy(9);
            blueprint.quality.gradient = gradient;
            (set, Simulation::of(blueprint).with_instructions(set).run(600).hash())
        };
        let runs: Vec<(InstructionSet, u64)> = InstructionSet::available().into_iter().map(run).collect();
        assert!(runs.len() >= 2, "one instruction set alone proves nothing");
        assert!(runs.iter().all(|run| run.1 == runs[0].1), "{gradient:?}: hashes after 600 ticks differ: {runs:x?}");
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let run = |threads| {
        let mut simulation = Simulation::of(busy(56)).with_threads(threads);
        assert!(simulation.particles().len() >= 6_000, "below the sharing threshold nothing is shared");
        (threads, simulation.run(30).hash())
    };
    let runs = [1, 2, 3, 8].map(run);
    assert!(runs.iter().all(|run| run.1 == runs[0].1), "hashes differ with the number of threads: {runs:x?}");
}

#[test]
fn more_threads_than_cores_give_the_same_sound_world_and_come_to_an_end() {
    let cores = thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let run = |threads: usize| {
        let mut simulation = Simulation::of(busy(56)).with_threads(threads);
        let count = simulation.particles().len();
        simulation.run(120);
        let counters = simulation.counters();
        assert_eq!((counters.escaped, counters.non_finite), (0, 0), "{threads} threads");
        assert_eq!(simulation.particles().len(), count, "{threads} threads");
        simulation.hash()
    };
    let alone = run(1);
    // Threads that wait for one another on too few cores may wait for ever: that shall fail, not hang.
    let (sender, outcome) = std::sync::mpsc::channel();
    thread::spawn(move || sender.send(run(cores + 2)));
    // 120 ticks of 6,272 particles take some seconds; a machine that is busy with much else gets a hundred times that.
    let crowded = outcome.recv_timeout(std::time::Duration::from_secs(600));
    assert_eq!(crowded, Ok(alone), "{} threads on {cores} cores", cores + 2);
}

#[test]
fn binned_neighbours_equal_all_pairs() {
    for preset in [Preset::Classic, Preset::Draft, Preset::Balanced] {
        let run = |neighbours| {
            let mut blueprint = busy(9);
            (blueprint.preset, blueprint.quality) = (preset, preset.quality());
            let solver = Solver::new(InstructionSet::detect(), neighbours);
            Simulation::of(blueprint).with_solver(solver).run(300).hash()
        };
        assert_eq!(
            run(Neighbours::Binned),
            run(Neighbours::Brute),
            "{}: the bins miss a pair that brute force finds",
            preset.name()
        );
    }
}

#[test]
fn the_same_inputs_give_the_same_world_and_others_another() {
    let run = |seed: u64| {
        let mut random = Random::new(seed);
        let mut simulation = Simulation::of(busy(9));
        for _ in 0..60 {
            let stroke = Stroke::dab(BrushShape::Disc, random.point(Vec2::new(36.0, 27.0)), random.within(0.0, 3.0));
            simulation.push(match random.index(3) {
                0 => Intent::Erase { stroke },
                1 => Intent::Blow { stroke, velocity: random.point(Vec2::splat(100.0)) },
                _ => Intent::Draw { element: WATER, stroke },
            });
            simulation.run(1);
        }
        simulation.hash()
    };
    assert_eq!(run(1), run(1), "two runs of the same inputs differ");
    assert_ne!(run(1), run(2), "the hash does not see the inputs");
}

/// The standard scenes. Those that have a size get one at which threads share particles or air, if that is not theirs
/// by default; the others run as they are played.
const STANDARD: [(&str, &[(&str, &str)]); 35] = [
    ("acid", &[]),
    ("avalanche", &[]),
    ("burning_house", &[]),
    ("campfire", &[]),
    ("communicating_vessels", &[("left", "6.5"), ("right", "6")]),
    ("dam_break", &[]),
    ("distillery", &[]),
    ("dune", &[]),
    ("dust_mill", &[]),
    ("ember_rain", &[]),
    ("empty", &[("columns", "1200"), ("rows", "640")]),
    ("fireworks", &[]),
    ("fountain", &[]),
    ("frozen_lake", &[]),
    ("galton_board", &[]),
    ("garden", &[]),
    ("geyser", &[]),
    ("honey_and_mercury", &[]),
    ("honey_lamp", &[]),
    ("hourglass", &[]),
    ("hydrostatic", &[("columns", "100"), ("depth", "64")]),
    ("ice_dam", &[]),
    ("layers", &[]),
    ("mercury_maze", &[]),
    ("oil_lamp", &[]),
    ("rest_density", &[]),
    ("sand_castle", &[]),
    ("sealed_air", &[]),
    ("silo", &[]),
    ("snow_globe", &[]),
    ("u_tube", &[]),
    ("volcano", &[]),
    ("waterfall", &[]),
    ("wind_tunnel", &[]),
    ("winter", &[]),
];

/// Ticks of a standard scene: five seconds, in which all that it has has begun to move, burn or flow.
const TICKS: u32 = 300;

/// Hash of a standard scene after [`TICKS`], and whether threads had anything to share in it. `empty` is built in: water
/// on a ledge of rock, in wind.
fn standard_run(scene: &str, settings: &[(&str, &str)], set: InstructionSet, threads: usize) -> (u64, bool) {
    let mut simulation = Simulation::scene(scene, settings).with_threads(threads).with_instructions(set);
    let at = |x: f32, y: f32| Vec2::new(x, y);
    if scene == "empty" {
        let ledge = Stroke { shape: BrushShape::Square, from: at(500.0, 60.0), to: at(600.0, 60.0), radius: 4.0 };
        let drop = Stroke::dab(BrushShape::Disc, at(560.0, 120.0), 20.0);
        simulation.push(Intent::Stamp { element: ROCK, stroke: ledge });
        simulation.push(Intent::Stamp { element: WATER, stroke: drop });
    }
    let mut shared = false;
    for step in 0..20 {
        if scene == "empty" {
            let gust = Stroke::dab(BrushShape::Disc, at(200.0 + 40.0 * step as f32, 200.0), 150.0);
            simulation.push(Intent::Blow { stroke: gust, velocity: at(120.0, -40.0) });
        }
        simulation.run(TICKS / 20);
        let air = simulation.get::<AirGrid>();
        shared |= simulation.particles().len() >= 6_000 || (air.is_worth_waking() && !air.is_quiet());
    }
    (simulation.hash(), shared)
}

#[test]
fn no_standard_scene_is_left_out() {
    let mut names = scene::builtin_names();
    names.sort_unstable();
    assert_eq!(STANDARD.map(|(name, _)| name).to_vec(), names);
}

/// Runs each of some standard scenes on the best instruction set with one thread, and again on one of the others with more
/// threads, both in turn; says how many of them had something to share. What set or threads alone change is told apart by the
/// tests above and by those of the kernels.
fn run_twice<'a>(scenes: impl Iterator<Item = (&'a str, &'a [(&'a str, &'a str)])>) -> usize {
    let best = InstructionSet::detect();
    let others: Vec<InstructionSet> = InstructionSet::available().into_iter().filter(|set| *set != best).collect();
    assert!(!others.is_empty(), "one instruction set alone proves nothing");
    let ways = others.into_iter().cycle().zip([2, 3].into_iter().cycle());
    let shares = scenes.zip(ways).map(|((name, settings), (other, threads))| {
        let (hash, shares) = standard_run(name, settings, best, 1);
        let again = standard_run(name, settings, other, threads).0;
        assert_eq!(hash, again, "{name}: another hash after {TICKS} ticks on {other:?} with {threads} threads");
        shares
    });
    shares.filter(|shares| *shares).count()
}

#[test]
#[cfg_attr(debug_assertions, ignore = "the standard scenes at their sizes need the release build")]
fn standard_scenes_have_the_same_bits_on_every_instruction_set_and_number_of_threads() {
    // Side by side: most of them have nothing to share.
    let halves = thread::scope(|scope| {
        let halves = [0, 1].map(|half| scope.spawn(move || run_twice(STANDARD.into_iter().skip(half).step_by(2))));
        halves.map(|half| half.join().unwrap_or_else(|panic| resume_unwind(panic)))
    });
    let scenes_that_share: usize = halves.into_iter().sum();
    assert!(scenes_that_share >= 5, "only {scenes_that_share} scenes are large enough to be shared");
}
