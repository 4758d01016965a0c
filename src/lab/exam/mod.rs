//! The physics exam: answers that are known from theory or experiment, computed by the program as it is shipped, and
//! compared.
//!
//! ```text
//! assets/exam/cases.ron ─► ExamCase ┐
//! cases ────────────────────────────┴► scenes (assets/exam, assets/scenes) at a quality ─► Finding ─► Answer
//! ```
//!
//! A case builds its world as every scene is built (`scene::from_text`, `Checkpoint::of_scene`) and changes nothing in it
//! afterwards but what it says. It is a future that yields after each tick, so that the caller can do something else in
//! between: count, stop, or draw a frame (`jobs`). [`super::cases`] runs and reports them.

mod case;
mod cases;
mod dam_truth;
pub mod exhibits;
mod finding;
mod fit;
mod refinement;
mod set_up;
mod shares;
mod suite;
#[cfg(test)]
mod tests;
#[cfg(not(target_arch = "wasm32"))]
pub mod truth;
#[cfg(all(feature = "charts", not(target_arch = "wasm32")))]
pub mod truth_charts;

pub use case::{Bound, CASES, ExamCase, KnownMiss, RowBound};
pub use finding::Answer;
