//! What is thrown at the world that is played comes in the ticks in which it is due, as if many hands did it; a copy is judged
//! beside it ([`StressTest`]).

use crate::{
    game::{history, language::spoken, toasts::Toasts},
    lab::gauntlet::throws::{StressTest, Throw},
    sim::{
        generation::Generation,
        intent::{Intent, IntentQueue},
        pace::Pace,
        recorder::REWIND_TICKS,
        recording::{Entry, Input},
        state::{Clock, Setup},
    },
};
use bevy::prelude::{Resource, World};
use glam::Vec2;
use tr::tr;

/// What was thrown.
#[derive(Resource, Debug)]
pub struct Thrown {
    /// What is still to come.
    input: Input,
    /// The tick in which the last of it comes.
    last: u64,
    /// The world that it is thrown at, the length of its d, m, and how it pulled before, d/s².
    generation: Generation,
    spacing: f32,
    gravity: Vec2,
}

impl Thrown {
    fn new(setup: &Setup, generation: Generation, input: &[Entry]) -> Self {
        Self {
            input: Input::new(input.to_vec()),
            last: input.last().map_or(0, |entry| entry.tick),
            generation,
            spacing: setup.blueprint.scale.spacing,
            gravity: setup.domain.gravity,
        }
    }

    /// Whether something is still to come.
    pub fn comes(&self, clock: &Clock) -> bool {
        clock.tick <= self.last
    }
}

/// Throws something, which can be undone, and has a copy of the world judged.
pub fn throw(world: &mut World, name: &str) {
    let (Some(throw), Some(setup)) = (Throw::find(name), world.get_resource::<Setup>()) else { return };
    let clock = world.resource::<Clock>();
    if world.get_resource::<Thrown>().is_some_and(|thrown| thrown.comes(clock)) {
        return;
    }
    if let Some(element) = throw.lacks(setup) {
        let element = spoken(element);
        world.resource_mut::<Toasts>().say(tr!("This world knows no {}", element));
        return;
    }
    let input = throw.input(setup, clock.tick);
    let thrown = Thrown::new(setup, Generation::of(world), &input);
    history::checkpoint(world);
    StressTest::begin(world, throw, input);
    world.insert_resource(thrown);
}

/// Gives the world what is due. Before every fixed update.
pub fn feed(world: &mut World) {
    if world.resource::<Pace>().rewinds {
        return;
    }
    let Some(mut thrown) = world.remove_resource::<Thrown>() else { return };
    let generation = Generation::of(world);
    if generation.scene != thrown.generation.scene {
        return;
    }
    let setup = world.resource::<Setup>();
    let shorter = thrown.spacing / setup.blueprint.scale.spacing;
    if generation != thrown.generation || shorter != 1.0 {
        // In the midst of it, or after a change of the detail, nothing more comes; but what fell falls as before.
        let gravity = shorter * thrown.gravity;
        if setup.domain.gravity != gravity {
            world.resource_mut::<IntentQueue>().push(Intent::Gravity { gravity });
        }
        return;
    }
    thrown.input.give(world);
    if world.resource::<Clock>().tick <= thrown.last + REWIND_TICKS {
        world.insert_resource(thrown);
    }
}
