//! What the files of worlds have in common: a first line, a version, a checksum, and what can be wrong with them.

use crate::{
    kernel::particles::Particles,
    scene::{KNOBS, effects::Effect},
    sim::snapshot::hash_bytes,
};
use serde::{Serialize, de::DeserializeOwned};

/// Version of the format of save files and of recordings. Columns, effects and knobs that are added raise it by themselves;
/// raise the first number when anything else that they hold changes. Old files are refused, not misread.
pub(crate) const VERSION: u16 = 700 + (Particles::COLUMNS.len() + Effect::ALL.len() + KNOBS.len()) as u16;

/// Why a file is not taken, in one line. The text is what kind of file it is.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileError {
    /// Something else.
    #[error("not a {0} of Powder Master")]
    Foreign(&'static str),
    /// Written by another version, of this format.
    #[error("a {0} of format {1}; this program reads format {2}")]
    Version(&'static str, u16, u16),
    /// Cut or changed.
    #[error("the {0} is damaged: {1}")]
    Damaged(&'static str, String),
    /// It holds what no world has, or what can't have been.
    #[error("the {0} is not sound: {1}")]
    Unsound(&'static str, String),
    /// A picture, but no world is in it.
    #[error("a picture without a world; programs that shrink or convert pictures take the world out of them")]
    Bare,
    /// A state in a recording is no good save file.
    #[error("a state in the recording: {0}")]
    State(Box<FileError>),
}

/// A kind of file.
pub(crate) struct Kind {
    /// Its name in messages.
    pub name: &'static str,
    /// Its first line.
    pub magic: &'static [u8],
    /// Version of its format.
    pub version: u16,
}

impl Kind {
    /// The beginning of a file.
    pub fn begin(&self) -> Vec<u8> {
        [self.magic, &self.version.to_le_bytes()].concat()
    }

    /// What stands behind the beginning of a file.
    pub fn open<'a>(&self, bytes: &'a [u8]) -> Result<&'a [u8], FileError> {
        let rest = bytes.strip_prefix(self.magic).ok_or_else(|| {
            if !bytes.is_empty() && self.magic.starts_with(bytes) {
                self.damaged("it ends in its first line")
            } else {
                FileError::Foreign(self.name)
            }
        })?;
        let (version, rest) = rest.split_first_chunk().ok_or_else(|| self.damaged("it ends in its header"))?;
        match u16::from_le_bytes(*version) {
            found if found == self.version => Ok(rest),
            found => Err(FileError::Version(self.name, found, self.version)),
        }
    }

    /// A file that holds `contents` behind a checksum.
    pub fn seal(&self, contents: &impl Serialize) -> Vec<u8> {
        // Writing to memory has no way to fail, and every length is known.
        let body = postcard::to_stdvec(contents).unwrap_or_default();
        let mut bytes = self.begin();
        bytes.extend(hash_bytes(&body).to_le_bytes());
        bytes.extend(body);
        bytes
    }

    /// What [`Self::seal`] put into a file, and its checksum.
    pub fn unseal<T: DeserializeOwned>(&self, bytes: &[u8]) -> Result<(T, u64), FileError> {
        let rest = self.open(bytes)?;
        let (hash, body) = rest.split_first_chunk().ok_or_else(|| self.damaged("it ends in its header"))?;
        let hash = u64::from_le_bytes(*hash);
        if hash != hash_bytes(body) {
            return Err(self.damaged("its contents do not fit its checksum"));
        }
        let (contents, left) = postcard::take_from_bytes(body).map_err(|error| self.damaged(error))?;
        if !left.is_empty() {
            return Err(self.damaged("something stands behind its end"));
        }
        Ok((contents, hash))
    }

    /// The error for a file that was cut or changed.
    pub fn damaged(&self, what: impl ToString) -> FileError {
        FileError::Damaged(self.name, what.to_string())
    }

    /// The error for a file that holds what can't be.
    pub fn unsound(&self, what: String) -> FileError {
        FileError::Unsound(self.name, what)
    }
}
