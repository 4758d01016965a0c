//! RON scene and element files → validated values → the world that they describe.
//!
//! ```text
//! builtin / a path ─► file (the format) ─► build ─► Blueprint
//!                       │ expression, number    ├ place: shapes → particles and rock (shape, image)
//!                       └ error: one line each  ├ flow: emitters, winds, drains, pressures
//!                                               └ knobs: the numbers and words that every scene has, `--set`
//! challenges: a scene, and what is to be reached in it
//! ```

mod build;
mod builtin;
mod category;
pub(crate) mod elements;
mod error;
mod expression;
mod facts;
mod file;
mod flow;
mod image;
mod knobs;
mod number;
mod place;
mod shape;
mod table;
#[cfg(test)]
mod tests;

pub mod blueprint;
pub mod challenges;
pub mod effects;
pub mod passes;
pub mod readers;

pub use build::{DETAIL, SceneFile, from_text, load};
pub(crate) use build::{MOST_CELLS, MOST_DETAIL, SIDE};
pub use builtin::{DEFAULT_SCENE, builtin_names};
pub use category::SceneCategory;
pub use elements::elements;
pub use error::SceneError;
pub use file::ParameterSpec;
pub(crate) use flow::MOST_COVERED;
pub use knobs::{KNOBS, Knob, Part, Tuning, Values};
pub use number::Range;
