//! What is done in a case before each tick.

use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
    },
    lab::gauntlet::arrange::element,
    scene::effects::{Effect, Mode},
    sim::{
        generation::Generation,
        intent::{Intent, IntentQueue},
        state::{ParticleStore, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;

/// What is done, given the number of ticks that were done.
pub(super) type Act = fn(&mut World, u64);

/// By the names of the cases.
pub(super) const SCRIPTS: [(&str, Act); 23] = [
    ("gravity_flips", |world, tick| set_gravity(world, Vec2::new(0.0, if tick % 2 == 0 { -G } else { G }))),
    ("gravity_turns", turn_gravity),
    ("heap_turned", turn_gravity),
    ("heap_shaken", |world, tick| {
        let (x, y) = TURN[if tick / 6 % 2 == 0 { 1 } else { 15 }];
        set_gravity(world, G * Vec2::new(x, y));
    }),
    ("silo_gate", |world, tick| {
        if tick < 300 {
            let stroke = Stroke::rectangle(Vec2::new(24.0, 30.0), Vec2::new(35.9, 34.9));
            let element = named(world, "rock");
            let shut = Intent::Stamp { element, stroke };
            intend(world, if tick % 2 == 0 { shut } else { Intent::Erase { stroke } });
        }
    }),
    ("heat_flips", |world, tick| {
        if tick < 240 {
            let stroke = everywhere(world);
            intend(world, Intent::Warm { stroke, degrees: if tick / 2 % 2 == 0 { 1e4 } else { -1e4 } });
        }
    }),
    ("crowded_changes", |world, tick| {
        if tick < 240 {
            let stroke = everywhere(world);
            intend(world, Intent::Warm { stroke, degrees: if tick / 15 % 2 == 0 { 1e4 } else { -1e4 } });
        }
    }),
    ("wind_1000", |world, tick| {
        if tick < 240 && tick / 15 % 2 == 0 {
            let velocity = own_spacings(world, Vec2::new(1000.0, 200.0));
            let stroke = everywhere(world);
            intend(world, Intent::Blow { stroke, velocity });
        }
    }),
    ("pressure_1e6", |world, tick| {
        if tick == 0 {
            press(world, 1e6);
        }
    }),
    ("suction", |world, tick| {
        if tick < 30 {
            press(world, -1e6);
        }
    }),
    ("one_cell", stir),
    ("one_cell_hole", stir),
    ("air_vortex", |world, tick| blow(world, tick == 0, (40.0, 60.0), 16.0, (200.0, 0.0))),
    ("air_open_box", |world, tick| blow(world, tick == 0, (30.0, 24.0), 16.0, (120.0, 160.0))),
    ("rock_over_water", |world, tick| {
        if tick < 300 && tick % 6 == 0 {
            // Erasing takes everything under the brush, so that the bar is rubbed out where it was and as large.
            let bar = |k: u64| {
                let at = Vec2::new(10.0 + (k * 17 % 40) as f32, 4.0 + (k * 7 % 20) as f32);
                Stroke { shape: BrushShape::Disc, from: at, to: at + Vec2::new(8.0, 4.0), radius: 1.2 }
            };
            let (step, element) = (tick / 6, named(world, "rock"));
            let painted = Intent::Stamp { element, stroke: bar(step) };
            intend(world, if step % 2 == 0 { painted } else { Intent::Erase { stroke: bar(step - 1) } });
        }
    }),
    ("rock_erased", |world, tick| {
        if tick == 30 {
            let floor = Stroke::rectangle(Vec2::new(20.0, 18.0), Vec2::new(60.0, 19.9));
            intend(world, Intent::Erase { stroke: floor });
        }
    }),
    ("pool_asleep", |world, tick| {
        if tick == 240 {
            let element = named(world, "water");
            intend(world, Intent::Stamp { element, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(15.0, 60.0), 0.0) });
        }
    }),
    ("no_particles", |world, tick| {
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::splat(20.0), 0.0);
        let element = named(world, "water");
        match tick {
            30 => intend(world, Intent::Stamp { element, stroke }),
            31 => intend(world, Intent::Erase { stroke: Stroke { radius: 5.0, ..stroke } }),
            _ => {}
        }
    }),
    ("quality_changes", |world, tick| {
        let preset = Preset::ALL[(tick % 6) as usize];
        intend(world, Intent::Quality { preset, quality: preset.quality() });
        blow(world, tick == 10, (50.0, 30.0), 15.0, (-50.0, 0.0));
    }),
    ("quality_and_detail_changes", |world, tick| {
        // Twelve in a second, more than a hand can press; six qualities and five details meet in all ways.
        if tick % 5 == 0 {
            let change = (tick / 5) as usize;
            let (preset, detail) = (Preset::ALL[change % 6], [1.0, 0.5, 2.0, 0.73, 1.37][change % 5]);
            intend(world, Intent::Detail { detail });
            intend(world, Intent::Quality { preset, quality: preset.quality() });
        }
        blow(world, tick == 12, (50.0, 30.0), 15.0, (-50.0, 0.0));
    }),
    ("effects_toggle", |world, tick| {
        let mut digits = tick * 88_573 % 3_u64.pow(Effect::ALL.len() as u32);
        for effect in Effect::ALL {
            intend(world, Intent::Effect { effect, mode: [Mode::Auto, Mode::On, Mode::Off][(digits % 3) as usize] });
            digits /= 3;
        }
        blow(world, tick == 10, (50.0, 30.0), 15.0, (-50.0, 0.0));
    }),
    ("mouse_minute", use_every_tool),
    ("poison", poison),
];

