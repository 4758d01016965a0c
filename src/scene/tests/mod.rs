//! Tests of the whole way from text to blueprint.

mod builtins;
mod detail;
mod effects;
mod faults;
mod mutations;
mod scenes;

use crate::scene::{
    blueprint::Blueprint,
    build::SceneFile,
    builtin::{Origin, Source},
    effects::EffectModes,
    error::SceneError,
};
use std::{borrow::Cow, path::PathBuf};

/// The scene file with this text, as if it lay in the current folder as `test.ron`.
fn read(text: &[u8]) -> Result<SceneFile, SceneError> {
    SceneFile::from_source(Source {
        name: "test".to_owned(),
        file: "test.ron".to_owned(),
        bytes: Cow::Owned(text.to_vec()),
        origin: Origin::Folder(PathBuf::new()),
    })
}

/// The world of a scene with this text.
fn build(text: &str) -> Result<Blueprint, SceneError> {
    read(text.as_bytes())?.build(&[], None, &EffectModes::new())
}

/// A scene with a box of 10 × 8 spacings of 0.5 m and these further fields.
fn scene(fields: &str) -> String {
    format!("(title: \"Test\", spacing: 0.5, size: (5, 4),\n{fields})")
}

/// `KEY=VALUE` pairs as the command line hands them over.
fn settings(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect()
}
