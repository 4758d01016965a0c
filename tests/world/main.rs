//! Tests of the headless world as a whole. One binary, so that Bevy is linked once.

#[path = "../support/mod.rs"]
mod support;

mod burning;
mod control;
mod determinism;
mod draught;
mod elements;
mod expansion;
mod fracture;
mod grains;
mod hard_cases;
mod heat;
mod layers;
mod ledger;
mod monkey;
mod motion;
mod other_quality;
#[path = "../properties/mod.rs"]
mod properties;
mod reactions;
mod recordings;
mod refinement;
mod resampling;
mod rewind;
mod saves;
mod sleep;
mod stages;
mod still;
mod symmetry;
