//! The challenges that come with the game.

use super::file::Challenge;
use crate::scene::error::{SceneError, choices};
use include_dir::{Dir, include_dir};
use std::sync::{Arc, LazyLock};

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/challenges");

/// Read once: who judges asks for one in the middle of a tick.
static ALL: LazyLock<Result<Vec<Arc<Challenge>>, SceneError>> = LazyLock::new(|| {
    let files = FILES.files().filter(|file| file.path().extension().is_some_and(|ending| ending == "ron"));
    let named = files.filter_map(|file| Some((file.path().file_stem()?.to_str()?, file.contents())));
    let mut all: Vec<_> =
        named.map(|(name, bytes)| Challenge::read(name, bytes).map(Arc::new)).collect::<Result<_, _>>()?;
    all.sort_by_key(|challenge| challenge.number);
    Ok(all)
});

/// All challenges, in their order.
///
/// # Errors
/// If one of them is not what the format asks for.
pub fn challenges() -> Result<&'static [Arc<Challenge>], SceneError> {
    ALL.as_ref().map(Vec::as_slice).map_err(Clone::clone)
}

/// The challenge of a name.
///
/// # Errors
/// If there is none.
pub fn find(name: &str) -> Result<Arc<Challenge>, SceneError> {
    let all = challenges()?;
    all.iter().find(|challenge| challenge.name == name).cloned().ok_or_else(|| {
        let known = all.iter().map(|challenge| challenge.name.as_str());
        SceneError::file(name, format_args!("no such challenge; {}", choices(name, known)))
    })
}
