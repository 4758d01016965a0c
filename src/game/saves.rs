//! Saving worlds while playing, and the list of saved ones. `opening` loads them.

use crate::{
    game::{
        disk,
        files::{self, SAVE_ENDING},
        toasts::Toasts,
    },
    sim::{
        checkpoint::Checkpoint,
        file::FileError,
        state::{Clock, Setup},
    },
};
use bevy::prelude::{Resource, World};
use std::{
    io,
    path::{Path, PathBuf},
    time::SystemTime,
};
use tr::tr;

/// Folders that save files are in; new ones go into the first that can be written.
#[derive(Resource, Clone, Debug)]
pub struct SaveFolders(pub Vec<PathBuf>);

impl Default for SaveFolders {
    fn default() -> Self {
        Self(files::folders())
    }
}

/// Why a file is not loaded.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// It can't be read.
    #[error("can't be read: {0}")]
    Unread(#[from] io::Error),
    /// It is no sound save file.
    #[error(transparent)]
    Bad(#[from] FileError),
}

/// What a save file holds, for the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summary {
    /// Title of the scene.
    pub title: String,
    /// Its tick.
    pub tick: u64,
    /// Particles, rock included.
    pub particles: usize,
}

impl Summary {
    /// Reads the file at `path` to the end, as loading it would.
    pub fn read(path: &Path) -> Result<Self, LoadError> {
        let saved = read(path)?;
        let state = &saved.state;
        Ok(Self {
            title: saved.setup.blueprint.title.clone(),
            tick: state.clock.tick,
            particles: state.particles.len() + state.solids.count(),
        })
    }
}

/// The save files in `folders` and when each was written, newest first.
pub fn list(folders: &[PathBuf]) -> Vec<(PathBuf, SystemTime)> {
    let files = folders.iter().flat_map(|folder| disk::list(folder));
    let mut saves: Vec<_> =
        files.filter(|(path, _)| path.extension().is_some_and(|ending| ending == SAVE_ENDING)).collect();
    saves.sort_by(|(a, written_a), (b, written_b)| written_b.cmp(written_a).then_with(|| a.cmp(b)));
    saves
}

/// Writes the world into a new file and says where.
pub fn save(world: &mut World) {
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let (folders, tick) = (&world.resource::<SaveFolders>().0, world.resource::<Clock>().tick);
    let written = files::write_new(folders, &setup.blueprint.name, tick, SAVE_ENDING, &Checkpoint::of(world).encode());
    let mut toasts = world.resource_mut::<Toasts>();
    match written {
        Ok(path) => toasts.say(tr!("Saved: {}", path.display())),
        Err(error) => toasts.warn(tr!("Not saved: {}", error)),
    }
}

fn read(path: &Path) -> Result<Checkpoint, LoadError> {
    Ok(Checkpoint::decode(&disk::read(path)?)?)
}
