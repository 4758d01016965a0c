//! Viscosity and vorticity confinement against what is known of them.

use super::*;

use crate::{
    element::{ElementId, ElementParams, Traits},
    params::{GradientKernel, Preset},
    pbf::tests::{Bench, random_numbers},
    predict::longest_move,
    predictor::{Predictor, PredictorParams},
    units::TICK_SECONDS,
};
use glam::DVec2;

fn viscosity(coefficient: f32) -> ElementParams {
    ElementParams { viscosity: vec![coefficient], ..ElementParams::default() }
}

fn vorticity(strength: f32) -> ElementParams {
    ElementParams { vorticity: vec![strength], mass: vec![1000.0], ..ElementParams::default() }
}

/// A square of 20 × 20 particles on the lattice, `jitter` d off it at random, with velocities from `velocity`.
fn square(jitter: f32, velocity: impl Fn(Vec2) -> Vec2) -> Bench {
    let mut bench = Bench::new(60, 60, Preset::Balanced);
    let mut random = random_numbers(9);
    for k in 0..400 {
        let site = Vec2::new(20.5 + (k % 20) as f32, 20.5 + (k / 20) as f32);
        let at = site + jitter * (2.0 * Vec2::new(random(), random()) - 1.0);
        bench.add(at, velocity(at));
    }
    bench
}

