//! Numbers only: particles, rock, air and the passes over them. Knows no App, World, file or window.
//!
//! **Units.** Inside the kernel a length is counted in particle spacings `d` and a time in seconds (`units` converts). The
//! density of liquid is counted in that of its lattice; where masses meet, as in the exchange of liquid and air, they are
//! kg/m² d², so that a density is the mass of a cell of 1 d². The box is `[0, width] × [0, height]`, y points up.

#![forbid(unsafe_op_in_unsafe_fn)]
#![cfg_attr(all(test, target_arch = "wasm32"), feature(custom_test_frameworks, test))]
#![cfg_attr(all(test, target_arch = "wasm32"), test_runner(crate::suite::run))]

pub mod air;
pub mod bins;
mod blocks;
pub mod brush;
mod cells;
pub mod checks;
pub mod columns;
mod crew;
pub mod crowding;
pub mod decay;
pub mod diffusion;
pub mod element;
pub mod forces;
pub mod fracture;
pub mod heat;
pub mod parallel;
pub mod params;
pub mod particles;
pub mod pbf;
pub mod piece;
pub mod predict;
pub mod predictor;
pub mod random;
pub mod reactions;
pub mod relabel;
pub mod resample;
pub mod simd;
pub mod sleep;
pub mod smoothing;
pub mod solids;
pub mod sources;
pub mod spawn;
pub mod units;
pub mod velocity;

#[cfg(all(test, target_arch = "wasm32"))]
#[path = "../web/suite.rs"]
mod suite;
