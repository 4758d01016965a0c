//! Showing a recording in the game: its input comes in the ticks in which it came, as if somebody played. Whoever takes
//! a hand in it goes on from there.

use crate::{
    game::{render::extract::Epoch, toasts::Toasts},
    scene::blueprint::Blueprint,
    sim::{
        intent::IntentQueue,
        pace::Pace,
        recording::Recording,
        save,
        state::{Clock, Setup},
    },
};
use bevy::prelude::{Resource, World};
use std::sync::Arc;

/// The recording that is shown.
#[derive(Resource, Debug)]
pub struct Playback {
    recording: Recording,
    stretch: usize,
    /// Intents of the stretch that were given.
    given: usize,
    /// What the world was when it was looked at last.
    blueprint: Arc<Blueprint>,
    tick: u64,
    /// Edits of the world once it has taken what was given.
    edits: u64,
}

/// Shows a recording. The world is at the start of it.
pub fn begin(world: &mut World, recording: Recording) {
    let (blueprint, Clock { tick, edits, .. }) = (world.resource::<Setup>().blueprint.clone(), *world.resource());
    world.insert_resource(Playback { recording, stretch: 0, given: 0, blueprint, tick, edits });
}

/// Gives the world the input that is due. Before every fixed update.
pub fn feed(world: &mut World) {
    let Some(mut playback) = world.remove_resource::<Playback>() else { return };
    let Clock { tick: now, edits, .. } = *world.resource();
    let same = Arc::ptr_eq(&playback.blueprint, &world.resource::<Setup>().blueprint);
    if !same || now < playback.tick || now > playback.tick + 1 || edits != playback.edits {
        world.resource_mut::<Toasts>().say("The recording is left here");
        return;
    }
    playback.tick = now;
    playback.give(world, now);
    let Playback { recording, stretch, .. } = &playback;
    let shown = &recording.stretches[*stretch];
    if now < shown.tick + shown.marks.len() as u64 {
        world.insert_resource(playback);
        return;
    }
    match recording.stretches.get(stretch + 1).map(|next| next.start()) {
        Some(Ok(saved)) => {
            save::load(world, saved);
            world.resource_mut::<Epoch>().0 += 1;
            playback.stretch += 1;
            playback.given = 0;
            Clock { tick: playback.tick, edits: playback.edits, .. } = *world.resource();
            playback.blueprint = world.resource::<Setup>().blueprint.clone();
            playback.give(world, playback.tick);
            world.insert_resource(playback);
        }
        Some(Err(error)) => world.resource_mut::<Toasts>().warn(error.to_string()),
        None => {
            *world.resource_mut::<Pace>() = Pace { paused: true, steps_due: 0, ..*world.resource::<Pace>() };
            world.resource_mut::<Toasts>().say("The recording ends here");
        }
    }
}

impl Playback {
    fn give(&mut self, world: &mut World, now: u64) {
        let mut queue = world.resource_mut::<IntentQueue>();
        for entry in self.recording.stretches[self.stretch].entries[self.given..].iter().take_while(|e| e.tick <= now) {
            queue.push(entry.intent);
            self.given += 1;
            self.edits += 1;
        }
    }
}
