//! The game on a web page: what `cli` is to a command line, this is to the page's script (`web/`).
//!
//! ```text
//! page ─► start(link) ─► game                   hook: stats, scene, pause ◄─► window.powderMaster
//!      └► measure(link, ticks) ─► lab           threads: one a Web Worker, where the page may share memory
//! ```

pub mod link;

#[cfg(all(target_arch = "wasm32", feature = "app"))]
mod hook;
#[cfg(target_arch = "wasm32")]
mod host;
#[cfg(target_arch = "wasm32")]
mod measure;
#[cfg(all(target_arch = "wasm32", feature = "app"))]
mod reader;
#[cfg(all(target_arch = "wasm32", feature = "app"))]
mod start;
#[cfg(all(test, target_arch = "wasm32"))]
pub(crate) mod suite;
#[cfg(all(target_arch = "wasm32", target_feature = "atomics"))]
mod threads;
