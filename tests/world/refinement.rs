//! Finer is better: with half the substep or half the spacing the errors go down, and nothing becomes unstable.

use crate::support::{Furnish, SimulationExt, blueprint, empty_box, with_water};
use glam::Vec2;
use powder_master::{
    kernel::params::Preset,
    scene::effects::{Effect, Mode},
    sim::{
        simulation::Simulation,
        state::{Setup, SolverState},
    },
};

/// Orders of convergence between neighbours of a sequence of errors.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// Kinetic and potential energy, d²/s² for the mass of a particle.
fn energy(simulation: &Simulation) -> f64 {
    let gravity = simulation.get::<Setup>().blueprint.domain.gravity.as_dvec2();
    let particles = simulation.particles();
    let of = |i: usize| {
        0.5 * particles.velocity(i).as_dvec2().length_squared() - gravity.dot(particles.position(i).as_dvec2())
    };
    (0..particles.len()).map(of).sum()
}

#[test]
fn a_fall_is_exact_at_any_substep() {
    let error = |substeps: u32| {
        let mut blueprint = empty_box(16, 400);
        blueprint.domain.gravity = Vec2::new(0.0, -98.1);
        blueprint.quality.substeps = substeps;
        for effect in [Effect::Air, Effect::Drag] {
            blueprint.effects.insert(effect, Mode::Off);
        }
        blueprint.water(Vec2::new(8.0, 350.0), Vec2::ZERO);
        let mut simulation = Simulation::of(blueprint);
        simulation.run(120);
        // y = y₀ − g t²/2
        (f64::from(simulation.particles().y[0]) - (350.0 - 0.5 * 98.1 * 4.0)).abs()
    };
    for substeps in [1, 2, 4, 8] {
        // The leapfrog's move is the parabola's. Each substep rounds a coordinate of 350 d by up to 2⁻¹⁶ d.
        let rounding = 120.0 * f64::from(substeps) / 65_536.0;
        let error = error(substeps);
        assert!(error < rounding, "{substeps} substeps: {error} d off, rounding makes {rounding} at most");
    }
}

#[test]
fn half_the_substep_quarters_the_error_of_a_throw_through_air() {
    // Still air, C v², of something light, so that rounding does not show: what is left is the splitting of drag and
    // gravity.
    let place = |substeps: u32| {
        let mut blueprint = empty_box(200, 300);
        blueprint.domain.gravity = Vec2::new(0.0, -98.1);
        blueprint.quality.substeps = substeps;
        blueprint.effects.insert(Effect::Drag, Mode::On);
        blueprint.effects.insert(Effect::AirFeedback, Mode::Off);
        with_water(&mut blueprint, |water| water.drag = 20.0);
        blueprint.water(Vec2::new(20.0, 200.0), Vec2::new(90.0, 60.0));
        let mut simulation = Simulation::of(blueprint);
        simulation.run(60);
        simulation.particles().position(0).as_dvec2()
    };
    let finest = place(64);
    let errors: Vec<f64> = [1, 2, 4, 8].map(|substeps| place(substeps).distance(finest)).into();
    for order in orders(&errors) {
        assert!(order > 1.8, "second order is 2: {errors:?} d");
    }
}

/// 99th percentile of max(0, ρ/ρ₀ − 1) in a pool after it has settled, and the most that its energy rose above the start.
fn pool(preset: Preset, substeps: u32) -> (f64, f64) {
    let mut blueprint = empty_box(16, 30);
    (blueprint.preset, blueprint.quality) = (preset, preset.quality());
    blueprint.quality.substeps = substeps;
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    // Tension pushes once an iteration: more of it is another liquid.
    for effect in [Effect::Air, Effect::Drag, Effect::Tension] {
        blueprint.effects.insert(effect, Mode::Off);
    }
    blueprint.pool((0, 0), (16, 22));
    let mut simulation = Simulation::of(blueprint);
    let start = energy(&simulation);
    let (mut errors, mut rise) = (Vec::new(), 0.0_f64);
    for tick in 0..180 {
        simulation.run(1);
        rise = rise.max(energy(&simulation) - start);
        if tick >= 140 && tick % 4 == 0 {
            let mut found: Vec<f64> =
                simulation.get::<SolverState>().density.iter().map(|rho| f64::from((rho - 1.0).max(0.0))).collect();
            found.sort_unstable_by(f64::total_cmp);
            errors.push(found[found.len() * 99 / 100]);
        }
    }
    assert_eq!((simulation.counters().escaped, simulation.counters().non_finite), (0, 0));
    (errors.iter().sum::<f64>() / errors.len() as f64, rise / start.abs())
}

#[test]
fn half_the_substep_lowers_the_density_error_of_a_pool() {
    let found = [1, 2, 4, 8].map(|substeps| pool(Preset::Classic, substeps));
    for pair in found.windows(2) {
        assert!(pair[1].0 < 0.8 * pair[0].0, "the plain method's error by substeps: {found:?}");
    }
    // With the predictor the error is at its floor already; it must not rise, and nothing may boil.
    let predicted = [1, 2, 4, 8].map(|substeps| pool(Preset::Balanced, substeps));
    for (error, _) in predicted {
        assert!(error < 0.02, "with the predictor: {predicted:?}");
    }
    // The predictor aims 1 % under the rest density, so a pool at the start's rises by half of that, and some more as its
    // particles leave the lattice. The plain method has no such bound: what its corrections leave undone becomes speeds
    // over Δt, and at eight substeps its pool boils.
    for (_, rise) in predicted {
        assert!(rise < 0.02, "energy from nowhere, as a share of the start's: {found:?} {predicted:?}");
    }
}

#[test]
fn half_the_spacing_brings_the_dam_break_closer_to_its_limit() {
    /// Times at which the front is looked at, in units of √(base/g).
    const TIMES: [f32; 4] = [0.6, 0.9, 1.2, 1.5];
    let fronts = |columns: u32| {
        let start = blueprint("dam_break", &[("columns", &columns.to_string())]);
        let unit = (columns as f32 / -start.domain.gravity.y).sqrt();
        let mut simulation = Simulation::of(start);
        let (begin, mut found, mut last, mut ticks) = (energy(&simulation), Vec::new(), columns as f32, 0);
        while found.len() < TIMES.len() {
            simulation.run(1);
            ticks += 1;
            let low = 0.25 * columns as f32;
            let mut foot: Vec<f32> = (simulation.particles().x.iter().zip(&simulation.particles().y))
                .filter(|(_, y)| **y < low)
                .map(|(x, _)| x + 0.5)
                .collect();
            foot.sort_unstable_by(f32::total_cmp);
            let front = foot[foot.len() * 99 / 100];
            let (now, before) = (ticks as f32 / 60.0 / unit, (ticks - 1) as f32 / 60.0 / unit);
            if now >= TIMES[found.len()] {
                let share = (TIMES[found.len()] - before) / (now - before);
                found.push(f64::from((last + share * (front - last)) / columns as f32));
            }
            last = front;
            assert!(energy(&simulation) <= 1.01 * begin, "{columns} columns: energy from nowhere");
        }
        found
    };
    let found: Vec<Vec<f64>> = [10, 20, 40].map(fronts).into();
    let apart: Vec<f64> = found
        .windows(2)
        .map(|pair| pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).abs()).sum::<f64>() / TIMES.len() as f64)
        .collect();
    assert!(apart[1] < 0.75 * apart[0], "fronts {found:?} are {apart:?} apart");
    assert!(found[2].windows(2).all(|pair| pair[1] > pair[0]), "the front went back: {found:?}");
}
