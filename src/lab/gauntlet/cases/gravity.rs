//! Gravity that does not stay as it is.

use super::common::{intend, water};
use crate::{
    lab::gauntlet::case::{Density, Gain, GauntletCase, Rules, Size},
    sim::{
        intent::Intent,
        state::{ParticleStore, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;

const POOL: &str = "(title: \"Gravity\", spacing: 0.1, size: (6, 5), effects: {air: off, drag: off}, contents: [
    (element: \"water\", shape: Rect(min: (0, 0), max: (6, 2)))])";

/// Why energy is told apart from what a change of gravity puts in.
const PUT_IN: &str =
    "Turning gravity changes every particle's height energy; that is counted as put in. Beyond it: 1.5 m/s.";

/// Standard gravity, m/s².
const G: f32 = 9.81;

fn pull(world: &mut World, gravity: Vec2) {
    let gravity = world.resource::<Setup>().blueprint.scale.vec_to_kernel(gravity);
    if world.resource::<Setup>().domain.gravity != gravity {
        intend(world, Intent::Gravity { gravity });
    }
}

pub(super) const FLIPPING: GauntletCase = GauntletCase {
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
        gain: Some(Gain::Speed(1.5)),
        density: Some(Density { shock: 0, worst: 0.05, end: 0.05 }),
        work: 2.0,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const TURNING: GauntletCase = GauntletCase {
    name: "gravity_turns",
    title: "Gravity that turns in circles",
    what: "A pool whose gravity turns once in 3 s, so that it is poured from wall to wall, for 9 s.",
    guards: "Floors that are walls a moment later: water left behind, or thrown ever higher.",
    allowed: PUT_IN,
    scene: POOL,
    act: Some(|world, tick| {
        // Sixteen directions, from a table: this way the bits are the same on every machine.
        const EVEN: f32 = std::f32::consts::FRAC_1_SQRT_2;
        const TURN: [(f32, f32); 16] = [
            (0.0, -1.0),
            (0.38268, -0.92388),
            (EVEN, -EVEN),
            (0.92388, -0.38268),
            (1.0, 0.0),
            (0.92388, 0.38268),
            (EVEN, EVEN),
            (0.38268, 0.92388),
            (0.0, 1.0),
            (-0.38268, 0.92388),
            (-EVEN, EVEN),
            (-0.92388, 0.38268),
            (-1.0, 0.0),
            (-0.92388, -0.38268),
            (-EVEN, -EVEN),
            (-0.38268, -0.92388),
        ];
        let (x, y) = TURN[(tick * 16 / 180 % 16) as usize];
        pull(world, G * Vec2::new(x, y));
    }),
    ticks: 540,
    rules: Rules {
        gain: Some(Gain::Speed(1.5)),
        density: Some(Density { shock: 0, worst: 0.3, end: 0.2 }),
        work: 2.0,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const WEIGHTLESS: GauntletCase = GauntletCase {
    name: "weightless",
    title: "Drops at rest without gravity",
    what: "120 lone particles of water, up to the walls and corners of the box, at rest and without gravity, with every effect \
           on.",
    guards: "Anything that moves by itself: a force of a particle on itself or of a wall out of reach, wind from nothing, \
             rounding that drifts.",
    allowed: "Not a bit of any position may change.",
    size: Size::Quick,
    scene: "(title: \"Weightless\", spacing: 0.1, size: (6, 5), gravity: (0, 0),
        effects: {air: on, drag: on, predictor: on, tension: on, viscosity: on, vorticity: on})",
    arrange: Some(|blueprint| {
        for k in 0..120 {
            let cell = Vec2::new((k % 12) as f32, (k / 12) as f32);
            water(blueprint, Vec2::splat(0.05) + Vec2::new(0.535, 0.54) * cell, Vec2::ZERO);
        }
    }),
    ticks: 120,
    rules: Rules {
        gain: Some(Gain::Speed(0.0)),
        fastest: Some(0.0),
        rest: Some(0.0),
        calm: true,
        also: Some(unmoved),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const FLOATING: GauntletCase = GauntletCase {
    name: "floating",
    title: "A block at rest without gravity",
    what: "A block of 20 × 10 particles on the lattice floats in the middle of the box, without gravity, for 5 s.",
    guards: "Surfaces that evaporate, or draw a body together and let it swing.",
    allowed: "The predictor aims at a density of 0.99, and the tensile correction pushes at every surface, so that the block \
              finds another shape; for that, an energy of 0.5 m/s. Then it is at rest, to 0.02 d a tick.",
    size: Size::Quick,
    scene: "(title: \"Floating\", spacing: 0.1, size: (6, 5), gravity: (0, 0), contents: [
        (element: \"water\", shape: Rect(min: (2, 2), max: (4, 3)))])",
    ticks: 300,
    rules: Rules {
        confines: Some(|at| (1.5..=4.5).contains(&at.x) && (1.5..=3.5).contains(&at.y)),
        gain: Some(Gain::Speed(0.5)),
        density: Some(Density { shock: 0, worst: 0.03, end: 0.02 }),
        rest: Some(0.02),
        work: 1.2,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
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
