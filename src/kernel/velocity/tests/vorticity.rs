//! Vorticity confinement against what is known of it.

use super::{kinetic_energy, square};
use crate::{
    element::ElementParams,
    params::{GradientKernel, Preset},
    pbf::tests::{Bench, random_numbers},
    predict::longest_move,
    simd::InstructionSet,
    velocity::{apply_vorticity, energy},
};
use glam::Vec2;

fn vorticity(strength: f32) -> ElementParams {
    ElementParams { vorticity: vec![strength], mass: vec![1000.0], ..ElementParams::default() }
}

#[test]
fn rigid_rotation_has_a_vorticity_of_twice_its_rate() {
    let middle = Vec2::splat(30.0);
    for (gradient, rate) in [(GradientKernel::Spiky, 3.0), (GradientKernel::Rational, -2.0)] {
        let mut bench = square(0.0, |at| rate * (at - middle).perp());
        bench.quality.gradient = gradient;
        bench.solve(false);
        apply_vorticity(&mut bench.particles, &mut bench.solver, &vorticity(0.0), f64::MAX, 1, 0.01);
        for i in 0..400 {
            let inner = (bench.particles.position(i) - middle).abs().max_element() < 6.0;
            let vorticity = bench.solver.lambda[i];
            // The sum over the lattice is 8 % off the integral that the kernel is normalised by.
            assert!(
                !inner || (vorticity - 2.0 * rate).abs() < 0.1 * (2.0 * rate).abs(),
                "{gradient:?}: ω = {vorticity} at {} instead of {}",
                bench.particles.position(i),
                2.0 * rate
            );
        }
    }
}

#[test]
fn confinement_of_strength_zero_changes_nothing() {
    let mut bench = square(0.3, |at| Vec2::new(at.y, at.x - at.y));
    bench.solve(false);
    let before = bench.particles.clone();
    apply_vorticity(&mut bench.particles, &mut bench.solver, &vorticity(0.0), f64::MAX, 1, 0.01);
    assert_eq!(before, bench.particles);
}

#[test]
fn confinement_pushes_across_the_slope_of_the_vorticity() {
    // A round eddy: the push goes along its rotation, faster where it is already turning.
    let middle = Vec2::splat(30.0);
    let eddy = |at: Vec2| {
        let from = at - middle;
        60.0 * from.perp() / (4.0 + from.length_squared())
    };
    let mut bench = square(0.0, eddy);
    bench.solve(false);
    let before = bench.particles.clone();
    apply_vorticity(&mut bench.particles, &mut bench.solver, &vorticity(1.0), f64::MAX, 1, 0.01);
    for i in 0..400 {
        let from = before.position(i) - middle;
        let push = bench.particles.velocity(i) - before.velocity(i);
        let along = push.dot(from.perp().normalize());
        if (2.0..5.0).contains(&from.length()) {
            assert!(along > 0.0, "the eddy is pushed back by {along} at {from} from its middle");
            assert!(push.dot(from.normalize()).abs() < 0.5 * along, "the push {push} at {from} is not along the eddy");
        }
    }
}

#[test]
fn confinement_makes_no_wave_grow_faster_than_its_bound_says_whatever_its_strength() {
    let radius = Preset::Balanced.quality().kernel_radius;
    // The bound itself: ε Δt = 0.07 h.
    let bound = 0.07 * radius / 0.01;
    for (strength, cut) in [(0.99 * bound, 0), (10.0 * bound, 400)] {
        // The wavelength that grows fastest, 1.7 h, and a short and a long one.
        for waves in [1.0, 1.7, 6.0] {
            let turn = std::f64::consts::TAU / f64::from(waves * radius);
            let mut bench = square(0.0, |at| Vec2::new(0.0, (10.0 * (turn * f64::from(at.x)).sin()) as f32));
            bench.solve(false);
            for pass in 0..20 {
                let before = kinetic_energy(&bench.particles);
                let report =
                    apply_vorticity(&mut bench.particles, &mut bench.solver, &vorticity(strength), f64::MAX, 1, 0.01);
                let growth = (kinetic_energy(&bench.particles) / before).sqrt();
                assert_eq!(report.clamps, cut, "ε {strength}: particles whose strength was cut");
                assert!(
                    growth < 1.0 + 1.45 * 0.07 * 1.05,
                    "ε {strength}, {waves} h, pass {pass}: a wave became {growth} times as high in a substep"
                );
            }
        }
    }
}

#[test]
fn confinement_pushes_no_crowd_further_than_its_cap() {
    let quality = Preset::Balanced.quality();
    let (dt, strength) = (0.01, 0.06 * quality.kernel_radius / 0.01);
    let cap = 0.1 * longest_move(&quality) / dt;
    for (across, is_crowd) in [(20.0, false), (0.4, true)] {
        let mut bench = Bench::new(60, 60, Preset::Balanced);
        let mut random = random_numbers(31);
        for _ in 0..400 {
            let at = Vec2::splat(30.0) + across * (Vec2::new(random(), random()) - 0.5);
            bench.add(at, 600.0 * Vec2::new(random() - 0.5, random() - 0.5));
        }
        bench.solve(false);
        let before = bench.particles.clone();
        let report = apply_vorticity(&mut bench.particles, &mut bench.solver, &vorticity(strength), f64::MAX, 1, dt);
        let changes = (0..400).map(|i| bench.particles.velocity(i).distance(before.velocity(i)));
        let furthest = changes.fold(0.0, f32::max);
        assert!(furthest <= 1.0001 * cap, "{furthest} d/s; the cap is {cap}");
        assert_eq!(report.clamps > 0, is_crowd, "{} pushes were cut, the largest is {furthest}", report.clamps);
    }
}

#[test]
fn confinement_gives_no_more_energy_than_it_may() {
    let strength = 0.06 * Preset::Balanced.quality().kernel_radius / 0.01;
    // A round eddy, and a crowd that turns.
    for across in [20.0, 4.0] {
        let mut random = random_numbers(17);
        let mut bench = Bench::new(60, 60, Preset::Balanced);
        for _ in 0..400 {
            let from = across * (Vec2::new(random(), random()) - 0.5);
            bench.add(Vec2::splat(30.0) + from, 60.0 * from.perp() / (4.0 + from.length_squared()));
        }
        bench.solve(false);
        let elements = vorticity(strength);
        let added = |most: f64| {
            let mut bench = Bench {
                solver: bench.solver.clone(),
                particles: bench.particles.clone(),
                ..square(0.0, |_| Vec2::ZERO)
            };
            let before = energy(&bench.particles, &elements, Vec2::ZERO, None, InstructionSet::detect());
            apply_vorticity(&mut bench.particles, &mut bench.solver, &elements, most, 1, 0.01);
            (energy(&bench.particles, &elements, Vec2::ZERO, None, InstructionSet::detect()) - before, bench.particles)
        };
        let (freely, free) = added(f64::MAX);
        assert!(freely > 0.0, "it has nothing to bound");
        for share in [0.9, 0.1, 1e-3] {
            let (bounded, _) = added(share * freely);
            assert!((bounded / freely - share).abs() < 1e-5, "{bounded} of {freely}, not the share {share}");
        }
        // Where nothing was lost, nothing is given; not even if more was gained.
        assert!(added(0.0).0.abs() < 1e-6 * freely && added(-freely).0.abs() < 1e-6 * freely);
        assert_eq!(added(1.001 * freely).1, free, "what is within the bound is not touched");
    }
}
