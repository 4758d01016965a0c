//! Viscosity against what is known of it.

use super::{kinetic_energy, square};
use crate::{
    element::{ElementId, ElementParams},
    params::Preset,
    particles::Particles,
    pbf::tests::{Bench, random_numbers},
    units::TICK_SECONDS,
    velocity::apply_viscosity,
};
use glam::{DVec2, Vec2};

fn viscosity(coefficient: f32) -> ElementParams {
    ElementParams { viscosity: vec![coefficient], ..ElementParams::default() }
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
                apply_viscosity(
                    &mut bench.particles,
                    &mut bench.solver,
                    &bench.domain,
                    &viscosity(coefficient),
                    1,
                    TICK_SECONDS,
                );
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
        apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, &viscosity(0.1), 1, TICK_SECONDS);
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
    apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, &viscosity(0.5), 1, TICK_SECONDS);
    assert_eq!(before, bench.particles);
}

#[test]
fn a_liquid_is_as_thick_at_many_substeps_as_at_one() {
    let left = |substeps: u16| {
        let mut bench = square(0.0, |at| Vec2::new((0.4 * f64::from(at.y)).cos() as f32, 0.0));
        bench.solve(false);
        for _ in 0..40 * substeps {
            let dt = TICK_SECONDS / f32::from(substeps);
            apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, &viscosity(0.1), 1, dt);
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
    apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, &elements, 1, TICK_SECONDS);
    let change = |i: usize| f64::from(masses[i]) * (bench.particles.velocity(i) - before.velocity(i)).as_dvec2();
    let (sum, all) = (0..400).map(change).fold((DVec2::ZERO, 0.0), |(sum, all), one| (sum + one, all + one.length()));
    assert!(all > 1.0 && sum.length() < 1e-4 * all, "{} of {all} came or went", sum.length());
}

/// Viscosity of the liquid's own, that walls hold.
fn thick(coefficient: f32) -> ElementParams {
    ElementParams { stickiness: vec![coefficient], ..viscosity(coefficient) }
}

#[test]
fn what_is_thick_keeps_its_momentum_up_to_its_surfaces() {
    // Both thin out to nothing around it, where each volume is another.
    let mut bench = square(0.2, |_| Vec2::ZERO);
    let mut random = random_numbers(6);
    for i in 0..400 {
        (bench.particles.vx[i], bench.particles.vy[i]) = (40.0 * (random() - 0.5), 40.0 * (random() - 0.5));
    }
    bench.solve(false);
    let came = |elements: &ElementParams| {
        let (mut particles, mut solver) = (bench.particles.clone(), bench.solver.clone());
        apply_viscosity(&mut particles, &mut solver, &bench.domain, elements, 1, TICK_SECONDS);
        let change = |i: usize| (particles.velocity(i) - bench.particles.velocity(i)).as_dvec2();
        let changes = (0..400).map(change);
        let (sum, all) = changes.fold((DVec2::ZERO, 0.0), |(sum, all), one| (sum + one, all + one.length()));
        sum.length() / all
    };
    let (thick, smoothed) = (came(&thick(0.4)), came(&viscosity(0.4)));
    assert!(thick < 1e-5, "{thick} of what changed hands came or went");
    assert!(smoothed > 1e-4, "the test can fail");
}

#[test]
fn walls_hold_what_is_thick_and_let_slip_what_is_smoothed() {
    let speeds = |on_rock: bool, elements: &ElementParams| -> Vec<f32> {
        let floor = if on_rock { 4 } else { 0 };
        let mut bench = Bench::new(60, 20, Preset::Balanced);
        bench.rock((0, 0), (60, floor));
        for k in 0..300 {
            bench.add(Vec2::new((k % 60) as f32 + 0.5, (floor + k / 60) as f32 + 0.5), Vec2::new(10.0, 0.0));
        }
        bench.solve(false);
        apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, elements, 1, TICK_SECONDS);
        let of = |row: i32| {
            let is_of = |i: &usize| {
                let at = bench.particles.position(*i);
                at.y as i32 == floor + row && (20.0..40.0).contains(&at.x)
            };
            let own: Vec<f32> = (0..300).filter(is_of).map(|i| bench.particles.vx[i]).collect();
            own.iter().sum::<f32>() / own.len() as f32
        };
        (0..4).map(of).collect()
    };
    for on_rock in [false, true] {
        let held = speeds(on_rock, &thick(0.4));
        assert!(held[0] < 8.6 && held[0] > 7.6 && held[1] < 9.95, "rock {on_rock}: {held:?}");
        assert!(held.is_sorted() && (held[3] - 10.0).abs() < 1e-4, "rock {on_rock}: out of reach of it, {held:?}");
        let slipped = speeds(on_rock, &viscosity(0.4));
        assert!(slipped.iter().all(|speed| (speed - 10.0).abs() < 1e-4), "rock {on_rock}: {slipped:?}");
        // However thick it is, nothing is turned round.
        assert!(speeds(on_rock, &thick(100.0)).iter().all(|speed| (0.0..=10.001).contains(speed)));
    }
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
            let report = apply_viscosity(
                &mut bench.particles,
                &mut bench.solver,
                &bench.domain,
                &viscosity(coefficient),
                1,
                TICK_SECONDS,
            );
            let after = kinetic_energy(&bench.particles);
            assert_eq!(report.clamps, cut, "c {coefficient}: particles whose coefficient was cut");
            assert!(after <= before, "c {coefficient}, pass {pass}: energy {before} → {after}");
        }
        // Many substeps take small shares each: the same coefficient is within the bound of one.
        let report = apply_viscosity(
            &mut bench.particles,
            &mut bench.solver,
            &bench.domain,
            &viscosity(coefficient),
            1,
            TICK_SECONDS / 16.0,
        );
        assert_eq!(report.clamps, 0, "c {coefficient} in sixteen substeps");
    }
}

