//! What a world sounds like: from its state to the controls of [`powder_sound`](crate::sound), and a run's sound as WAV.
//!
//! An [`Ear`] remembers how each particle moved when it last listened; what its kinetic energy lost since is what is heard of
//! splashes and of grains that strike. It reads the world and changes nothing of it, on one thread and in the order of the
//! particles, so that a world sounds the same however many threads run it.
//!
//! `listener`, `audible`, `source` → `kinds`, `memory`, `crowd` → `matter`, `fires`, `wind`, `blast` → `ear` → `track`, `wav`.

mod audible;
mod blast;
mod crowd;
mod ear;
mod fires;
mod kinds;
mod listener;
mod matter;
mod memory;
mod source;
#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests;
#[cfg(not(target_arch = "wasm32"))]
pub mod track;
#[cfg(not(target_arch = "wasm32"))]
mod wav;
mod wind;

pub use audible::Audible;
pub use ear::Ear;
pub use listener::Listener;
