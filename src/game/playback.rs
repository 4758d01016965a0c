//! Showing a recording in the game: its input comes in the ticks in which it came, as if somebody played. Whoever edits
//! the world goes on from there.

use crate::{
    game::toasts::Toasts,
    sim::{
        generation::Generation,
        pace::Pace,
        recording::{Input, Recording},
        state::Clock,
    },
};
use bevy::prelude::{Resource, World};
use tr::tr;

/// The recording that is shown.
#[derive(Resource, Debug)]
pub struct Playback {
    recording: Recording,
    segment: usize,
    input: Input,
    /// The world as it was looked at last, and its edits once it has taken what was given.
    generation: Generation,
    edits: u64,
}

/// Shows a recording. The world is at the start of it.
pub fn begin(world: &mut World, recording: Recording) {
    let playback = Playback::new(world, recording, 0);
    world.insert_resource(playback);
}

impl Playback {
    /// Shows a segment, at whose start the world is.
    fn new(world: &World, recording: Recording, segment: usize) -> Self {
        let input = Input::new(recording.segments[segment].entries.clone());
        let (generation, edits) = (Generation::of(world), world.resource::<Clock>().edits);
        Self { recording, segment, input, generation, edits }
    }

    fn give(&mut self, world: &mut World) {
        self.edits += self.input.give(world);
    }
}

/// Gives the world the input that is due. Before every fixed update.
pub fn feed(world: &mut World) {
    let Some(mut playback) = world.remove_resource::<Playback>() else { return };
    if Generation::of(world) != playback.generation || world.resource::<Clock>().edits != playback.edits {
        world.resource_mut::<Toasts>().say(tr!("The recording is left here"));
        return;
    }
    playback.give(world);
    if world.resource::<Clock>().tick < playback.recording.segments[playback.segment].now() {
        world.insert_resource(playback);
        return;
    }
    let Playback { recording, segment, .. } = playback;
    match recording.segments.get(segment + 1).map(|next| next.start()) {
        Some(Ok(start)) => {
            start.restore(world);
            let mut playback = Playback::new(world, recording, segment + 1);
            playback.give(world);
            world.insert_resource(playback);
        }
        Some(Err(error)) => world.resource_mut::<Toasts>().warn(error.to_string()),
        None => {
            *world.resource_mut::<Pace>() = Pace { paused: true, steps_due: 0, ..*world.resource::<Pace>() };
            world.resource_mut::<Toasts>().say(tr!("The recording ends here"));
        }
    }
}
