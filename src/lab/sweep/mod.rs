//! The sweep: what accuracy costs in a scene. From one checkpoint, every setting of a design runs the same ticks; what came
//! out is held against what it took.
//!
//! ```text
//! design ─► Setting… ─► measure (a run, timed and sampled) ─► journal (kept, so that a sweep goes on where it stopped)
//!                                                               │
//!             table (curve.csv) ◄─ row (runs of a setting together, what is wrong with them) ◄─┘
//!             summary (summary.md) ◄─ front (which settings are beaten by others), presets (are they in order),
//!                                     truth (which are truest)
//! ```
//!
//! A flow is chaotic: every run of a setting but the first sets out a rounding off, so that errors are means with a scatter. The
//! same round at other numbers of threads must come to the same world.

pub mod design;
#[cfg(feature = "charts")]
pub mod draw;
mod error;
pub mod front;
mod measure;
pub mod presets;
pub mod record;
pub mod row;
mod run;
#[cfg(test)]
mod shipped;
pub mod summary;
pub mod table;
mod truth;

pub use error::ErrorMeasure;
pub use run::Sweep;
