//! What players and their machines do.

use super::common::{element, intend, size};
use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
    },
    lab::gauntlet::case::{Density, Gain, GauntletCase, Over, Rules, Size},
    scene::effects::{Effect, Mode},
    sim::{
        generation::Generation,
        intent::Intent,
        state::{ParticleStore, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;
use std::time::Duration;

const DAM: &str = "(title: \"Dam\", spacing: 0.1, size: (8, 5), contents: [
    (element: \"rock\", shape: Rect(min: (5, 0), max: (5.2, 1))),
    (element: \"water\", shape: Rect(min: (0, 0), max: (2, 4)))])";

pub(super) const HITCHES: GauntletCase = GauntletCase {
    name: "hitches",
    title: "Frames that come late",
    what: "A dam break in frames of 1/60 s of which every 60th comes 200 ms, 10 s or a day late.",
    guards: "The death spiral: a late frame runs all the ticks that it missed, takes longer for it, and the next is later \
             still; or one tick of a day.",
    allowed: "At most 8 ticks in a frame, each of 1/60 s; the rest is dropped. The water does not notice.",
    size: Size::Quick,
    scene: DAM,
    frames: Some(|frame| match frame {
        60 => Duration::from_millis(200),
        120 => Duration::from_secs(10),
        180 => Duration::from_secs(86_400),
        _ => Duration::from_nanos(16_666_667),
    }),
    ticks: 240,
    rules: Rules {
        gain: Some(Gain::Speed(0.8)),
        density: Some(Density { shock: 10, worst: 0.3, end: 0.1 }),
        air: Rules::SEALED,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const QUALITY_CHANGES: GauntletCase = GauntletCase {
    name: "quality_changes",
    title: "Another quality every tick",
    what: "A dam break with a gust over it; before every tick the next of the six qualities is chosen.",
    guards: "State that belongs to one quality (kernel radius, air cells, the predictor's pressure) and is taken over by \
             another.",
    allowed: "Energy as in the dam break, 1 m/s; the most expensive tick is that of the most expensive quality.",
    size: Size::Quick,
    over: Over::Nothing,
    scene: DAM,
    act: Some(|world, tick| {
        let preset = Preset::ALL[(tick % 6) as usize];
        intend(world, Intent::Quality { preset, quality: preset.quality() });
        gust(world, tick);
    }),
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Speed(1.0)),
        density: Some(Density { shock: 10, worst: 0.3, end: 0.2 }),
        work: 100.0,
        air: Rules::SEALED,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const EFFECTS_TOGGLE: GauntletCase = GauntletCase {
    name: "effects_toggle",
    title: "Effects switched every tick",
    what: "A dam break with a gust over it; before every tick each effect is switched on, off or to auto, in another \
           combination.",
    guards: "Stages that count on each other having run.",
    allowed: "Energy: as much as corrections give; a tick without the predictor takes them for motion. Some ticks in a row \
              without it let the water be crushed to half as much again.",
    size: Size::Quick,
    scene: DAM,
    act: Some(|world, tick| {
        let mut digits = tick * 5 % 6561;
        for effect in Effect::ALL {
            intend(world, Intent::Effect { effect, mode: [Mode::Auto, Mode::On, Mode::Off][(digits % 3) as usize] });
            digits /= 3;
        }
        gust(world, tick);
    }),
    ticks: 300,
    rules: Rules {
        gain: Some(Gain::Corrections(1.0)),
        density: Some(Density { shock: 10, worst: 0.6, end: 0.3 }),
        air: Rules::SEALED,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

fn gust(world: &mut World, tick: u64) {
    if tick == 10 {
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(50.0, 30.0), 15.0);
        intend(world, Intent::Blow { stroke, velocity: Vec2::new(-50.0, 0.0) });
    }
}

pub(super) const MOUSE_MINUTE: GauntletCase = GauntletCase {
    name: "mouse_minute",
    title: "The mouse held down everywhere for a minute",
    what: "Every tool with a brush as large as the box, at once and every tick for a minute: water is poured, wind is blown, \
           pressure is pumped, rock is drawn and erased.",
    guards: "Ids, counts, edits and limits that only run out after thousands of strokes; air that is pumped up for ever.",
    allowed: "As fast as wind can be. The box stays full, so it may be too dense while it is stirred.",
    scene: "(title: \"Mouse\", spacing: 0.1, size: (3, 2), particle_limit: 800)",
    act: Some(|world, tick| {
        let (middle, reach) = (size(world) / 2.0, size(world).length());
        let everywhere = Stroke::dab(BrushShape::Disc, middle, reach);
        let spot = Vec2::new((tick * 7 % 30) as f32, (tick * 3 % 20) as f32);
        let elements = world.resource::<Setup>().elements();
        let (rock, water) = (element(elements, "rock"), element(elements, "water"));
        let turn = if tick / 20 % 2 == 0 { 300.0 } else { -300.0 };
        intend(world, Intent::Draw { element: water, stroke: everywhere });
        intend(world, Intent::Blow { stroke: everywhere, velocity: Vec2::new(turn, 0.5 * turn) });
        intend(world, Intent::Press { stroke: everywhere, amount: 0.5 * turn / 300.0 });
        intend(world, Intent::Stamp { element: rock, stroke: Stroke::dab(BrushShape::Square, spot, 2.0) });
        if tick % 4 == 0 {
            let half = Stroke::dab(BrushShape::Disc, Vec2::new(30.0 - spot.x, 20.0 - spot.y), 9.0);
            intend(world, Intent::Erase { stroke: half });
        }
    }),
    ticks: 3600,
    rules: Rules { fastest: Some(1000.0), ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};

pub(super) const POISON: GauntletCase = GauntletCase {
    name: "poison",
    title: "Particles that are no number",
    what: "In a dam break a particle's position or velocity becomes NaN, infinite or 10³⁰, once every ten ticks, five times.",
    guards: "One bad number that spreads to every neighbour, and theirs.",
    allowed: "Each is taken away and counted, and no other.",
    size: Size::Quick,
    scene: DAM,
    act: Some(|world, tick| {
        let poison = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30];
        if let (0, Some(value)) = (tick % 10, poison.get(tick as usize / 10)) {
            let particles = &mut world.resource_mut::<ParticleStore>().0;
            let field = if tick % 20 == 0 { &mut particles.x } else { &mut particles.vy };
            if let Some(victim) = field.get_mut(100 + tick as usize) {
                *victim = *value;
            }
            // No player can do this, so that there is no intent for it.
            Generation::count_state(world);
        }
    }),
    ticks: 240,
    rules: Rules {
        removed: 5,
        density: Some(Density { shock: 10, worst: 0.3, end: 0.1 }),
        air: Rules::SEALED,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};
