//! What breaks solvers of this kind, each case once.

use crate::support::{Furnish, Random, SimulationExt, WATER, apart, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{params::Preset, particles::Particles, solids::Solids},
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::simulation::Simulation,
};
use std::collections::HashMap;

const GRAVITY: f32 = 98.1;

/// A column of water in the lower left corner of a box of `4 n × 3 n`, at rest, without air.
fn dam(n: i32) -> Blueprint {
    let mut blueprint = empty_box(4 * n as u32, 3 * n as u32);
    blueprint.domain.gravity = Vec2::new(0.0, -GRAVITY);
    for effect in [Effect::Air, Effect::Drag] {
        blueprint.effects.insert(effect, Mode::Off);
    }
    blueprint.pool((0, 0), (n, 2 * n));
    blueprint
}

fn in_id_order(particles: &Particles) -> Vec<(u32, [u32; 4])> {
    let bits = |i: usize| [particles.x[i], particles.y[i], particles.vx[i], particles.vy[i]].map(f32::to_bits);
    particles.in_id_order().into_iter().map(|i| (particles.id[i as usize], bits(i as usize))).collect()
}

/// Distance of each particle to its nearest neighbour, shortest first.
fn gaps(particles: &Particles) -> Vec<f32> {
    let gap = |i: usize| {
        let others = (0..particles.len()).filter(|&j| j != i);
        others.map(|j| particles.position(i).distance(particles.position(j))).fold(f32::MAX, f32::min)
    };
    let mut gaps: Vec<f32> = (0..particles.len()).map(gap).collect();
    gaps.sort_unstable_by(f32::total_cmp);
    gaps
}

/// Values that no particle may have.
const POISON: [f32; 5] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30];

#[test]
fn a_particle_that_is_no_number_goes_and_all_others_do_not_notice() {
    let mut clean = Simulation::of(dam(8));
    let mut poisoned = Simulation::of(dam(8));
    // Before, among and behind the others: none of those may lose its place in the order.
    let others = clean.particles().clone();
    let store = poisoned.particles_mut();
    *store = Particles::default();
    let mut next_id = 1_000_000;
    for i in 0..=others.len() {
        if [0, 1, 50, others.len()].contains(&i) {
            for poison in POISON {
                store.push(next_id, WATER, Vec2::new(poison, 5.0), Vec2::ZERO);
                store.push(next_id + 1, WATER, Vec2::splat(5.0), Vec2::new(0.0, poison));
                next_id += 2;
            }
        }
        if i < others.len() {
            store.push(others.id[i], others.element[i], others.position(i), others.velocity(i));
        }
    }
    clean.run(100);
    poisoned.run(100);
    assert_eq!(poisoned.counters().non_finite, 8 * POISON.len() as u64, "not every bad particle was counted");
    assert_eq!(in_id_order(poisoned.particles()), in_id_order(clean.particles()), "a removed particle left a trace");
}

#[test]
fn a_particle_that_turns_bad_during_play_is_as_if_it_had_been_erased() {
    for poison in POISON {
        let mut simulations = [Simulation::of(dam(8)), Simulation::of(dam(8))];
        for simulation in &mut simulations {
            simulation.run(40);
        }
        let [clean, poisoned] = &mut simulations;
        let victim = poisoned.particles().id[60];
        poisoned.particles_mut().vy[60] = poison;
        clean.particles_mut().retain(|particles, i| particles.id[i] != victim);
        clean.run(40);
        poisoned.run(40);
        assert_eq!(poisoned.counters().non_finite, 1);
        assert_eq!(in_id_order(poisoned.particles()), in_id_order(clean.particles()), "{poison} left a trace");
    }
}

#[test]
fn many_on_one_point_settle_apart_under_gravity() {
    for preset in Preset::ALL {
        let mut blueprint = empty_box(12, 30);
        (blueprint.preset, blueprint.quality) = (preset, preset.quality());
        blueprint.domain.gravity = Vec2::new(0.0, -GRAVITY);
        for _ in 0..64 {
            blueprint.water(Vec2::new(6.2, 8.4), Vec2::ZERO);
        }
        let mut simulation = Simulation::of(blueprint);
        simulation.run(120);
        assert_eq!(simulation.particles().len(), 64, "{}: particles were lost", preset.name());
        // Two pairs may lie closer in a puddle as shallow as this: below the rest density nothing pushes but tension.
        let gaps = gaps(simulation.particles());
        assert!(gaps[4] > 0.2, "{}: still on one point: gaps of {:?}", preset.name(), &gaps[..8]);
    }
}

