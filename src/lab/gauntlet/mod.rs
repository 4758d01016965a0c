//! The stability gauntlet: every way in which a solver of this kind is known to fail, run by the program as it is shipped
//! at every quality, and judged by one judge.
//!
//! ```text
//! assets/gauntlet ─► GauntletCase: a scene, what is done to it ─► world, tick by tick ─► judge ─► Stability
//! arrange, script ─┘                                                                       │
//!                                                  examiner: every rule, by what `measure` finds
//!                                                                                          │
//! random: worlds that nobody thought of, under random hands ─► world, tick by tick ────────┤
//! throws: what a player throws at a world of their own ──────► a copy of it, tick by tick ──┘
//! ```
//!
//! A case builds its world as every scene is built (`scene::from_text`, `Checkpoint::of_scene`). What is done to it before each
//! tick is a script (`sim::script`), which runs headless here and in the game where a case is watched. [`super::cases`] runs
//! and reports them.

mod arrange;
mod bounds;
mod calm;
mod case;
mod confines;
mod end;
mod ends;
mod examiner;
mod judge;
mod judged;
mod list;
mod measure;
#[cfg(not(target_arch = "wasm32"))]
pub mod random;
mod rule;
mod script;
mod stability;
mod suite;
#[cfg(test)]
mod tests;
pub mod throws;

pub use bounds::{Bound, bounds};
pub use case::GauntletCase;
pub use list::CASES;
pub use stability::Stability;
