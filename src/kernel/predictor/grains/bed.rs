//! The part of the grid that grains can press in.

use crate::{
    parallel::Team,
    predictor::{conjugate::Conjugate, grid::MacGrid, rock::ClosedFaces, stencil::Axis},
};
use glam::Vec2;
use std::ops::Range;

/// A cell with more rock than this is a wall.
const WALL: f32 = 0.5;

/// The grid where it has pressure.
pub(in crate::predictor) struct Bed<'a> {
    pub grid: &'a MacGrid,
    pub closed: &'a ClosedFaces,
    /// 1 in cells that have a pressure.
    pub liquid: &'a [f32],
    /// Rows and columns from the first to the last such cell.
    pub rows: Range<usize>,
    pub span: Range<usize>,
    /// Particles of a full face.
    pub full: f32,
    /// What gravity adds in the substep, d/s.
    pub kick: Vec2,
    pub team: Team,
}

/// Rows and columns in which fields may differ from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Touched {
    pub rows: Range<usize>,
    pub columns: Range<usize>,
}

impl Touched {
    /// Shows `visit` the pieces of the fields that lie in these rows and columns, but no more in those of `bed`.
    pub fn left(&self, bed: &Bed, mut visit: impl FnMut(Range<usize>)) {
        let (grid, now) = (bed.grid, bed.touched());
        if *self == now {
            return;
        }
        for (j, row) in self.rows.clone().map(|j| (j, grid.row(j))) {
            if now.rows.contains(&j) {
                visit(row..row + now.columns.start);
                visit(row + now.columns.end.min(grid.stride)..row + grid.stride);
            } else {
                visit(row..row + grid.stride);
            }
        }
    }

    /// The indices of its faces.
    pub fn all(&self, grid: &MacGrid) -> impl Iterator<Item = usize> + use<> {
        let (stride, columns) = (grid.stride, self.columns.clone());
        self.rows.clone().flat_map(move |j| j * stride + columns.start..j * stride + columns.end)
    }
}

impl<'a> Bed<'a> {
    pub fn new(
        (grid, closed): (&'a MacGrid, &'a ClosedFaces),
        conjugate: &'a Conjugate,
        full: f32,
        kick: Vec2,
        team: Team,
    ) -> Self {
        let Conjugate { liquid, rows, span, .. } = conjugate;
        Self { grid, closed, liquid, rows: rows.clone(), span: span.clone(), full, kick, team }
    }

    /// Rows and columns of faces and corners that touch such a cell.
    pub(super) fn touched(&self) -> Touched {
        Touched { rows: self.rows.start..self.rows.end + 1, columns: self.span.start..self.span.end + 1 }
    }

    #[inline(always)]
    pub fn is_liquid(&self, k: usize) -> bool {
        self.liquid[k] > 0.0
    }

    /// Whether a face is one of a cell that has a pressure.
    #[inline(always)]
    pub fn is_touched(&self, axis: Axis, k: usize) -> bool {
        self.liquid[k] + self.liquid[k - axis.step(self.grid)] > 0.0
    }

    /// Open share of a face.
    #[inline(always)]
    pub fn open(&self, axis: Axis, k: usize) -> f32 {
        let at = self.closed.row(k / self.grid.stride) + k % self.grid.stride;
        if axis == Axis::U { self.closed.open_u[at] } else { self.closed.open_v[at] }
    }

    #[inline(always)]
    pub fn is_wall(&self, k: usize) -> bool {
        self.closed.rock[self.closed.row(k / self.grid.stride) + k % self.grid.stride] > WALL
    }
}
