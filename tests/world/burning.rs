//! Burning in a world: how fast it spreads, where it stops, that no energy is made, and that it can be left out.

use crate::support::{SimulationExt, assert_goes_on_from_a_save, blueprint, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        heat::{chemical, held},
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{
        effects::Effects,
        intent::Intent,
        simulation::Simulation,
        state::{Books, HeatCurves, ParticleStore, Rock},
    },
};

/// Slowest and fastest front through wood, m/s: what is to be watched, neither waited for nor missed.
const FRONT: [f32; 2] = [0.05, 0.3];

/// All energy, with what the air got and without what light and hands gave, quanta.
pub(super) fn energy(simulation: &Simulation) -> i64 {
    let (particles, rock) = (simulation.get::<ParticleStore>(), simulation.get::<Rock>());
    let books = simulation.get::<Books>();
    let own = held(particles, rock) + chemical(particles, rock, simulation.get::<HeatCurves>());
    own + books.outside()
}

/// A room with gravity, `columns` × `rows` d of the scene's own spacing.
pub(super) fn room(columns: u32, rows: u32) -> Blueprint {
    let mut room = empty_box(columns, rows);
    room.domain.gravity = Vec2::new(0.0, -98.1);
    room
}

pub(super) fn stamp(simulation: &mut Simulation, name: &str, min: [f32; 2], max: [f32; 2]) {
    let element = simulation.element(name);
    let stroke = Stroke::rectangle(Vec2::from(min) + 0.5, Vec2::from(max) - 0.5);
    simulation.push(Intent::Stamp { element, stroke });
    simulation.apply_edits();
}

/// A beam `thick` d thick and 60 d long above a floor, with embers on its left end.
fn beam(thick: u32) -> Simulation {
    let mut simulation = Simulation::of(room(80, 60));
    let top = 20.0 + thick as f32;
    stamp(&mut simulation, "wood", [10.0, 20.0], [70.0, top]);
    stamp(&mut simulation, "ember", [10.0, top], [18.0, top + 8.0]);
    simulation
}

/// How far the fire has come: the first column of a beam of which all is wood, d.
fn front(simulation: &Simulation, thick: u32) -> f32 {
    let wood = simulation.element("wood");
    let mut whole = [0; 80];
    for (cell, element, _) in simulation.get::<Rock>().iter() {
        whole[cell.x as usize] += u32::from(element == wood);
    }
    whole.iter().position(|count| *count == thick).unwrap_or(70) as f32
}

/// Slowest and fastest front along a fuse, m/s: a player who lights it walks away, and does not wait for it. As fast as the
/// slowest and the fastest at which people stroll.
const FUSE: [f32; 2] = [0.3, 1.5];

#[test]
fn a_fuse_burns_along_and_lights_what_it_leads_to() {
    let mut simulation = Simulation::of(room(120, 60));
    stamp(&mut simulation, "fuse", [10.0, 20.0], [92.0, 21.0]);
    stamp(&mut simulation, "metal", [90.0, 17.0], [100.0, 19.0]);
    stamp(&mut simulation, "gunpowder", [90.0, 19.0], [96.0, 23.0]);
    let (lumps, fuses, before) = (simulation.count("gunpowder"), simulation.count("fuse"), energy(&simulation));
    simulation.push(Intent::Ignite { stroke: Stroke::dab(BrushShape::Disc, Vec2::new(11.0, 20.5), 2.0) });
    let mut ticks = 0;
    while simulation.count("gunpowder") == lumps {
        assert!(ticks < 3600, "{} of {fuses} lumps of fuse are left", simulation.count("fuse"));
        simulation.run(1);
        ticks += 1;
    }
    let speed = 8.0 / (ticks as f32 / 60.0);
    assert!((FUSE[0]..=FUSE[1]).contains(&speed), "{speed} m/s");
    assert_eq!(energy(&simulation), before);
}

#[test]
fn fire_runs_along_a_beam_and_no_energy_is_made() {
    let mut simulation = beam(6);
    let before = energy(&simulation);
    simulation.run(600);
    let from = front(&simulation, 6);
    simulation.run(1200);
    let to = front(&simulation, 6);
    assert!(to < 70.0, "the beam has burnt down");
    let speed = (to - from) * 0.1 / 20.0;
    assert!((FRONT[0]..FRONT[1]).contains(&speed), "{speed} m/s");
    assert_eq!(energy(&simulation), before);
    assert!(simulation.count("ash") > 10 && simulation.get::<Books>().to_air > 0);
}

