//! How loud the game is: chosen in the bar, kept from session to session.

use crate::game::kept::KeptFile;
use bevy::{
    log::error,
    prelude::{DetectChangesMut, ResMut, Resource},
};
use serde::{Deserialize, Serialize};

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

impl Kept {
    fn check(&self) -> Result<(), String> {
        let fits = (0.0..=1.0).contains(&self.level);
        if fits { Ok(()) } else { Err(format!("level {}; allowed: 0 … 1", self.level)) }
    }
}

/// How loud the game is.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Volume {
    now: Kept,
    kept: Kept,
    file: KeptFile,
}

impl Volume {
    /// That of the user. What is wrong with the file is told in a line of the log.
    pub fn of_user() -> Self {
        Self::of_file(KeptFile::of_user(FILE))
    }

    fn of_file(file: KeptFile) -> Self {
        let kept = file.read(Kept::check);
        Self { now: kept, kept, file }
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
}

/// Keeps what changed. What can't be kept is told once, and holds for the session.
pub fn keep(mut volume: ResMut<Volume>) {
    let volume = volume.bypass_change_detection();
    if volume.now == volume.kept {
        return;
    }
    volume.kept = volume.now;
    if let Err(error) = volume.file.write(&volume.now) {
        error!("{error}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::kept::parse;
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
        world.insert_resource(Volume::of_file(KeptFile::of_folder(&folder, FILE)));
        world.run_system_once(keep).unwrap();
        assert!(!folder.exists(), "nothing changed, so nothing is written");
        world.resource_mut::<Volume>().set(0.25);
        world.resource_mut::<Volume>().toggle();
        world.run_system_once(keep).unwrap();
        let again = Volume::of_file(KeptFile::of_folder(&folder, FILE));
        assert_eq!((again.level(), again.is_muted()), (0.25, true));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_damaged_file_is_left_out() {
        for damaged in
            [&b""[..], b"(level: 2.0, muted: false)", b"(level: nan, muted: false)", b"(muted: true)", b"\xff"]
        {
            assert!(parse(damaged, Kept::check).is_err_and(|fault| fault.lines().count() == 1), "{damaged:?}");
        }
        assert_eq!(parse(b"(level: 0.5, muted: true)", Kept::check), Ok(Kept { level: 0.5, muted: true }));
    }
}
