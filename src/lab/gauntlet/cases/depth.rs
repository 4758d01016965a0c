//! Water under its own weight.

use super::{
    common::{BOILS, TREMBLES, water},
    crowd::apart,
};
use crate::{
    lab::gauntlet::case::{Density, Gain, GauntletCase, Rules, Size},
    sim::state::ParticleStore,
};
use bevy::ecs::world::World;
use glam::Vec2;

pub(super) const DAM_BREAK: GauntletCase = GauntletCase {
    name: "dam_break",
    title: "Dam break",
    what: "A column of water 30 particles wide and 60 high collapses in a closed box.",
    guards: "Over-relaxation and corrections that pump energy: an unlucky setting explodes while its density error looks \
             best.",
    allowed: "Energy: 2 % of that of the column over the floor (3 m on the mean), a speed of 1.08 m/s.",
    scene: "(title: \"Dam break\", spacing: 0.1, size: (12, 8), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (3, 6)))])",
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Speed(1.08)),
        density: Some(Density { shock: 10, worst: 0.2, end: 0.05 }),
        work: 2.0,
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const CLUMPS: GauntletCase = GauntletCase {
    name: "clumps",
    title: "No clumps",
    what: "4,970 particles of water fall as a block and settle.",
    guards: "Clumps: a kernel whose gradient fades at the centre lets particles stay in one another.",
    allowed: "After 6 s the nearest neighbour of 99 % of the particles is at least 0.6 d away. The pool still sloshes.",
    scene: "(title: \"Settling\", spacing: 0.1, size: (11, 8), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (2, 0.5), max: (9.1, 7.5)))])",
    ticks: 360,
    rules: Rules {
        gain: Some(Gain::Speed(1.5)),
        density: Some(Density { shock: 120, worst: 0.3, end: 0.1 }),
        work: 2.0,
        also: Some(|world| apart(world, 0.99, 0.6)),
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const POOL: GauntletCase = GauntletCase {
    name: "pool",
    title: "A pool at rest",
    what: "Water 30 particles wide and 70 deep, at rest from the start.",
    guards: "Pools that boil, sink or swell for ever.",
    allowed: "rms speed 0.02 d a tick, calm to the eye; the surface within 2 % of its height; density error 3 %. The \
              predictor aims at a density of 0.99, to which the water swells: by 2 % at most, an energy of 1.17 m/s. No \
              limiter acts.",
    scene: "(title: \"Pool\", spacing: 0.1, size: (3, 9), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (3, 7)))])",
    ticks: 600,
    rules: Rules {
        gain: Some(Gain::Speed(1.17)),
        density: Some(Density { shock: 0, worst: 0.06, end: 0.03 }),
        rest: Some(0.02),
        work: 1.5,
        calm: true,
        also: Some(|world| stands(world, 70.0, 0.02)),
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const FULL_BOX: GauntletCase = GauntletCase {
    name: "full_box",
    title: "A box full to the brim",
    what: "A closed box of 40 by 40 particles without room for one more, weightless, at rest from the start.",
    guards: "Jacobi steps that overshoot where all particles are too dense at once and none can give way: the water boils \
             by itself, most of all with many short substeps.",
    allowed: "rms speed 0.02 d a tick, density error 3 %, a speed of 0.05 m/s while they find their places. No limiter acts.",
    scene: "(title: \"Full\", spacing: 0.1, size: (4, 4), gravity: (0, 0), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (4, 4)))])",
    ticks: 120,
    rules: Rules {
        gain: Some(Gain::Speed(0.05)),
        density: Some(Density { shock: 10, worst: 0.03, end: 0.03 }),
        rest: Some(0.02),
        work: 2.0,
        calm: true,
        ..Rules::ALWAYS
    },
    known: Some(TREMBLES),
    ..GauntletCase::USUAL
};

pub(super) const DEEP_TANK: GauntletCase = GauntletCase {
    name: "deep_tank",
    title: "A tank 40 m deep",
    what: "Water 12 particles wide and 400 deep, at rest from the start.",
    guards: "A local solver carries pressure a kernel radius an iteration: deep water is pressed together.",
    allowed: "As the pool: swollen by 2.5 % at most, an energy of 3.1 m/s.",
    scene: "(title: \"Deep tank\", spacing: 0.1, size: (1.2, 44), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (1.2, 40)))])",
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Speed(3.1)),
        density: Some(Density { shock: 0, worst: 0.06, end: 0.03 }),
        rest: Some(0.02),
        work: 1.5,
        also: Some(|world| stands(world, 400.0, 0.02)),
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const SHAFT: GauntletCase = GauntletCase {
    name: "shaft",
    title: "A shaft one air cell wide",
    what: "A shaft in rock, 4 d wide and 100 deep, closed below and above and full to the lid.",
    guards: "Walls closer than the kernel: a predictor's cell that is half rock, and sums that see both walls.",
    allowed: "At rest as a pool. Water that fills its shaft to the lid has nowhere to go to for its rest density of 0.99.",
    scene: "(title: \"Shaft\", spacing: 0.1, size: (2.4, 12), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (1, 1), max: (1.4, 11))),
        (element: \"rock\", shape: Rect(min: (0.4, 0.4), max: (2, 11.6)))])",
    ticks: 300,
    rules: Rules {
        confines: Some(|at| (1.0..=1.4).contains(&at.x) && (1.0..=11.0).contains(&at.y)),
        gain: Some(Gain::Speed(0.5)),
        density: Some(Density { shock: 0, worst: 0.06, end: 0.05 }),
        rest: Some(0.03),
        work: 1.5,
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const NARROW_SHAFT: GauntletCase = GauntletCase {
    name: "narrow_shaft",
    title: "A shaft one particle wide",
    what: "The same shaft, 1 d wide: the particles stand in file.",
    guards: "Rock on both sides of every particle, within its kernel and within one cell of the predictor's grid.",
    allowed: "At rest as a pool.",
    size: Size::Quick,
    scene: "(title: \"File\", spacing: 0.1, size: (2.1, 12), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (1, 1), max: (1.1, 11))),
        (element: \"rock\", shape: Rect(min: (0.4, 0.4), max: (1.7, 11.6)))])",
    ticks: 300,
    rules: Rules {
        confines: Some(|at| (1.0..=1.1).contains(&at.x) && (1.0..=11.0).contains(&at.y)),
        gain: Some(Gain::Speed(0.7)),
        density: Some(Density { shock: 0, worst: 0.06, end: 0.05 }),
        rest: Some(0.03),
        work: 1.5,
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const OVERFULL_SHAFT: GauntletCase = GauntletCase {
    name: "overfull_shaft",
    title: "A shaft filled over its brim",
    what: "The shaft one air cell wide with a fifth more particles than it has room for.",
    guards: "A constraint that can't be met: no setting of positions has the rest density, and the excess must not become \
             motion, nor press anybody into the rock.",
    allowed: "A fifth too dense on the mean, so 40 % for one in a hundred. Corrections without an end make it tremble, by as much \
              as they are: 0.1 d in each substep.",
    size: Size::Quick,
    scene: "(title: \"Overfull\", spacing: 0.1, size: (2.4, 12), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (1, 1), max: (1.4, 11))),
        (element: \"rock\", shape: Rect(min: (0.4, 0.4), max: (2, 11.6)))])",
    arrange: Some(|blueprint| {
        for k in 0..80 {
            let at = Vec2::new(1.1 + 0.1 * (k % 3) as f32, 1.1 + 9.8 * k as f32 / 80.0);
            water(blueprint, at, Vec2::ZERO);
        }
    }),
    ticks: 300,
    rules: Rules {
        confines: Some(|at| (1.0..=1.4).contains(&at.x) && (1.0..=11.0).contains(&at.y)),
        gain: Some(Gain::Corrections(2.0)),
        density: Some(Density { shock: 60, worst: 0.4, end: 0.4 }),
        rest: Some(1.0),
        work: 1.5,
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const CORNER_100G: GauntletCase = GauntletCase {
    name: "corner_100g",
    title: "A corner under 100 g",
    what: "A block of 40 × 30 particles is pressed into a corner of the box by 981 m/s², along the diagonal.",
    guards: "Weight a hundred times the usual: a tick's fall is 2.7 d, the pressure at the bottom that of 300 m.",
    allowed: "Energy: a hundredth of what the block falls through (6 m × 981 m/s²), a speed of 11 m/s. Under a hundredfold \
              weight a pool sloshes ten times as fast, and for as long: 3 d a tick.",
    scene: "(title: \"Corner\", spacing: 0.1, size: (6, 6), gravity: (-693.7, -693.7), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0.5, 0.5), max: (4.5, 3.5)))])",
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Speed(11.0)),
        density: Some(Density { shock: 60, worst: 1.0, end: 0.3 }),
        rest: Some(3.0),
        work: 4.0,
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const WEDGE: GauntletCase = GauntletCase {
    name: "wedge",
    title: "A wedge of 30° under 4 g",
    what: "Some 1,700 particles in a wedge of rock and floor, pressed into its tip by four times gravity.",
    guards: "A crush where two walls meet at an acute angle: water that is pressed into the rock or through it.",
    allowed: "Density error 30 %, at the end 10 %; nearest neighbour beyond 0.3 d for 99 %. It still sloshes, twice as fast as \
              under 1 g.",
    scene: "(title: \"Wedge\", spacing: 0.1, size: (10, 6), gravity: (-37.9, -10.2), effects: {air: off, drag: off}, contents: [
        (element: \"rock\", shape: Polygon(points: [(0, 0.1), (0, 6), (10, 6), (10, 5.87)])),
        (element: \"water\", shape: Polygon(points: [(0, 0), (0, 0.1), (7.5, 4.41), (7.5, 0)]))])",
    ticks: 420,
    rules: Rules {
        gain: Some(Gain::Speed(2.0)),
        density: Some(Density { shock: 60, worst: 0.3, end: 0.1 }),
        rest: Some(0.3),
        work: 2.0,
        also: Some(|world| apart(world, 0.99, 0.3)),
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

/// Whether the water's surface stands at `height` d, to a share of it: twice the mean height of the particles.
pub(super) fn stands(world: &World, height: f64, share: f64) -> Result<(), String> {
    let particles = world.resource::<ParticleStore>();
    let mean = particles.y.iter().map(|y| f64::from(*y)).sum::<f64>() / particles.len().max(1) as f64;
    let found = 2.0 * mean;
    if (found / height - 1.0).abs() <= share {
        Ok(())
    } else {
        Err(format!("stands {found:.2} d high, allowed {height} ± {}", share * height))
    }
}
