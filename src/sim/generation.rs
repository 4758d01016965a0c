//! Which world it is: counted at the one place where a state is put in the place of another.

use bevy::prelude::{Resource, World};
use std::sync::atomic::{AtomicU64, Ordering};

/// Numbers that were given so far. They only have to differ, in every world of this process.
static GIVEN: AtomicU64 = AtomicU64::new(0);

/// Changes when the state of a world is put in the place of another: by undo, reset, another scene, a save file. All that is
/// carried on from tick to tick, or derived from a world, begins anew when it changes. No two worlds share one.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Generation {
    /// Changes with every scene that is opened, and with every state of another scene.
    pub scene: u64,
    /// Changes with every state.
    pub state: u64,
}

impl Generation {
    /// That of `world`.
    pub fn of(world: &World) -> Self {
        world.get_resource::<Self>().copied().unwrap_or_default()
    }

    /// The state of `world` is another one, which no tick and no intent has made.
    pub fn count_state(world: &mut World) {
        world.get_resource_or_init::<Self>().state = next();
    }

    /// `world` is of another scene.
    pub(super) fn count_scene(world: &mut World) {
        world.get_resource_or_init::<Self>().scene = next();
    }
}

fn next() -> u64 {
    GIVEN.fetch_add(1, Ordering::Relaxed) + 1
}
