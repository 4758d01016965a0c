//! The part of the grid that grains can press in.

use crate::{
    parallel::Team,
    predictor::{conjugate::Conjugate, grid::MacGrid, rock::ClosedFaces, stencil::Axis, wide::load},
    simd::each_lane,
};
use glam::Vec2;
use std::ops::Range;

/// A cell with more rock than this is a wall.
const WALL: f32 = 0.5;

/// The first of some cells side by side.
#[derive(Clone, Copy)]
pub(in crate::predictor) struct At {
    pub row: usize,
    pub column: usize,
    /// Its index.
    pub k: usize,
}

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

    /// What of some columns is among those with pressure.
    #[inline(always)]
    pub fn within(&self, columns: Range<usize>) -> Range<usize> {
        columns.start.max(self.span.start)..columns.end.min(self.span.end)
    }

    #[inline(always)]
    pub fn is_liquid(&self, k: usize) -> bool {
        self.liquid[k] > 0.0
    }

    /// 1 for those of some faces side by side that are one of a cell that has a pressure, 0 for others.
    #[inline(always)]
    pub fn touched<const N: usize>(&self, axis: Axis, k: usize) -> [f32; N] {
        let (before, after) = (load::<N>(self.liquid, k - axis.step(self.grid)), load::<N>(self.liquid, k));
        each_lane(|i| if after[i] + before[i] > 0.0 { 1.0 } else { 0.0 })
    }

    /// Open shares of faces side by side.
    #[inline(always)]
    pub fn open<const N: usize>(&self, axis: Axis, At { row, column, .. }: At) -> [f32; N] {
        let ClosedFaces { open_u, open_v, .. } = self.closed;
        load(if axis == Axis::U { open_u } else { open_v }, self.closed.row(row) + column)
    }

    /// Rock of cells side by side.
    #[inline(always)]
    pub fn rock<const N: usize>(&self, row: usize, column: usize) -> [f32; N] {
        load(&self.closed.rock, self.closed.row(row) + column)
    }
}

/// Whether a cell with so much rock is a wall.
#[inline(always)]
pub(super) fn is_wall(rock: f32) -> bool {
    rock > WALL
}
