//! What the game does when another scene begins, or the same goes on at another detail.

use crate::{
    game::{camera::WorldCamera, input::strokes::DragState, toolbox::Toolbox, tools::Tool},
    scene::blueprint::Blueprint,
    sim::{generation::Generation, state::Setup},
};
use bevy::prelude::{Res, ResMut, Resource, World};

/// The scene that the camera and the tools follow.
#[derive(Resource, Default)]
pub struct Followed(u64);

/// Shows the whole of its box, takes up the scene's first element.
pub fn follow_scene(
    setup: Option<Res<Setup>>,
    generation: Res<Generation>,
    mut followed: ResMut<Followed>,
    mut camera: ResMut<WorldCamera>,
    mut tools: ResMut<Toolbox>,
) {
    let Some(setup) = setup else { return };
    let blueprint = &setup.blueprint;
    if followed.0 == generation.scene {
        return;
    }
    followed.0 = generation.scene;
    camera.set_world(blueprint.domain.size);
    tools.unit = blueprint.scale.detail;
    tools.tool = first_tool(blueprint).unwrap_or(tools.tool);
}

/// The scene's first element.
fn first_tool(blueprint: &Blueprint) -> Option<Tool> {
    let elements = &blueprint.elements;
    let first = blueprint.first_element.as_deref().and_then(|name| elements.find(name));
    let movable = || elements.iter().find(|(_, element)| !element.fixed).map(|(id, _)| id);
    first.or_else(movable).map(Tool::Element)
}

/// An element in hand that the world no longer has, as after an undo, gives way to the scene's first.
pub fn follow_elements(world: &mut World) {
    let (tools, setup) = (world.resource::<Toolbox>(), world.get_resource::<Setup>());
    if let (Tool::Element(id), Some(setup)) = (tools.tool, setup)
        && id.index() >= setup.elements().len()
        && let Some(tool) = first_tool(&setup.blueprint)
    {
        world.resource_mut::<Toolbox>().tool = tool;
    }
}

/// Where the d of the scene is another one, what is in d goes on in that: the picture, the brush and the drag stay in
/// their place.
pub fn follow_detail(world: &mut World) {
    let (size, detail) = match world.get_resource::<Setup>() {
        Some(setup) => (setup.blueprint.domain.size, setup.blueprint.scale.detail),
        None => return,
    };
    let factor = detail / world.resource::<Toolbox>().unit;
    if world.resource::<Followed>().0 != Generation::of(world).scene || factor == 1.0 {
        return;
    }
    world.resource_mut::<WorldCamera>().rescale(size, factor);
    world.resource_mut::<Toolbox>().unit = detail;
    world.resource_mut::<DragState>().rescale(factor);
}
