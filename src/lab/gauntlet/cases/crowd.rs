//! Particles that start too close to each other.

use super::common::{TREMBLES, noise, water};
use crate::{
    kernel::particles::Particles,
    lab::gauntlet::case::{Density, Gain, GauntletCase, Rules, Size},
    scene::blueprint::Blueprint,
    sim::state::ParticleStore,
};
use bevy::ecs::world::World;
use glam::Vec2;

const OPEN: &str = "(title: \"Crowd\", spacing: 0.1, size: (6, 5), effects: {air: off, drag: off})";

/// Why crowds may gain energy.
const CORRECTIONS: &str = "Particles inside each other hold energy that no sum of motion and height shows. It is let out by \
     corrections, each of at most the correction limit in a substep; these add up as long as they overlap. The bound is a \
     multiple of that speed (0.6 m/s at `draft` to 4.8 m/s at `reference`), the same at every quality.";

pub(super) const TWO_AT_A_POINT: GauntletCase = GauntletCase {
    name: "two_at_a_point",
    title: "Two at one point",
    what: "Two particles of water at exactly the same place, in the air and on the floor.",
    guards: "The direction from one to the other is 0/0.",
    allowed: "They may part as fast as a correction takes them. Nothing brakes two particles on a smooth floor, so that they \
              may still glide at 0.1 d a tick; but at least 0.2 d apart.",
    size: Size::Quick,
    scene: OPEN,
    arrange: Some(|blueprint| {
        for at in [Vec2::new(2.0, 1.0), Vec2::new(4.03, 0.025)] {
            (0..2).for_each(|_| water(blueprint, at, Vec2::ZERO));
        }
    }),
    ticks: 240,
    rules: Rules {
        gain: Some(Gain::Corrections(3.0)),
        rest: Some(0.1),
        also: Some(|world| apart(world, 1.0, 0.2)),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const POINT_64: GauntletCase = GauntletCase {
    name: "point_64",
    title: "64 at one point",
    what: "64 particles of water at one point, 84 cm above the floor.",
    guards: "Particles that stay in one another for ever, or part at any speed.",
    allowed: CORRECTIONS,
    size: Size::Quick,
    scene: OPEN,
    arrange: Some(|blueprint| (0..64).for_each(|_| water(blueprint, Vec2::new(3.02, 0.84), Vec2::ZERO))),
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Corrections(6.5)),
        density: Some(Density { shock: 60, worst: 0.5, end: 0.1 }),
        rest: Some(0.15),
        work: 2.0,
        also: Some(|world| apart(world, 0.92, 0.2)),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const POINT_10000: GauntletCase = GauntletCase {
    name: "point_10000",
    title: "10,000 at one point",
    what: "10,000 particles of water at one point in the middle of a box.",
    guards: "Every particle is every other's neighbour: the cost grows with the square of the number, and so do the sums.",
    allowed: "The crowd is scattered at once to four particles a d², so that no tick costs more than 50 of a calm one. The \
              energy is that of corrections, as for 64.",
    scene: "(title: \"Crowd\", spacing: 0.1, size: (18, 14), effects: {air: off, drag: off})",
    arrange: Some(|blueprint| (0..10_000).for_each(|_| water(blueprint, Vec2::new(9.02, 7.04), Vec2::ZERO))),
    ticks: 180,
    rules: Rules {
        gain: Some(Gain::Corrections(14.0)),
        density: Some(Density { shock: 120, worst: 0.5, end: 0.3 }),
        work: 50.0,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const GRID_TENTH: GauntletCase = GauntletCase {
    name: "grid_tenth",
    title: "A grid of 0.1 d",
    what: "A block of 40 × 40 particles, 0.1 d from one to the next: a hundred where there is room for one.",
    guards: "Densities of a hundred: λ and the corrections of an overfilled block.",
    allowed: CORRECTIONS,
    scene: OPEN,
    arrange: Some(|blueprint| grid(blueprint, 0.01)),
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Corrections(10.0)),
        density: Some(Density { shock: 60, worst: 0.5, end: 0.15 }),
        work: 30.0,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const GRID_THIRD: GauntletCase = GauntletCase {
    name: "grid_third",
    title: "A grid of 0.3 d",
    what: "A block of 40 × 40 particles, 0.3 d from one to the next: eleven where there is room for one.",
    guards: "As a grid of 0.1 d, nearer to what a careless spawn makes.",
    allowed: CORRECTIONS,
    size: Size::Quick,
    scene: OPEN,
    arrange: Some(|blueprint| grid(blueprint, 0.03)),
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Corrections(10.0)),
        density: Some(Density { shock: 60, worst: 0.5, end: 0.15 }),
        work: 10.0,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

fn grid(blueprint: &mut Blueprint, spacing: f32) {
    for k in 0..1600 {
        let cell = Vec2::new((k % 40) as f32 - 19.5, (k / 40) as f32 - 19.5);
        water(blueprint, Vec2::new(3.0, 2.0) + spacing * cell, Vec2::ZERO);
    }
}

pub(super) const SPAWN_OVER_WATER: GauntletCase = GauntletCase {
    name: "spawn_over_water",
    title: "Spawned over water",
    what: "A pool 60 particles wide and 15 deep, and 300 more at random places inside it.",
    guards: "Pairs at any distance at all, as a program that places particles without looking makes them.",
    allowed: CORRECTIONS,
    size: Size::Quick,
    scene: "(title: \"Crowd\", spacing: 0.1, size: (6, 5), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (6, 1.5)))])",
    arrange: Some(|blueprint| {
        for k in 0..300 {
            let at = Vec2::new(3.0, 0.75) + noise(k) * Vec2::new(5.9, 1.4);
            water(blueprint, at, Vec2::ZERO);
        }
    }),
    ticks: 420,
    rules: Rules {
        gain: Some(Gain::Corrections(8.0)),
        density: Some(Density { shock: 60, worst: 0.3, end: 0.1 }),
        rest: Some(0.3),
        work: 2.0,
        ..Rules::ALWAYS
    },
    known: Some(TREMBLES),
    ..GauntletCase::USUAL
};

pub(super) const CLOSE_PAIRS: GauntletCase = GauntletCase {
    name: "close_pairs",
    title: "Pairs at every distance",
    what: "Pairs and triples of particles from 10⁻³⁸ m apart to the edge of the kernel, without gravity, with the tensile \
           correction on at its greatest strength and all other effects.",
    guards: "The tensile correction overflows where the kernel isn't clamped before its power is taken, and a gradient \
             near the centre or the edge may.",
    allowed: CORRECTIONS,
    size: Size::Quick,
    scene: "(title: \"Pairs\", spacing: 0.1, size: (20, 8), gravity: (0, 0), fluid: (tension_strength: 1),
        effects: {tension: on, viscosity: on, vorticity: on, air: on, drag: on})",
    arrange: Some(|blueprint| {
        let gaps =
            [1e-38, 1e-30, 1e-20, 1e-12, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.249, 0.25, 0.3];
        for (k, gap) in gaps.into_iter().enumerate() {
            // At the left wall's corner such gaps are not rounded away.
            for (row, way) in [Vec2::X, Vec2::Y, Vec2::new(0.6, 0.8)].into_iter().enumerate() {
                let at = Vec2::new(0.5 + 1.1 * k as f32, 1.5 + 2.0 * row as f32);
                water(blueprint, at, Vec2::ZERO);
                water(blueprint, at + gap * way, Vec2::ZERO);
                if row == 2 {
                    water(blueprint, at - gap * way, Vec2::ZERO);
                }
            }
        }
    }),
    ticks: 120,
    rules: Rules { gain: Some(Gain::Corrections(4.0)), work: 1.0, ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

/// Distance of each particle to its nearest neighbour, d, shortest first.
pub(super) fn gaps(particles: &Particles) -> Vec<f32> {
    let mut order: Vec<usize> = (0..particles.len()).collect();
    order.sort_unstable_by(|&a, &b| particles.x[a].total_cmp(&particles.x[b]));
    let nearest = |own: usize| {
        let mut nearest = f32::MAX;
        let mut look = |others: &mut dyn Iterator<Item = &usize>| {
            for &other in others {
                if (particles.x[other] - particles.x[order[own]]).abs() >= nearest {
                    break;
                }
                nearest = nearest.min(particles.position(other).distance(particles.position(order[own])));
            }
        };
        look(&mut order[own + 1..].iter());
        look(&mut order[..own].iter().rev());
        nearest
    };
    let mut gaps: Vec<f32> = (0..order.len()).map(nearest).collect();
    gaps.sort_unstable_by(f32::total_cmp);
    gaps
}

/// Whether this share of the particles has its nearest neighbour at least `least` d away.
pub(super) fn apart(world: &World, share: f64, least: f32) -> Result<(), String> {
    let gaps = gaps(world.resource::<ParticleStore>());
    let rank = ((1.0 - share) * gaps.len() as f64).round() as usize;
    match gaps.get(rank) {
        Some(gap) if gap.is_nan() || *gap < least => Err(format!(
            "the nearest neighbour of {} in a hundred is within {gap:.3} d, allowed {least}",
            (100.0 * (1.0 - share)).round()
        )),
        _ => Ok(()),
    }
}
