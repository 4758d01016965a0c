//! What is done with gauges, between ticks.

use crate::{
    game::{
        actions::Action,
        camera::WorldCamera,
        disk, files,
        gauges::{
            desk::{GaugeDesk, Shown},
            grip::{self, Grip, Part},
        },
        hud::panels::gauges::panel::PANEL,
        input::{
            bindings::Bindings,
            pointer::{HudCover, Pointer},
        },
        panels::Panels,
        toasts::Toasts,
    },
    kernel::units::Scale,
    lab::gauges::{
        place::{Place, usual_radius},
        quantity::{Of, QUANTITIES, Quantity},
        set::Gauges,
        table,
    },
    sim::{
        generation::Generation,
        state::{Clock, Setup},
    },
};
use bevy::prelude::{Mut, World};
use glam::Vec2;
use std::{env, path::PathBuf};
use tr::tr;

/// The pointer's pixel, if it is over the world.
fn pointed(world: &World) -> Option<Vec2> {
    let cover = world.resource::<HudCover>();
    world.resource::<Pointer>().at.filter(|pixel| !cover.covers(*pixel))
}

/// Sets a gauge under the pointer, or in the middle of what is seen if that is elsewhere; at the mark of one takes that away.
pub fn set_spot(world: &mut World) {
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let (scale, radius) = (setup.blueprint.scale, usual_radius(setup));
    let camera = world.resource::<WorldCamera>();
    let pixel = pointed(world);
    if let Some(number) = pixel.and_then(|pixel| marked(pixel, world.resource(), camera, scale)) {
        return remove(world, number);
    }
    let pixel = pixel.unwrap_or((camera.free().min + camera.free().max) / 2.0);
    let at = scale.vec_to_metres(camera.to_world(pixel));
    set(world, Place::Spot { at, radius });
}

/// The number of the gauge whose mark is at a pixel.
fn marked(pixel: Vec2, gauges: &Gauges, camera: &WorldCamera, scale: Scale) -> Option<u32> {
    let grip = grip::at(pixel, gauges, camera, scale)?;
    (grip.part == Part::Whole).then_some(grip.number)
}

/// Begins a line under the pointer, or ends it there.
pub fn set_end(world: &mut World) {
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let (scale, key) = (setup.blueprint.scale, world.resource::<Bindings>().key(Action::GaugeLine));
    let Some(pixel) = pointed(world) else {
        let told = tr!("Point at the world: {key} begins a line there, and {key} again ends it", key);
        return world.resource_mut::<Toasts>().say(told);
    };
    let at = scale.vec_to_metres(world.resource::<WorldCamera>().to_world(pixel));
    let scene = Generation::of(world).scene;
    match world.resource::<GaugeDesk>().begun(scene) {
        Some(from) => {
            world.resource_mut::<GaugeDesk>().lay_down();
            set(world, Place::Line { from, to: at });
        }
        None => {
            world.resource_mut::<GaugeDesk>().begin(scene, at);
            let told = tr!("The line begins here: {key} again ends it, Esc lays it down", key);
            world.resource_mut::<Toasts>().say(told);
        }
    }
}

/// Lays down a line that waits for its second end; `false` if none does.
pub fn lay_down(world: &mut World) -> bool {
    world.resource_mut::<GaugeDesk>().lay_down()
}

fn set(world: &mut World, place: Place) {
    let is_set = world.resource_scope(|world, mut gauges: Mut<Gauges>| gauges.set(world, place));
    match is_set {
        Ok(number) => {
            let mut desk = world.resource_mut::<GaugeDesk>();
            desk.selected = Some(number);
            // Who sets a gauge wants to see what it reads.
            let has = |quantity: &Quantity| matches!(quantity.of, Of::Line(_)) == matches!(place, Place::Line { .. });
            if !has(desk.shown.0) {
                desk.shown = QUANTITIES.iter().find(|quantity| has(quantity)).map_or(desk.shown, Shown);
            }
            open(world);
        }
        Err(what) => world.resource_mut::<Toasts>().warn(tr!("No gauge: {}", what)),
    }
}

fn open(world: &mut World) {
    let mut panels = world.resource_mut::<Panels>();
    if !panels.iter().any(|(panel, open)| panel.id == PANEL.id && open) {
        panels.toggle(PANEL.id);
    }
}

/// Lets a gauge stand out, and opens the panel.
pub fn select(world: &mut World, number: u32) {
    world.resource_mut::<GaugeDesk>().selected = Some(number);
    open(world);
}

/// Moves a gauge that is gripped as far as the drag went, d; no line becomes shorter than it can be.
pub fn drag(world: &mut World, grip: Grip, way: Vec2) {
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let scale = setup.blueprint.scale;
    let place = grip.place(scale.vec_to_metres(way), scale.vec_to_metres(setup.blueprint.domain.size));
    world.resource_mut::<GaugeDesk>().selected = Some(grip.number);
    world.resource_scope(|world, mut gauges: Mut<Gauges>| gauges.move_to(world, grip.number, place));
}

/// Takes a gauge away.
pub fn remove(world: &mut World, number: u32) {
    if world.resource_mut::<Gauges>().remove(number) {
        world.resource_mut::<Toasts>().say(tr!("Gauge {} is gone", number));
    }
}

/// Goes along with a world that was put in the place of another, before the ticks of a frame.
pub fn follow(world: &mut World) {
    world.resource_scope(|world, mut gauges: Mut<Gauges>| gauges.follow(world));
}

/// Writes what is kept of the readings as a table, as a screenshot is written.
pub fn save(world: &mut World) {
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let (scene, tick) = (&setup.blueprint.name, world.resource::<Clock>().tick);
    let folder = if cfg!(target_arch = "wasm32") { PathBuf::new() } else { env::current_dir().unwrap_or_default() };
    let path = files::free_path(&folder, scene, tick, "csv");
    let written = disk::give(&path, table::text(world.resource::<Gauges>()).as_bytes());
    let mut toasts = world.resource_mut::<Toasts>();
    match written {
        Ok(()) => toasts.say(tr!("Readings: {}", path.display())),
        Err(error) => toasts.warn(tr!("The readings are not saved: {}: {}", path.display(), error)),
    }
}
