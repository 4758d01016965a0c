//! Preconditioned conjugate gradients.

use crate::kernel::{
    parallel::{Rows, Sweep, Team, sweep},
    predictor::{
        PredictorReport,
        level::{RowSums, WORTH_A_PIECE, row_dot},
        multigrid::Hierarchy,
    },
};
use std::ops::Range;

/// Iterations at most; one to three are usual.
const MOST_ITERATIONS: u32 = 8;
/// Residual, relative to the right-hand side, at which it is good enough: what is left is the constraint's to do.
const TOLERANCE: f64 = 0.1;
/// Substep from which on that holds, s: shorter ones must each be as much better, or what is left adds up. The first guess
/// lags behind a body that moves, so that it drags at it.
const LONG_ENOUGH: f64 = 1.0 / 120.0;

/// The residual at which a solve for a substep of `dt` (s) is good enough.
pub(super) fn tolerance(dt: f32) -> f64 {
    let share = f64::from(dt) / LONG_ENOUGH;
    TOLERANCE * if share < 0.999 { share } else { 1.0 }
}

/// The vectors of the iteration. The solution stays as the next first guess.
#[derive(Clone, Debug, Default)]
pub(super) struct Conjugate {
    /// Rows from the first to the last that has a liquid cell. Outside of them `liquid` and `solution` are 0 and the other
    /// fields are not read.
    pub rows: Range<usize>,
    /// 1 in liquid cells, else 0.
    pub liquid: Vec<f32>,
    /// In: first guess. Out: solution, d/s.
    pub solution: Vec<f32>,
    /// Whether a row has liquid.
    pub wet: Vec<bool>,
    direction: Vec<f32>,
    sums: [RowSums; 2],
}

impl Conjugate {
    /// Makes room for a grid.
    pub fn resize(&mut self, len: usize) {
        for field in [&mut self.liquid, &mut self.solution, &mut self.direction] {
            field.resize(len, 0.0);
        }
    }

    /// Sets out from a solution that reaches over `rows`.
    pub fn resume(&mut self, solution: Vec<f32>, rows: Range<usize>) {
        self.resize(solution.len());
        (self.solution, self.rows) = (solution, rows);
    }

    /// Solves the equation of the hierarchy's finest level, whose right-hand side becomes the residual, up to `tolerance`.
    pub fn solve(&mut self, hierarchy: &mut Hierarchy, tolerance: f64, team: Team) -> PredictorReport {
        let Self { solution, direction, sums: [sums, after], .. } = self;
        let finest = hierarchy.finest();
        let (stride, rows, cells) = (finest.stride, finest.rows.clone(), finest.cells());
        // The operator reads one row below and one above.
        direction[cells.start - stride..cells.start].fill(0.0);
        direction[cells.end..cells.end + stride].fill(0.0);
        let [scale, mut left] = finest.take_product_off(solution, [&mut *sums, after], team);
        let scale = scale.max(1e-30);
        let (mut iterations, mut last) = (0, f64::INFINITY);
        while iterations < MOST_ITERATIONS && left > tolerance * tolerance * scale {
            let next = hierarchy.cycle(sums, team);
            let finest = hierarchy.finest();
            let turn =
                Turn { preconditioned: &finest.x, stride, keep: (next / last) as f32, is_first: iterations == 0 };
            sweep(&turn, rows.clone(), Rows::new(direction, stride, &rows), stride, WORTH_A_PIECE, team);
            last = next;
            let curvature = finest.apply(direction, sums, team);
            if curvature <= 0.0 || !curvature.is_finite() {
                break;
            }
            let advance = Advance { direction, product: &finest.work, stride, step: (next / curvature) as f32 };
            let fields = (Rows::new(solution, stride, &rows), Rows::new(&mut finest.b, stride, &rows));
            sweep(&advance, rows.clone(), (fields, sums.rows(&rows)), stride, WORTH_A_PIECE, team);
            left = sums.total(&rows);
            iterations += 1;
        }
        if left.is_nan() || left > scale {
            // Worse than no pressure at all: better to leave it all to the constraint than to act on it.
            solution[cells].fill(0.0);
        }
        let unsolved = left.is_nan() || left > tolerance * tolerance * scale;
        PredictorReport { liquid: true, iterations, residual: (left / scale).sqrt() as f32, unsolved, cuts: 0 }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let fields = [&self.liquid, &self.solution, &self.direction];
        4 * fields.iter().map(|field| field.capacity()).sum::<usize>()
    }
}

/// Turns the direction.
struct Turn<'a> {
    preconditioned: &'a [f32],
    stride: usize,
    /// Share of the last direction that is kept.
    keep: f32,
    is_first: bool,
}

impl Sweep<Rows<'_, f32>> for Turn<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, direction: Rows<f32>) {
        let preconditioned = &self.preconditioned[rows.start * self.stride..rows.end * self.stride];
        if self.is_first {
            direction.field.copy_from_slice(preconditioned);
        } else {
            for (direction, preconditioned) in direction.field.iter_mut().zip(preconditioned) {
                *direction = *preconditioned + self.keep * *direction;
            }
        }
    }
}

/// Goes a step along the direction and notes b · b for each row.
struct Advance<'a> {
    direction: &'a [f32],
    /// A times the direction.
    product: &'a [f32],
    stride: usize,
    step: f32,
}

/// Rows of solution and right-hand side, and their sums.
type Advanced<'a> = ((Rows<'a, f32>, Rows<'a, f32>), Rows<'a, f64>);

impl Sweep<Advanced<'_>> for Advance<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((mut solution, mut b), sums): Advanced) {
        for (((j, solution), b), sum) in rows.zip(solution.each()).zip(b.each()).zip(sums.field) {
            let cells = j * self.stride..(j + 1) * self.stride;
            let (direction, product) = (&self.direction[cells.clone()], &self.product[cells]);
            for i in 0..solution.len() {
                solution[i] += self.step * direction[i];
                b[i] -= self.step * product[i];
            }
            *sum = row_dot(b, b);
        }
    }
}
