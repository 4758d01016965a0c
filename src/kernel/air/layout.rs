//! How the cells of a grid lie, and which of them are rock: all that `shape` follows from.

use super::tiling::Tiling;
use crate::params::OpenSides;

/// Whether place `k` of the fields is in the ring around `columns` × `rows` cells.
pub(super) fn in_ring(k: usize, columns: usize, rows: usize) -> bool {
    let (i, j) = (k % (columns + 2), k / (columns + 2));
    i == 0 || j == 0 || i > columns || j > rows
}

/// The cells of a grid.
pub(super) struct Layout<'a> {
    /// Cells along x.
    pub(super) columns: usize,
    /// Cells along y.
    pub(super) rows: usize,
    /// Cells with rock in them, with the ring, which counts as solid.
    pub(super) solid: &'a [bool],
    /// Sides of the box that let air through.
    pub(super) open: OpenSides,
}

impl Layout<'_> {
    /// Values between a cell and the one above it.
    pub(super) fn stride(&self) -> usize {
        self.columns + 2
    }

    /// Whether place `k` of the fields is in the ring.
    pub(super) fn in_ring(&self, k: usize) -> bool {
        in_ring(k, self.columns, self.rows)
    }

    /// How it is cut into tiles.
    pub(super) fn tiling(&self) -> Tiling {
        Tiling::new(self.columns, self.rows)
    }
}
