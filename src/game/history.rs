//! Undo and redo: whole states, frozen before each edit, within a bound on memory.

use crate::sim::{control, effects::Effects, snapshot::Snapshot, state::Setup};
use bevy::prelude::{Resource, World};
use std::{collections::VecDeque, sync::Arc};

/// Most memory that frozen states may take, bytes.
const MEMORY_LIMIT: usize = 192 << 20;
/// Most states that are kept.
const LENGTH_LIMIT: usize = 200;

/// A state, and the scene that it is of: loading a save file is an edit like any other.
struct Frozen {
    state: Snapshot,
    setup: Setup,
    effects: Effects,
}

impl Frozen {
    fn of(world: &World) -> Self {
        Self {
            state: control::freeze(world),
            setup: world.resource::<Setup>().clone(),
            effects: world.resource::<Effects>().clone(),
        }
    }

    fn restore(&self, world: &mut World) {
        if !Arc::ptr_eq(&world.resource::<Setup>().blueprint, &self.setup.blueprint) {
            control::load(world, self.setup.blueprint.clone());
            world.insert_resource(self.setup.clone());
            world.insert_resource(self.effects.clone());
        }
        // A state goes on at the quality that it was run at: a recording has the changes since then taken back, too.
        let mut setup = world.resource_mut::<Setup>();
        (setup.preset, setup.quality) = (self.setup.preset, self.setup.quality);
        control::thaw(world, &self.state);
    }

    /// Bytes that it takes, to a good approximation.
    fn size_in_memory(&self) -> usize {
        let own = self.state.size_in_memory();
        // A loaded world brings its start along, twice; all its states share it, so this errs on the large side.
        if self.setup.origin.clock.tick > 0 { own + 2 * self.setup.origin.size_in_memory() } else { own }
    }
}

/// States to go back to and to go forward to.
#[derive(Resource, Default)]
pub struct History {
    undo: VecDeque<Frozen>,
    redo: Vec<Frozen>,
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

    fn push_undo(&mut self, state: Frozen) {
        self.undo.push_back(state);
        let mut bytes: usize = self.undo.iter().chain(&self.redo).map(Frozen::size_in_memory).sum();
        while self.undo.len() > 1 && (bytes > MEMORY_LIMIT || self.undo.len() > LENGTH_LIMIT) {
            if let Some(oldest) = self.undo.pop_front() {
                bytes -= oldest.size_in_memory();
            }
        }
    }
}

/// Remembers the state as it is, before an edit.
pub fn checkpoint(world: &mut World) {
    let state = Frozen::of(world);
    let mut history = world.get_resource_or_init::<History>();
    history.redo.clear();
    history.push_undo(state);
}

/// Goes back to the state before the last edit; `false` if there is none.
pub fn undo(world: &mut World) -> bool {
    let Some(earlier) = world.get_resource_or_init::<History>().undo.pop_back() else { return false };
    let now = Frozen::of(world);
    earlier.restore(world);
    world.get_resource_or_init::<History>().redo.push(now);
    true
}

/// Goes forward again; `false` if nothing was undone.
pub fn redo(world: &mut World) -> bool {
    let Some(later) = world.get_resource_or_init::<History>().redo.pop() else { return false };
    let now = Frozen::of(world);
    later.restore(world);
    world.get_resource_or_init::<History>().push_undo(now);
    true
}
