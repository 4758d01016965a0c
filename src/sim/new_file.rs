//! Files that take the place of an old one in one step, once they are whole.
//!
//! What is written goes into a part file beside it, which is moved over the old one when the disk has all of it. A disk that
//! is full in the middle of it leaves what was there; so does a program that is killed, but for the part file.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, ErrorKind, Write},
    path::{Path, PathBuf},
    process,
};

/// Why a file is not written, in one line: where, what, and what to do.
#[derive(Debug, thiserror::Error)]
#[error("{}: can't be written: {error}{}", path.display(), advice(error.kind()))]
pub struct Unwritten {
    /// Where it should be.
    pub path: PathBuf,
    /// What the system says.
    pub error: io::Error,
}

/// What to do where a file can't be written, behind what the system says of it.
fn advice(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "; what was there is kept: make room, or write to another disk"
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "; write to a folder of your own",
        _ => "",
    }
}

/// A file that is written.
#[derive(Debug)]
pub struct NewFile {
    out: BufWriter<File>,
    /// The part file and the place that it takes in the end; none of a device or a pipe, which has no old content.
    moves: Option<(PathBuf, PathBuf)>,
    /// What the system said first.
    fault: Option<io::Error>,
}

impl NewFile {
    /// Begins a file at `path`. What is there stays until [`finish`](Self::finish).
    ///
    /// # Errors
    /// If the file that is there may not be written, or the folder takes no new one.
    pub fn create(path: &Path) -> io::Result<Self> {
        let old = match OpenOptions::new().write(true).open(path) {
            Ok(file) => Some(file),
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        let about = old.as_ref().map(File::metadata).transpose()?;
        if let (Some(file), Some(about)) = (old, &about)
            && !about.is_file()
        {
            return Ok(Self { out: BufWriter::new(file), moves: None, fault: None });
        }
        // A link stays one: what it leads to is replaced.
        let place = if about.is_some() { fs::canonicalize(path)? } else { path.to_owned() };
        let mut part = place.as_os_str().to_owned();
        part.push(format!(".{}.part", process::id()));
        let part = PathBuf::from(part);
        let out = BufWriter::new(File::create(&part)?);
        let new = Self { out, moves: Some((part, place)), fault: None };
        if let Some(about) = about {
            new.file().set_permissions(about.permissions())?;
        }
        Ok(new)
    }

    /// The open file, for locks.
    pub fn file(&self) -> &File {
        self.out.get_ref()
    }

    /// Why it could not be written, as the system said it: who writes a table or a picture hears of it in that writer's
    /// words.
    pub fn fault(&mut self) -> Option<io::Error> {
        self.fault.take()
    }

    fn note<T>(&mut self, outcome: io::Result<T>) -> io::Result<T> {
        outcome.inspect_err(|error| {
            let fault = error.raw_os_error().map(io::Error::from_raw_os_error);
            self.fault = self.fault.take().or(fault);
        })
    }

    /// Waits until the disk has all of it, puts it in its place, and returns it, still open.
    ///
    /// # Errors
    /// If the disk does not take it. Then what was there is still there.
    pub fn finish(mut self) -> io::Result<File> {
        self.out.flush()?;
        if let Some((part, place)) = &self.moves {
            // Some disks say only now that they are full.
            self.file().sync_all()?;
            fs::rename(part, place)?;
        }
        let file = self.file().try_clone()?;
        self.moves = None;
        Ok(file)
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes);
        self.note(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.out.flush();
        self.note(flushed)
    }
}

impl Drop for NewFile {
    fn drop(&mut self) {
        if let Some((part, _)) = &self.moves {
            // What matters is why it was not finished.
            let _ = fs::remove_file(part);
        }
    }
}

/// Writes a file so that a failure leaves no half of it behind, and nothing lost that was there.
///
/// # Errors
/// If it can't be written.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = NewFile::create(path)?;
    file.write_all(bytes)?;
    file.finish().map(drop)
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    /// An empty folder of a test's own.
    fn folder(name: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("powder-new-file-{name}-{}", process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("the folder of temporary files can be written");
        path
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("it was made");
        let mut names: Vec<_> = entries.map(|entry| entry.expect("it is ours").file_name().into_string()).collect();
        names.sort();
        names.into_iter().map(|name| name.expect("a plain name")).collect()
    }

    #[test]
    fn an_old_file_stays_until_the_new_one_is_whole() {
        let folder = folder("whole");
        let path = folder.join("a.json");
        fs::write(&path, "old").expect("it is ours");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).expect("it is ours");
        let mut file = NewFile::create(&path).expect("it can be written");
        file.write_all(&[b'x'; 100_000]).expect("there is room");
        assert_eq!(fs::read(&path).expect("it is there"), b"old");
        drop(file);
        assert_eq!((names(&folder), fs::read(&path).expect("it is there")), (vec!["a.json".into()], b"old".to_vec()));
        write_whole(&path, b"new").expect("it can be written");
        assert_eq!((names(&folder), fs::read(&path).expect("it is there")), (vec!["a.json".into()], b"new".to_vec()));
        assert_eq!(fs::metadata(&path).expect("it is there").permissions().mode() & 0o777, 0o640, "as it was");
        fs::remove_dir_all(folder).expect("it is ours");
    }

    #[test]
    fn links_stay_links_and_devices_devices() {
        let folder = folder("links");
        let (file, link, device) = (folder.join("file"), folder.join("link"), folder.join("device"));
        fs::write(&file, "old").expect("it is ours");
        symlink(&file, &link).and_then(|()| symlink("/dev/null", &device)).expect("links can be made");
        write_whole(&link, b"new").expect("it can be written");
        write_whole(&device, b"new").expect("it takes anything");
        assert_eq!(fs::read(&file).expect("it is there"), b"new");
        assert!(link.is_symlink() && device.is_symlink());
        assert!(!fs::metadata("/dev/null").expect("a system has one").is_file());
        assert_eq!(names(&folder), ["device", "file", "link"]);
        let error = write_whole(&folder, b"").expect_err("a folder is no file");
        assert_eq!(error.kind(), ErrorKind::IsADirectory);
        fs::remove_dir_all(folder).expect("it is ours");
    }
}