#[test]
fn fire_dies_in_wood_that_water_cools() {
    let mut simulation = beam(3);
    stamp(&mut simulation, "metal", [30.0, 23.0], [32.0, 40.0]);
    stamp(&mut simulation, "metal", [68.0, 23.0], [70.0, 40.0]);
    stamp(&mut simulation, "water", [32.0, 23.0], [68.0, 36.0]);
    simulation.run(6000);
    // It comes as far as the tank, and no further than the width of its wall and the beam's thickness into what the water cools.
    let front = front(&simulation, 3);
    assert!((25.0..35.0).contains(&front), "the fire stands at {front} d");
    assert_eq!(simulation.count("burning_wood"), 0, "it still burns");
    assert_eq!(simulation.count("water") + simulation.count("steam"), 36 * 13);
}

#[test]
fn a_match_that_is_held_for_a_second_sets_fire_to_all_that_can_burn_and_to_nothing_else() {
    for (name, burns) in [
        ("wood", true),
        ("plant", true),
        ("oil", true),
        ("tar", true),
        ("coal", true),
        ("charcoal", true),
        ("dust", true),
        ("hydrogen", true),
        ("water", false),
        ("metal", false),
        ("acid", false),
        ("sand", false),
    ] {
        let mut simulation = Simulation::of(room(60, 40));
        stamp(&mut simulation, name, [10.0, 0.0], [50.0, 10.0]);
        simulation.run(30);
        let (count, before) = (simulation.count(name), energy(&simulation));
        let dab = Stroke::dab(BrushShape::Disc, Vec2::new(30.0, 10.0), 4.0);
        for _ in 0..60 {
            simulation.push(Intent::Ignite { stroke: dab }).run(1);
        }
        assert_eq!(simulation.get::<Books>().by_hand > 0, burns, "{name}");
        // Tar, the slowest, goes out again where nothing else burns: of it a share of 1/3 burns in a second.
        simulation.run(300);
        let gone = count - simulation.count(name);
        assert!(if burns { gone > 0 } else { gone == 0 }, "{name}: {gone} of {count} are gone");
        assert_eq!(energy(&simulation), before, "{name}");
    }
}

#[test]
fn smoke_fades_and_then_nothing_runs() {
    let mut simulation = Simulation::of(room(40, 40));
    stamp(&mut simulation, "smoke", [10.0, 10.0], [20.0, 20.0]);
    simulation.run(60);
    assert!(simulation.get::<Effects>().get(Effect::Decay).running);
    // A lump is left after 100 s with a chance of e^(−100/6): one of a hundred with 6 · 10⁻⁶.
    simulation.run(6000);
    assert_eq!(simulation.particles().len(), 0);
    assert_eq!(simulation.get::<Books>().gone, 100);
    assert!(!simulation.get::<Effects>().get(Effect::Decay).running);
}

#[test]
fn a_cold_house_calls_for_nothing_and_one_where_nothing_may_burn_stands() {
    let mut cold = Simulation::of(room(40, 40));
    stamp(&mut cold, "wood", [10.0, 10.0], [20.0, 20.0]);
    stamp(&mut cold, "oil", [10.0, 20.0], [20.0, 24.0]);
    cold.run(60);
    let effects = cold.get::<Effects>();
    assert!(!effects.get(Effect::Decay).running && !effects.get(Effect::Heat).running);
    let mut house = blueprint("burning_house", &[]);
    house.effects.insert(Effect::Decay, Mode::Off);
    let mut house = Simulation::of(house);
    let wood = house.count("wood");
    house.run(300);
    assert_eq!((house.count("wood"), house.count("fire")), (wood, 0));
}

#[test]
fn a_world_that_burns_goes_on_from_a_save_to_the_bit_on_any_threads() {
    let mut simulation = Simulation::of(blueprint("oil_lamp", &[]));
    simulation.run(120);
    let before = simulation.count("oil");
    assert_goes_on_from_a_save(&mut simulation, 180);
    assert!(simulation.count("oil") < before && simulation.count("fire") > 0, "nothing burns");
}

#[test]
fn a_lamp_burns_until_its_oil_is_gone() {
    let mut simulation = Simulation::of(blueprint("oil_lamp", &[]));
    let all = simulation.count("oil");
    simulation.run(1800);
    let half = simulation.count("oil");
    assert!(half < 3 * all / 4, "{half} of {all} are left after 30 s");
    assert!(simulation.count("burning_oil") > 5, "the lamp went out");
}

#[test]
fn what_burns_at_another_detail_is_what_a_save_of_it_would_be() {
    for finer in [0.5, 2.0] {
        let mut simulation = beam(4);
        simulation.run(30);
        simulation.push(Intent::Detail { detail: finer });
        simulation.apply_edits();
        // All that burns, fades or dissolves does so by the size of its lumps.
        assert_goes_on_from_a_save(&mut simulation, 300);
        assert!(simulation.count("fire") > 0, "detail {finer}: nothing burns");
    }
}
