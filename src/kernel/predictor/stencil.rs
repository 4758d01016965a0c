//! Bilinear weights of the faces around a point.

use crate::{blocks::Reach, predictor::grid::MacGrid, simd::whole_below};

/// Which faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// Left faces: they stand on columns' edges and rows' middles.
    U,
    /// Lower faces: they stand on columns' middles and rows' edges.
    V,
}

impl Axis {
    /// From the cell before a face to the one after it.
    #[inline(always)]
    pub fn step(self, grid: &MacGrid) -> usize {
        match self {
            Self::U => 1,
            Self::V => grid.stride,
        }
    }

    /// Index along x of the faces to the left of a point, and the share of those to the right.
    #[inline(always)]
    pub fn column(self, grid: &MacGrid, x: f32) -> (u32, f32) {
        match self {
            Self::U => whole_below(x * grid.per_cell + 1.0, 1, grid.columns as u32),
            Self::V => whole_below(x * grid.per_cell + 0.5, 0, grid.columns as u32),
        }
    }

    /// Index along y of the faces below a point, and the share of those above.
    #[inline(always)]
    pub fn row(self, grid: &MacGrid, y: f32) -> (u32, f32) {
        match self {
            Self::U => whole_below(y * grid.per_cell + 0.5, 0, grid.rows as u32),
            Self::V => whole_below(y * grid.per_cell + 1.0, 1, grid.rows as u32),
        }
    }
}

impl Reach for &MacGrid {
    #[inline(always)]
    fn rows(self, y: f32) -> [u32; 2] {
        // A stencil has two rows, and those of v begin half a cell higher.
        [Axis::U.row(self, y).0, Axis::V.row(self, y).0 + 2]
    }
}

/// Points whose stencils are found side by side.
pub(super) const LANES: usize = 16;

/// The four faces around each of some points: index of the lower left one, and the shares of the right and upper ones.
pub(super) struct Stencils {
    pub corner: [u32; LANES],
    pub right: [f32; LANES],
    pub upper: [f32; LANES],
}

impl Stencils {
    /// The faces around points, d.
    #[inline(always)]
    pub fn new(grid: &MacGrid, x: &[f32; LANES], y: &[f32; LANES], axis: Axis) -> Self {
        let mut stencils = Self { corner: [0; LANES], right: [0.0; LANES], upper: [0.0; LANES] };
        let stride = grid.stride as u32;
        for lane in 0..LANES {
            let (i, right) = axis.column(grid, x[lane]);
            let (j, upper) = axis.row(grid, y[lane]);
            stencils.corner[lane] = j * stride + i;
            (stencils.right[lane], stencils.upper[lane]) = (right, upper);
        }
        stencils
    }
}

/// Calls `add(column, row, weight)` for the four faces around a point, d.
pub(super) fn faces_around(grid: &MacGrid, x: f32, y: f32, axis: Axis, mut add: impl FnMut(usize, usize, f32)) {
    let ((i, right), (j, upper)) = (axis.column(grid, x), axis.row(grid, y));
    let (i, j, left, lower) = (i as usize, j as usize, 1.0 - right, 1.0 - upper);
    add(i, j, left * lower);
    add(i + 1, j, right * lower);
    add(i, j + 1, left * upper);
    add(i + 1, j + 1, right * upper);
}