fn kinetic_energy(particles: &Particles) -> f64 {
    (0..particles.len()).map(|i| 0.5 * f64::from(particles.velocity(i).length_squared())).sum()
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
fn viscosity_never_raises_the_kinetic_energy_or_a_speed() {
    for jitter in [0.0, 0.2, 0.45] {
        for coefficient in [0.02, 0.5] {
            let mut bench = square(jitter, |_| Vec2::ZERO);
            let mut random = random_numbers(21);
            for i in 0..400 {
                bench.particles.vx[i] = 40.0 * (random() - 0.5);
                bench.particles.vy[i] = 40.0 * (random() - 0.5);
            }
            bench.solve(false);
            for pass in 0..20 {
                let fastest = |p: &Particles| (0..p.len()).map(|i| p.velocity(i).length()).fold(0.0, f32::max);
                let (energy, speed) = (kinetic_energy(&bench.particles), fastest(&bench.particles));
                apply_viscosity(&mut bench.particles, &mut bench.solver, &viscosity(coefficient), 1, TICK_SECONDS);
                let (after, speed_after) = (kinetic_energy(&bench.particles), fastest(&bench.particles));
                assert!(after < energy, "jitter {jitter}, c {coefficient}, pass {pass}: energy {energy} → {after}");
                assert!(
                    speed_after <= speed * 1.0001,
                    "jitter {jitter}, c {coefficient}: speed {speed} → {speed_after}"
                );
            }
        }
    }
}

#[test]
fn viscosity_damps_a_shear_layer_and_keeps_its_momentum() {
    let mut bench = square(0.1, |at| Vec2::new(if at.y > 30.0 { 5.0 } else { -5.0 }, 0.0));
    bench.solve(false);
    let step = |bench: &Bench| -> f32 {
        let mean = |low: f32| {
            let layer: Vec<usize> = (0..400).filter(|&i| (low..low + 1.0).contains(&bench.particles.y[i])).collect();
            layer.iter().map(|&i| bench.particles.vx[i]).sum::<f32>() / layer.len() as f32
        };
        mean(30.0) - mean(29.0)
    };
    assert!((step(&bench) - 10.0).abs() < 1e-3);
    for _ in 0..50 {
        apply_viscosity(&mut bench.particles, &mut bench.solver, &viscosity(0.1), 1, TICK_SECONDS);
    }
    let left = step(&bench);
    assert!((0.1..4.0).contains(&left), "the step of the shear layer went from 10 to {left} d/s");
    let momentum: f32 = bench.particles.vx.iter().sum();
    assert!(momentum.abs() < 0.02 * 5.0 * 400.0, "viscosity made a momentum of {momentum}");
    let still: f32 = bench.particles.vy.iter().map(|v| v.abs()).fold(0.0, f32::max);
    assert_eq!(still, 0.0, "viscosity moves particles across the layer");
}

#[test]
fn an_even_flow_feels_no_viscosity() {
    let mut bench = square(0.3, |_| Vec2::new(3.0, -4.0));
    bench.solve(false);
    let before = bench.particles.clone();
    apply_viscosity(&mut bench.particles, &mut bench.solver, &viscosity(0.5), 1, TICK_SECONDS);
    assert_eq!(before, bench.particles);
}

#[test]
fn velocities_follow_from_the_moves_and_cut_corrections_are_counted() {
    let mut bench = square(0.0, |_| Vec2::ZERO);
    bench.predicted = true;
    bench.solve(false);
    bench.solver.density.fill(1.0);
    bench.solver.x.clone_from(&bench.particles.x);
    bench.solver.y.clone_from(&bench.particles.y);
    let [usual, longest] = [bench.quality.correction_limit, bench.quality.longest_correction()];
    assert!(longest > usual);
    for i in 0..400 {
        bench.solver.x[i] += match i {
            0..7 => usual,
            // In a crowd there is further to go.
            7..12 => {
                bench.solver.density[i] = 2.5;
                if i < 9 { longest } else { usual }
            }
            _ => 0.01,
        };
    }
    let before = bench.particles.clone();
    let report = update_velocities(
        &mut bench.particles,
        &mut bench.solver,
        &bench.solids,
        Vec2::ZERO,
        None,
        Traits::default(),
        1,
        0.01,
    );
    assert_eq!(report.position_clamps, 9, "corrections at their limit");
    let shares = |i| bench.solver.correction_share(i, bench.particles.position(i)).unwrap();
    assert!((shares(3) - 1.0).abs() < 1e-3 && (shares(8) - 1.0).abs() < 1e-3 && shares(10) < 0.6 && shares(20) < 0.2);
    assert_eq!(bench.solver.correction_share(20, Vec2::splat(5.0)), None, "another particle");
    for i in 0..400 {
        let moved = bench.particles.x[i] - before.x[i];
        assert!((bench.particles.vx[i] - moved / 0.01).abs() < 1e-3 && bench.particles.vy[i] == 0.0);
        assert!(moved > 0.009, "particle {i} did not go where it was sent");
    }
}

/// A substep, s.
const SUBSTEP: f32 = 2.0 / 3.0 * TICK_SECONDS;

/// Change of velocity of a particle inside a square that flows at (2, 0) d/s while it sinks through it at 3 d/s, and of
/// one that flows with it, where all have `density` and the pressure predictor ran before corrections of `way` d upwards.
fn after_a_correction(density: f32, way: f32) -> [Vec2; 2] {
    let mut bench = square(0.0, |_| Vec2::new(2.0, 0.0));
    bench.particles.vy[210] = -3.0;
    after_corrections(bench, [210, 205], density, way, true)
}

/// Change of velocity of two particles whose world is liquid or not: see [`after_a_correction`].
fn after_corrections(mut bench: Bench, ids: [usize; 2], density: f32, way: f32, is_liquid: bool) -> [Vec2; 2] {
    let mut predictor = Predictor::default();
    let params = PredictorParams {
        domain: &bench.domain,
        cell: bench.quality.kernel_radius,
        rest_density: 1.0,
        masses: None,
        grains: None,
        instructions: bench.solver.instructions,
        threads: 1,
        dt: SUBSTEP,
    };
    assert_eq!(predictor.run(&mut bench.particles, &bench.solids, &params).liquid, is_liquid);
    bench.predicted = true;
    bench.particles.push_x.fill(0.0);
    bench.particles.push_y.fill(0.0);
    bench.solve(false);
    bench.solver.density.fill(density);
    bench.solver.x.clone_from(&bench.particles.x);
    bench.solver.y.clone_from(&bench.particles.y);
    bench.solver.y.iter_mut().for_each(|y| *y += way);
    let before = bench.particles.clone();
    let flow = Some(predictor.flow());
    update_velocities(
        &mut bench.particles,
        &mut bench.solver,
        &bench.solids,
        Vec2::ZERO,
        flow,
        Traits::default(),
        1,
        SUBSTEP,
    );
    ids.map(|id| {
        let i = before.id.iter().position(|own| *own == id as u32).unwrap();
        assert!((bench.particles.y[i] - before.y[i] - way).abs() < 1e-4, "the correction itself was lost");
        bench.particles.velocity(i) - before.velocity(i)
    })
}

#[test]
fn after_the_predictor_a_correction_ends_motion_beside_the_flow_and_makes_none() {
    let [from, to] = PRESSED.map(|share| 1.0 + share / Preset::Balanced.quality().substeps as f32);
    // What is not pressed together finds its place, and no more.
    assert_eq!(after_a_correction(from - 1e-4, 0.2), [Vec2::ZERO; 2]);
    // A tenth of a spacing in 0.011 s is 9 d/s, of which no more than the way back to the flow is taken.
    for way in [0.1, 0.4] {
        let [sinking, flowing] = after_a_correction(1.2, way);
        assert!((2.5..=3.0).contains(&sinking.y) && sinking.x == 0.0, "{sinking} of 3 d/s after {way} d");
        assert!(flowing.length() < 0.1, "{flowing} beyond the flow after {way} d");
    }
    // A short one takes its own speed, or the share of it by which the liquid is pressed.
    let way = 0.01;
    let [sinking, _] = after_a_correction(1.2, way);
    assert!((sinking.y - way / SUBSTEP).abs() < 1e-3, "{sinking}");
    let [sinking, _] = after_a_correction((from + to) / 2.0, way);
    assert!((sinking.y - 0.5 * way / SUBSTEP).abs() < 1e-3, "{sinking}");
    // And none that goes along with the motion adds to it.
    assert_eq!(after_a_correction(1.2, -0.1)[0], Vec2::ZERO);
}

#[test]
fn a_correction_holds_up_a_drop_at_a_wall_and_leaves_spray_alone() {
    let drops = || {
        let mut bench = Bench::new(60, 60, Preset::Balanced);
        for at in [Vec2::new(0.6, 0.4), Vec2::new(30.0, 30.0)] {
            bench.add(at, Vec2::new(0.0, -3.0));
        }
        bench
    };
    // However thin it is; 0.4 d are more than it takes.
    let [held, spray] = after_corrections(drops(), [0, 1], 0.1, 0.4, false);
    assert_eq!((held, spray), (Vec2::new(0.0, 3.0), Vec2::ZERO));
    // Not more than the correction's own speed, and nothing of one along with the motion.
    let [held, _] = after_corrections(drops(), [0, 1], 0.1, 0.01, false);
    assert!((held.y - 0.01 / SUBSTEP).abs() < 1e-3, "{held}");
    assert_eq!(after_corrections(drops(), [0, 1], 0.1, -0.1, false)[0], Vec2::ZERO);
}

#[test]
fn a_correction_into_rock_stops_at_its_face() {
    let mut bench = square(0.0, |_| Vec2::ZERO);
    bench.rock((40, 10), (41, 50));
    bench.bin();
    for i in 0..400 {
        bench.solver.x[i] += 0.6;
    }
    update_velocities(
        &mut bench.particles,
        &mut bench.solver,
        &bench.solids,
        Vec2::ZERO,
        None,
        Traits::default(),
        1,
        0.01,
    );
    for i in 0..400 {
        let at = bench.particles.position(i);
        assert!(!bench.solids.is_solid(Solids::cell_of(at)), "particle {i} was moved into rock, to {at}");
    }
}

#[test]
fn a_liquid_is_as_thick_at_many_substeps_as_at_one() {
    let left = |substeps: u16| {
        let mut bench = square(0.0, |at| Vec2::new((0.4 * f64::from(at.y)).cos() as f32, 0.0));
        bench.solve(false);
        for _ in 0..40 * substeps {
            let dt = TICK_SECONDS / f32::from(substeps);
            apply_viscosity(&mut bench.particles, &mut bench.solver, &viscosity(0.1), 1, dt);
        }
        kinetic_energy(&bench.particles)
    };
    let (one, eight) = (left(1), left(8));
    assert!((eight / one - 1.0).abs() < 0.01, "{one} is left at one substep, {eight} at eight");
}

#[test]
fn viscosity_keeps_the_momentum_of_liquids_of_any_mass_and_thickness() {
    // What moves is far from the edges of the lattice, so that all are as dense.
    let mut bench = square(0.0, |_| Vec2::ZERO);
    let mut random = random_numbers(5);
    for i in 0..400 {
        bench.particles.element[i] = ElementId((random() > 0.5).into());
        if bench.particles.position(i).distance(Vec2::splat(30.0)) < 5.0 {
            (bench.particles.vx[i], bench.particles.vy[i]) = (40.0 * (random() - 0.5), 40.0 * (random() - 0.5));
        }
    }
    bench.solve(false);
    let masses: Vec<f32> = bench.particles.element.iter().map(|element| [1.0, 0.1][element.index()]).collect();
    bench.solver.masses.clone_from(&masses);
    let before = bench.particles.clone();
    let elements = ElementParams { viscosity: vec![0.02, 0.43], ..ElementParams::default() };
    apply_viscosity(&mut bench.particles, &mut bench.solver, &elements, 1, TICK_SECONDS);
    let change = |i: usize| f64::from(masses[i]) * (bench.particles.velocity(i) - before.velocity(i)).as_dvec2();
    let (sum, all) = (0..400).map(change).fold((DVec2::ZERO, 0.0), |(sum, all), one| (sum + one, all + one.length()));
    assert!(all > 1.0 && sum.length() < 1e-4 * all, "{} of {all} came or went", sum.length());
}

#[test]
fn viscosity_is_stable_at_any_coefficient_and_cut_to_what_its_passes_can_do() {
    for (coefficient, cut) in [(0.99, 0), (10.0, 0), (15.9, 0), (160.0, 400)] {
        let mut bench = square(0.2, |_| Vec2::ZERO);
        let mut random = random_numbers(33);
        for i in 0..400 {
            (bench.particles.vx[i], bench.particles.vy[i]) = (40.0 * (random() - 0.5), 40.0 * (random() - 0.5));
        }
        bench.solve(false);
        for pass in 0..50 {
            let before = kinetic_energy(&bench.particles);
            let report =
                apply_viscosity(&mut bench.particles, &mut bench.solver, &viscosity(coefficient), 1, TICK_SECONDS);
            let after = kinetic_energy(&bench.particles);
            assert_eq!(report.clamps, cut, "c {coefficient}: particles whose coefficient was cut");
            assert!(after <= before, "c {coefficient}, pass {pass}: energy {before} → {after}");
        }
        // Many substeps take small shares each: the same coefficient is within the bound of one.
        let report =
            apply_viscosity(&mut bench.particles, &mut bench.solver, &viscosity(coefficient), 1, TICK_SECONDS / 16.0);
        assert_eq!(report.clamps, 0, "c {coefficient} in sixteen substeps");
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
            let before = energy(&bench.particles, &elements, Vec2::ZERO, None);
            apply_vorticity(&mut bench.particles, &mut bench.solver, &elements, most, 1, 0.01);
            (energy(&bench.particles, &elements, Vec2::ZERO, None) - before, bench.particles)
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
