//! What a tick costs and how exact it is, from a thousand particles to a million: the scene `dam_break` at every quality,
//! on one thread and on several, with the other programs beside it that the reader brings along.
//!
//! Modules: `plan` what is measured, `measure` the runs, `table` what is drawn from them, `beside` other programs' figures,
//! `charts` the pictures.

mod beside;
#[cfg(feature = "charts")]
mod charts;
mod measure;
mod plan;
mod table;

pub use beside::{Beside, Figure};
#[cfg(feature = "charts")]
pub use charts::charts;
pub use measure::{Row, Skipped, Window, measure};
pub use plan::{CHARTS, Plan, SCENE, Setting, particles};
pub use table::{Fit, fits};
