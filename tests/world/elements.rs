//! Every element under every tool, and through emitters and drains.

use crate::support::{SimulationExt, assert_goes_on_from_a_save, empty_box};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::{Element, ElementId},
        solids::Solids,
        sources::{Drain, Emitter, Rect},
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{intent::Intent, simulation::Simulation, state::Sources},
};

const SIDE: u32 = 40;

/// An open box with gravity, in which everything stays what it is.
fn room() -> Blueprint {
    let mut blueprint = empty_box(SIDE, SIDE);
    blueprint.effects.extend([Effect::Heat, Effect::Decay].map(|effect| (effect, Mode::Off)));
    blueprint.domain.gravity = Vec2::new(0.0, -98.1);
    blueprint
}

fn elements() -> Vec<(ElementId, Element)> {
    room().elements.iter().map(|(id, element)| (id, element.clone())).collect()
}

fn assert_sound(simulation: &Simulation, name: &str, after: &str) {
    let particles = simulation.particles();
    for i in 0..particles.len() {
        let (at, velocity) = (particles.position(i), particles.velocity(i));
        assert!(at.is_finite() && velocity.is_finite(), "{name}, {after}: {at}, {velocity}");
        let is_inside = at.min_element() >= 0.0 && at.max_element() <= SIDE as f32;
        assert!(is_inside && !simulation.rock().is_solid(Solids::cell_of(at)), "{name}, {after}: astray at {at}");
    }
}

fn disc(at: (f32, f32)) -> Stroke {
    Stroke::dab(BrushShape::Disc, Vec2::from(at), 5.0)
}

#[test]
fn every_tool_works_with_every_element() {
    for (id, element) in elements() {
        let (name, mut simulation) = (&element.name, Simulation::of(room()));
        simulation.push(Intent::Draw { element: id, stroke: disc((20.0, 20.0)) }).run(1);
        let drawn = simulation.count(name);
        assert!(drawn > 0, "{name}: nothing was drawn");
        simulation.push(Intent::Stamp { element: id, stroke: disc((8.0, 8.0)) }).run(1);
        let stamped = simulation.count(name);
        // π r² sites, less those at the rim.
        assert!(stamped >= drawn + 60, "{name}: {stamped} after {drawn}");
        simulation.run(60);
        simulation.push(Intent::Blow { stroke: disc((20.0, 8.0)), velocity: Vec2::new(200.0, 50.0) });
        simulation.push(Intent::Press { stroke: disc((10.0, 10.0)), amount: 2.0 }).run(30);
        assert_sound(&simulation, name, "wind and pressure");
        assert_eq!(simulation.count(name), stamped, "{name}: wind and pressure take none away");
        // Where it did not go by itself.
        let free = if element.is_gas() { 1.5 } else { 38.5 };
        simulation.push(Intent::Fill { element: id, at: Vec2::new(20.5, free) }).run(1);
        let filled = simulation.count(name);
        assert!(filled > 2 * stamped, "{name}: {filled} fill what {stamped} left");
        simulation.run(30);
        assert_sound(&simulation, name, "a full box");
        assert_eq!(simulation.count(name), filled, "{name}: a full box loses none");
        simulation.push(Intent::Erase { stroke: Stroke::dab(BrushShape::Square, Vec2::splat(20.0), 30.0) }).run(1);
        assert_eq!(simulation.count(name), 0, "{name}: the eraser leaves some");
    }
}

#[test]
fn what_is_fixed_replaces_what_moves_and_goes_without_a_trace() {
    let all = elements();
    for (fixed, solid) in all.iter().filter(|(_, element)| element.fixed) {
        for (id, element) in all.iter().filter(|(_, element)| !element.fixed) {
            let mut simulation = Simulation::of(room());
            simulation.push(Intent::Stamp { element: *id, stroke: disc((20.0, 6.0)) }).run(1);
            let before = simulation.count(&element.name);
            simulation.push(Intent::Stamp { element: *fixed, stroke: disc((20.0, 6.0)) }).run(10);
            let name = format!("{} on {}", solid.name, element.name);
            assert!(simulation.count(&solid.name) >= 60 && simulation.count(&element.name) < before / 2, "{name}");
            assert_sound(&simulation, &name, "ten ticks");
        }
    }
}

