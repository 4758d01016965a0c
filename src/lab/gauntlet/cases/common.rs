//! What several cases are made with.

use crate::{
    kernel::{
        element::{Element, ElementId, ElementTable},
        random::{mix, unit},
    },
    scene::blueprint::Blueprint,
    sim::{
        intent::{Intent, IntentQueue},
        state::Setup,
    },
};
use bevy::ecs::world::World;
use glam::Vec2;
use std::sync::Arc;

/// What plain PBF does to water that is deep or pressed hard.
pub(super) const BOILS: &str = "plain PBF carries pressure a few particles down an iteration; water that is deeper than some 27 \
     particles, or pressed as hard, is crushed and boils";

/// What plain PBF does to water at rest.
pub(super) const TREMBLES: &str =
    "plain PBF takes every correction for motion, and water at rest trembles at .06 to .10 d a tick";

/// The element called `name`; every table has those of the built-in scenes.
pub(super) fn element(elements: &ElementTable, name: &str) -> ElementId {
    elements.find(name).unwrap_or_default()
}

/// Adds a particle of water, at a place and a velocity in m.
pub(super) fn water(blueprint: &mut Blueprint, at: Vec2, velocity: Vec2) {
    let id = element(&blueprint.elements, "water");
    let (at, velocity) = (blueprint.scale.vec_to_kernel(at), blueprint.scale.vec_to_kernel(velocity));
    blueprint.particles.push(blueprint.next_id, id, at, velocity);
    blueprint.next_id += 1;
}

/// Changes what water is.
pub(super) fn change_water(blueprint: &mut Blueprint, change: impl Fn(&mut Element)) {
    let mut rows: Vec<Element> = blueprint.elements.iter().map(|(_, element)| element.clone()).collect();
    rows.iter_mut().filter(|row| row.name == "water").for_each(change);
    blueprint.elements = Arc::new(ElementTable::new(rows));
}

/// Two numbers in −½ … ½ that belong to `seed`.
pub(super) fn noise(seed: u32) -> Vec2 {
    let mixed = mix(seed);
    Vec2::new(unit(mixed), unit(mixed >> 16)) * 0.5
}

/// Puts an intent in the queue.
pub(super) fn intend(world: &mut World, intent: Intent) {
    world.resource_mut::<IntentQueue>().push(intent);
}

/// Size of the box, d.
pub(super) fn size(world: &World) -> Vec2 {
    world.resource::<Setup>().blueprint.domain.size
}
