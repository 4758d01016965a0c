//! The files that the game writes by itself: where they go and what they are called.

use crate::{game::disk, sim::new_file::Unwritten};
use std::{
    io,
    path::{Path, PathBuf},
};

/// Ending of save files.
pub const SAVE_ENDING: &str = "pms";
/// Longest part of a file's name that comes from the scene.
const NAME_LIMIT: usize = 60;

/// The folders that the game's files may be in: the one that it runs in, and the system's one for a user's data where
/// that can't be written.
pub fn folders() -> Vec<PathBuf> {
    #[cfg(target_arch = "wasm32")]
    let folders = vec![PathBuf::from("saved worlds")];
    #[cfg(not(target_arch = "wasm32"))]
    let folders = {
        let data = directories::BaseDirs::new().map(|folders| folders.data_dir().join("powder-master"));
        std::env::current_dir().ok().into_iter().chain(data).collect()
    };
    folders
}

/// Writes a new file into the first folder that takes it, and says where; or why the last one does not.
pub fn write_new(
    folders: &[PathBuf],
    scene: &str,
    tick: u64,
    ending: &str,
    bytes: &[u8],
) -> Result<PathBuf, Unwritten> {
    let mut refusal = Unwritten { path: PathBuf::new(), error: io::Error::other("there is no folder to write to") };
    for folder in folders {
        let path = free_path(folder, scene, tick, ending);
        match disk::write(&path, bytes) {
            Ok(()) => return Ok(path),
            Err(error) => refusal = Unwritten { path, error },
        }
    }
    Err(refusal)
}

/// A name in `folder` that is not taken yet.
pub fn free_path(folder: &Path, scene: &str, tick: u64, ending: &str) -> PathBuf {
    // A scene may be named anything, a file not.
    let fit = |letter: char| if letter.is_alphanumeric() || letter == '_' { letter } else { '-' };
    let scene: String = scene.chars().take(NAME_LIMIT).map(fit).collect();
    let mut path = folder.join(format!("powder-{scene}-{tick}.{ending}"));
    let mut number = 2;
    while disk::exists(&path) {
        path = folder.join(format!("powder-{scene}-{tick}-{number}.{ending}"));
        number += 1;
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn files_never_replace_each_other_and_stay_in_their_folder() {
        let folder = std::env::temp_dir().join(format!("powder-files-{}", std::process::id()));
        let folders = [PathBuf::from("/dev/null/nowhere"), folder.clone()];
        let first = write_new(&folders, "../a b", 7, "pms", b"one").expect("the second folder takes it");
        let second = write_new(&folders, "../a b", 7, "pms", b"two").expect("so it does again");
        assert_eq!(first, folder.join("powder----a-b-7.pms"));
        assert_eq!(second, folder.join("powder----a-b-7-2.pms"));
        assert_eq!(fs::read(&first).expect("it was written"), b"one");
        assert_eq!(fs::read_dir(&folder).expect("it was made").count(), 2, "nothing else is left behind");
        fs::remove_dir_all(&folder).expect("it is ours");
        assert!(write_new(&folders[..1], "a", 7, "pms", b"").is_err());
    }
}
