//! Small files that keep what the player has chosen from session to session, in the folder of the user's data (in a page, in the
//! browser's storage).

use crate::{
    game::{disk, files},
    sim::new_file::Unwritten,
};
use bevy::log::error;
use ron::ser::PrettyConfig;
use serde::{Serialize, de::DeserializeOwned};
use std::{
    io::{self, ErrorKind},
    path::{Path, PathBuf},
};

/// How the name of a file ends that could not be read as it was.
const UNREAD: &str = "unread.ron";

/// A file of choices; if it is nowhere, they go with the session.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KeptFile(Option<PathBuf>);

impl KeptFile {
    /// That of the user, so that a start from anywhere finds it.
    pub fn of_user(name: &str) -> Self {
        Self(files::folders().pop().map(|folder| folder.join(name)))
    }

    /// One in a folder.
    pub fn of_folder(folder: &Path, name: &str) -> Self {
        Self(Some(folder.join(name)))
    }

    /// What it holds, as `read` takes it; what there is at first if there is no file yet. What is wrong with it is told in a line of
    /// the log, and as it is written anew as soon as something is chosen, it is kept beside.
    pub fn read_by<T: Default>(&self, read: impl FnOnce(&[u8]) -> (T, Option<String>)) -> T {
        let Some(path) = &self.0 else { return T::default() };
        let (value, fault) = match disk::read(path) {
            Ok(bytes) => {
                let (value, fault) = read(&bytes);
                (value, fault.map(|fault| format!("{fault}; {}", keep_beside(path, &bytes))))
            }
            Err(error) if error.kind() == ErrorKind::NotFound => (T::default(), None),
            Err(error) => (T::default(), Some(format!("can't be read: {error}"))),
        };
        if let Some(fault) = fault {
            error!("{}: {fault}", path.display());
        }
        value
    }

    /// What it holds, if `check` has nothing to say against it.
    pub fn read<T: Default + DeserializeOwned>(&self, check: impl FnOnce(&T) -> Result<(), String>) -> T {
        self.read_by(|bytes| match parse(bytes, check) {
            Ok(value) => (value, None),
            Err(fault) => (T::default(), Some(format!("not read, so all is as at first: {fault}"))),
        })
    }

    /// Writes it anew.
    pub fn write(&self, value: &impl Serialize) -> Result<(), Unwritten> {
        let Some(path) = &self.0 else { return Ok(()) };
        let text = ron::ser::to_string_pretty(value, PrettyConfig::default()).map_err(io::Error::other);
        let written = text.and_then(|text| disk::replace(path, text.as_bytes()));
        written.map_err(|error| Unwritten { path: path.clone(), error })
    }
}

/// Keeps a file with a fault under another name, and says which.
fn keep_beside(path: &Path, bytes: &[u8]) -> String {
    let beside = path.with_extension(UNREAD);
    match disk::replace(&beside, bytes) {
        Ok(()) => format!("kept as {}", beside.display()),
        Err(error) => format!("can't be kept as {}: {error}", beside.display()),
    }
}

/// What the bytes of a file say, or in one line what is wrong with them.
pub fn parse<T: DeserializeOwned>(bytes: &[u8], check: impl FnOnce(&T) -> Result<(), String>) -> Result<T, String> {
    let value = ron::de::from_bytes(bytes).map_err(|error| error.to_string())?;
    check(&value)?;
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn what_can_t_be_read_is_kept_beside_what_is_written_next() {
        let folder = std::env::temp_dir().join(format!("powder-kept-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let file = KeptFile::of_folder(&folder, "numbers.ron");
        let read =
            || file.read(|numbers: &Vec<u32>| if numbers.len() < 4 { Ok(()) } else { Err("too many".to_owned()) });
        let text = |name: &str| fs::read_to_string(folder.join(name)).ok();
        assert_eq!(read(), [0; 0], "there is none yet");
        file.write(&vec![1, 2]).unwrap();
        assert_eq!((read(), text("numbers.unread.ron")), (vec![1, 2], None), "a good one is not kept twice");
        for bad in ["[1, 2, 3, 4]", "[1, \"two\"]", ""] {
            fs::write(folder.join("numbers.ron"), bad).unwrap();
            assert_eq!(read(), [0; 0]);
            file.write(&vec![7]).unwrap();
            assert_eq!((read(), text("numbers.unread.ron").as_deref()), (vec![7], Some(bad)));
        }
        fs::remove_dir_all(folder).unwrap();
    }
}
