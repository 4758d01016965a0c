//! The gallery: scenes to choose from by their pictures, and the parameters of each.

mod find;
mod grid;
mod menu;
pub mod panel;
pub mod pictures;
mod sheet;

pub use menu::SceneFolder;
