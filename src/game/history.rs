//! Undo and redo: checkpoints, taken before each edit, within a bound on memory.

use crate::{scene::challenges::Challenge, sim::checkpoint::Checkpoint};
use bevy::prelude::{Resource, World};
use std::collections::VecDeque;

/// Most memory that the checkpoints may take, bytes.
const MEMORY_LIMIT: usize = 192 << 20;
/// Most checkpoints that are kept.
const LENGTH_LIMIT: usize = 200;

/// Bytes that a checkpoint takes, to a good approximation.
fn bytes(checkpoint: &Checkpoint) -> usize {
    let (own, origin) = (checkpoint.bytes(), &checkpoint.setup.origin);
    // A loaded world brings its start along, twice; all its states share it, so this errs on the large side.
    if origin.clock.tick > 0 { own + 2 * origin.size_in_memory() } else { own }
}

/// Checkpoints to go back to and to go forward to.
#[derive(Resource, Default)]
pub struct History {
    undo: VecDeque<Checkpoint>,
    redo: Vec<Checkpoint>,
}

impl History {
    /// Forgets everything (another scene).
    pub fn clear(&mut self) {
        self.undo.clear();
        self.redo.clear();
    }

    /// Whether there is something to take back and something to make again.
    pub fn reach(&self) -> (bool, bool) {
        (!self.undo.is_empty(), !self.redo.is_empty())
    }

    /// Forgets the states of challenges: nothing of an earlier try can be had back in the next.
    fn forget_challenges(&mut self) {
        let is_free = |state: &Checkpoint| !Challenge::is_name_of_scene(&state.setup.blueprint.name);
        self.undo.retain(is_free);
        self.redo.retain(is_free);
    }

    fn push_undo(&mut self, state: Checkpoint) {
        self.undo.push_back(state);
        let mut total: usize = self.undo.iter().chain(&self.redo).map(bytes).sum();
        while self.undo.len() > 1 && (total > MEMORY_LIMIT || self.undo.len() > LENGTH_LIMIT) {
            if let Some(oldest) = self.undo.pop_front() {
                total -= bytes(&oldest);
            }
        }
    }
}

/// Remembers the state as it is, before an edit.
pub fn checkpoint(world: &mut World) {
    let state = Checkpoint::of(world);
    remember(world, state);
}

/// Remembers the state before something that was done between ticks.
pub fn remember(world: &mut World, before: Checkpoint) {
    let mut history = world.get_resource_or_init::<History>();
    history.redo.clear();
    history.push_undo(before);
}

/// Forgets the states of challenges, before one begins.
pub fn forget_challenges(world: &mut World) {
    world.get_resource_or_init::<History>().forget_challenges();
}

/// Goes back to the state before the last edit; `false` if there is none.
pub fn undo(world: &mut World) -> bool {
    let Some(earlier) = world.get_resource_or_init::<History>().undo.pop_back() else { return false };
    let now = Checkpoint::of(world);
    earlier.restore(world);
    world.get_resource_or_init::<History>().redo.push(now);
    true
}

/// Goes forward again; `false` if nothing was undone.
pub fn redo(world: &mut World) -> bool {
    let Some(later) = world.get_resource_or_init::<History>().redo.pop() else { return false };
    let now = Checkpoint::of(world);
    later.restore(world);
    world.get_resource_or_init::<History>().push_undo(now);
    true
}
