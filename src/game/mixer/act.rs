//! Puts an element of the player's own into the world that is played, and forgets one.

use super::own::{OwnElements, fault};
use crate::{
    game::{
        history,
        language::spoken,
        mixer::desk::MixerDesk,
        toasts::Toasts,
        toolbox::Toolbox,
        tools::{Tool, spaced},
    },
    kernel::element::Element,
    sim::{checkpoint::Checkpoint, new_file::Unwritten, state::Setup},
};
use bevy::prelude::World;
use tr::tr;

/// Puts an element into the world, takes it up and keeps it; one that is there as it is, is only taken up. Undo takes it out of
/// the world again.
pub fn mix(world: &mut World, element: Element) {
    if !world.contains_resource::<Setup>() {
        return;
    }
    let before = Checkpoint::of(world);
    let elements = before.setup.elements();
    let here = elements.find(&element.name);
    if let Some(id) = here.filter(|id| *elements.get(*id) == element) {
        world.resource_mut::<Toolbox>().tool = Tool::Element(id);
        return;
    }
    let mixed = match fault(&element, &world.resource::<MixerDesk>().standard) {
        Some(fault) => Err(fault),
        None => before.clone().with_element(element.clone()),
    };
    let mixed = match mixed {
        Ok(mixed) => mixed,
        Err(fault) => return world.resource_mut::<Toasts>().warn(tr!("No such element: {}", fault)),
    };
    mixed.restore(world);
    history::remember(world, before);
    if let Some(id) = mixed.setup.elements().find(&element.name) {
        world.resource_mut::<Toolbox>().tool = Tool::Element(id);
    }
    let name = spoken(&spaced(&element.name));
    let told = if here.is_some() { tr!("All {} is changed", name) } else { tr!("There is {} now: pour it", name) };
    let kept = world.resource_mut::<OwnElements>().keep(element);
    tell(world, told, kept);
}

/// Forgets an element that was kept. Worlds that have it keep it.
pub fn forget(world: &mut World, name: &str) {
    let forgotten = world.resource_mut::<OwnElements>().forget(name);
    let name = spoken(&spaced(name));
    tell(world, tr!("{} is forgotten: worlds that have it keep it", name), forgotten);
}

fn tell(world: &mut World, told: String, written: Result<(), Unwritten>) {
    let mut toasts = world.resource_mut::<Toasts>();
    match written {
        Ok(()) => toasts.say(told),
        Err(error) => toasts.warn(tr!("{told}, but that is not kept: {error}", told, error)),
    }
}
