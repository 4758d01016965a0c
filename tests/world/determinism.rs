//! The same inputs give the same bits: on every instruction set, on any number of threads, however neighbours are found.

use crate::support::{Furnish, Random, Sandbox, WATER, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        bins::Neighbours,
        brush::{BrushShape, Stroke},
        params::{GradientKernel, Preset},
        pbf::Solver,
        simd::InstructionSet,
    },
    scene::blueprint::{Blueprint, Effect, Mode},
    sim::intent::Intent,
};

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
            (set, Sandbox::of(blueprint).with_lanes(set).tick(600).hash())
        };
        let runs: Vec<(InstructionSet, u64)> = InstructionSet::available().into_iter().map(run).collect();
        assert!(runs.len() >= 2, "one instruction set alone proves nothing");
        assert!(runs.iter().all(|run| run.1 == runs[0].1), "{gradient:?}: hashes after 600 ticks differ: {runs:x?}");
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let run = |threads| {
        let mut sandbox = Sandbox::of(busy(56)).with_threads(threads);
        assert!(sandbox.particles().len() >= 6_000, "below the sharing threshold nothing is shared");
        (threads, sandbox.tick(30).hash())
    };
    let runs = [1, 2, 3, 8].map(run);
    assert!(runs.iter().all(|run| run.1 == runs[0].1), "hashes differ with the number of threads: {runs:x?}");
}

#[test]
fn binned_neighbours_equal_all_pairs() {
    for preset in [Preset::Classic, Preset::Draft, Preset::Balanced] {
        let run = |neighbours| {
            let mut blueprint = busy(9);
            (blueprint.preset, blueprint.quality) = (preset, preset.quality());
            let solver = Solver::new(InstructionSet::detect(), neighbours);
            Sandbox::of(blueprint).with_solver(solver).tick(300).hash()
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
        let mut sandbox = Sandbox::of(busy(9));
        for _ in 0..60 {
            let stroke = Stroke::dab(BrushShape::Disc, random.point(Vec2::new(36.0, 27.0)), random.within(0.0, 3.0));
            sandbox.push(match random.index(3) {
                0 => Intent::Erase { stroke },
                1 => Intent::Blow { stroke, velocity: random.point(Vec2::splat(100.0)) },
                _ => Intent::Draw { element: WATER, stroke },
            });
            sandbox.tick(1);
        }
        sandbox.hash()
    };
    assert_eq!(run(1), run(1), "two runs of the same inputs differ");
    assert_ne!(run(1), run(2), "the hash does not see the inputs");
}
