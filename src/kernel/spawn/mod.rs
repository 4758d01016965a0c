//! Placing and taking away matter: what tools, emitters and drains do.
//!
//! New particles stand on the sites of the lattice (the centres of the cells), a little off them when poured, and only
//! where no other particle is near: nothing is ever put into something, nor into a cell that the box cuts.

mod matter;
mod occupancy;
mod over;
mod paste;
mod select;
#[cfg(test)]
mod tests;

pub use matter::{EditReport, Matter, Pouring};
pub use occupancy::Occupancy;
