//! The kernel as a crate of its own: without Bevy it is built in half a minute, and what else is in the program can't
//! change how it is compiled.

#[path = "../../../src/kernel/mod.rs"]
#[expect(dead_code, reason = "the stages, which are elsewhere, call some of it")]
pub mod kernel;
