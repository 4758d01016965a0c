//! Numbers only: particles, rock, air and the passes over them. Knows no App, World, file or window.
//!
//! **Units.** Inside the kernel a length is counted in particle spacings `d`, a time in seconds and a mass in masses of
//! one particle of the reference liquid (`units` converts). The box is `[0, width] × [0, height]`, y points up.

pub mod air;
pub mod bins;
pub mod brush;
pub mod checks;
pub mod element;
pub mod forces;
pub mod parallel;
pub mod params;
pub mod particles;
pub mod pbf;
pub mod predict;
pub mod predictor;
pub mod simd;
pub mod sleep;
pub mod smoothing;
pub mod solids;
pub mod sources;
pub mod spawn;
pub mod units;
pub mod velocity;
