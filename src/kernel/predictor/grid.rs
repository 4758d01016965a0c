//! Geometry of the staggered grid.

use glam::Vec2;
use std::ops::Range;

/// Rows and columns of cells with a ring of padding. Cell (i, j) with 1 ≤ i ≤ columns, 1 ≤ j ≤ rows has index
/// `j · stride + i`; face u of that index is its left one, face v its lower one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct MacGrid {
    /// Cells along x.
    pub columns: usize,
    /// Cells along y. The last row may reach past the box.
    pub rows: usize,
    /// Distance of an index to the one above.
    pub stride: usize,
    /// Edge of a cell, d.
    pub cell: f32,
    /// 1/cell.
    pub per_cell: f32,
}

impl MacGrid {
    /// Cells of about `cell` d whose number along x is whole.
    pub fn new(size: Vec2, cell: f32) -> Self {
        let columns = ((size.x / cell + 0.5) as usize).max(1);
        let cell = size.x / columns as f32;
        let rows = ((size.y / cell).ceil() as usize).max(1);
        Self { columns, rows, stride: columns + 2, cell, per_cell: 1.0 / cell }
    }

    /// Length of a field.
    pub fn len(&self) -> usize {
        self.stride * (self.rows + 3)
    }

    /// The indices of rows.
    #[inline(always)]
    pub fn rows(&self, rows: Range<usize>) -> Range<usize> {
        self.row(rows.start)..self.row(rows.end)
    }

    /// Index of cell (0, j).
    #[inline(always)]
    pub fn row(&self, j: usize) -> usize {
        j * self.stride
    }
}
