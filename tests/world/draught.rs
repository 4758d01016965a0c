//! Particles drag the air along (`air_feedback`).

use crate::support::{Furnish, ROCK, SimulationExt, WATER, empty_box};
use glam::{DVec2, Vec2};
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::{OpenSides, Preset},
        sources::{Emitter, Rect, Wind},
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{effects::Effects, intent::Intent, simulation::Simulation, state::AirGrid},
};

fn area(min: (f32, f32), max: (f32, f32)) -> Rect {
    Rect { min: min.into(), max: max.into() }
}

/// Mean velocity of the air in the cells whose centre is in an area, d/s.
fn wind_in(simulation: &Simulation, area: Rect) -> Vec2 {
    let air = simulation.get::<AirGrid>();
    let (mut sum, mut count) = (Vec2::ZERO, 0.0);
    for row in 0..air.rows() {
        for column in 0..air.columns() {
            if area.contains(Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * air.cell()) {
                sum += air.velocity_at_cell(column, row);
                count += 1.0;
            }
        }
    }
    sum / count
}

fn dab(x: f32, y: f32) -> Stroke {
    Stroke::dab(BrushShape::Disc, Vec2::new(x, y), 8.0)
}

/// Mean speed there, d/s.
fn speed_in(simulation: &Simulation, area: Rect) -> f32 {
    let air = simulation.get::<AirGrid>();
    let cells = (0..air.rows()).flat_map(|row| (0..air.columns()).map(move |column| (column, row)));
    let inside =
        cells.filter(|&(column, row)| area.contains(Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * air.cell()));
    let speeds: Vec<f32> = inside.map(|(column, row)| air.velocity_at_cell(column, row).length()).collect();
    speeds.iter().sum::<f32>() / speeds.len() as f32
}

fn with_feedback(mut blueprint: Blueprint, mode: Mode) -> Simulation {
    blueprint.effects.insert(Effect::AirFeedback, mode);
    Simulation::of(blueprint)
}

#[test]
fn particles_and_air_keep_their_momentum() {
    let mut blueprint = empty_box(160, 160);
    for effect in [Effect::Viscosity, Effect::Vorticity, Effect::Tension, Effect::Predictor, Effect::Sleep] {
        blueprint.effects.insert(effect, Mode::Off);
    }
    for i in 0..400 {
        let place = Vec2::new(70.0 + (i % 20) as f32 * 1.3, 70.0 + (i / 20) as f32 * 1.3);
        blueprint.water(place, Vec2::new(60.0 + (i % 7) as f32, (i % 11) as f32));
    }
    let mut simulation = with_feedback(blueprint, Mode::On);
    let momentum = |simulation: &Simulation| {
        let (air, particles) = (simulation.get::<AirGrid>(), simulation.particles());
        let water = (0..particles.len()).map(|i| particles.velocity(i).as_dvec2() * 1000.0);
        air.momentum() * 1.2 + water.fold(DVec2::ZERO, |sum, part| sum + part)
    };
    let (start, air_before) = (momentum(&simulation), simulation.get::<AirGrid>().momentum());
    // The sound that they make has not reached a wall yet.
    simulation.run(3);
    let drift = (momentum(&simulation) - start).length() / start.length();
    assert!(drift < 1e-5, "momentum drifts by {drift}");
    let gained = (simulation.get::<AirGrid>().momentum() - air_before).length() * 1.2 / start.length();
    assert!(gained > 1e-3, "the air gained {gained} of it: nothing to see");
}

#[test]
fn a_spray_drags_a_draught_along() {
    let wind = |mode: Mode| {
        let mut blueprint = empty_box(240, 80);
        blueprint.air.open = OpenSides { left: true, right: true, ..OpenSides::default() };
        blueprint.emitters.push(Emitter {
            element: WATER,
            area: area((10.0, 36.0), (12.0, 44.0)),
            velocity: Vec2::new(150.0, 0.0),
            rate: 300.0,
            total: None,
            start: 0,
            given: 0,
            due: 0.0,
        });
        let mut simulation = with_feedback(blueprint, mode);
        simulation.run(60);
        wind_in(&simulation, area((30.0, 32.0), (120.0, 48.0))).x
    };
    let (off, auto) = (wind(Mode::Off), wind(Mode::Auto));
    assert_eq!(off, 0.0, "the air moves although nothing gives it anything");
    assert!(auto > 15.0, "a draught of {auto} d/s");
}

#[test]
fn water_that_falls_down_a_shaft_pushes_the_air_out_below() {
    let out = |mode: Mode| {
        let mut blueprint = empty_box(48, 240);
        blueprint.domain.gravity = Vec2::new(0.0, -98.1);
        blueprint.air.open = OpenSides { left: true, right: true, bottom: true, top: true };
        blueprint.rock((12, 40), (16, 220));
        blueprint.rock((32, 40), (36, 220));
        blueprint.pool((16, 190), (32, 206));
        let mut simulation = with_feedback(blueprint, mode);
        // It falls some 85 d: its lower end is still well inside.
        simulation.run(75);
        let lowest = simulation.particles().y.iter().copied().fold(f32::INFINITY, f32::min);
        assert!(lowest > 60.0, "the water is out already: {lowest}");
        wind_in(&simulation, area((18.0, 30.0), (30.0, 44.0))).y
    };
    let (off, auto) = (out(Mode::Off), out(Mode::Auto));
    assert_eq!(off, 0.0);
    assert!(auto < -15.0, "{auto} d/s come out below");
}

