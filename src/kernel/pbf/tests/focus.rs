//! Iterations after the first: only where it is still too dense, and there as well as anywhere.

use super::*;
use std::collections::BTreeMap;

const SPOT: Vec2 = Vec2::new(12.0, 11.0);

/// A lattice with a crowd at [`SPOT`] after `iterations`.
fn solved(iterations: u32, instructions: InstructionSet, threads: usize, neighbours: Neighbours) -> Bench {
    let mut bench = Bench::new(60, 30, Preset::Fast);
    (bench.predicted, bench.quality.iterations, bench.quality.correction_limit) = (true, iterations, 0.5);
    bench.solver = Solver::new(instructions, neighbours);
    for k in 0..60 * 22 {
        bench.add(Vec2::new((k % 60) as f32 + 0.5, (k / 60) as f32 + 0.5), Vec2::ZERO);
    }
    let mut random = random_numbers(3);
    for _ in 0..3 {
        bench.add(SPOT + Vec2::new(random(), random()) - 0.5, Vec2::ZERO);
    }
    bench.bin();
    let params = SolveParams {
        domain: &bench.domain,
        fluid: &bench.fluid,
        quality: &bench.quality,
        tension: true,
        predicted: true,
        masses: None,
        threads,
    };
    bench.solver.solve(&bench.particles, &params);
    bench
}

fn alone(iterations: u32) -> Bench {
    solved(iterations, InstructionSet::detect(), 1, Neighbours::Binned)
}

/// Corrected positions by id.
fn places(bench: &Bench) -> BTreeMap<u32, Vec2> {
    let Solver { x, y, .. } = &bench.solver;
    bench.particles.id.iter().zip(x.iter().zip(y)).map(|(id, (x, y))| (*id, Vec2::new(*x, *y))).collect()
}

#[test]
fn iterations_after_the_first_go_where_it_is_too_dense_and_nowhere_else() {
    let (one, three) = (alone(1), alone(3));
    let (once, thrice) = (places(&one), places(&three));
    let moved = |id: &&u32| once[id] != thrice[id];
    let far = once.keys().filter(|id| once[id].distance(SPOT) > 20.0);
    assert_eq!(far.filter(moved).count(), 0, "what is calm was iterated again");
    let near = once.keys().filter(|id| once[id].distance(SPOT) < 2.0);
    assert!(near.filter(moved).count() > 8, "what is crowded was not");
    // The density is that at the start of the last iteration.
    let densest = |bench: &Bench| bench.solver.density.iter().copied().fold(0.0, f32::max);
    assert!(densest(&three) < 0.9 * densest(&one), "{} after {}", densest(&three), densest(&one));
}

#[test]
fn who_is_iterated_again_depends_on_neither_lanes_nor_threads_nor_search() {
    let expected = places(&alone(4));
    for instructions in InstructionSet::available() {
        for (threads, neighbours) in [(1, Neighbours::Binned), (3, Neighbours::Binned), (1, Neighbours::Brute)] {
            let found = places(&solved(4, instructions, threads, neighbours));
            assert!(found == expected, "{instructions:?}, {threads} threads, {neighbours:?}");
        }
    }
}
