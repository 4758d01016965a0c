//! Springs and drains, which a brush sets: what flows on, and what takes all that moves, after the hand has gone.

use crate::{
    game::{
        history,
        language::spoken,
        toasts::Toasts,
        toolbox::Toolbox,
        tools::{Tool, spaced},
    },
    kernel::{brush::Stroke, element::ElementId, sources::Rect},
    scene::blueprint::Blueprint,
    sim::{
        control,
        intent::Intent,
        state::{Setup, Sources},
    },
};
use bevy::prelude::{MouseButton, World};
use tr::tr;

/// What a press does where the brush is: the left button sets a spring of the element, the right one a drain; where there is a spring or a
/// drain already, both take that away. If it can't be, why.
fn press(
    button: MouseButton,
    element: ElementId,
    stroke: Stroke,
    (sources, scene): (&Sources, &Blueprint),
) -> Result<Intent, String> {
    let (area, elements) = (Rect::under(&stroke), &scene.elements);
    if areas(sources).any(|(other, _)| other.meets(area)) {
        return Ok(Intent::RemoveSources { stroke });
    }
    let is_spring = button == MouseButton::Left;
    let count = if is_spring { sources.emitters.len() } else { sources.drains.len() };
    if is_spring && elements.get(element).fixed {
        let name = spoken(&spaced(&elements.get(element).name));
        return Err(tr!("No spring: {} does not flow", name));
    }
    if count >= Sources::MOST {
        return Err(tr!("There are {} already: a press on one takes it away", Sources::MOST));
    }
    if !Sources::fits(area, scene) {
        return Err(tr!("Too large: draw a smaller rectangle"));
    }
    Ok(if is_spring { Intent::SetEmitter { element, stroke } } else { Intent::SetDrain { stroke } })
}

/// Where the springs and drains are, d, and of what each spring is.
pub fn areas(sources: &Sources) -> impl Iterator<Item = (Rect, Option<ElementId>)> {
    let springs = sources.emitters.iter().map(|emitter| (emitter.area, Some(emitter.element)));
    springs.chain(sources.drains.iter().map(|drain| (drain.area, None)))
}

/// Does what a press of a button does under a brush.
pub fn set(world: &mut World, button: MouseButton, stroke: Stroke) {
    let (Tool::Element(element), Some(setup)) = (world.resource::<Toolbox>().tool, world.get_resource::<Setup>())
    else {
        return;
    };
    match press(button, element, stroke, (world.resource(), &setup.blueprint)) {
        Ok(intent) => {
            history::checkpoint(world);
            control::edit(world, intent);
        }
        Err(why) => world.resource_mut::<Toasts>().say(why),
    }
}
