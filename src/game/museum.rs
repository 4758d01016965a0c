//! The museum: the exhibit of the exam that is looked at, if one is.

use crate::{
    game::{history, toasts::Toasts},
    kernel::params::Preset,
    lab::exam::exhibits::Exhibit,
    sim::{checkpoint::Checkpoint, generation::Generation, pace::Pace, state::Setup},
};
use bevy::prelude::{Res, ResMut, Resource, World};
use std::sync::Arc;

/// What is looked at.
#[derive(Resource, Default)]
pub struct Museum {
    /// The exhibit, and which scene its world is.
    shown: Option<(&'static Exhibit, u64)>,
}

impl Museum {
    /// The exhibit, if the world is still its own.
    pub fn shown(&self, generation: Generation) -> Option<&'static Exhibit> {
        self.shown.filter(|(_, scene)| *scene == generation.scene).map(|(exhibit, _)| exhibit)
    }
}

/// Goes to the exhibit of a name, at the quality that is in force; undo leads back.
pub fn visit(world: &mut World, name: &str) {
    let Some(exhibit) = Exhibit::find(name) else { return };
    let preset = world.get_resource::<Setup>().map_or(Preset::Balanced, |setup| setup.preset);
    let blueprint = match exhibit.build(preset) {
        Ok(blueprint) => blueprint,
        Err(error) => return world.resource_mut::<Toasts>().warn(error.to_string()),
    };
    if world.contains_resource::<Setup>() {
        history::checkpoint(world);
    }
    Checkpoint::of_scene(Arc::new(blueprint)).restore(world);
    let pace = *world.resource::<Pace>();
    *world.resource_mut::<Pace>() = Pace { paused: false, steps_due: 0, speed: exhibit.speed, ..pace };
    let scene = Generation::of(world).scene;
    world.resource_mut::<Museum>().shown = Some((exhibit, scene));
}

/// Another world goes on as fast as time goes by.
pub fn leave(generation: Res<Generation>, mut museum: ResMut<Museum>, mut pace: ResMut<Pace>) {
    if let Some((exhibit, scene)) = museum.shown
        && scene != generation.scene
    {
        museum.shown = None;
        if pace.speed == exhibit.speed {
            pace.speed = 1.0;
        }
    }
}
