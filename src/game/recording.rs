//! Recording what the player and the autopilot do, for `run --replay`. The record is that of one scene: where that changes,
//! it is written and ends.

use crate::{
    game::{files, hud::toast::Toasts},
    sim::{
        replay::Recorder,
        state::{Clock, Setup},
    },
};
use bevy::{
    log::error,
    prelude::{Resource, World},
};
use std::{io, path::PathBuf};

/// The file that is recorded to.
#[derive(Resource, Clone, Debug)]
pub struct Recording(PathBuf);

/// Records from now on, the start of a scene, into a file.
pub fn begin(world: &mut World, path: PathBuf) {
    world.insert_resource(Recorder::default());
    world.insert_resource(Recording(path));
}

/// Writes what was recorded so far.
pub fn write(world: &mut World) {
    if let Err(problem) = try_write(world) {
        world.resource_mut::<Toasts>().warn(problem);
    }
}

/// Ends the record before something that it can't hold.
pub fn stop(world: &mut World, before: &str) {
    if !world.contains_resource::<Recording>() {
        return;
    }
    match try_write(world) {
        Ok(()) => world.resource_mut::<Toasts>().warn(format!("The recording ends here, with {before}")),
        Err(problem) => world.resource_mut::<Toasts>().warn(problem),
    }
    world.remove_resource::<Recording>();
    world.remove_resource::<Recorder>();
}

/// Writes the record when the game ends.
pub fn write_at_exit(world: &mut World) {
    if let Err(problem) = try_write(world) {
        error!("{problem}");
    }
}

fn try_write(world: &World) -> Result<(), String> {
    let (Some(Recording(path)), Some(recorder)) = (world.get_resource(), world.get_resource::<Recorder>()) else {
        return Ok(());
    };
    let (setup, clock) = (world.resource::<Setup>(), world.resource::<Clock>());
    let replay = recorder.replay(&setup.blueprint, clock.tick, clock.edits);
    let text = replay.write().map_err(io::Error::from);
    text.and_then(|text| files::write_whole(path, text.as_bytes()))
        .map_err(|error| format!("{}: the recording can't be written: {error}", path.display()))
}
