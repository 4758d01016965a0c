//! The stars that the player has earned, kept from session to session. One that is earned stays, whatever comes after.

use crate::{
    game::kept::KeptFile,
    scene::challenges::challenges,
    sim::{judge::Stars, new_file::Unwritten},
};
use bevy::prelude::Resource;
use std::{collections::BTreeMap, path::Path};

/// The file that they are kept in.
const FILE: &str = "challenges.ron";

/// Stars by the names of their challenges.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Earned {
    stars: BTreeMap<String, Stars>,
    file: KeptFile,
}

impl Earned {
    /// Those of the user. What is wrong with the file is told in a line of the log.
    pub fn of_user() -> Self {
        Self::of_file(KeptFile::of_user(FILE))
    }

    /// Those that a folder keeps, or none yet.
    pub fn of_folder(folder: &Path) -> Self {
        Self::of_file(KeptFile::of_folder(folder, FILE))
    }

    fn of_file(file: KeptFile) -> Self {
        Self { stars: file.read(|_| Ok(())), file }
    }

    /// Those of a challenge.
    pub fn of(&self, name: &str) -> Stars {
        self.stars.get(name).copied().unwrap_or_default()
    }

    /// How many there are, of how many that can be had.
    pub fn count(&self) -> (usize, usize) {
        let all = challenges().unwrap_or_default();
        (all.iter().map(|challenge| self.of(&challenge.name).count()).sum(), 3 * all.len())
    }

    /// Adds those that were earned, and keeps them.
    ///
    /// # Errors
    /// If they can't be kept for the next session.
    pub fn add(&mut self, name: &str, stars: Stars) -> Result<(), Unwritten> {
        let before = self.of(name);
        self.stars.insert(name.to_owned(), before.with(stars));
        if self.of(name) == before { Ok(()) } else { self.file.write(&self.stars) }
    }
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn they_outlive_the_session_and_add_up() {
        let folder = std::env::temp_dir().join(format!("powder-challenges-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        let mut earned = Earned::of_folder(&folder);
        assert_eq!((earned.of("cup"), earned.count().0), (Stars::default(), 0));
        let few = Stars { done: true, particles: true, strokes: false };
        earned.add("cup", few).expect("the folder of temporary files can be written");
        earned.add("cup", Stars { done: true, particles: false, strokes: true }).expect("so it can again");
        let again = Earned::of_folder(&folder);
        assert_eq!((again.of("cup"), again.count().0), (Stars::ALL, 3), "a star that is earned stays");
        assert_eq!(again.of("oil"), Stars::default());
        fs::write(folder.join(FILE), "{ \"cup\": 7").expect("it is ours");
        assert_eq!(Earned::of_folder(&folder).count().0, 0, "a damaged file holds none");
        fs::remove_dir_all(folder).expect("it is ours");
    }
}
