//! What a scene does by itself: the hard cases of the stability gauntlet change their world before every tick.

use crate::sim::state::{Clock, Setup};
use bevy::prelude::{Resource, World};

/// Acts on the world before each tick of its scene, like a player. In any other scene it does nothing.
#[derive(Resource, Clone, Debug)]
pub struct Script {
    /// Name of the scene that it belongs to.
    pub scene: String,
    /// What it does, told the ticks that the scene has run. Whatever it does follows from that and the world alone, so
    /// that a scene that is begun again goes the same way. It acts by intents, which a recording holds; what it changes
    /// by itself it has to count ([`Generation`](crate::sim::generation::Generation)).
    pub act: fn(&mut World, u64),
}

/// Lets the script act.
pub(crate) fn run(world: &mut World) {
    let (Some(script), Some(setup)) = (world.get_resource::<Script>(), world.get_resource::<Setup>()) else { return };
    if setup.blueprint.name == script.scene {
        let (act, tick) = (script.act, world.resource::<Clock>().tick);
        act(world, tick);
    }
}
