//! The shelf: the last stamps, kept from session to session as a file each.

use crate::{
    game::{disk, files},
    sim::{
        new_file::Unwritten,
        stamp::{STAMP_ENDING, Stamp},
    },
};
use bevy::{log::error, prelude::Resource};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

/// Most stamps that are kept.
pub const MOST: usize = 12;
/// The folder that they are in, in that of the user's data.
const FOLDER: &str = "stamps";

/// A stamp that is kept.
#[derive(Clone, Debug)]
pub struct Kept {
    /// Its number in this session; unique.
    pub number: u64,
    /// The stamp.
    pub stamp: Arc<Stamp>,
    /// Its file, if it has one.
    file: Option<PathBuf>,
}

/// One number is one stamp.
impl PartialEq for Kept {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number
    }
}

/// The last stamps, newest first.
#[derive(Resource, Clone, Debug, Default)]
pub struct Shelf {
    stamps: Vec<Kept>,
    /// Where they are kept; if nowhere, they go with the session.
    folder: Option<PathBuf>,
    /// Whether the folder was read.
    is_read: bool,
    /// Stamps that were numbered.
    count: u64,
}

impl Shelf {
    /// That of the user, in the folder of the user's data, so that a start from anywhere finds it.
    pub fn of_user() -> Self {
        files::folders().pop().map_or_else(Self::default, |folder| Self::of_folder(&folder.join(FOLDER)))
    }

    /// That which a folder keeps. It is read when it is first asked for.
    pub fn of_folder(folder: &Path) -> Self {
        Self { folder: Some(folder.to_owned()), ..Self::default() }
    }

    /// Its stamps, newest first. What is wrong with a file is told in a line of the log.
    pub fn stamps(&mut self) -> &[Kept] {
        if !std::mem::replace(&mut self.is_read, true) {
            self.read();
        }
        &self.stamps
    }

    /// Puts a new one on it, in the place of the oldest if it is full. It holds for the session, even if it can't be kept.
    pub fn add(&mut self, stamp: Stamp) -> (Kept, Result<(), Unwritten>) {
        self.stamps();
        let bytes = stamp.encode();
        let oldest = if self.stamps.len() < MOST { None } else { self.stamps.pop().and_then(|oldest| oldest.file) };
        let file = match (oldest, &self.folder) {
            (Some(file), _) => Some((disk::replace(&file, &bytes), file)),
            (None, Some(folder)) => {
                let file = free_path(folder);
                Some((disk::write(&file, &bytes), file))
            }
            (None, None) => None,
        };
        let (file, kept) = match file {
            None => (None, Ok(())),
            Some((Ok(()), file)) => (Some(file), Ok(())),
            Some((Err(error), path)) => (None, Err(Unwritten { path, error })),
        };
        let new = self.number(stamp, file);
        self.stamps.insert(0, new.clone());
        (new, kept)
    }

    fn read(&mut self) {
        let Some(folder) = &self.folder else { return };
        let mut files = disk::list(folder);
        files.retain(|(path, _)| path.extension().is_some_and(|ending| ending == STAMP_ENDING));
        files.sort_by(|(a, written_a), (b, written_b)| written_b.cmp(written_a).then_with(|| a.cmp(b)));
        for (path, _) in files {
            if self.stamps.len() == MOST {
                break;
            }
            let read = disk::read(&path).map_err(|error| format!("can't be read: {error}"));
            match read.and_then(|bytes| Stamp::decode(&bytes).map_err(|error| error.to_string())) {
                Ok(stamp) => {
                    let kept = self.number(stamp, Some(path));
                    self.stamps.push(kept);
                }
                Err(fault) => error!("{}: {fault}", path.display()),
            }
        }
    }

    fn number(&mut self, stamp: Stamp, file: Option<PathBuf>) -> Kept {
        self.count += 1;
        Kept { number: self.count, stamp: Arc::new(stamp), file }
    }
}

/// A name in `folder` that is not taken yet.
fn free_path(folder: &Path) -> PathBuf {
    let path = |number: u32| folder.join(format!("stamp-{number}.{STAMP_ENDING}"));
    let mut number = 1;
    while disk::exists(&path(number)) {
        number += 1;
    }
    path(number)
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use super::*;
    use crate::{
        kernel::{particles::Particles, piece::Piece, solids::Solids},
        sim::springs::Springs,
    };
    use glam::{IVec2, Vec2};
    use std::fs;

    /// A stamp that is `columns` wide.
    fn stamp(columns: i32) -> Stamp {
        let mut particles = Particles::default();
        particles.push(3, crate::kernel::element::ElementId(0), Vec2::splat(1.5), Vec2::X);
        let piece = Piece::of(&particles, &Solids::new(40, 4), IVec2::ZERO, IVec2::new(columns, 4), 0.1);
        Stamp { elements: vec!["water".to_owned()], piece, springs: Springs::default() }
    }

    fn widths(shelf: &mut Shelf) -> Vec<i32> {
        shelf.stamps().iter().map(|kept| kept.stamp.piece.size.x).collect()
    }

    #[test]
    fn the_last_stamps_outlive_the_session_and_what_is_no_stamp_is_left_out() {
        let folder = std::env::temp_dir().join(format!("powder-stamps-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        let mut shelf = Shelf::of_folder(&folder);
        assert_eq!(widths(&mut shelf), [0; 0], "there is no folder yet");
        for columns in 2..16 {
            shelf.add(stamp(columns)).1.expect("the folder of temporary files can be written");
        }
        let last: Vec<i32> = (4..16).rev().collect();
        assert_eq!(widths(&mut shelf), last);
        let files = fs::read_dir(&folder).expect("it was made").count();
        assert_eq!(files, MOST, "what falls off the shelf leaves its file to the new one");
        // Files that are written in the same moment have no order.
        let mut found = widths(&mut Shelf::of_folder(&folder));
        found.sort_unstable_by(|a, b| b.cmp(a));
        assert_eq!(found, last);
        fs::write(folder.join("stamp-1.pmt"), "no stamp").expect("it is ours");
        assert_eq!(widths(&mut Shelf::of_folder(&folder)).len(), MOST - 1);
        fs::remove_dir_all(folder).expect("it is ours");
    }

    #[test]
    fn what_can_t_be_kept_holds_for_the_session() {
        let mut shelf = Shelf::of_folder(Path::new("/dev/null/nowhere"));
        assert!(shelf.add(stamp(3)).1.is_err());
        assert_eq!(widths(&mut shelf), [3]);
    }
}
