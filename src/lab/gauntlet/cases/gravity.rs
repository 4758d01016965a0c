//! Gravity that does not stay as it is.

use crate::{
    lab::gauntlet::case::{Case, Density, Rules, Size},
    sim::{
        control::set_gravity,
        state::{ParticleStore, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;

const POOL: &str = "(title: \"Gravity\", spacing: 0.1, size: (6, 5), effects: {air: off, drag: off}, contents: [
    (element: \"water\", shape: Rect(min: (0, 0), max: (6, 2)))])";

/// Why energy is told apart from what a change of gravity puts in.
const PUT_IN: &str = "Turning gravity changes every particle's height energy; that is counted as put in. Beyond it: 1.5 m/s.";

/// Standard gravity, m/s².
const G: f32 = 9.81;

fn pull(world: &mut World, gravity: Vec2) {
    let gravity = world.resource::<Setup>().blueprint.scale.vec_to_kernel(gravity);
    set_gravity(world, gravity);
}

pub(in crate::lab::gauntlet) const FLIPPING: Case = Case {
    name: "gravity_flips",
    title: "Gravity that flips every tick",
    what: "A pool whose gravity points down and up in turn, every tick, for 5 s.",
    guards: "Pressure that is kept from the last tick and is wrong in this one; resonance with the tick.",
    allowed: PUT_IN,
    size: Size::Quick,
    scene: POOL,
    act: Some(|world, tick| pull(world, Vec2::new(0.0, if tick % 2 == 0 { -G } else { G }))),
    ticks: 300,
    rules: Rules {
        gain: Some(1.5),
        density: Some(Density { shock: 0, worst: 0.1, end: 0.1 }),
        work: 2.0,
        ..Rules::ALWAYS
    },
    ..Case::USUAL
};

pub(in crate::lab::gauntlet) const TURNING: Case = Case {
    name: "gravity_turns",
    title: "Gravity that turns in circles",
    what: "A pool whose gravity turns once in 3 s, so that it is poured from wall to wall, for 9 s.",
    guards: "Floors that are walls a moment later: water left behind, or thrown ever higher.",
    allowed: PUT_IN,
    scene: POOL,
    act: Some(|world, tick| {
        // Sixteen directions, from a table: this way the bits are the same on every machine.
        const TURN: [(f32, f32); 16] = [
            (0.0, -1.0),
            (0.38268, -0.92388),
            (0.70711, -0.70711),
            (0.92388, -0.38268),
            (1.0, 0.0),
            (0.92388, 0.38268),
            (0.70711, 0.70711),
            (0.38268, 0.92388),
            (0.0, 1.0),
            (-0.38268, 0.92388),
            (-0.70711, 0.70711),
            (-0.92388, 0.38268),
            (-1.0, 0.0),
            (-0.92388, -0.38268),
            (-0.70711, -0.70711),
            (-0.38268, -0.92388),
        ];
        let (x, y) = TURN[(tick * 16 / 180 % 16) as usize];
        pull(world, G * Vec2::new(x, y));
    }),
    ticks: 540,
    rules: Rules {
        gain: Some(1.5),
        density: Some(Density { shock: 0, worst: 0.3, end: 0.3 }),
        ..Rules::ALWAYS
    },
    ..Case::USUAL
};

pub(in crate::lab::gauntlet) const WEIGHTLESS: Case = Case {
    name: "weightless",
    title: "At rest without gravity",
    what: "A block of water and three lone particles on the lattice, at rest, without gravity, with every effect on.",
    guards: "Anything that moves by itself: a force between particles at rest, wind from nothing, rounding that drifts.",
    allowed: "Not a bit of any position may change.",
    size: Size::Quick,
    scene: "(title: \"Weightless\", spacing: 0.1, size: (6, 5), gravity: (0, 0),
        effects: {air: on, drag: on, tension: on, viscosity: on, vorticity: on}, contents: [
        (element: \"water\", shape: Rect(min: (2, 2), max: (4, 3))),
        (element: \"water\", shape: Rect(min: (0, 0), max: (0.1, 0.1))),
        (element: \"water\", shape: Rect(min: (5, 4.9), max: (5.1, 5))),
        (element: \"water\", shape: Rect(min: (1, 1), max: (1.1, 1.1)))])",
    ticks: 120,
    rules: Rules { gain: Some(0.0), fastest: Some(0.0), rest: Some(0.0), calm: true, also: Some(unmoved), ..Rules::ALWAYS },
    ..Case::USUAL
};

/// Whether everybody stands where the scene put them.
fn unmoved(world: &World) -> Result<(), String> {
    let now = &world.resource::<ParticleStore>().0;
    let start = &world.resource::<Setup>().origin.particles;
    let moved = (now.in_id_order().into_iter().zip(start.in_id_order()))
        .filter(|&(i, j)| now.position(i as usize) != start.position(j as usize))
        .count();
    if moved == 0 { Ok(()) } else { Err(format!("{moved} particles moved")) }
}
