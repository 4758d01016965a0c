//! Single particles and eddies against known solutions.

use crate::support::{Furnish, SimulationExt, empty_box, with_water};
use glam::Vec2;
use powder_master::{
    kernel::params::Preset,
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::simulation::Simulation,
};

const GRAVITY: f32 = 98.1;

fn without(blueprint: &mut Blueprint, effects: &[Effect]) {
    for &effect in effects {
        blueprint.effects.insert(effect, Mode::Off);
    }
}

#[test]
fn a_throw_without_air_follows_its_parabola() {
    for preset in Preset::ALL {
        let mut blueprint = empty_box(300, 300);
        (blueprint.preset, blueprint.quality) = (preset, preset.quality());
        blueprint.domain.gravity = Vec2::new(0.0, -GRAVITY);
        without(&mut blueprint, &[Effect::Air, Effect::Drag]);
        let (start, velocity) = (Vec2::new(20.0, 100.0), Vec2::new(90.0, 120.0));
        blueprint.water(start, velocity);
        let mut simulation = Simulation::of(blueprint);
        for tick in 1..=120 {
            simulation.run(1);
            let time = tick as f32 / 60.0;
            let exact = start + velocity * time - Vec2::new(0.0, 0.5 * GRAVITY * time * time);
            let at = simulation.particles().position(0);
            assert!((at - exact).length() < 0.002, "{}: {at} instead of {exact} at tick {tick}", preset.name());
            let (speed, exact) = (simulation.particles().velocity(0), velocity - Vec2::new(0.0, GRAVITY * time));
            assert!((speed - exact).length() < 0.002, "{}: {speed} instead of {exact} at tick {tick}", preset.name());
        }
        assert_eq!(simulation.counters().speed_clamps, 0, "a throw of 150 d/s was slowed");
    }
}

#[test]
fn without_forces_a_particle_flies_straight_on() {
    let mut blueprint = empty_box(300, 300);
    without(&mut blueprint, &[Effect::Air, Effect::Drag]);
    blueprint.water(Vec2::new(10.0, 200.0), Vec2::new(60.0, -30.0));
    let mut simulation = Simulation::of(blueprint);
    simulation.run(240);
    let at = simulation.particles().position(0);
    assert!((at - Vec2::new(250.0, 80.0)).length() < 0.02, "{at} instead of (250, 80)");
}

#[test]
fn drag_slows_a_particle_as_its_exact_solution_does() {
    let mut blueprint = empty_box(400, 40);
    blueprint.effects.insert(Effect::Air, Mode::Off);
    let speed = 240.0;
    blueprint.water(Vec2::new(5.0, 20.0), Vec2::new(speed, 0.0));
    let rate = 0.45 / (1000.0 * 0.1);
    let mut simulation = Simulation::of(blueprint);
    for tick in 1..=60 {
        simulation.run(1);
        let time = tick as f32 / 60.0;
        let exact = speed / (1.0 + rate * speed * time);
        let found = simulation.particles().vx[0];
        assert!((found - exact).abs() < 1e-3 * exact, "tick {tick}: {found} d/s instead of {exact}");
    }
}

#[test]
fn a_drop_falls_at_its_terminal_speed() {
    for drag in [0.45, 5.0, 100.0] {
        let mut blueprint = empty_box(20, 2000);
        blueprint.domain.gravity = Vec2::new(0.0, -GRAVITY);
        // The answer is for air that stands still.
        without(&mut blueprint, &[Effect::AirFeedback]);
        with_water(&mut blueprint, |water| water.drag = drag);
        blueprint.water(Vec2::new(10.0, 1900.0), Vec2::ZERO);
        let mut simulation = Simulation::of(blueprint);
        simulation.run(600);
        // g = C v²/(ρ d²), in d/s with d = 0.1 m. Half a tick's gravity before the drag and half after it make u = v +
        // g Δt/2 go to u/(1 + g/v_∞² u Δt), so that what stays is v² = v_∞² + (g Δt/2)²: of second order in Δt.
        let (exact, kick) = ((9.81_f32 * 1000.0 * 0.01 / drag).sqrt() / 0.1, 0.5 * GRAVITY / 60.0);
        let expected = exact.hypot(kick);
        let found = -simulation.particles().vy[0];
        assert!((found - expected).abs() < 1e-3 * expected, "C = {drag}: {found} d/s instead of {expected}");
    }
}

/// Taylor–Green vortex in a box that is full of water: one eddy, 24 × 24 particles.
fn vortex(vorticity: f32) -> Blueprint {
    let mut blueprint = empty_box(24, 24);
    without(&mut blueprint, &[Effect::Air, Effect::Drag, Effect::Viscosity]);
    with_water(&mut blueprint, |water| water.vorticity = vorticity);
    blueprint.pool((0, 0), (24, 24));
    for i in 0..blueprint.particles.len() {
        let at = blueprint.particles.position(i).as_dvec2() * std::f64::consts::PI / 24.0;
        let velocity = 30.0 * glam::DVec2::new(at.x.sin() * at.y.cos(), -at.x.cos() * at.y.sin());
        (blueprint.particles.vx[i], blueprint.particles.vy[i]) = (velocity.x as f32, velocity.y as f32);
    }
    blueprint
}

#[test]
fn confinement_gives_an_eddy_back_what_solving_took_and_no_more() {
    let run = |vorticity: f32, ticks: usize| {
        let mut simulation = Simulation::of(vortex(vorticity));
        let start = simulation.rms_speed();
        let mut energies = Vec::new();
        for tick in 1..=ticks {
            simulation.run(1);
            let energy = (simulation.rms_speed() / start).powi(2);
            // What f32 rounds off in each of 400 ticks.
            assert!(energy <= 1.0 + 4e-5, "ε = {vorticity}: energy {energy} of the start's at tick {tick}");
            energies.push(energy);
        }
        energies
    };
    let early = |energies: Vec<f64>| energies[..60].iter().sum::<f64>();
    // What of the start's energy is there in the first second, summed over its ticks: at most 60. Two runs whose starts
    // differ by 1/1000 d are 0.8 to 1.4 apart (twelve of each, standard deviation).
    assert!(run(0.02, 400)[399] < 0.9, "an eddy that never slows");
    let [without, half, strongest] = [0.0, 0.5, 1.0].map(|strength| early(run(strength, 60)));
    assert!(half > without + 3.0, "half as much keeps {half}, none {without}");
    assert!(strongest > half - 1.4, "the strongest keeps {strongest}, half as much {half}");
}
