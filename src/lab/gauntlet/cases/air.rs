//! Air that is pushed harder than air can be.

use super::common::{intend, size};
use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        sources::Rect,
    },
    lab::gauntlet::case::{Density, GauntletCase, Rules, Size},
    scene::blueprint::PressurePatch,
    sim::{
        intent::Intent,
        state::{AirGrid, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;

/// A pool, a hill of rock and drops in closed air.
const SEALED: &str = "(title: \"Air\", spacing: 0.1, size: (8, 6), contents: [
    (element: \"rock\", shape: Disc(centre: (5, 1), radius: 1)),
    (element: \"rock\", shape: Rect(min: (2, 3), max: (4, 3.3))),
    (element: \"water\", shape: Rect(min: (0, 0), max: (4, 1))),
    (element: \"water\", shape: Disc(centre: (2.5, 4.5), radius: 0.4))])";

/// Why the energy of the water is not bounded where air carries it.
const AIR_CARRIES: &str = "The air may give the water any energy that it has; what is bounded is its speed: no \
     particle is faster than the air can be.";

/// Fastest that air moves, m/s: the limiter of the air's step, at the sound speed of these scenes, with what gravity and
/// pressure add.
const FASTEST: f64 = 1000.0;

pub(super) const WIND_1000: GauntletCase = GauntletCase {
    name: "wind_1000",
    title: "Wind of 1,000 m/s, on and off",
    what: "A storm of 1,000 m/s is blown over the whole box for a quarter of a second, ceases for as long, and so on for \
           4 s; then it is left alone for 6 s.",
    guards: "Courant numbers of a hundred; drag that overshoots; wind that blows on for ever.",
    allowed: AIR_CARRIES,
    scene: SEALED,
    act: Some(|world, tick| {
        let (middle, reach) = (size(world) / 2.0, size(world).length());
        if tick < 240 && tick / 15 % 2 == 0 {
            let velocity = world.resource::<Setup>().blueprint.scale.vec_to_kernel(Vec2::new(1000.0, 200.0));
            let stroke = Stroke::dab(BrushShape::Disc, middle, reach);
            intend(world, Intent::Blow { stroke, velocity });
        }
    }),
    ticks: 600,
    rules: Rules {
        fastest: Some(FASTEST),
        density: Some(Density { shock: 300, worst: 0.4, end: 0.1 }),
        rest: Some(0.3),
        air: Rules::SEALED,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const PRESSURE_1E6: GauntletCase = GauntletCase {
    name: "pressure_1e6",
    title: "A pressure of a million in one cell",
    what: "One cell of the air is set to a million times the pressure of the surroundings, beside water and rock.",
    guards: "A shock that no time step resolves: sound a thousand times faster than the grid's.",
    allowed: "The box then holds air of some hundreds of atmospheres, in which a storm goes on that carries the water along \
              and presses it against rock: it may be four times too dense. No particle is faster than the air can be. The \
              mass of the air may be off by 10⁻⁴: each substep keeps it to f32's rounding and no better, and in a storm that \
              hardly changes, neither do the roundings, so that those of up to 150,000 substeps add up.",
    scene: SEALED,
    act: Some(|world, tick| press(world, tick, 1e6)),
    ticks: 300,
    rules: Rules {
        fastest: Some(FASTEST),
        density: Some(Density { shock: 60, worst: 3.0, end: 3.0 }),
        air: Some(1e-4),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const SUCTION: GauntletCase = GauntletCase {
    name: "suction",
    title: "A pressure of minus a million",
    what: "A million is taken off the pressure of one cell, again and again for half a second.",
    guards: "Pressure below nothing, and what a square root or a division makes of it.",
    allowed: AIR_CARRIES,
    size: Size::Quick,
    scene: SEALED,
    act: Some(|world, tick| {
        if tick < 30 {
            press(world, 0, -1e6);
        }
    }),
    ticks: 300,
    rules: Rules {
        fastest: Some(FASTEST),
        density: Some(Density { shock: 60, worst: 0.3, end: 0.1 }),
        rest: Some(0.1),
        air: Rules::SEALED,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

fn press(world: &mut World, tick: u64, amount: f32) {
    if tick == 0 {
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(62.0, 38.0), 0.0);
        intend(world, Intent::Press { stroke, amount });
    }
}

pub(super) const VACUUM: GauntletCase = GauntletCase {
    name: "vacuum",
    title: "A vacuum",
    what: "The right half of a closed box holds no air at all when the left half's is let in.",
    guards: "A pressure of exactly 0: no sound, no mass to carry a velocity, nothing to divide by.",
    allowed: AIR_CARRIES,
    size: Size::Quick,
    scene: SEALED,
    arrange: Some(|blueprint| {
        let area = Rect { min: Vec2::new(40.0, 0.0), max: Vec2::new(80.0, 60.0) };
        blueprint.pressures.push(PressurePatch { area, pressure: 0.0 });
    }),
    ticks: 420,
    rules: Rules {
        fastest: Some(400.0),
        density: Some(Density { shock: 120, worst: 0.3, end: 0.1 }),
        air: Rules::SEALED,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const ONE_CELL: GauntletCase = GauntletCase {
    name: "one_cell",
    title: "Air in a box of one cell",
    what: "A box of one air cell with two particles of water in it; wind, pressure and suction by turns.",
    guards: "A grid without a neighbour in any direction.",
    allowed: AIR_CARRIES,
    size: Size::Quick,
    scene: "(title: \"One cell\", spacing: 0.1, size: (0.4, 0.4), contents: [
        (element: \"water\", shape: Rect(min: (0.1, 0.1), max: (0.3, 0.2)))])",
    act: Some(stir),
    ticks: 90,
    rules: Rules { fastest: Some(FASTEST), air: Rules::SEALED, ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

pub(super) const ONE_CELL_HOLE: GauntletCase = GauntletCase {
    name: "one_cell_hole",
    title: "Air in a cell with a hole in its rock",
    what: "A room of one air cell in solid rock; one stone of its wall is missing, and behind it the rock goes on. The \
           outside of the rock is open. The same winds.",
    guards: "Rooms that are smaller than the grid sees, and holes that it sees by half.",
    allowed: AIR_CARRIES,
    size: Size::Quick,
    scene: "(title: \"One cell\", spacing: 0.1, size: (2.4, 2.4), open: (right: true), contents: [
        (element: \"none\", shape: Rect(min: (0.8, 0.8), max: (1.2, 1.2))),
        (element: \"water\", shape: Rect(min: (0.8, 0.8), max: (1.1, 0.9))),
        (element: \"rock\", shape: Rect(min: (0.4, 0.4), max: (1.6, 1.6)))])",
    arrange: Some(|blueprint| {
        for y in 8..12 {
            for x in 8..13 {
                if x < 12 || y == 9 {
                    blueprint.solids.remove(glam::IVec2::new(x, y));
                }
            }
        }
    }),
    act: Some(stir),
    ticks: 90,
    rules: Rules {
        confines: Some(|at| (0.79..=1.31).contains(&at.x) && (0.79..=1.21).contains(&at.y)),
        fastest: Some(FASTEST),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

/// Wind, pressure and suction by turns for half a second.
fn stir(world: &mut World, tick: u64) {
    if tick >= 30 {
        return;
    }
    let stroke = Stroke::dab(BrushShape::Disc, size(world) * 0.42, 3.0);
    let velocity = Vec2::new(3e4, -2e4) * if tick.is_multiple_of(2) { 1.0 } else { -1.0 };
    intend(
        world,
        match tick % 3 {
            0 => Intent::Blow { stroke, velocity },
            1 => Intent::Press { stroke, amount: 1000.0 },
            _ => Intent::Press { stroke, amount: -1000.0 },
        },
    );
}

pub(super) const SEALED_ROCK: GauntletCase = GauntletCase {
    name: "sealed_rock",
    title: "A pulse among rocks",
    what: "A pulse of pressure runs to and fro in a closed box with rock in it, 1,000 ticks.",
    guards: "Air that is lost or made where it is carried along walls and corners; a field that swings below nothing.",
    allowed: "Mass to 10⁻⁵. Without limiters.",
    size: Size::Quick,
    scene: "(title: \"Sealed\", spacing: 0.1, size: (8, 6), gravity: (0, 0), pressures: [(min: (0.5, 0.5), max: (2, 2), pressure: 1.5)],
        contents: [
        (element: \"rock\", shape: Disc(centre: (5, 3), radius: 1)),
        (element: \"rock\", shape: Line(from: (1, 5), to: (3, 3), width: 0.2)),
        (element: \"rock\", shape: Rect(min: (6.5, 0), max: (6.6, 3)))])",
    ticks: 1000,
    rules: Rules { air: Rules::SEALED, calm: true, ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

pub(super) const VORTEX: GauntletCase = GauntletCase {
    name: "air_vortex",
    title: "Wind in the corner of a box",
    what: "A gust of 20 m/s is let loose in a closed box of air, 600 ticks.",
    guards: "Advection that makes energy: wind that gets stronger by itself.",
    allowed: "Never more than the gust's energy, and at the end at most 0.6 of it: the finer the cells, the less is lost.",
    size: Size::Quick,
    scene: "(title: \"Gust\", spacing: 0.1, size: (8, 8), gravity: (0, 0))",
    act: Some(|world, tick| {
        if tick == 0 {
            let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(40.0, 60.0), 16.0);
            intend(world, Intent::Blow { stroke, velocity: Vec2::new(200.0, 0.0) });
        }
    }),
    ticks: 600,
    rules: Rules { air: Rules::SEALED, calm: true, also: Some(|world| gust_has_left(world, 0.6)), ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

pub(super) const OPEN_BOX: GauntletCase = GauntletCase {
    name: "air_open_box",
    title: "A gust in a box with four open sides",
    what: "A gust of 20 m/s is let loose in a small box of air that is open all around, 1,200 ticks.",
    guards: "Air that comes in with a speed of its own: a gust that feeds itself, until it is a storm.",
    allowed: "At the end a fiftieth of the gust's energy: it blows out.",
    size: Size::Quick,
    scene: "(title: \"Open box\", spacing: 0.1, size: (4.8, 4.8), gravity: (0, 0),
        open: (left: true, right: true, bottom: true, top: true))",
    act: Some(|world, tick| {
        if tick == 0 {
            let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(30.0, 24.0), 16.0);
            intend(world, Intent::Blow { stroke, velocity: Vec2::new(120.0, 160.0) });
        }
    }),
    ticks: 1200,
    rules: Rules { calm: true, also: Some(|world| gust_has_left(world, 0.02)), ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

/// That at most such a share of the energy is left of a gust of 200 d/s: a cone 16 d wide, which holds a sixth of a
/// cylinder's ½ v² π r².
fn gust_has_left(world: &World, share: f64) -> Result<(), String> {
    let air = world.resource::<AirGrid>();
    let (left, gust) = (air.kinetic_energy() + air.pressure_energy(), 0.5 * 200.0 * 200.0 * 804.0 / 6.0);
    if left <= share * gust { Ok(()) } else { Err(format!("{:.3} of the gust's energy left", left / gust)) }
}
