//! Binned neighbour search: strips as high as the search reaches, cut into thin columns.
//!
//! Particles are counting-sorted by cell (row by row), so that whatever may touch a run of consecutive particles lies in
//! three contiguous runs, one in each of three strips. Runs of consecutive particles are the groups that the passes work
//! on side by side. Rock is binned into the same cells, once for every change of the rock.
//!
//! The search reaches further than the kernel by a margin: particles move on while the solver iterates, and each may move
//! by the correction limit. So no pair is missed, and since pairs beyond the kernel add exact zeros, neither the width of
//! a group nor the search itself shows in the result.
//!
//! Modules: `cells` the geometry, `sort` the order of the particles, `strip` those of a row of cells, `group` what the passes
//! work on, `groups` how they are cut, `tiles` marks on the box, `focus` the groups that are iterated again, `rock`, and `search` the
//! whole.

mod cells;
mod focus;
mod group;
mod groups;
mod rock;
mod search;
mod sort;
mod strip;
#[cfg(test)]
mod tests;
mod tiles;

pub(crate) use group::split;
pub use group::{Group, Run};
pub use rock::RockBins;
pub use search::{Bins, Neighbours};
pub(crate) use strip::Strip;
