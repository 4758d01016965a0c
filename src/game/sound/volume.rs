//! How loud the game is: chosen in the bar, kept from session to session.

use crate::{
    game::{disk, files},
    sim::new_file::Unwritten,
};
use bevy::{
    log::error,
    prelude::{DetectChangesMut, ResMut, Resource},
};
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};
use std::{
    io::{self, ErrorKind},
    path::{Path, PathBuf},
};

/// The file that it is kept in.
const FILE: &str = "sound.ron";

/// What is kept.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Kept {
    /// 0 … 1.
    level: f32,
    muted: bool,
}

impl Default for Kept {
    fn default() -> Self {
        Self { level: 0.7, muted: false }
    }
}

/// How loud the game is.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Volume {
    now: Kept,
    kept: Kept,
    /// Where that is kept; if nowhere, it goes with the session.
    file: Option<PathBuf>,
}

impl Volume {
    /// That of the user, in the folder of the user's data. What is wrong with the file is told in a line of the log.
    pub fn of_user() -> Self {
        files::folders().pop().map_or_else(Self::default, |folder| Self::of_folder(&folder))
    }

    fn of_folder(folder: &Path) -> Self {
        let path = folder.join(FILE);
        let kept = match disk::read(&path) {
            Ok(bytes) => read(&bytes).unwrap_or_else(|fault| {
                error!("{}: not read, so sound is as at first: {fault}", path.display());
                Kept::default()
            }),
            Err(fault) => {
                if fault.kind() != ErrorKind::NotFound {
                    error!("{}: can't be read: {fault}", path.display());
                }
                Kept::default()
            }
        };
        Self { now: kept, kept, file: Some(path) }
    }

    /// Where the slider stands, 0 … 1, muted or not.
    pub fn level(&self) -> f32 {
        self.now.level
    }

    /// Moves the slider, 0 … 1. Who moves it wants to hear something.
    pub fn set(&mut self, level: f32) {
        self.now = Kept { level: level.clamp(0.0, 1.0), muted: false };
    }

    /// Whether it is switched off.
    pub fn is_muted(&self) -> bool {
        self.now.muted
    }

    /// Switches it off, and on again.
    pub fn toggle(&mut self) {
        self.now.muted = !self.now.muted;
    }

    /// By what all is multiplied: the square of the slider's place, which is about as loud as that seems. 0 if nothing is to be
    /// heard.
    pub fn gain(&self) -> f32 {
        if self.now.muted { 0.0 } else { self.now.level * self.now.level }
    }

    fn write(&self) -> Result<(), Unwritten> {
        let Some(path) = &self.file else { return Ok(()) };
        let text = ron::ser::to_string_pretty(&self.now, PrettyConfig::default()).map_err(io::Error::other);
        let written = text.and_then(|text| disk::replace(path, text.as_bytes()));
        written.map_err(|error| Unwritten { path: path.clone(), error })
    }
}

/// What a file has kept.
fn read(bytes: &[u8]) -> Result<Kept, String> {
    let kept: Kept = ron::de::from_bytes(bytes).map_err(|error| error.to_string())?;
    if !(0.0..=1.0).contains(&kept.level) {
        return Err(format!("level {}; allowed: 0 … 1", kept.level));
    }
    Ok(kept)
}

/// Keeps what changed. What can't be kept is told once, and holds for the session.
pub fn keep(mut volume: ResMut<Volume>) {
    let volume = volume.bypass_change_detection();
    if volume.now == volume.kept {
        return;
    }
    volume.kept = volume.now;
    if let Err(error) = volume.write() {
        error!("{error}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy::{ecs::system::RunSystemOnce, prelude::World};
    use std::fs;

    #[test]
    fn a_muted_game_is_silent_and_one_whose_slider_moves_is_not_muted() {
        let mut volume = Volume::default();
        assert!(volume.gain() > 0.0 && !volume.is_muted());
        volume.toggle();
        assert_eq!(volume.gain(), 0.0);
        volume.set(1.5);
        assert_eq!((volume.gain(), volume.is_muted()), (1.0, false));
        volume.set(0.0);
        assert_eq!(volume.gain(), 0.0);
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn it_outlives_the_session() {
        let folder = std::env::temp_dir().join(format!("powder-volume-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        let mut world = World::new();
        world.insert_resource(Volume::of_folder(&folder));
        world.run_system_once(keep).unwrap();
        assert!(!folder.exists(), "nothing changed, so nothing is written");
        world.resource_mut::<Volume>().set(0.25);
        world.resource_mut::<Volume>().toggle();
        world.run_system_once(keep).unwrap();
        let again = Volume::of_folder(&folder);
        assert_eq!((again.level(), again.is_muted()), (0.25, true));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_damaged_file_is_left_out() {
        for damaged in
            [&b""[..], b"(level: 2.0, muted: false)", b"(level: nan, muted: false)", b"(muted: true)", b"\xff"]
        {
            assert!(read(damaged).is_err_and(|fault| fault.lines().count() == 1), "{damaged:?}");
        }
        assert_eq!(read(b"(level: 0.5, muted: true)"), Ok(Kept { level: 0.5, muted: true }));
    }
}
