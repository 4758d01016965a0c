//! Tracers: points that drift with the air and are drawn as short streaks, so that wind can be seen. They are part of the
//! picture, not of the world: nothing in the simulation reads them.

use crate::{
    game::render::air::{Streak, streak},
    kernel::{random::Random, units::TICK_SECONDS},
    lab::colours::Reference,
    sim::{
        pace::Pace,
        state::{AirGrid, Setup},
    },
};
use bevy::prelude::{Res, ResMut, Resource, Time, Virtual};
use glam::Vec2;

/// Number of tracers.
const COUNT: usize = 420;
/// Time after which a tracer starts anew elsewhere, s.
const LIFE: f32 = 1.6;
/// Time that the tail of a streak lasts, s.
const TAIL: f32 = 0.26;
/// Wind below this share of the reference is not drawn.
const FLOOR: f32 = 0.03;

#[derive(Clone, Copy, Debug, Default)]
struct Tracer {
    at: Vec2,
    age: f32,
    velocity: Vec2,
}

/// The tracers.
#[derive(Resource, Clone, Debug, Default)]
pub struct Tracers {
    all: Vec<Tracer>,
    random: Random,
    /// Whether any of them moves.
    awake: bool,
}

impl Tracers {
    /// Streaks of those that the wind moves.
    pub fn pack(&self, reference: Reference, out: &mut Vec<Streak>) {
        if !self.awake {
            return;
        }
        for tracer in &self.all {
            let strength = tracer.velocity.length() / reference.wind - FLOOR;
            if strength > 0.0 {
                let life = tracer.age / LIFE;
                let fade = 4.0 * life * (1.0 - life);
                let opacity = 80.0 * fade * (strength / (0.25 + strength));
                out.push(streak(tracer.at - tracer.velocity * TAIL, tracer.at, [196, 214, 226, opacity as u8]));
            }
        }
    }
}

/// Lets the tracers drift for one frame.
pub fn drift(
    mut tracers: ResMut<Tracers>,
    air: Option<Res<AirGrid>>,
    setup: Option<Res<Setup>>,
    pace: Res<Pace>,
    time: Res<Time<Virtual>>,
) {
    let (Some(air), Some(setup)) = (air, setup) else { return };
    if air.is_quiet() {
        tracers.awake = false;
        return;
    }
    let seconds = if pace.stands() { 0.0 } else { time.delta_secs().min(8.0 * TICK_SECONDS) };
    let size = setup.blueprint.domain.size;
    tracers.awake = true;
    tracers.all.resize(COUNT, Tracer { age: LIFE, ..Tracer::default() });
    for k in 0..COUNT {
        let mut tracer = tracers.all[k];
        tracer.age += seconds;
        tracer.at += tracer.velocity * seconds;
        let outside = tracer.at.cmplt(Vec2::ZERO).any() || tracer.at.cmpgt(size).any();
        if tracer.age >= LIFE || outside {
            // The first generation starts at all ages, so that they don't blink together.
            let age = if tracer.at == Vec2::ZERO { LIFE * tracers.random.share() } else { 0.0 };
            tracer = Tracer {
                at: Vec2::new(tracers.random.share(), tracers.random.share()) * size,
                age,
                velocity: Vec2::ZERO,
            };
        }
        tracer.velocity = air.sample_velocity(tracer.at);
        tracers.all[k] = tracer;
    }
}
