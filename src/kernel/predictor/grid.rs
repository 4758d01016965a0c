//! Geometry of the staggered grid.

use glam::Vec2;
use std::ops::Range;

/// What is done to columns is done in pieces of so many. The lanes of sums, the pairs of finer levels and what may be dry
/// ([`Pieces`](super::pieces::Pieces)) begin anew in each, so that it makes no difference, to the last bit, how many there are.
const SPAN_STEP: usize = 64;

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

/// Some columns and rows of a grid, among them padding.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Window {
    pub columns: Range<usize>,
    pub rows: Range<usize>,
}

impl Window {
    /// Whether a cell of the grid is in it.
    #[inline(always)]
    pub fn has(&self, grid: &MacGrid, k: usize) -> bool {
        self.rows.contains(&(k / grid.stride)) && self.columns.contains(&(k % grid.stride))
    }
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

    /// Where a column or row of cells begins, d.
    #[inline(always)]
    pub fn edge(&self, index: usize) -> f32 {
        (index as f32 - 1.0) * self.cell
    }

    /// Cells of rock that a column or row of the grid's cells reaches.
    pub fn sites(&self, index: usize) -> Range<i32> {
        let low = self.edge(index);
        low.floor() as i32..(low + self.cell).ceil() as i32
    }

    /// Columns of cells, rounded to whole pieces of [`SPAN_STEP`] from the first on.
    pub fn whole_pieces(&self, columns: Range<usize>) -> Range<usize> {
        if columns.is_empty() {
            return 1..1;
        }
        let (first, last) = (columns.start - 1, columns.end - 2);
        let (low, high) = (first / SPAN_STEP * SPAN_STEP, (last / SPAN_STEP + 1) * SPAN_STEP);
        low + 1..high.min(self.columns) + 1
    }

    /// Columns of cells near particles between `low` and `high` (d along x): those whose faces they reach and two more on
    /// either side, rounded to whole pieces.
    pub fn columns_near(&self, [low, high]: [f32; 2]) -> Range<usize> {
        if low > high {
            return 1..1;
        }
        let column = |x: f32| 1 + ((x * self.per_cell) as usize).min(self.columns - 1);
        self.whole_pieces(column(low).saturating_sub(3).max(1)..(column(high) + 4).min(self.columns + 1))
    }

    /// Columns with the padding beside the first and the last.
    pub fn padded(&self, columns: &Range<usize>) -> Range<usize> {
        let start = if columns.start == 1 { 0 } else { columns.start };
        start..if columns.end == self.columns + 1 { self.stride } else { columns.end }
    }

    /// The indices of rows.
    #[inline(always)]
    pub fn rows(&self, rows: Range<usize>) -> Range<usize> {
        self.row(rows.start)..self.row(rows.end)
    }

    /// All columns and rows, with the padding.
    pub fn all(&self) -> Window {
        Window { columns: 0..self.stride, rows: 0..self.rows + 3 }
    }

    /// The columns and rows that reach some cells of rock.
    pub fn window(&self, [across, up]: [Range<i32>; 2]) -> Window {
        let index = |site: i32, most: usize| ((site as f32 * self.per_cell).max(0.0) as usize + 1).min(most);
        // A cell of rock that ends with a cell may be found to reach the next.
        let span =
            |sites: Range<i32>, most: usize| index(sites.start, most).saturating_sub(1)..index(sites.end, most) + 1;
        Window { columns: span(across, self.stride - 1), rows: span(up, self.rows + 2) }
    }

    /// Columns and rows with so many around them.
    pub fn widened(&self, window: &Window, by: usize) -> Window {
        let span = |span: &Range<usize>, most: usize| span.start.saturating_sub(by)..(span.end + by).min(most);
        Window { columns: span(&window.columns, self.stride), rows: span(&window.rows, self.rows + 3) }
    }

    /// The indices in a window.
    pub fn indices<'a>(&'a self, window: &'a Window) -> impl Iterator<Item = usize> + 'a {
        let columns = &window.columns;
        window.rows.clone().flat_map(move |j| self.row(j) + columns.start..self.row(j) + columns.end)
    }

    /// Cells of rock that a window reaches.
    pub fn sites_in(&self, window: &Window) -> [Range<i32>; 2] {
        let last = |span: &Range<usize>| self.sites(span.end.max(1) - 1).end;
        [&window.columns, &window.rows].map(|span| self.sites(span.start).start..last(span))
    }

    /// The cells in a window but for the padding.
    pub fn cells_in<'a>(&'a self, window: &'a Window) -> impl Iterator<Item = usize> + 'a {
        let columns = window.columns.start.max(1)..window.columns.end.min(self.columns + 1);
        let rows = window.rows.start.max(1)..window.rows.end.min(self.rows + 1);
        rows.flat_map(move |j| self.row(j) + columns.start..self.row(j) + columns.end)
    }

    /// Index of cell (0, j).
    #[inline(always)]
    pub fn row(&self, j: usize) -> usize {
        j * self.stride
    }
}
