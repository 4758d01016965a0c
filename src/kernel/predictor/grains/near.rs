//! Which part of the grid friction works on: where grains touch, or are under a stress that they left. Single grains that drift in a
//! liquid rub on nothing.

use crate::{
    predictor::{
        grains::{bed::Bed, spread::Spread},
        grid::MacGrid,
        pieces::Pieces,
    },
    simd::{Lanes, Pass},
};
use std::ops::Range;

/// Cells around what is sought that are worked on as well: corners of a cell in which grains touch can have a stress, what an
/// iteration gives it comes from faces up to two cells from there, and what is strained where grains touch in the next substep from
/// faces of one cell more.
const REACH: usize = 4;

/// Pieces of rows of faces, cells and their lower left corners.
#[derive(Clone, Debug, Default)]
pub(super) struct Near {
    /// Faces that grains reach.
    reached: Pieces,
    /// Where grains touch, or are under stress.
    touching: Pieces,
    /// What friction works on, and did in the last substep. Outside of it nothing is stressed or strained.
    now: Pieces,
    before: Pieces,
}

impl Near {
    /// All of a grid, where it is unknown what is stressed.
    pub fn all(grid: &MacGrid) -> Self {
        let none = || Pieces::new(grid.columns + 1, grid.rows, 0);
        let mut all = Self { reached: none(), touching: none(), now: none(), before: none() };
        all.now.fill();
        all
    }

    /// Finds it anew, among the rows and columns that particles reach. `is_stressed` says whether any of some cells side by side, or
    /// of their corners, is.
    pub fn find(
        &mut self,
        bed: &Bed,
        (rows, columns): (&Range<usize>, &Range<usize>),
        spread: &Spread,
        is_stressed: impl Fn(Range<usize>) -> bool,
    ) {
        bed.team.instructions.run(Find { near: self, bed, rows, columns, spread, is_stressed });
    }

    /// Faces that grains reach.
    pub fn reached(&self) -> &Pieces {
        &self.reached
    }

    /// What friction works on, with rows of padding.
    pub fn now(&self) -> &Pieces {
        &self.now
    }

    /// Rows of cells, with one more.
    pub fn rows(&self, grid: &MacGrid) -> Range<usize> {
        let Range { start, end } = self.now.rows();
        start.max(1)..end.min(grid.rows + 2).max(1)
    }

    /// Those of a row that are worked on.
    #[inline(always)]
    pub fn runs(&self, row: usize) -> impl Iterator<Item = Range<usize>> + use<'_> {
        self.now.runs(row)
    }

    /// How many of a row are, on the mean.
    pub fn per_row(&self) -> usize {
        self.now.per_row().max(1)
    }

    /// Shows `visit` the indices of what was worked on in the last substep and no longer is.
    pub fn left(&self, grid: &MacGrid, mut visit: impl FnMut(Range<usize>)) {
        self.before.without(&self.now, |row, run| visit(grid.row(row) + run.start..grid.row(row) + run.end));
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        [&self.reached, &self.touching, &self.now, &self.before].map(Pieces::memory).iter().sum()
    }
}

struct Find<'a, F> {
    near: &'a mut Near,
    bed: &'a Bed<'a>,
    rows: &'a Range<usize>,
    columns: &'a Range<usize>,
    spread: &'a Spread<'a>,
    is_stressed: F,
}

impl<F: Fn(Range<usize>) -> bool> Pass for Find<'_, F> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { near: Near { reached, touching, now, before }, bed, rows, columns, spread, is_stressed } = self;
        let grid = bed.grid;
        std::mem::swap(now, before);
        let indices = |row: usize, columns: Range<usize>| grid.row(row) + columns.start..grid.row(row) + columns.end;
        let across = columns.start..columns.end + 1;
        reached.find_by(rows.clone(), across.clone(), |row, columns| spread.any(indices(row, columns)));
        let rows = rows.start.saturating_sub(2).max(1)..(rows.end + 1).min(grid.rows + 2);
        touching.find_by(rows, across, |row, around| {
            let cells = around.start.saturating_sub(REACH).max(1)..(around.end + REACH).min(columns.end);
            let cells = indices(row, cells);
            (reached.is_near(row, around.start) && spread.any_touch(bed, cells.clone())) || is_stressed(cells)
        });
        now.widen(touching, REACH);
    }
}
