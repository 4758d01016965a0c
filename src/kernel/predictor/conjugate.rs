//! Preconditioned conjugate gradients.

use crate::kernel::{
    parallel::Team,
    predictor::{PredictorReport, grid::MacGrid, multigrid::Hierarchy},
};
use std::ops::Range;

/// Iterations at most; one to three are usual.
const MOST_ITERATIONS: u32 = 8;
/// Residual, relative to the right-hand side, at which it is good enough: what is left is the constraint's to do.
const TOLERANCE: f64 = 0.1;

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
    direction: Vec<f32>,
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

    /// Keeps the last solution as the first guess where there still is liquid; `before` are the rows that had it.
    #[inline(always)]
    pub fn keep_guess(&mut self, grid: &MacGrid, before: Range<usize>) {
        let before = grid.rows(before);
        for (p, liquid) in self.solution[before.clone()].iter_mut().zip(&self.liquid[before]) {
            *p *= *liquid;
        }
    }

    /// Solves the equation of the hierarchy's finest level, whose right-hand side becomes the residual.
    #[inline(always)]
    pub fn solve(&mut self, hierarchy: &mut Hierarchy, team: Team) -> PredictorReport {
        let Self { solution, direction, .. } = self;
        let (stride, cells) = (hierarchy.finest().stride, hierarchy.finest().cells());
        // The operator reads one row below and one above.
        direction[cells.start - stride..cells.start].fill(0.0);
        direction[cells.end..cells.end + stride].fill(0.0);
        let finest = hierarchy.finest();
        let scale = dot(&finest.b[cells.clone()], &finest.b[cells.clone()]).max(1e-30);
        finest.apply(solution, team);
        let mut left = subtract(&mut finest.b[cells.clone()], 1.0, &finest.work[cells.clone()]);
        let (mut iterations, mut last) = (0, 0.0);
        while iterations < MOST_ITERATIONS && left > TOLERANCE * TOLERANCE * scale {
            hierarchy.cycle(team);
            let finest = hierarchy.finest();
            let preconditioned = &finest.x[cells.clone()];
            let next = dot(&finest.b[cells.clone()], preconditioned);
            if iterations == 0 {
                direction[cells.clone()].copy_from_slice(preconditioned);
            } else {
                let keep = (next / last) as f32;
                for (direction, preconditioned) in direction[cells.clone()].iter_mut().zip(preconditioned) {
                    *direction = *preconditioned + keep * *direction;
                }
            }
            last = next;
            finest.apply(direction, team);
            let curvature = dot(&direction[cells.clone()], &finest.work[cells.clone()]);
            if curvature <= 0.0 || !curvature.is_finite() {
                break;
            }
            let step = (next / curvature) as f32;
            for (solution, direction) in solution[cells.clone()].iter_mut().zip(&direction[cells.clone()]) {
                *solution += step * *direction;
            }
            left = subtract(&mut finest.b[cells.clone()], step, &finest.work[cells.clone()]);
            iterations += 1;
        }
        if left.is_nan() || left > scale {
            // Worse than no pressure at all: better to leave it all to the constraint than to act on it.
            solution[cells].fill(0.0);
        }
        PredictorReport { liquid: true, iterations, residual: (left / scale).sqrt() as f32 }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let fields = [&self.liquid, &self.solution, &self.direction];
        4 * fields.iter().map(|field| field.capacity()).sum::<usize>()
    }
}

/// Lanes of the sums: fixed, so that their rounding does not depend on the processor.
const SUM_LANES: usize = 32;
/// Entries that are summed in single precision before they go to the double-precision sum.
const SUM_CHUNK: usize = 1024;

/// `a · b` with a fixed order of sums.
#[inline(always)]
fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut total = 0.0;
    for (a, b) in a.chunks(SUM_CHUNK).zip(b.chunks(SUM_CHUNK)) {
        let mut lanes = [0.0_f32; SUM_LANES];
        let (a_rows, a_rest) = a.as_chunks::<SUM_LANES>();
        let (b_rows, b_rest) = b.as_chunks::<SUM_LANES>();
        for (a, b) in a_rows.iter().zip(b_rows) {
            for lane in 0..SUM_LANES {
                lanes[lane] += a[lane] * b[lane];
            }
        }
        for (lane, (a, b)) in lanes.iter_mut().zip(a_rest.iter().zip(b_rest)) {
            *lane += a * b;
        }
        total += total_of(lanes);
    }
    total
}

/// `a −= share · b`; returns `a · a`, in the order of [`dot`].
#[inline(always)]
fn subtract(a: &mut [f32], share: f32, b: &[f32]) -> f64 {
    let mut total = 0.0;
    for (a, b) in a.chunks_mut(SUM_CHUNK).zip(b.chunks(SUM_CHUNK)) {
        for (a, b) in a.iter_mut().zip(b) {
            *a -= share * b;
        }
        total += dot(a, a);
    }
    total
}

/// The sum of lanes, halving them each time.
#[inline(always)]
fn total_of(mut lanes: [f32; SUM_LANES]) -> f64 {
    let mut width = SUM_LANES / 2;
    while width > 0 {
        for lane in 0..width {
            lanes[lane] += lanes[lane + width];
        }
        width /= 2;
    }
    f64::from(lanes[0])
}
