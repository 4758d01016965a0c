//! Powder Master: a real-time 2-D sandbox of powders and fluids in moving air. In an app of your own (examples/minimal.rs):
//!
#![doc = concat!("```ignore\n", include_str!("../examples/minimal.rs"), "```")]
//!
//! Public for such apps are what the example uses and what stands beside it: [`sim::SimulationPlugin`], [`scene`],
//! [`sim::checkpoint`], [`sim::intent`], [`sim::pace`], [`sim::simulation`], [`sim::state`], and of [`kernel`] the types in
//! their signatures. The rest is public for the parts of this program only, and changes without notice.
//!
//! How data flows from the mouse to the screen:
//!
//! ```text
//! game::input   mouse and keys ─► intents (sim::intent), in world units
//!     │
//!     ▼  60 times a second, in FixedUpdate (sim::stages)
//! Script ─► Edit ─► Sources ─► Count ─► Gate ─► Step ─► Measure
//! cases      intents  emitters  census  effects   │      checks, cost
//!                                                 ▼  as often as the speeds call for
//!             Air ─► Forces ─► Pressure ─► Predict ─► Bin ─► Solve ─► Velocity
//!             each a thin system over one function of `kernel`
//!     │
//!     ▼  every frame
//! game::render  matter, rock, air and light, between two ticks      game::hud  counts, cost, tools
//! ```
//!
//! Who may import whom: `kernel, sound ← scene ← sim ← lab ← game ← cli, web`, and no two files each other (tests/laws). Nothing
//! below `game` knows egui, a window or a renderer, and builds without them (`--no-default-features`). The words stand in
//! docs/glossary.md; docs/adding.md says which files an addition takes.

#![forbid(unsafe_op_in_unsafe_fn)]
#![cfg_attr(all(test, target_arch = "wasm32"), feature(custom_test_frameworks, test))]
#![cfg_attr(all(test, target_arch = "wasm32"), test_runner(crate::web::suite::run))]

#[cfg(not(target_arch = "wasm32"))]
pub mod cli;
#[cfg(feature = "app")]
pub mod game;
pub mod lab;
pub mod scene;
pub mod sim;
pub mod web;

pub use powder_kernel as kernel;
pub use powder_sound as sound;
