//! Reactions in a world: what they make of it, what they wake, and that they can be left out.

use crate::support::{SimulationExt, assert_goes_on_from_a_save, blueprint, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::brush::{BrushShape, Stroke},
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        intent::Intent,
        simulation::Simulation,
        state::{Rock, SleepState},
    },
};

fn pool() -> Simulation {
    Simulation::of(blueprint("hydrostatic", &[("columns", "20"), ("depth", "10")]))
}

fn salted(mut simulation: Simulation) -> Simulation {
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(10.0, 12.0), 2.0);
    let salt = simulation.element("salt");
    simulation.push(Intent::Stamp { element: salt, stroke }).run(1);
    simulation
}

#[test]
fn salt_dissolves_in_water() {
    let mut simulation = salted(pool());
    let (all, salt, water) = (simulation.particles().len(), simulation.count("salt"), simulation.count("water"));
    assert!(salt > 8 && simulation.get::<Effects>().get(Effect::Reactions).running);
    simulation.run(900);
    assert_eq!(simulation.count("salt"), 0, "undissolved after 15 s");
    assert_eq!((simulation.count("brine"), simulation.count("water")), (2 * salt, water - salt));
    assert_eq!(simulation.particles().len(), all);
    // Brine and water do not react: there is nothing left to do.
    assert!(!simulation.get::<Effects>().get(Effect::Reactions).running);
}

#[test]
fn nothing_reacts_where_it_is_switched_off() {
    let mut blueprint = blueprint("hydrostatic", &[("columns", "20"), ("depth", "10")]);
    blueprint.effects.insert(Effect::Reactions, Mode::Off);
    let mut simulation = salted(Simulation::of(blueprint));
    let salt = simulation.count("salt");
    simulation.run(300);
    assert_eq!((simulation.count("salt"), simulation.count("brine")), (salt, 0));
}

#[test]
fn what_reacts_wakes_what_lies_on_it() {
    let mut world = empty_box(20, 20);
    world.domain.gravity = Vec2::new(0.0, -98.1);
    let mut simulation = Simulation::of(world);
    let [wood, water, acid] = ["wood", "water", "acid"].map(|name| simulation.element(name));
    let floor = Stroke::rectangle(Vec2::new(0.5, 0.5), Vec2::new(19.5, 3.5));
    simulation.push(Intent::Stamp { element: wood, stroke: floor });
    let pool = Stroke::rectangle(Vec2::new(0.5, 4.5), Vec2::new(19.5, 9.5));
    simulation.push(Intent::Stamp { element: water, stroke: pool }).run(600);
    assert!(simulation.get::<SleepState>().asleep() > 100, "the pool does not rest");
    let rock = simulation.get::<Rock>().count();
    simulation.push(Intent::Stamp { element: acid, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(10.0, 14.0), 2.0) });
    simulation.run(600);
    // Acid is heavier than water, and sinks to the wood.
    let eaten = rock - simulation.get::<Rock>().count();
    assert!(eaten > 0, "acid under water eats no wood");
    assert_eq!(simulation.count("coal"), eaten);
}

#[test]
fn a_plant_drinks_its_pool() {
    let mut simulation = pool();
    let plant = simulation.element("plant");
    simulation.push(Intent::Stamp { element: plant, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(10.0, 5.0), 1.0) });
    simulation.run(1);
    let (plants, water) = (simulation.count("plant"), simulation.count("water"));
    simulation.run(1200);
    let grown = simulation.count("plant") - plants;
    assert!(grown > 20, "{grown} lumps grew in 20 s");
    assert_eq!(simulation.count("water"), water - grown);
}

#[test]
fn a_world_that_reacts_goes_on_from_a_save_to_the_bit_on_any_threads() {
    let mut simulation = Simulation::of(blueprint("acid", &[]));
    simulation.run(120);
    let before = simulation.count("metal");
    assert_goes_on_from_a_save(&mut simulation, 180);
    assert!(simulation.count("metal") < before && simulation.count("hydrogen") > 0, "nothing reacts");
}