/// Density error of a settled pool whose left end is at `left` d: mean and 99th percentile of max(0, ρ − 1).
fn pool_error(preset: Preset, left: i32) -> (f64, f64) {
    let mut blueprint = empty_box(4096 + 40, 20);
    (blueprint.preset, blueprint.quality) = (preset, preset.quality());
    blueprint.domain.gravity = Vec2::new(0.0, -GRAVITY);
    for effect in [Effect::Air, Effect::Drag] {
        blueprint.effects.insert(effect, Mode::Off);
    }
    // Two walls of rock around it, so that both pools have the same sides.
    blueprint.rock((left, 0), (left + 3, 20));
    blueprint.rock((left + 33, 0), (left + 36, 20));
    blueprint.pool((left + 3, 0), (left + 33, 12));
    let mut simulation = Simulation::of(blueprint);
    simulation.run(120);
    let mut sum = (0.0, 0.0);
    for _ in 0..60 {
        simulation.run(1);
        let solver = simulation.get::<powder_master::sim::state::SolverState>();
        let mut errors: Vec<f64> = solver.density.iter().map(|&density| f64::from((density - 1.0).max(0.0))).collect();
        errors.sort_unstable_by(f64::total_cmp);
        sum.0 += errors.iter().sum::<f64>() / errors.len() as f64 / 60.0;
        sum.1 += errors[errors.len() * 99 / 100] / 60.0;
    }
    assert_eq!(simulation.counters().escaped, 0);
    sum
}

#[test]
fn a_pool_far_from_the_origin_is_like_one_at_it() {
    // How the predictor's cells stand to the walls makes a difference, here as there: a mean over two cells of it.
    let mean = |preset: Preset, first: i32| {
        let errors: Vec<(f64, f64)> = (0..5).map(|k| pool_error(preset, first + k)).collect();
        (errors.iter().map(|error| error.0).sum::<f64>() / 5.0, errors.iter().map(|error| error.1).sum::<f64>() / 5.0)
    };
    for preset in [Preset::Classic, Preset::Balanced] {
        let (near, far) = (mean(preset, 8), mean(preset, 4096));
        for (what, near, far) in [("mean", near.0, far.0), ("p99", near.1, far.1)] {
            let gap = (far - near).abs();
            assert!(gap < 0.1 * near + 0.002, "{}: {what} density error {far} far out, {near} here", preset.name());
        }
    }
}

#[test]
fn gravity_acts_far_from_the_origin_at_every_quality() {
    for preset in Preset::ALL {
        let mut blueprint = empty_box(8, 7000);
        (blueprint.preset, blueprint.quality) = (preset, preset.quality());
        blueprint.domain.gravity = Vec2::new(0.0, -GRAVITY);
        for effect in [Effect::Air, Effect::Drag] {
            blueprint.effects.insert(effect, Mode::Off);
        }
        blueprint.water(Vec2::new(4.0, 6500.0), Vec2::ZERO);
        let mut simulation = Simulation::of(blueprint);
        simulation.run(60);
        let speed = -simulation.particles().vy[0];
        assert!((speed - GRAVITY).abs() < 0.01 * GRAVITY, "{}: {speed} d/s after a second", preset.name());
    }
}

#[test]
fn no_shot_passes_rock_one_layer_thick() {
    let mut random = Random::new(77);
    let mut shots = 0;
    for preset in [Preset::Classic, Preset::Draft, Preset::Balanced] {
        for per_tick in [0.5, 1.0, 3.0, 7.0, 20.0, 50.0] {
            let mut blueprint = empty_box(100, 100);
            (blueprint.preset, blueprint.quality) = (preset, preset.quality());
            // The air that they drag along presses hard enough to break it.
            blueprint.effects.insert(Effect::Fracture, Mode::Off);
            // A closed cell of rock one layer thick: a straight wall, and a stair that only touches at its corners.
            blueprint.rock((60, 0), (61, 100));
            for k in 0..60 {
                blueprint.rock((k, 60 - k), (k + 1, 61 - k));
            }
            let inside = |at: Vec2| at.x < 60.0 && at.x + at.y > 61.0;
            while blueprint.particles.len() < 560 {
                let at = random.point(Vec2::splat(100.0));
                if inside(at) && !blueprint.solids.is_solid(Solids::cell_of(at)) {
                    let way = random.point(Vec2::splat(2.0)) - 1.0;
                    blueprint.water(at, way.normalize_or(Vec2::X) * per_tick * 60.0);
                    shots += 1;
                }
            }
            let mut simulation = Simulation::of(blueprint);
            for _ in 0..20 {
                simulation.run(1);
                let particles = simulation.particles();
                let out: Vec<Vec2> =
                    (0..particles.len()).map(|i| particles.position(i)).filter(|&at| !inside(at)).collect();
                assert!(out.is_empty(), "{}, {per_tick} d a tick: through to {out:?}", preset.name());
            }
            assert_eq!(simulation.counters().escaped, 0, "{}, {per_tick} d a tick: inside rock", preset.name());
            assert_eq!(simulation.counters().non_finite, 0);
            assert_eq!(simulation.particles().len(), 560);
        }
    }
    assert!(shots >= 10_000, "only {shots} shots");
}

