//! Where scene files and their pictures come from: the binary itself, so that it runs from any folder, or a path.

use crate::scene::error::{SceneError, choices};
use include_dir::{Dir, include_dir};
use std::{
    borrow::Cow,
    fs::File,
    io::{ErrorKind, Read},
    path::{Path, PathBuf},
};

static SCENES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/scenes");

/// The element rows, as they stand in `assets/elements.ron`.
pub(super) const ELEMENTS: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/elements.ron"));

/// The scene that the game starts with; first in every list.
pub const DEFAULT_SCENE: &str = "waterfall";

/// Largest file that is read, bytes.
const LARGEST: u64 = 16 << 20;

/// Names of the scenes in the binary, sorted, the default one first.
pub fn builtin_names() -> Vec<&'static str> {
    let mut names: Vec<&str> = SCENES
        .files()
        .filter(|file| file.path().extension().is_some_and(|extension| extension == "ron"))
        .filter_map(|file| file.path().file_stem()?.to_str())
        .collect();
    names.sort_unstable_by_key(|name| (*name != DEFAULT_SCENE, *name));
    names
}

/// Where a scene came from, and so where its pictures are.
#[derive(Clone, Debug)]
pub(super) enum Origin {
    /// The binary.
    Builtin,
    /// The folder of its file.
    Folder(PathBuf),
}

impl Origin {
    /// The bytes of a file that a scene names.
    pub(super) fn read(&self, file: &str) -> Result<Cow<'static, [u8]>, String> {
        match self {
            Self::Builtin => SCENES
                .get_file(file)
                .map(|file| Cow::Borrowed(file.contents()))
                .ok_or_else(|| format!("no file `{file}` under assets/scenes")),
            Self::Folder(folder) => read(&folder.join(file)).map(Cow::Owned),
        }
    }
}

/// A scene file as it was read.
pub(super) struct Source {
    /// Name of the scene.
    pub(super) name: String,
    /// Name of the file in errors.
    pub(super) file: String,
    pub(super) bytes: Cow<'static, [u8]>,
    pub(super) origin: Origin,
}

/// Reads the scene called `name_or_path`: one in the binary, or a path.
pub(super) fn find(name_or_path: &str) -> Result<Source, SceneError> {
    if let Some(file) = builtin_names().contains(&name_or_path).then(|| format!("{name_or_path}.ron"))
        && let Some(found) = SCENES.get_file(&file)
    {
        return Ok(Source {
            name: name_or_path.to_owned(),
            file: format!("assets/scenes/{file}"),
            bytes: Cow::Borrowed(found.contents()),
            origin: Origin::Builtin,
        });
    }
    let path = Path::new(name_or_path);
    let is_path = path.extension().is_some_and(|extension| extension == "ron") || path.components().count() > 1;
    if !is_path && !path.exists() {
        // A page has no files.
        let or_path = if cfg!(target_arch = "wasm32") { "" } else { ", or a path to a .ron file" };
        let what = format!("no such scene; {}{or_path}", choices(name_or_path, builtin_names()));
        return Err(SceneError::file(name_or_path, what));
    }
    let bytes = read(path).map_err(|what| SceneError::file(name_or_path, what))?;
    Ok(Source {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        file: name_or_path.to_owned(),
        bytes: Cow::Owned(bytes),
        origin: Origin::Folder(path.parent().unwrap_or(Path::new("")).to_owned()),
    })
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    if path.is_dir() {
        return Err("a folder; allowed: a file".to_owned());
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes)).map_err(|error| {
        match error.kind() {
            ErrorKind::NotFound => "no such file".to_owned(),
            _ => format!("can't be read: {error}"),
        }
    })?;
    if bytes.len() as u64 > LARGEST {
        return Err(format!("larger than {} MiB", LARGEST >> 20));
    }
    Ok(bytes)
}