#[test]
fn a_pool_shields_its_depth_from_a_gale() {
    let run = |mode: Mode| {
        let mut blueprint = empty_box(200, 80);
        blueprint.domain.gravity = Vec2::new(0.0, -98.1);
        blueprint.air.open = OpenSides { left: true, right: true, ..OpenSides::default() };
        blueprint.pool((0, 0), (200, 20));
        let (velocity, rate) = (Vec2::new(150.0, 0.0), 20.0);
        blueprint.winds.push(Wind { area: area((0.0, 24.0), (200.0, 80.0)), velocity, rate });
        let mut simulation = with_feedback(blueprint, mode);
        simulation.run(40);
        let particles = simulation.particles();
        let pushed = particles.vx.iter().sum::<f32>() / particles.len() as f32;
        (speed_in(&simulation, area((40.0, 0.0), (160.0, 12.0))), pushed)
    };
    let (off, auto) = (run(Mode::Off), run(Mode::Auto));
    println!("wind in the depth and speed of the water: {off:?} without, {auto:?} with feedback");
    assert!(off.0 > 20.0, "the gale does not reach the depth anyway: {} d/s", off.0);
    assert!(auto.0 < 0.3 * off.0, "a wind of {} d/s blows at the bottom of a pool", auto.0);
    assert!(auto.1.abs() < 0.7 * off.1.abs(), "the whole pool is pushed: {} d/s of {}", auto.1, off.1);
}

#[test]
fn no_grid_is_built_where_nothing_moves_the_air() {
    let built = |simulation: &Simulation| simulation.get::<AirGrid>().is_built();
    let mut blueprint = empty_box(100, 60);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.pool((0, 0), (100, 10));
    blueprint.rock((40, 10), (44, 30));
    let mut simulation = with_feedback(blueprint, Mode::Off);
    assert!(!built(&simulation));
    let hash = simulation.run(10).hash();
    assert!(!built(&simulation), "a pool at rest has a grid of air");
    // The same world with a grid.
    let rock = simulation.rock().0.clone();
    simulation.get_mut::<AirGrid>().build(&rock);
    assert!(built(&simulation) && simulation.get::<AirGrid>().is_solid_cell(10, 4));
    assert_eq!(simulation.hash(), hash, "a grid at rest shows in the hash");
    for scene in ["dam_break", "hydrostatic", "rest_density", "communicating_vessels"] {
        let mut simulation = Simulation::scene(scene, &[]);
        simulation.run(2);
        assert!(!built(&simulation), "{scene} has no air, but a grid of it");
    }
}

#[test]
fn air_that_is_built_late_goes_on_as_air_that_was_there_all_along() {
    for intent in [
        Intent::Blow { stroke: dab(50.0, 20.0), velocity: Vec2::new(80.0, 10.0) },
        Intent::Press { stroke: dab(50.0, 20.0), amount: 0.5 },
        Intent::Stamp { element: ROCK, stroke: dab(50.0, 20.0) },
        Intent::Erase { stroke: dab(42.0, 20.0) },
    ] {
        let run = |early: bool| {
            let mut blueprint = empty_box(100, 60);
            blueprint.rock((40, 10), (44, 30));
            let mut simulation = Simulation::of(blueprint);
            if early {
                let rock = simulation.rock().0.clone();
                simulation.get_mut::<AirGrid>().build(&rock);
            }
            simulation.run(3);
            assert_eq!(simulation.get::<AirGrid>().is_built(), early);
            simulation.push(intent.clone());
            simulation.run(10);
            assert!(!simulation.get::<AirGrid>().is_quiet(), "{intent:?} leaves the air at rest");
            simulation.hash()
        };
        assert_eq!(run(false), run(true), "{intent:?}");
    }
}

#[test]
fn feedback_runs_where_it_is_called_for_and_not_in_classic() {
    let run = |preset: Preset, speed: f32| {
        let mut blueprint = empty_box(100, 60);
        (blueprint.preset, blueprint.quality) = (preset, preset.quality());
        blueprint.water(Vec2::new(50.0, 30.0), Vec2::new(speed, 0.0));
        let mut simulation = Simulation::of(blueprint);
        simulation.run(10);
        let state = simulation.get::<Effects>().get(Effect::AirFeedback);
        (state.active_ticks > 0, simulation.calls(Pass::Feedback) > 0, simulation.get::<AirGrid>().is_quiet())
    };
    assert_eq!(run(Preset::Balanced, 80.0), (true, true, false));
    assert_eq!(run(Preset::Balanced, 0.5), (false, false, true), "a slow drop wakes the air");
    assert_eq!(run(Preset::Classic, 80.0), (false, false, true));
}

/// Share of a puddle, 60 d long and 3 d deep, that eight sweeps of the hand leave on the left third of the floor.
fn left_by_the_hand(mode: Mode) -> f64 {
    let mut blueprint = empty_box(160, 80);
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint.pool((0, 0), (60, 3));
    let mut simulation = with_feedback(blueprint, mode);
    simulation.run(30);
    for _ in 0..8 {
        for step in 0..20 {
            let stroke = dab(3.0 * step as f32, 3.0);
            simulation.push(Intent::Blow { stroke, velocity: Vec2::new(180.0, 0.0) });
            simulation.run(1);
        }
    }
    let x = &simulation.particles().x;
    x.iter().filter(|&&x| x < 50.0).count() as f64 / x.len() as f64
}

#[test]
fn the_hand_blows_water_away_although_water_slows_the_air() {
    let (off, auto) = (left_by_the_hand(Mode::Off), left_by_the_hand(Mode::Auto));
    println!("{off} {auto}");
    assert!(auto < 0.4, "{auto} of the puddle stays, {off} in air that yields to nobody");
}
