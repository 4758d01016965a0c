//! The multigrid V-cycle that preconditions the pressure equation: damped Jacobi, aggregation of 2 × 2 cells, Galerkin
//! coarse operators, an over-weighted coarse correction (aggregation underestimates smooth corrections, Braess 1995).

use crate::{
    parallel::{Rows, Sweep, Team, sweep},
    predictor::level::{Level, RowSums, WORTH_A_PIECE, damping},
};
use std::ops::Range;

/// Weight of the coarse correction.
const CORRECTION: f32 = 1.8;
/// Smoothing steps on the coarsest level.
const COARSEST_STEPS: usize = 12;

/// All levels, finest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Hierarchy {
    levels: Vec<Level>,
}

impl Hierarchy {
    /// Levels down to a handful of cells.
    pub fn new(columns: usize, rows: usize) -> Self {
        let mut levels = vec![Level::new(columns, rows, 0)];
        let (mut columns, mut rows) = (columns, rows);
        while columns * rows > 16 {
            (columns, rows) = (columns.div_ceil(2), rows.div_ceil(2));
            levels.push(Level::new(columns, rows, levels.len()));
        }
        Self { levels }
    }

    /// The level of the grid itself.
    pub fn finest(&mut self) -> &mut Level {
        &mut self.levels[0]
    }

    /// All of them.
    #[cfg(test)]
    pub fn levels(&mut self) -> &mut [Level] {
        &mut self.levels
    }

    /// Builds the coarse operators from the finest.
    pub fn coarsen(&mut self, team: Team) {
        for depth in 1..self.levels.len() {
            let (fine, coarse) = self.levels.split_at_mut(depth);
            coarsen(&fine[depth - 1], &mut coarse[0], team);
        }
    }

    /// One V(2,2) cycle for the right-hand side in `finest().b`, from 0; the result is in `finest().x`. Returns b · x.
    pub fn cycle(&mut self, sums: &mut RowSums, team: Team) -> f64 {
        let coarsest = self.levels.len() - 1;
        for depth in 0..coarsest {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            let fine = &mut fine[depth];
            fine.smooth_from_zero(team);
            fine.restrict(&mut coarse[0], team);
        }
        let level = &mut self.levels[coarsest];
        level.smooth_from_zero(team);
        for _ in 0..COARSEST_STEPS - 1 {
            level.smooth(team);
        }
        for depth in (0..coarsest).rev() {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            let fine = &mut fine[depth];
            prolong(&coarse[0], fine, team);
            fine.smooth(team);
            if depth > 0 {
                fine.smooth(team);
            }
        }
        // Where there is one level only, this is a step more.
        self.levels[0].smooth_and_sum(sums, team)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.levels.iter().map(Level::memory).sum()
    }
}

/// The two rows of cells that a run of a coarse row is made of, as pairs along the row. What is not solved for is 0.
#[inline(always)]
fn pairs<'a>(field: &'a [f32], fine: &Level, row: usize, run: &Range<usize>) -> [&'a [[f32; 2]]; 2] {
    [2 * row - 1, 2 * row].map(|j| field[j * fine.stride + 2 * run.start - 1..][..2 * run.len()].as_chunks().0)
}

/// Couplings across the edge of an aggregate add up, those inside one leave the diagonal.
fn coarsen(fine: &Level, coarse: &mut Level, team: Team) {
    coarse.wet.coarsen(&fine.wet);
    coarse.take();
    let (rows, stride) = (coarse.wet.rows(), coarse.stride);
    let mut operator = std::mem::take(&mut coarse.operator);
    let [diagonal, damped, right, upper] = operator.fields_mut().map(|field| Rows::new(field, stride, &rows));
    let band = ((diagonal, damped), (right, upper));
    sweep(&Coarsen { fine, coarse }, rows, band, 4 * coarse.wet.per_row(), WORTH_A_PIECE, team);
    coarse.operator = operator;
}

struct Coarsen<'a> {
    fine: &'a Level,
    coarse: &'a Level,
}

/// Rows of diagonal and damping, and of the couplings to the right and up.
type Operator<'a> = ((Rows<'a, f32>, Rows<'a, f32>), (Rows<'a, f32>, Rows<'a, f32>));

impl Sweep<Operator<'_>> for Coarsen<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((mut diagonal, mut damped), (mut right, mut upper)): Operator) {
        let [of_diagonal, _, of_right, of_upper] = self.fine.operator.fields();
        let out = diagonal.each().zip(damped.each()).zip(right.each()).zip(upper.each());
        for (j, (((to_diagonal, to_damped), to_right), to_upper)) in rows.zip(out) {
            for run in self.coarse.wet.runs(j) {
                let [diagonal, right, upper] =
                    [of_diagonal, of_right, of_upper].map(|field| pairs(field, self.fine, j, &run));
                let (to_diagonal, to_damped) = (&mut to_diagonal[run.clone()], &mut to_damped[run.clone()]);
                let (to_right, to_upper) = (&mut to_right[run.clone()], &mut to_upper[run]);
                for i in 0..to_diagonal.len() {
                    let whole = (diagonal[0][i][0] + diagonal[0][i][1]) + (diagonal[1][i][0] + diagonal[1][i][1]);
                    let inside = (right[0][i][0] + right[1][i][0]) + (upper[0][i][0] + upper[0][i][1]);
                    to_diagonal[i] = whole - 2.0 * inside;
                    to_damped[i] = damping(to_diagonal[i]);
                    to_right[i] = right[0][i][1] + right[1][i][1];
                    to_upper[i] = upper[1][i][0] + upper[1][i][1];
                }
            }
        }
    }
}

/// Adds the coarse solution to the fine one.
fn prolong(coarse: &Level, fine: &mut Level, team: Team) {
    let mut x = std::mem::take(&mut fine.x);
    let band = Rows::new(&mut x, fine.stride, &fine.wet.rows());
    sweep(&Prolong { coarse, fine }, fine.wet.rows(), band, fine.wet.per_row(), WORTH_A_PIECE, team);
    fine.x = x;
}

struct Prolong<'a> {
    coarse: &'a Level,
    fine: &'a Level,
}

impl Sweep<Rows<'_, f32>> for Prolong<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut x: Rows<f32>) {
        let Self { coarse, fine } = self;
        let [_, of_damped, ..] = fine.operator.fields();
        for (j, x) in rows.zip(x.each()) {
            // A run begins with a pair; its last may be cut by the grid's edge.
            for run in fine.wet.runs(j) {
                let from = &coarse.x[j.div_ceil(2) * coarse.stride + run.start.div_ceil(2)..];
                // What is not solved for stays 0.
                let weight = |damped: f32| if damped > 0.0 { CORRECTION } else { 0.0 };
                let (damped, odd_damped) = of_damped[j * fine.stride..][run.clone()].as_chunks();
                let (x, odd_x) = x[run].as_chunks_mut();
                let pairs = x.len();
                for (([left, right], [damped_left, damped_right]), from) in x.iter_mut().zip(damped).zip(from) {
                    *left += weight(*damped_left) * from;
                    *right += weight(*damped_right) * from;
                }
                if let ([x], [damped]) = (odd_x, odd_damped) {
                    *x += weight(*damped) * from[pairs];
                }
            }
        }
    }
}
