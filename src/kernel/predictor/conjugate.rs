//! Preconditioned conjugate gradients.

use crate::{
    parallel::{Rows, Sweep, Team, sweep},
    predictor::{
        level::{Level, RowSums, WORTH_A_PIECE},
        multigrid::Hierarchy,
        pieces::Pieces,
        report::PredictorReport,
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
    /// Columns from the first to the last that has one, rounded to whole pieces.
    pub span: Range<usize>,
    /// 1 in liquid cells, else 0.
    pub liquid: Vec<f32>,
    /// The last pressure, d/s, which the next solve sets out from.
    pub solution: Vec<f32>,
    /// Room for the potential of the density feedback; all 0.
    pub potential: Vec<f32>,
    /// Columns near particles; in the others `liquid` and `solution` are 0.
    pub area: Range<usize>,
    direction: Vec<f32>,
    sums: [RowSums; 2],
}

impl Conjugate {
    /// Makes room for a grid.
    pub fn resize(&mut self, len: usize) {
        for field in [&mut self.liquid, &mut self.solution, &mut self.potential, &mut self.direction] {
            field.resize(len, 0.0);
        }
    }

    /// Sets out from a solution that reaches over `rows` and `columns`.
    pub fn resume(&mut self, solution: Vec<f32>, rows: Range<usize>, columns: Range<usize>) {
        self.resize(solution.len());
        (self.solution, self.rows, self.area) = (solution, rows, columns);
    }

    /// Solves the equation of the hierarchy's finest level, whose right-hand side becomes the residual, up to
    /// `tolerance`, setting out from what stands in `solution` (d/s).
    pub fn solve(
        &mut self,
        hierarchy: &mut Hierarchy,
        solution: &mut [f32],
        tolerance: f64,
        team: Team,
    ) -> PredictorReport {
        let Self { direction, sums: [sums, after], .. } = self;
        let finest = hierarchy.finest();
        let (stride, rows, per_row) = (finest.stride, finest.wet.rows(), finest.wet.per_row());
        // The operator reads one cell further.
        finest.wet.clear_around(direction, stride);
        let [scale, mut left] = finest.take_product_off(solution, [&mut *sums, after], team);
        let scale = scale.max(1e-30);
        let (mut iterations, mut last) = (0, f64::INFINITY);
        while iterations < MOST_ITERATIONS && left > tolerance * tolerance * scale {
            let next = hierarchy.cycle(sums, team);
            let finest = hierarchy.finest();
            let turn = Turn {
                preconditioned: &finest.x,
                stride,
                wet: &finest.wet,
                keep: (next / last) as f32,
                is_first: iterations == 0,
            };
            sweep(&turn, rows.clone(), Rows::new(direction, stride, &rows), per_row, WORTH_A_PIECE, team);
            last = next;
            let curvature = finest.apply(direction, sums, team);
            if curvature <= 0.0 || !curvature.is_finite() {
                break;
            }
            let Level { work: product, wet, b, .. } = finest;
            let advance = Advance { direction, product, stride, wet, step: (next / curvature) as f32 };
            let fields = (Rows::new(solution, stride, &rows), Rows::new(b, stride, &rows));
            sweep(&advance, rows.clone(), (fields, sums.rows(&rows)), per_row, WORTH_A_PIECE, team);
            left = sums.total(&rows);
            iterations += 1;
        }
        if left.is_nan() || left > scale {
            // Worse than no pressure at all: better to leave it all to the constraint than to act on it.
            solution[rows.start * stride..rows.end * stride].fill(0.0);
        }
        let unsolved = left.is_nan() || left > tolerance * tolerance * scale;
        PredictorReport { liquid: true, iterations, residual: (left / scale).sqrt() as f32, unsolved, cuts: 0 }
    }

    /// Clears what a solve wrote.
    pub fn clear(&self, solution: &mut [f32], stride: usize) {
        for j in self.rows.clone() {
            solution[j * stride..][self.span.clone()].fill(0.0);
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let fields = [&self.liquid, &self.solution, &self.potential, &self.direction];
        4 * fields.iter().map(|field| field.capacity()).sum::<usize>()
    }
}

/// Turns the direction.
struct Turn<'a> {
    preconditioned: &'a [f32],
    stride: usize,
    wet: &'a Pieces,
    /// Share of the last direction that is kept.
    keep: f32,
    is_first: bool,
}

impl Sweep<Rows<'_, f32>> for Turn<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut direction: Rows<f32>) {
        for (j, direction) in rows.zip(direction.each()) {
            for run in self.wet.runs(j) {
                let preconditioned = &self.preconditioned[j * self.stride..][run.clone()];
                let direction = &mut direction[run];
                if self.is_first {
                    direction.copy_from_slice(preconditioned);
                    continue;
                }
                for (direction, preconditioned) in direction.iter_mut().zip(preconditioned) {
                    *direction = *preconditioned + self.keep * *direction;
                }
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
    wet: &'a Pieces,
    step: f32,
}

/// Rows of solution and right-hand side, and their sums.
type Advanced<'a> = ((Rows<'a, f32>, Rows<'a, f32>), Rows<'a, f64>);

impl Sweep<Advanced<'_>> for Advance<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((mut solution, mut b), sums): Advanced) {
        for (((j, solution), b), sum) in rows.zip(solution.each()).zip(b.each()).zip(sums.field) {
            for run in self.wet.runs(j) {
                let [direction, product] =
                    [self.direction, self.product].map(|field| &field[j * self.stride..][run.clone()]);
                let (solution, own) = (&mut solution[run.clone()], &mut b[run]);
                for i in 0..solution.len() {
                    solution[i] += self.step * direction[i];
                    own[i] -= self.step * product[i];
                }
            }
            *sum = self.wet.dot(j, b, b);
        }
    }
}