/// Something thick, and heavier, amid something thin, all in motion.
fn thick_amid_thin() -> (Bench, Vec<f32>) {
    stirred(square(0.2, |_| Vec2::ZERO), |at| at.distance(Vec2::splat(30.0)) < 4.0)
}

/// Particles in motion, thick and heavier where `is_thick` says so.
fn stirred(mut bench: Bench, is_thick: impl Fn(Vec2) -> bool) -> (Bench, Vec<f32>) {
    let mut random = random_numbers(8);
    for i in 0..bench.particles.len() {
        bench.particles.element[i] = ElementId(is_thick(bench.particles.position(i)).into());
        (bench.particles.vx[i], bench.particles.vy[i]) = (40.0 * (random() - 0.5), 40.0 * (random() - 0.5));
    }
    bench.solve(false);
    let masses: Vec<f32> = bench.particles.element.iter().map(|element| [0.7, 1.0][element.index()]).collect();
    bench.solver.masses.clone_from(&masses);
    (bench, masses)
}

#[test]
fn what_is_thin_takes_one_pass_beside_what_takes_many() {
    let run = |amid: f32| {
        let (mut bench, _) = thick_amid_thin();
        let elements = ElementParams { viscosity: vec![0.02, amid], ..ElementParams::default() };
        apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, &elements, 1, TICK_SECONDS);
        bench.particles
    };
    let (beside, alone) = (run(12.0), run(0.02));
    let mut far = 0;
    for i in (0..400).filter(|&i| alone.position(i).distance(Vec2::splat(30.0)) > 4.0 + 3.0) {
        let apart = (beside.velocity(i) - alone.velocity(i)).length();
        assert!(apart <= 1e-5 * alone.velocity(i).length().max(1.0), "{i}: {apart} d/s");
        far += 1;
    }
    assert!(far > 100, "{far} have none of it for a neighbour");
    let changed = (0..400).filter(|&i| beside.velocity(i) != alone.velocity(i)).count();
    assert!(changed > 30, "what is thick takes more than one pass: {changed}");
}

#[test]
fn what_is_thick_moves_as_it_did_where_it_is_few_and_brought_together() {
    for stickiness in [vec![], vec![0.0, 12.0]] {
        let run = |is_far_thick: bool| {
            let mut bench = square(0.2, |_| Vec2::ZERO);
            for k in 0..560 {
                bench.add(Vec2::new((k % 56) as f32 + 2.5, (k / 56) as f32 + 0.4), Vec2::ZERO);
            }
            let is_near = |at: Vec2| at.distance(Vec2::splat(30.0)) < 4.0;
            let (mut bench, _) = stirred(bench, |at| if at.y < 15.0 { is_far_thick } else { is_near(at) });
            let elements = ElementParams {
                viscosity: vec![0.02, 12.0],
                stickiness: stickiness.clone(),
                ..ElementParams::default()
            };
            apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, &elements, 1, TICK_SECONDS);
            // What is thick near by is few of all, or all of it together is most.
            assert_eq!(bench.solver.thick.is_empty(), is_far_thick);
            bench.particles
        };
        let (few, most) = (run(false), run(true));
        assert!((0..few.len()).all(|i| few.y[i] < 15.0 || few.velocity(i) == most.velocity(i)));
        assert!((0..few.len()).any(|i| few.velocity(i) != most.velocity(i)), "the test can fail");
    }
}

#[test]
fn thick_amid_thin_loses_energy_and_keeps_its_momentum() {
    for coefficients in [[0.02, 0.6], [0.02, 7.9], [0.4, 100.0], [0.26, 0.24]] {
        let (mut bench, masses) = thick_amid_thin();
        let elements = ElementParams {
            viscosity: coefficients.to_vec(),
            stickiness: coefficients.to_vec(),
            ..ElementParams::default()
        };
        let energy = |particles: &Particles| -> f64 {
            (0..400).map(|i| f64::from(masses[i] * particles.velocity(i).length_squared())).sum()
        };
        for pass in 0..20 {
            let before = bench.particles.clone();
            apply_viscosity(&mut bench.particles, &mut bench.solver, &bench.domain, &elements, 1, TICK_SECONDS);
            let (was, is) = (energy(&before), energy(&bench.particles));
            assert!(is < was, "{coefficients:?}, pass {pass}: energy {was} → {is}");
            let change =
                |i: usize| f64::from(masses[i]) * (bench.particles.velocity(i) - before.velocity(i)).as_dvec2();
            let sums = (0..400).map(change).fold((DVec2::ZERO, 0.0), |(sum, all), one| (sum + one, all + one.length()));
            assert!(sums.0.length() < 1e-4 * sums.1, "{coefficients:?}: {sums:?} came or went");
        }
    }
}
