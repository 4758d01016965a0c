//! Scenes as small moving pictures: the world of a scene at a coarse detail, and what draws it on the processor.
//!
//! ```text
//! scene file ─► world (some thousand particles) ─► painter ─► pixels
//!                                                    ├ rock: baked while it stands
//!                                                    ├ layer: bodies, clouds
//!                                                    └ shine: light of what glows
//! ```

mod bowl;
mod frame;
mod layer;
mod painter;
mod rock;
mod shine;
mod world;

pub use bowl::BOWL_TICKS;
pub use frame::{HEIGHT, WIDTH};
pub use world::{Miniature, Progress, run_up};
