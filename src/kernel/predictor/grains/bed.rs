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

    #[inline(always)]
    pub fn is_liquid(&self, k: usize) -> bool {
        self.liquid[k] > 0.0
    }

    /// Whether a face is one of a cell that has a pressure.
    #[inline(always)]
    pub fn is_touched(&self, axis: Axis, k: usize) -> bool {
        self.liquid[k] + self.liquid[k - axis.step(self.grid)] > 0.0
    }

    /// Whether a face is one of a cell that has a pressure, and open.
    #[inline(always)]
    pub fn is_moved(&self, axis: Axis, k: usize) -> bool {
        self.is_touched(axis, k) && self.open(axis, k) > 0.0
    }

    /// Open share of a face.
    #[inline(always)]
    pub fn open(&self, axis: Axis, k: usize) -> f32 {
        self.open_in(axis, k / self.grid.stride, k % self.grid.stride)
    }

    /// That of a face of a row.
    #[inline(always)]
    pub fn open_in(&self, axis: Axis, row: usize, column: usize) -> f32 {
        let at = self.closed.row(row) + column;
        if axis == Axis::U { self.closed.open_u[at] } else { self.closed.open_v[at] }
    }

    #[inline(always)]
    pub fn is_wall(&self, k: usize) -> bool {
        self.closed.rock[self.closed.row(k / self.grid.stride) + k % self.grid.stride] > WALL
    }
}
