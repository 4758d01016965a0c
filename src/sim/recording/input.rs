//! Input that waits for its tick: the one way in which what was recorded, read or made up reaches a world.

use crate::sim::{intent::IntentQueue, recording::segment::Entry, state::Clock};
use bevy::prelude::World;
use std::{iter::Peekable, vec};

/// Intents that wait for their ticks.
#[derive(Clone, Debug)]
pub struct Input(Peekable<vec::IntoIter<Entry>>);

impl Input {
    /// These intents, oldest first.
    pub fn new(entries: Vec<Entry>) -> Self {
        Self(entries.into_iter().peekable())
    }

    /// Gives `world` what is due after the ticks that it has done; how many intents that are.
    pub fn give(&mut self, world: &mut World) -> u64 {
        let now = world.resource::<Clock>().tick;
        let mut queue = world.resource_mut::<IntentQueue>();
        let mut given = 0;
        while let Some(entry) = self.0.next_if(|entry| entry.tick <= now) {
            queue.push(entry.intent);
            given += 1;
        }
        given
    }
}
