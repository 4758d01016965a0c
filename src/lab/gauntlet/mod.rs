//! The stability gauntlet: every way in which a solver of this kind is known to fail, run by the program as it is shipped
//! at every quality, and judged by one judge.
//!
//! ```text
//! assets/gauntlet ─► GauntletCase: a scene, what is done to it, the rules ─► world, tick by tick ─► Judge ─► Stability
//! arrange, script ─┘
//! ```
//!
//! A case builds its world as every scene is built (`scene::from_text`, `Checkpoint::of_scene`). What is done to it before each
//! tick is a script (`sim::script`), which runs headless here and in the game where a case is watched. [`super::cases`] runs
//! and reports them.

mod arrange;
mod case;
mod end;
mod ends;
mod judge;
mod list;
mod script;
mod stability;
mod suite;
#[cfg(test)]
mod tests;

pub use case::GauntletCase;
pub use list::CASES;
pub use stability::Stability;
