//! A person's side: input, tools, the picture, the HUD. Reads the simulation's resources and gives it intents.
//!
//! ```text
//! devices ─► input ─┬─► intents ────────────► simulation ─┬─► render ─► window
//!                   └─► orders ─► execute ─────► │        └─► hud ──────► │
//!                          ▲                                   │
//!                          └───────────────────────────────────┘
//! ```
//! A tool is a row of [`tools::TOOLS`], a view one of [`views::table::VIEWS`], a panel a file of [`hud::panels`]: keys,
//! help, menus and bars follow from these.

pub mod actions;
pub mod brush_mode;
pub mod camera;
pub mod challenges;
#[cfg(not(target_arch = "wasm32"))]
pub mod clip;
#[cfg(not(target_arch = "wasm32"))]
pub mod crash;
pub mod disk;
pub mod drop;
pub mod edit_icons;
pub mod execute;
pub mod favourites;
pub mod files;
pub mod follow;
pub mod frame;
pub mod gauges;
pub mod hints;
pub mod history;
pub mod hud;
pub mod icons;
pub mod input;
pub mod kept;
pub mod language;
pub mod lens;
#[cfg(target_arch = "wasm32")]
pub mod link;
pub mod lump;
pub mod mixer;
pub mod museum;
pub mod opening;
pub mod orders;
pub mod panels;
pub mod playback;
pub mod plugin;
pub mod recording;
pub mod render;
pub mod rest;
pub mod rewind;
pub mod saves;
pub mod screen;
#[cfg(not(target_arch = "wasm32"))]
pub mod screen_reader;
pub mod script;
pub mod settings;
pub mod sound;
pub mod split;
pub mod springs;
pub mod stamps;
#[cfg(test)]
mod tests;
pub mod throws;
pub mod toasts;
pub mod toolbox;
pub mod tools;
pub mod views;
pub mod window;

pub use plugin::GamePlugin;
pub use window::{GameError, run};
