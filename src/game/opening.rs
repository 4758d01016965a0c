//! Opens whatever file a player hands to the game, from the list of saves, dropped or pasted: a save file, a picture that
//! carries a world, a recording or a scene. The world at hand can be had back with undo; a bad file changes nothing.

use crate::{
    game::{disk, history, playback, toasts::Toasts},
    lab::autopilot::Autopilot,
    scene::{self, SceneError, SceneFile, effects::EffectModes, readers},
    sim::{checkpoint::Checkpoint, file::FileError, pace::Pace, picture, recording::Recording, state::Setup},
};
use bevy::prelude::World;
use std::{io, path::Path, sync::Arc};
use tr::tr;

/// Why a file is not opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// It can't be read.
    #[error("can't be read: {0}")]
    Unread(#[from] io::Error),
    /// It is none that the game knows.
    #[error("not a save file, picture, recording or scene (.ron) of Powder Master")]
    Foreign,
    /// It is no sound save file, picture or recording.
    #[error(transparent)]
    Bad(FileError),
    /// It is no sound scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl From<FileError> for OpenError {
    fn from(error: FileError) -> Self {
        if matches!(error, FileError::Foreign(_)) { Self::Foreign } else { Self::Bad(error) }
    }
}

/// What a file holds.
enum Contents {
    World(Checkpoint),
    Recording(Recording, Checkpoint),
}

/// Opens the file at a path.
pub fn open_file(world: &mut World, path: &Path) {
    let contents = if is_scene(path) {
        // By its path, as it may name pictures that are beside it.
        scene::load(&path.to_string_lossy()).map_err(OpenError::from).and_then(|scene| begin(world, &scene))
    } else {
        disk::read(path).map_err(OpenError::from).and_then(|bytes| read(&bytes))
    };
    open(world, path, contents);
}

/// Opens what a page was given: a file's name and its bytes.
pub fn open_bytes(world: &mut World, name: &str, bytes: &[u8]) {
    let contents = if is_scene(Path::new(name)) {
        readers::scene(bytes).map_err(OpenError::from).and_then(|scene| begin(world, &scene))
    } else {
        read(bytes)
    };
    open(world, Path::new(name), contents);
}

fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ron"))
}

/// The start of a scene at the quality that is in force.
fn begin(world: &World, scene: &SceneFile) -> Result<Contents, OpenError> {
    let preset = world.get_resource::<Setup>().map(|setup| setup.preset);
    let blueprint = scene.build(&[], preset, &EffectModes::new())?;
    Ok(Contents::World(Checkpoint::of_scene(Arc::new(blueprint))))
}

/// Reads what is no scene.
fn read(bytes: &[u8]) -> Result<Contents, OpenError> {
    if !Recording::is_meant(bytes) {
        return Ok(Contents::World(picture::read_world(bytes)?));
    }
    let recording = Recording::decode(bytes)?;
    let start = recording.segments[0].start()?;
    Ok(Contents::Recording(recording, start))
}

fn open(world: &mut World, path: &Path, contents: Result<Contents, OpenError>) {
    let name = path.file_name().unwrap_or(path.as_os_str()).display();
    let told = match contents {
        Ok(Contents::World(saved)) => {
            history::checkpoint(world);
            saved.restore(world);
            tr!("Loaded: {} (undo goes back)", name)
        }
        Ok(Contents::Recording(recording, start)) => {
            history::checkpoint(world);
            start.restore(world);
            // Another quality than the recorded one would leave the recording.
            world.resource_mut::<Autopilot>().hold(None);
            playback::begin(world, recording);
            let pace = *world.resource::<Pace>();
            *world.resource_mut::<Pace>() = Pace { paused: false, steps_due: 0, ..pace };
            tr!("Showing: {} (undo goes back)", name)
        }
        Err(error) => {
            world.resource_mut::<Toasts>().warn(format!("{name}: {error}"));
            return;
        }
    };
    world.resource_mut::<Toasts>().say(told);
}
