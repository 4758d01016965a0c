//! Heat in a world: what it wakes, what it survives, and where it is not.

use crate::support::{SimulationExt, assert_goes_on_from_a_save, blueprint};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::ElementId,
        heat::held,
        params::Preset,
        solids::Solids,
    },
    scene::{
        self,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        effects::Effects,
        intent::Intent,
        simulation::Simulation,
        state::{AirGrid, Books, HeatCurves, ParticleStore, Rock, Setup, SleepState},
        workers::Workers,
    },
};

fn everywhere() -> Stroke {
    Stroke::rectangle(Vec2::ZERO, Vec2::splat(1000.0))
}

/// Heat of all lumps, with what the air got and without what hands gave, quanta.
fn total(simulation: &Simulation) -> i64 {
    let books = simulation.get::<Books>();
    held(simulation.get::<ParticleStore>(), simulation.get::<Rock>()) + books.outside()
}

#[test]
fn warming_wakes_no_pool_and_boiling_does() {
    let mut simulation = Simulation::of(blueprint("hydrostatic", &[("columns", "20"), ("depth", "10")]));
    simulation.run(900);
    let all = simulation.particles().len();
    assert_eq!(simulation.get::<SleepState>().asleep(), all, "the pool does not rest");
    assert!(!simulation.get::<Effects>().get(Effect::Heat).running);
    let dab = Stroke::dab(BrushShape::Disc, Vec2::new(10.0, 3.0), 2.0);
    simulation.push(Intent::Warm { stroke: dab, degrees: 50.0 }).run(60);
    assert!(simulation.get::<Effects>().get(Effect::Heat).running);
    assert_eq!(simulation.get::<SleepState>().asleep(), all, "warm water wakes");
    assert_eq!(total(&simulation), 0);
    simulation.push(Intent::Warm { stroke: dab, degrees: 500.0 }).run(2);
    assert_eq!(simulation.get::<SleepState>().asleep(), 0, "boiling water sleeps on");
    assert_eq!(total(&simulation), 0);
}

#[test]
fn water_that_is_set_to_a_temperature_boils_at_once_and_stays_there() {
    let mut simulation = Simulation::of(blueprint("hydrostatic", &[("columns", "20"), ("depth", "10")]));
    simulation.run(900);
    let all = simulation.particles().len();
    assert_eq!(simulation.get::<SleepState>().asleep(), all, "the pool does not rest");
    simulation.push(Intent::SetTemperature { stroke: everywhere(), kelvin: 350.0 }).run(1);
    assert_eq!(simulation.get::<SleepState>().asleep(), all, "warm water wakes");
    assert_eq!((simulation.count("water"), total(&simulation)), (all, 0));
    let kelvin = |simulation: &Simulation| {
        let (particles, curves) = (simulation.get::<ParticleStore>(), simulation.get::<HeatCurves>());
        let kelvin = |i: usize| curves.curve(particles.element[i]).temperature(particles.heat_of(i));
        (0..particles.len()).map(kelvin).fold((f32::MAX, f32::MIN), |(a, b), is| (a.min(is), b.max(is)))
    };
    simulation.push(Intent::SetTemperature { stroke: everywhere(), kelvin: 450.0 }).run(2);
    assert_eq!((simulation.count("steam"), simulation.get::<SleepState>().asleep()), (all, 0));
    // Steam of 373 K; the next touch makes it as hot as was asked.
    simulation.push(Intent::SetTemperature { stroke: everywhere(), kelvin: 450.0 });
    simulation.apply_edits();
    let (coldest, hottest) = kelvin(&simulation);
    assert!(450.0 - coldest < 0.01 && hottest - 450.0 < 0.01, "{coldest} to {hottest} K");
    assert_eq!(total(&simulation), 0);
}

#[test]
fn a_world_that_melts_goes_on_from_a_save_to_the_bit() {
    let mut simulation = Simulation::of(blueprint("volcano", &[]));
    simulation.push(Intent::Warm { stroke: everywhere(), degrees: 30.0 }).run(240);
    assert_goes_on_from_a_save(&mut simulation, 120);
}

#[test]
fn heat_is_a_part_of_the_state() {
    let mut simulation = Simulation::of(blueprint("hydrostatic", &[("columns", "20"), ("depth", "10")]));
    let before = simulation.hash();
    simulation.push(Intent::Warm { stroke: everywhere(), degrees: 1.0 });
    simulation.apply_edits();
    assert_ne!(simulation.hash(), before, "warm water has the hash of cold water");
    simulation.push(Intent::Warm { stroke: everywhere(), degrees: -1.0 });
    simulation.apply_edits();
    assert_eq!(simulation.hash(), before, "water that is as cold as before has another hash");
}

