//! Heat in a world: what it wakes, what it survives, and where it is not.

use crate::support::{SimulationExt, assert_goes_on_from_a_save, blueprint};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::ElementId,
        heat::held,
        solids::Solids,
    },
    scene::{self, effects::Effect},
    sim::{
        checkpoint::Checkpoint,
        effects::Effects,
        intent::Intent,
        simulation::Simulation,
        state::{Books, HeatCurves, ParticleStore, Rock, Setup, SleepState},
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

#[test]
fn no_scene_at_the_temperature_of_the_room_has_any_heat() {
    for name in scene::builtin_names() {
        let mut simulation = Simulation::of(blueprint(name, &[]));
        simulation.run(2);
        let is_warm = [
            "volcano",
            "ice_dam",
            "frozen_lake",
            "avalanche",
            "snow_globe",
            "burning_house",
            "distillery",
            "oil_lamp",
            "dust_mill",
        ]
        .contains(&name);
        let has_heat = simulation.particles().has_heat() || !simulation.get::<Rock>().heats().is_empty();
        assert!(is_warm || !has_heat, "{name} has heat");
        let runs = simulation.get::<Effects>().get(Effect::Heat).running;
        assert_eq!(runs, has_heat && !["avalanche", "snow_globe"].contains(&name), "{name}");
    }
}
