//! Files from which a long command goes on that was stopped.

use crate::{
    cli::{failure::Failure, start::read},
    sim::{new_file::NewFile, snapshot::hash_bytes},
};
use std::{
    fs::{self, File, OpenOptions, TryLockError},
    io::{self, Write},
    path::{Path, PathBuf},
};

/// What a journal knows this build by: results of another are not mixed with its own.
pub(super) fn program() -> String {
    let build = std::env::current_exe().and_then(fs::read).map_or(0, |bytes| hash_bytes(&bytes));
    format!("{} {build:016x}", env!("CARGO_PKG_VERSION"))
}

/// A journal that holds one state, replaced whole: a program that is killed, or a disk that is full, leaves the one before.
pub(super) struct StateFile {
    path: PathBuf,
    /// Holds the lock. It ends with the process, however that ends.
    file: File,
}

impl StateFile {
    /// Opens the file at `path`, or makes it, and locks it; with what it holds, empty if it is new.
    pub(super) fn open(path: &Path) -> Result<(Self, Vec<u8>), Failure> {
        let unwritten = |error: io::Error| Failure::unwritten(path, error);
        let file = OpenOptions::new().read(true).append(true).create(true).open(path).map_err(unwritten)?;
        lock(&file, path)?;
        Ok((Self { path: path.to_owned(), file }, read(path)?))
    }

    /// Puts another state in the place of the last, in one step.
    pub(super) fn replace(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let written = || -> Result<File, io::Error> {
            let mut new = NewFile::create(&self.path)?;
            new.write_all(bytes)?;
            new.finish()
        };
        let file = written().map_err(|error| Failure::unwritten(&self.path, error))?;
        lock(&file, &self.path)?;
        self.file = file;
        Ok(())
    }
}

fn lock(file: &File, path: &Path) -> Result<(), Failure> {
    match file.try_lock() {
        Ok(()) => Ok(()),
        // A file system without locks.
        Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => Ok(()),
        Err(TryLockError::Error(error)) => Err(Failure::unwritten(path, error)),
        Err(TryLockError::WouldBlock) => Err(Failure::Usage(format!(
            "{}: another run writes here; allowed: to wait for its end, or another file",
            path.display()
        ))),
    }
}
