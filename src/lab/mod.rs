//! Accuracy: what a run is measured by, and what it leaves behind. Everything here reads the simulation's resources and
//! changes none, so that a measured world has the hash of an unmeasured one.

pub mod balance;
pub mod density;
pub mod headless;
pub mod metrics;
mod palette;
pub mod particle_list;
pub mod picture;
pub mod run;
pub mod sampler;
pub mod stats;
pub mod trace;
pub mod volume;
