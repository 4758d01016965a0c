//! Accuracy: what a run is measured by, and what it leaves behind. Everything here reads the simulation's resources and
//! changes none, so that a measured world has the hash of an unmeasured one. What only the command line asks for is not
//! in the page.

pub mod autopilot;
pub mod balance;
#[cfg(not(target_arch = "wasm32"))]
pub mod binning;
pub mod cases;
pub mod challenge;
#[cfg(all(feature = "charts", not(target_arch = "wasm32")))]
pub mod chart;
pub mod coarse;
pub mod colours;
pub mod density;
pub mod dial;
pub mod difference;
mod drift;
#[cfg(not(target_arch = "wasm32"))]
pub mod effect_cost;
pub mod exam;
#[cfg(not(target_arch = "wasm32"))]
pub mod experiment;
pub mod gauges;
pub mod gauntlet;
pub mod hand;
#[cfg(not(target_arch = "wasm32"))]
pub mod heat_cost;
pub mod jobs;
pub mod live;
pub mod machine;
pub mod maps;
pub mod markdown;
pub mod metrics;
pub mod miniature;
pub mod picture;
pub mod reference;
#[cfg(not(target_arch = "wasm32"))]
pub mod rest_density;
pub mod run;
pub mod sampler;
#[cfg(not(target_arch = "wasm32"))]
pub mod scaling;
pub mod shake;
#[cfg(not(target_arch = "wasm32"))]
pub mod sleep_cost;
#[cfg(not(target_arch = "wasm32"))]
pub mod soak;
pub mod sound;
pub mod split;
pub mod stats;
pub mod student;
#[cfg(not(target_arch = "wasm32"))]
pub mod sweep;
#[cfg(not(target_arch = "wasm32"))]
pub mod tables;
#[cfg(test)]
mod testing;
#[cfg(not(target_arch = "wasm32"))]
pub mod thread_cost;
#[cfg(test)]
pub(crate) mod vision;
pub mod volume;