#[test]
fn what_moves_has_the_same_heat_at_another_detail() {
    let mut simulation = Simulation::of(blueprint("ice_dam", &[]));
    simulation.run(300);
    let start = Checkpoint::of(simulation.world());
    let area = |simulation: &Simulation| f64::from(simulation.get::<Setup>().blueprint.scale.spacing).powi(2);
    let joules = |simulation: &Simulation| {
        let moves = held(simulation.get::<ParticleStore>(), &Solids::default());
        moves as f64 * area(simulation)
    };
    // The most that half a lump of each element holds: matter goes by whole particles. Rock, which may become thicker, keeps its
    // temperature.
    let particles = simulation.particles();
    let most = |id: ElementId| {
        let own = (0..particles.len()).filter(|i| particles.element[*i] == id);
        own.map(|i| f64::from(particles.heat_of(i)).abs()).fold(0.0, f64::max)
    };
    let halves = 0.5 * simulation.get::<Setup>().elements().iter().map(|(id, _)| most(id)).sum::<f64>();
    let before = joules(&simulation);
    for detail in [0.5, 0.8, 2.0] {
        let finer = start.clone().at_detail(detail).expect("it fits");
        let again = Simulation::resume(&finer, Workers::single());
        let (after, allowed) = (joules(&again), halves * area(&again).max(area(&simulation)));
        assert!((after - before).abs() <= allowed, "{after} of {before} at detail {detail}, {allowed} allowed");
    }
}

/// A room with warm air above its floor, in which an effect has a mode.
fn warm_room(preset: Preset, modes: &[(Effect, Mode)]) -> Simulation {
    let text = "(title: \"Warm room\", spacing: 0.1, size: (6, 6),
        pressures: [(min: (2, 1), max: (4, 3), pressure: 1, temperature: 600)])";
    let modes: EffectModes = modes.iter().copied().collect();
    let room = scene::from_text("warm_room", text).and_then(|file| file.build(&[], Some(preset), &modes));
    Simulation::of(room.unwrap_or_else(|error| panic!("{error}")))
}

/// Mean height of what is warm, weighed by how warm it is, d.
fn height_of_the_warm(simulation: &Simulation) -> f32 {
    let air = simulation.get::<AirGrid>();
    let (mut sum, mut moment) = (0.0, 0.0);
    for row in 0..air.rows() {
        let warmth: f32 = air.warmth_row(row).iter().sum();
        (sum, moment) = (sum + warmth, moment + warmth * (row as f32 + 0.5) * air.cell());
    }
    moment / sum
}

#[test]
fn a_scene_can_begin_with_warm_air_which_rises_and_does_not_burst() {
    let mut simulation = warm_room(Preset::Balanced, &[]);
    let (start, mass) = (height_of_the_warm(&simulation), simulation.get::<AirGrid>().mass());
    assert!(mass < 3500.0, "warm air is thin: {mass} of 3,600 d²");
    simulation.run(1);
    // Twice what gravity does in a tick; air that is not at the pressure around it moves at a part of the speed of sound, 400 d/s.
    assert!(simulation.get::<AirGrid>().max_speed() < 2.0 * 98.1 / 60.0);
    let runs =
        [Effect::Air, Effect::Convection, Effect::Heat].map(|effect| simulation.get::<Effects>().get(effect).running);
    assert_eq!(runs, [true, true, false], "the air is warm, and no lump is");
    assert_goes_on_from_a_save(&mut simulation, 30);
    let risen = height_of_the_warm(&simulation) - start;
    assert!(risen > 1.0, "risen by {risen} d");
    assert!((simulation.get::<AirGrid>().mass() / mass - 1.0).abs() < 1e-6);
    let mut without_heat = warm_room(Preset::Balanced, &[(Effect::Heat, Mode::Off)]);
    without_heat.run(31);
    assert_eq!(without_heat.hash(), simulation.hash(), "heat is that of lumps");
}

#[test]
fn air_that_may_not_be_warm_starts_at_rest() {
    for (preset, modes) in [
        (Preset::Balanced, &[(Effect::Air, Mode::Off)][..]),
        (Preset::Balanced, &[(Effect::Convection, Mode::Off)]),
        (Preset::Classic, &[]),
        (Preset::Classic, &[(Effect::Convection, Mode::On)]),
    ] {
        let mut simulation = warm_room(preset, modes);
        simulation.run(2);
        let air = simulation.get::<AirGrid>();
        assert!(!air.is_warm() && air.is_quiet(), "{preset:?}, {modes:?}");
        assert!(!simulation.get::<Effects>().get(Effect::Air).running, "{preset:?}, {modes:?}");
    }
}

#[test]
fn no_scene_at_the_temperature_of_the_room_has_any_heat() {
    for name in scene::builtin_names() {
        let mut simulation = Simulation::of(blueprint(name, &[]));
        simulation.run(2);
        let is_warm = [
            "volcano",
            "ice_dam",
            "frozen_lake",
            "fireworks",
            "geyser",
            "avalanche",
            "snow_globe",
            "burning_house",
            "distillery",
            "oil_lamp",
            "dust_mill",
            "campfire",
            "ember_rain",
            "winter",
        ]
        .contains(&name);
        let has_heat = simulation.particles().has_heat() || !simulation.get::<Rock>().heats().is_empty();
        assert!(is_warm || !has_heat, "{name} has heat");
        let runs = simulation.get::<Effects>().get(Effect::Heat).running;
        assert_eq!(runs, has_heat && !["avalanche", "snow_globe", "winter"].contains(&name), "{name}");
    }
}
