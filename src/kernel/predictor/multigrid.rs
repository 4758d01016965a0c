//! The multigrid V-cycle that preconditions the pressure equation: damped Jacobi, aggregation of 2 × 2 cells, Galerkin
//! coarse operators, an over-weighted coarse correction (aggregation underestimates smooth corrections, Braess 1995).

use crate::kernel::{parallel::Team, predictor::level::Level};

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
        let mut levels = vec![Level::new(columns, rows)];
        let (mut columns, mut rows) = (columns, rows);
        while columns * rows > 16 {
            (columns, rows) = (columns.div_ceil(2), rows.div_ceil(2));
            levels.push(Level::new(columns, rows));
        }
        Self { levels }
    }

    /// The level of the grid itself.
    pub fn finest(&mut self) -> &mut Level {
        &mut self.levels[0]
    }

    /// Builds the coarse operators from the finest.
    #[inline(always)]
    pub fn coarsen(&mut self) {
        self.levels[0].invert();
        for depth in 1..self.levels.len() {
            let (fine, coarse) = self.levels.split_at_mut(depth);
            coarsen(&fine[depth - 1], &mut coarse[0]);
        }
    }

    /// One V(2,2) cycle for the right-hand side in `finest().b`, from 0; the result is in `finest().x`.
    #[inline(always)]
    pub fn cycle(&mut self, team: Team) {
        let coarsest = self.levels.len() - 1;
        for depth in 0..coarsest {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            let (fine, coarse) = (&mut fine[depth], &mut coarse[0]);
            fine.smooth_from_zero();
            fine.smooth(team);
            fine.find_residual(team);
            restrict(fine, coarse);
        }
        let level = &mut self.levels[coarsest];
        level.smooth_from_zero();
        for _ in 0..COARSEST_STEPS {
            level.smooth(team);
        }
        for depth in (0..coarsest).rev() {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            let (fine, coarse) = (&mut fine[depth], &coarse[0]);
            prolong(coarse, fine);
            fine.smooth(team);
            fine.smooth(team);
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.levels.iter().map(Level::memory).sum()
    }
}

/// The two rows of cells that a coarse row is made of, from the first column on, as pairs along the row. A row that is
/// not solved for and the padding at the end of an odd row are 0.
#[inline(always)]
fn pairs<'a>(field: &'a [f32], fine: &Level, coarse: &Level, row: usize) -> [&'a [[f32; 2]]; 2] {
    [2 * row - 1, 2 * row].map(|j| field[j * fine.stride + 1..][..2 * coarse.columns].as_chunks().0)
}

/// Couplings across the edge of an aggregate add up, those inside one leave the diagonal.
#[inline(always)]
fn coarsen(fine: &Level, coarse: &mut Level) {
    coarse.take_rows(fine.rows.start.div_ceil(2)..fine.rows.end / 2 + 1);
    for j in coarse.rows.clone() {
        let [diagonal, right, upper] =
            [&fine.diagonal, &fine.right, &fine.upper].map(|field| pairs(field, fine, coarse, j));
        let out = j * coarse.stride + 1..j * coarse.stride + 1 + coarse.columns;
        let (to_right, to_upper) = (&mut coarse.right[out.clone()], &mut coarse.upper[out.clone()]);
        let to_diagonal = &mut coarse.diagonal[out];
        for i in 0..to_diagonal.len() {
            let whole = (diagonal[0][i][0] + diagonal[0][i][1]) + (diagonal[1][i][0] + diagonal[1][i][1]);
            let inside = (right[0][i][0] + right[1][i][0]) + (upper[0][i][0] + upper[0][i][1]);
            to_diagonal[i] = whole - 2.0 * inside;
            to_right[i] = right[0][i][1] + right[1][i][1];
            to_upper[i] = upper[1][i][0] + upper[1][i][1];
        }
    }
    coarse.invert();
}

/// The coarse right-hand side: the sum of an aggregate's residuals.
#[inline(always)]
fn restrict(fine: &Level, coarse: &mut Level) {
    for j in coarse.rows.clone() {
        let [lower, upper] = pairs(&fine.work, fine, coarse, j);
        let out = j * coarse.stride + 1..j * coarse.stride + 1 + coarse.columns;
        for ((sum, lower), upper) in coarse.b[out].iter_mut().zip(lower).zip(upper) {
            *sum = (lower[0] + lower[1]) + (upper[0] + upper[1]);
        }
    }
}

/// Adds the coarse solution to the fine one.
#[inline(always)]
fn prolong(coarse: &Level, fine: &mut Level) {
    for j in fine.rows.clone() {
        let own = j * fine.stride + 1..j * fine.stride + 1 + fine.columns;
        let from = &coarse.x[j.div_ceil(2) * coarse.stride + 1..][..coarse.columns];
        // What is not solved for stays 0.
        let weight = |damped: f32| if damped > 0.0 { CORRECTION } else { 0.0 };
        let (x, odd_x) = fine.x[own.clone()].as_chunks_mut();
        let (damped, odd_damped) = fine.damped[own].as_chunks();
        for (([left, right], [damped_left, damped_right]), from) in x.iter_mut().zip(damped).zip(from) {
            *left += weight(*damped_left) * from;
            *right += weight(*damped_right) * from;
        }
        if let ([x], [damped], Some(from)) = (odd_x, odd_damped, from.last()) {
            *x += weight(*damped) * from;
        }
    }
}