#[test]
fn a_crush_in_a_corner_stays_sound() {
    for preset in [Preset::Classic, Preset::Fast, Preset::Balanced] {
        let mut blueprint = empty_box(50, 30);
        (blueprint.preset, blueprint.quality) = (preset, preset.quality());
        // Down the slope of a wedge of 30° (7 up in 12 along) with 4 g.
        blueprint.domain.gravity = Vec2::new(-4.0 * GRAVITY * 0.966, -4.0 * GRAVITY * 0.259);
        for effect in [Effect::Air, Effect::Drag] {
            blueprint.effects.insert(effect, Mode::Off);
        }
        for x in 0..50 {
            blueprint.rock((x, (x * 7 / 12 + 1).min(30)), (x + 1, 30));
        }
        for x in 0..50 {
            blueprint.pool((x, 0), (x + 1, (x * 7 / 12 + 1).min(30)));
        }
        let mut simulation = Simulation::of(blueprint);
        simulation.run(150);
        let counters = simulation.counters();
        assert_eq!((counters.escaped, counters.non_finite), (0, 0), "{}: {counters:?}", preset.name());
        let solver = simulation.get::<powder_master::sim::state::SolverState>();
        let densest = solver.density.iter().copied().fold(0.0, f32::max);
        let gaps = gaps(simulation.particles());
        // The plain method gives way here; that it stays finite and in its place is all that it promises.
        if preset != Preset::Classic {
            assert!(densest < 1.3, "{}: crushed to a density of {densest}", preset.name());
            let closest = gaps[gaps.len() / 100];
            assert!(closest > 0.3, "{}: one in a hundred is within {closest} d of another", preset.name());
        }
    }
}

/// A start, its mirror image, and the width of the box.
fn and_image(left: Blueprint) -> (Simulation, Simulation, f32) {
    let mut right = left.clone();
    let width = right.domain.size.x;
    for x in &mut right.particles.x {
        *x = width - *x;
    }
    (Simulation::of(left), Simulation::of(right), width)
}

#[test]
fn a_mirrored_start_stays_mirrored_but_for_rounding() {
    let start = dam(10);
    let (mut left, mut right, width) = and_image(start.clone());
    let mut nudged = start;
    nudged.nudge(7);
    let mut nudged = Simulation::of(nudged);
    // Sums run from left to right in both, so that their rounding is not mirrored, and a dam break doubles any
    // difference every two or three ticks. So does it with one that is put in at the start: the two have to go together.
    for tick in 1..=24 {
        let rounding = apart(left.run(1), nudged.run(1), |at| at);
        let apart = apart(&left, right.run(1), |at| Vec2::new(width - at.x, at.y));
        assert!(apart < 8.0 * rounding, "tick {tick}: {apart:e} d from its mirror image, rounding makes {rounding:e}");
    }
}

#[test]
fn a_mirrored_start_on_an_odd_grid_stays_mirrored_for_a_while() {
    // Here the predictor has 19 columns of cells: its coarse grids pair them from the left, so that the solve comes to
    // another point within its tolerance than the mirrored one (16 columns pair the same from both sides). A solve leaves
    // a tenth of what pressure does in a tick, for a column at rest g Δt²: two of them part by 2 · 0.1 · 98.1/60² =
    // 0.0055 d in the first tick at most, a hundredth with the second tick's. What it really is, is 10⁻⁴, 20 times what
    // rounding makes, and doubles as fast: a sixth of a second is as long as a hundredth can hold.
    let (mut left, mut right, width) = and_image(dam(12));
    for tick in 1..=10 {
        left.run(1);
        right.run(1);
        let (a, b) = (left.particles(), right.particles());
        for (i, j) in a.in_id_order().into_iter().zip(b.in_id_order()) {
            let (found, other) = (a.position(i as usize), b.position(j as usize));
            let gap = found.distance(Vec2::new(width - other.x, other.y));
            assert!(gap < 0.01, "tick {tick}: {found} is {gap} d from the mirror image of its twin {other}");
        }
    }
}

#[test]
fn no_notch_in_the_rock_swallows_a_stream() {
    let mut blueprint = crate::support::blueprint("waterfall", &[]);
    (blueprint.preset, blueprint.quality) = (Preset::Draft, Preset::Draft.quality());
    let mut simulation = Simulation::of(blueprint);
    simulation.run(400);
    let mut crowds = HashMap::new();
    let particles = simulation.particles();
    for i in 0..particles.len() {
        *crowds.entry(Solids::cell_of(particles.position(i))).or_insert(0) += 1;
    }
    // One to a cell at rest, three or four where a jet hits.
    let (cell, most) = crowds.into_iter().max_by_key(|(_, count)| *count).expect("the waterfall has water");
    assert!(most <= 10, "{most} particles in the cell {cell}");
}
