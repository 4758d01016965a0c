//! Where the game's files are: a disk, or in a page the browser's own storage.

#[cfg(not(target_arch = "wasm32"))]
mod native {
    use crate::sim::new_file::write_whole;
    use std::{
        fs::{self, File},
        io::{self, Read},
        path::{Path, PathBuf},
        time::SystemTime,
    };

    /// Largest file that is read, bytes: more than the largest that is written.
    const LARGEST: u64 = 1 << 30;

    /// The bytes of a file. What a player drops on the window may be anything.
    pub fn read(path: &Path) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        File::open(path)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
        let fits = bytes.len() as u64 <= LARGEST;
        if fits { Ok(bytes) } else { Err(io::Error::other(format!("larger than {} MiB", LARGEST >> 20))) }
    }

    /// Writes a file into a folder, which is made if there is none.
    pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        write_whole(path, bytes)
    }

    /// Whether there is such a file.
    pub fn exists(path: &Path) -> bool {
        path.exists()
    }

    /// The files of a folder and when each was written.
    pub fn list(folder: &Path) -> Vec<(PathBuf, SystemTime)> {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        entries.filter_map(|entry| Some((entry.path(), entry.metadata().ok()?.modified().ok()?))).collect()
    }

    /// The time by which files are dated.
    pub fn now() -> SystemTime {
        SystemTime::now()
    }

    /// Gives the player a new file to look at, such as a picture.
    pub fn give(path: &Path, bytes: &[u8]) -> io::Result<()> {
        write(path, bytes)
    }
}

#[cfg(target_arch = "wasm32")]
mod browser {
    use std::{
        collections::BTreeMap,
        io,
        path::{Path, PathBuf},
        sync::{Mutex, MutexGuard, PoisonError},
        time::{Duration, SystemTime},
    };
    use wasm_bindgen::prelude::wasm_bindgen;

    // What the page's script does with files (`web/page.js`).
    #[wasm_bindgen(js_namespace = powderHost)]
    extern "C" {
        /// Keeps a file in the browser's own storage. That it could not, or calls it otherwise, is told later (`web::hook`).
        fn keep(path: &str, bytes: &[u8], written: f64);

        /// The same in place of the file that has this name.
        #[wasm_bindgen(js_name = replace)]
        fn keep_instead(path: &str, bytes: &[u8], written: f64);

        /// Gives the player a file, as a download.
        fn download(name: &str, bytes: &[u8]);

        /// Lets the player choose files of the device, which the game is given like those that are dropped (`web::hook`).
        pub fn choose();
    }

    /// The files, as the browser's storage has them: read before the game starts, kept up as it writes.
    static FILES: Mutex<BTreeMap<PathBuf, (Vec<u8>, SystemTime)>> = Mutex::new(BTreeMap::new());

    fn files() -> MutexGuard<'static, BTreeMap<PathBuf, (Vec<u8>, SystemTime)>> {
        FILES.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn time(milliseconds: f64) -> SystemTime {
        SystemTime::UNIX_EPOCH + Duration::from_secs_f64(milliseconds.max(0.0) / 1000.0)
    }

    /// Puts a file where it was: from the browser's storage, before the game starts. `written` is in milliseconds of
    /// the Unix epoch.
    #[wasm_bindgen]
    pub fn restore(path: String, bytes: Vec<u8>, written: f64) {
        files().insert(PathBuf::from(path), (bytes, time(written)));
    }

    /// Calls a file otherwise.
    pub fn rename(path: &Path, new: &Path) {
        let mut files = files();
        if let Some(file) = files.remove(path) {
            files.insert(new.to_owned(), file);
        }
    }

    /// The bytes of a file.
    pub fn read(path: &Path) -> io::Result<Vec<u8>> {
        files().get(path).map(|(bytes, _)| bytes.clone()).ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    /// Writes a new file.
    pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
        write_by(keep, path, bytes)
    }

    /// Writes a file in place of what was there.
    pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
        write_by(keep_instead, path, bytes)
    }

    fn write_by(host: fn(&str, &[u8], f64), path: &Path, bytes: &[u8]) -> io::Result<()> {
        let written = js_sys::Date::now();
        host(&path.to_string_lossy(), bytes, written);
        files().insert(path.to_owned(), (bytes.to_vec(), time(written)));
        Ok(())
    }

    /// Whether there is such a file.
    pub fn exists(path: &Path) -> bool {
        files().contains_key(path)
    }

    /// The files of a folder and when each was written.
    pub fn list(folder: &Path) -> Vec<(PathBuf, SystemTime)> {
        let inside = |path: &Path| path.parent() == Some(folder);
        files().iter().filter(|(path, _)| inside(path)).map(|(path, (_, written))| (path.clone(), *written)).collect()
    }

    /// The time by which files are dated.
    pub fn now() -> SystemTime {
        time(js_sys::Date::now())
    }

    /// Gives the player a new file to look at, such as a picture: a download.
    pub fn give(path: &Path, bytes: &[u8]) -> io::Result<()> {
        download(&path.file_name().unwrap_or_default().to_string_lossy(), bytes);
        Ok(())
    }
}

#[cfg(target_arch = "wasm32")]
pub use browser::{choose, exists, give, list, now, read, rename, replace, write};
#[cfg(not(target_arch = "wasm32"))]
pub use native::{exists, give, list, now, read, write, write as replace};