/// What is done in a case; `None` of one in which nothing is.
pub(super) fn of(case: &str) -> Option<Act> {
    SCRIPTS.iter().find(|(name, _)| *name == case).map(|(_, act)| *act)
}

/// Standard gravity, m/s².
const G: f32 = 9.81;

/// Sixteen directions, from a table: this way the bits are the same on every machine.
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
const EVEN: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// Puts an intent in the queue. Its lengths are the scene's own spacings: at any detail the same is done.
fn intend(world: &mut World, intent: Intent) {
    let detail = world.resource::<Setup>().blueprint.scale.detail;
    world.resource_mut::<IntentQueue>().push(intent.scaled(detail));
}

/// Metres (or m/s, m/s²) in the scene's own spacings.
fn own_spacings(world: &World, metres: Vec2) -> Vec2 {
    metres / world.resource::<Setup>().blueprint.scale.own_spacing()
}

/// The element called `name` in the world's table.
fn named(world: &World, name: &str) -> crate::kernel::element::ElementId {
    element(world.resource::<Setup>().elements(), name)
}

/// Size of the box, in the scene's own spacings.
fn size(world: &World) -> Vec2 {
    let blueprint = &world.resource::<Setup>().blueprint;
    blueprint.domain.size / blueprint.scale.detail
}

/// A brush as large as the box.
fn everywhere(world: &World) -> Stroke {
    Stroke::dab(BrushShape::Disc, size(world) / 2.0, size(world).length())
}

/// Sets gravity, m/s², if it is another one.
fn set_gravity(world: &mut World, gravity: Vec2) {
    let gravity = own_spacings(world, gravity);
    let Setup { blueprint, domain, .. } = world.resource::<Setup>();
    if domain.gravity != gravity * blueprint.scale.detail {
        intend(world, Intent::Gravity { gravity });
    }
}

/// Turns gravity once in 3 s.
fn turn_gravity(world: &mut World, tick: u64) {
    let (x, y) = TURN[(tick * 16 / 180 % 16) as usize];
    set_gravity(world, G * Vec2::new(x, y));
}

/// Changes the pressure of one cell.
fn press(world: &mut World, amount: f32) {
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(62.0, 38.0), 0.0);
    intend(world, Intent::Press { stroke, amount });
}

/// A gust at a place with a radius and a velocity, when it is time for it.
fn blow(world: &mut World, is_time: bool, at: (f32, f32), radius: f32, velocity: (f32, f32)) {
    if is_time {
        let stroke = Stroke::dab(BrushShape::Disc, at.into(), radius);
        intend(world, Intent::Blow { stroke, velocity: velocity.into() });
    }
}

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

/// Pours, blows, presses, draws rock and erases in every tick.
fn use_every_tool(world: &mut World, tick: u64) {
    let stroke = everywhere(world);
    let spot = Vec2::new((tick * 7 % 30) as f32, (tick * 3 % 20) as f32);
    let (rock, water) = (named(world, "rock"), named(world, "water"));
    let turn = if (tick / 20).is_multiple_of(2) { 300.0 } else { -300.0 };
    intend(world, Intent::Draw { element: water, stroke });
    intend(world, Intent::Blow { stroke, velocity: Vec2::new(turn, 0.5 * turn) });
    intend(world, Intent::Press { stroke, amount: 0.5 * turn / 300.0 });
    intend(world, Intent::Stamp { element: rock, stroke: Stroke::dab(BrushShape::Square, spot, 2.0) });
    if tick.is_multiple_of(4) {
        let half = Stroke::dab(BrushShape::Disc, Vec2::new(30.0 - spot.x, 20.0 - spot.y), 9.0);
        intend(world, Intent::Erase { stroke: half });
    }
}

/// Makes a position or a velocity no number, five times.
fn poison(world: &mut World, tick: u64) {
    let poison = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30];
    if let (0, Some(value)) = (tick % 10, poison.get(tick as usize / 10)) {
        let particles = &mut world.resource_mut::<ParticleStore>().0;
        let field = if tick.is_multiple_of(20) { &mut particles.x } else { &mut particles.vy };
        if let Some(poisoned) = field.get_mut(100 + tick as usize) {
            *poisoned = *value;
        }
        // No player can do this, so that there is no intent for it.
        Generation::count_state(world);
    }
}
