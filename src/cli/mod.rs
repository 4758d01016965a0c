//! The command line. `args` says what it understands, each command has a module of its own, `failure` is what they end
//! with if they don't end well.

mod args;
mod bench;
mod challenge;
mod clip;
mod dispatch;
mod failure;
mod gauges;
mod journal;
mod judge;
mod list;
mod merge;
mod output;
mod play;
mod progress;
mod random;
mod replay;
mod run;
mod scenes;
mod soak;
mod start;
mod study;
mod sweep;
mod threads;

pub use dispatch::main;
