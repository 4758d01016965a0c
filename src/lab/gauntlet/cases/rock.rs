//! Rock that comes and goes.

use super::common::{TREMBLES, element, intend};
use crate::{
    kernel::brush::{BrushShape, Stroke},
    lab::gauntlet::case::{Density, Gain, GauntletCase, Rules, Size},
    sim::{intent::Intent, state::Setup},
};
use bevy::ecs::world::World;
use glam::Vec2;

pub(super) const ROCK_OVER_WATER: GauntletCase = GauntletCase {
    name: "rock_over_water",
    title: "Rock painted over water, and removed",
    what: "A bar of rock is painted across a pool and rubbed out again, somewhere else each time, every 6 ticks for 5 s.",
    guards: "Water that finds itself in rock, and pressure that belongs to rock which is gone.",
    allowed: "Rock takes the place of the water that it is painted over; no other may get lost. Energy: 1 m/s.",
    size: Size::Quick,
    scene: "(title: \"Painted\", spacing: 0.1, size: (6, 5), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (6, 3)))])",
    act: Some(|world, tick| {
        if tick < 300 && tick % 6 == 0 {
            // Erasing takes everything under the brush, so that the bar is rubbed out where it was and as large.
            let bar = |k: u64| {
                let at = Vec2::new(10.0 + (k * 17 % 40) as f32, 4.0 + (k * 7 % 20) as f32);
                Stroke { shape: BrushShape::Disc, from: at, to: at + Vec2::new(8.0, 4.0), radius: 1.2 }
            };
            let step = tick / 6;
            let rock = element(world.resource::<Setup>().elements(), "rock");
            intend(
                world,
                match step % 2 {
                    0 => Intent::Stamp { element: rock, stroke: bar(step) },
                    _ => Intent::Erase { stroke: bar(step - 1) },
                },
            );
        }
    }),
    ticks: 480,
    rules: Rules {
        gain: Some(Gain::Speed(1.0)),
        density: Some(Density { shock: 0, worst: 0.3, end: 0.1 }),
        rest: Some(0.05),
        work: 2.0,
        ..Rules::ALWAYS
    },
    known: Some(TREMBLES),
    ..GauntletCase::USUAL
};

pub(super) const ROCK_ERASED: GauntletCase = GauntletCase {
    name: "rock_erased",
    title: "The floor erased under a full tank",
    what: "A full tank of 40 × 40 particles on a floor of rock 2 m above the ground; after half a second the floor is \
           rubbed out at once.",
    guards: "Pressure that was held by rock and is let go in one tick.",
    allowed: "Energy: 0.8 m/s beyond what it falls with.",
    size: Size::Quick,
    scene: "(title: \"Tank\", spacing: 0.1, size: (8, 8), effects: {air: off, drag: off}, contents: [
        (element: \"rock\", shape: Rect(min: (1.8, 1.8), max: (2, 6))),
        (element: \"rock\", shape: Rect(min: (6, 1.8), max: (6.2, 6))),
        (element: \"rock\", shape: Rect(min: (2, 1.8), max: (6, 2))),
        (element: \"water\", shape: Rect(min: (2, 2), max: (6, 6)))])",
    act: Some(erase_floor),
    ticks: 420,
    rules: Rules {
        gain: Some(Gain::Speed(0.8)),
        density: Some(Density { shock: 0, worst: 0.3, end: 0.1 }),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

fn erase_floor(world: &mut World, tick: u64) {
    if tick == 30 {
        let floor = Stroke::rectangle(Vec2::new(20.0, 18.0), Vec2::new(60.0, 19.9));
        intend(world, Intent::Erase { stroke: floor });
    }
}