#[test]
fn emitters_give_and_drains_take_all_that_moves() {
    for (id, element) in elements().into_iter().filter(|(_, element)| !element.fixed) {
        let mut blueprint = room();
        let area = |min: (f32, f32), max: (f32, f32)| Rect { min: Vec2::from(min), max: Vec2::from(max) };
        blueprint.emitters.push(Emitter {
            element: id,
            area: area((17.0, 17.0), (23.0, 23.0)),
            velocity: Vec2::ZERO,
            rate: 240.0,
            total: Some(300),
            start: 0,
            given: 0,
            due: 0.0,
        });
        // Where it falls, and where it rises.
        blueprint
            .drains
            .extend([area((0.0, 0.0), (40.0, 4.0)), area((0.0, 36.0), (40.0, 40.0))].map(|area| Drain { area }));
        let (name, mut simulation) = (&element.name, Simulation::of(blueprint));
        simulation.run(45);
        assert!(simulation.count(name) > 50, "{name}: {} after 45 ticks", simulation.count(name));
        assert_sound(&simulation, name, "45 ticks");
        simulation.run(20 * 60);
        let given = simulation.counters();
        assert_eq!(simulation.count(name), 0, "{name} is left behind: {given:?}");
    }
}

#[test]
fn what_a_player_sets_flows_drains_and_goes_again() {
    for (id, element) in elements() {
        let (name, mut simulation) = (&element.name, Simulation::of(room()));
        let [spring, sink] = [disc((20.0, 20.0)), Stroke::rectangle(Vec2::ZERO, Vec2::new(40.0, 40.0))];
        simulation.push(Intent::SetEmitter { element: id, stroke: spring }).run(1);
        if element.fixed {
            simulation.run(30);
            assert_eq!(simulation.count(name), 0, "{name} does not flow");
            continue;
        }
        simulation.run(30);
        let given = simulation.count(name);
        // A pour of one tick fills its share of the hundred sites.
        assert!(given > (50.0 * element.flow) as usize, "{name}: {given} after half a second");
        assert_sound(&simulation, name, "half a second of a spring");
        simulation.push(Intent::SetDrain { stroke: sink }).run(1);
        assert!(simulation.count(name) < 110, "{name}: {} are left in a drain", simulation.count(name));
        simulation.push(Intent::RemoveSources { stroke: spring }).run(2);
        let sources = simulation.get::<Sources>();
        assert!(sources.emitters.is_empty() && sources.drains.is_empty(), "the brush touches both");
        let left = simulation.count(name);
        simulation.run(30);
        assert_eq!(simulation.count(name), left, "{name}: something still flows");
    }
}

#[test]
fn springs_have_a_limit_and_keep_their_size_at_another_detail() {
    let water = elements().into_iter().find(|(_, element)| element.name == "water").expect("there is water").0;
    let mut simulation = Simulation::of(room());
    for _ in 0..Sources::MOST + 3 {
        simulation.push(Intent::SetEmitter { element: water, stroke: disc((20.0, 30.0)) });
        simulation.push(Intent::SetDrain { stroke: disc((20.0, 5.0)) });
    }
    simulation.run(1);
    let count = |simulation: &Simulation| {
        let sources = simulation.get::<Sources>();
        (sources.emitters.len(), sources.drains.len())
    };
    assert_eq!(count(&simulation), (Sources::MOST, Sources::MOST));
    assert_eq!(simulation.counters().refused, 0, "the world is not full for that");
    let rate = |simulation: &Simulation| simulation.get::<Sources>().emitters[0].rate;
    let before = rate(&simulation);
    simulation.push(Intent::Detail { detail: 2.0 }).run(1);
    assert_eq!(count(&simulation), (Sources::MOST, Sources::MOST));
    assert!((rate(&simulation) / before - 4.0).abs() < 1e-5, "four particles in place of one");
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(40.0, 60.0), 2.0);
    simulation.push(Intent::RemoveSources { stroke }).run(1);
    assert_eq!(count(&simulation), (0, Sources::MOST), "places are in the d of the finer world");
}

#[test]
fn a_spring_is_kept_in_saves() {
    let water = elements().into_iter().find(|(_, element)| element.name == "water").expect("there is water").0;
    let mut simulation = Simulation::of(room());
    simulation.push(Intent::SetEmitter { element: water, stroke: disc((20.0, 30.0)) });
    simulation.push(Intent::SetDrain { stroke: disc((5.0, 3.0)) }).run(20);
    assert_goes_on_from_a_save(&mut simulation, 40);
}
