//! Undo and redo: whole states, frozen before each edit, within a bound on memory.

use crate::sim::{control, snapshot::Snapshot};
use bevy::prelude::{Resource, World};
use std::collections::VecDeque;

/// Most memory that frozen states may take, bytes.
const MEMORY_LIMIT: usize = 192 << 20;
/// Most states that are kept.
const LENGTH_LIMIT: usize = 200;

/// States to go back to and to go forward to.
#[derive(Resource, Default)]
pub struct History {
    undo: VecDeque<Snapshot>,
    redo: Vec<Snapshot>,
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

    fn push_undo(&mut self, state: Snapshot) {
        self.undo.push_back(state);
        let mut bytes: usize = self.undo.iter().chain(&self.redo).map(size_in_memory).sum();
        while self.undo.len() > 1 && (bytes > MEMORY_LIMIT || self.undo.len() > LENGTH_LIMIT) {
            if let Some(oldest) = self.undo.pop_front() {
                bytes -= size_in_memory(&oldest);
            }
        }
    }
}

/// Remembers the state as it is, before an edit.
pub fn checkpoint(world: &mut World) {
    let state = control::freeze(world);
    let mut history = world.get_resource_or_init::<History>();
    history.redo.clear();
    history.push_undo(state);
}

/// Goes back to the state before the last edit; `false` if there is none.
pub fn undo(world: &mut World) -> bool {
    let Some(earlier) = world.get_resource_or_init::<History>().undo.pop_back() else { return false };
    let now = control::freeze(world);
    control::thaw(world, &earlier);
    world.get_resource_or_init::<History>().redo.push(now);
    true
}

/// Goes forward again; `false` if nothing was undone.
pub fn redo(world: &mut World) -> bool {
    let Some(later) = world.get_resource_or_init::<History>().redo.pop() else { return false };
    let now = control::freeze(world);
    control::thaw(world, &later);
    world.get_resource_or_init::<History>().push_undo(now);
    true
}

/// Bytes that a state takes, to a good approximation.
fn size_in_memory(state: &Snapshot) -> usize {
    let cells = (state.solids.columns() * state.solids.rows()) as usize;
    state.particles.len() * 21 + cells * 5 + state.air.columns() * state.air.rows() * 12
}
