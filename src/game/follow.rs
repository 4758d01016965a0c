//! What the game does when another scene begins.

use crate::{
    game::{
        camera::WorldCamera,
        tools::{Tool, Toolbox},
    },
    sim::{generation::Generation, state::Setup},
};
use bevy::prelude::{Local, Res, ResMut};

/// Shows the whole of its box, takes up the scene's first element.
pub fn follow_scene(
    setup: Option<Res<Setup>>,
    generation: Res<Generation>,
    mut seen: Local<u64>,
    mut camera: ResMut<WorldCamera>,
    mut tools: ResMut<Toolbox>,
) {
    let Some(setup) = setup else { return };
    let blueprint = &setup.blueprint;
    if *seen == generation.scene {
        return;
    }
    *seen = generation.scene;
    camera.set_world(blueprint.domain.size);
    let elements = &blueprint.elements;
    let first = blueprint.first_element.as_deref().and_then(|name| elements.find(name));
    let movable = || elements.iter().find(|(_, element)| !element.fixed).map(|(id, _)| id);
    if let Some(element) = first.or_else(movable) {
        tools.tool = Tool::Element(element);
    }
}
