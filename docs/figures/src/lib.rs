//! The tables and charts of the documents: what makes each, at which commit and on which machine it was made, and which are
//! out of date. `cargo figures make` makes them, `cargo figures stale` lists those whose sources have changed since.
//!
//! ```text
//! manifest   figures.ron: name, page, commands, sources
//! make       runs the commands ─► region: between two marks of a page ─► stamp: commit, machine, date, other work
//! stale      stamp's commit ─► repository: what changed since among the sources
//! ```

pub mod fault;
pub mod make;
pub mod manifest;
pub mod others;
pub mod region;
pub mod repository;
pub mod stale;
pub mod stamp;

// The program's own word for a processor, without the rest of the program.
#[path = "../../../src/lab/machine.rs"]
pub mod machine;
