//! Preconditioned conjugate gradients.

use crate::kernel::predictor::{PredictorReport, multigrid::Hierarchy};

/// Iterations at most; one to three are usual.
const MOST_ITERATIONS: u32 = 8;
/// Residual, relative to the right-hand side, at which it is good enough: what is left is the constraint's to do.
const TOLERANCE: f64 = 0.1;

/// The vectors of the iteration. The solution stays as the next first guess.
#[derive(Clone, Debug, Default)]
pub(super) struct Conjugate {
    /// 1 in liquid cells, else 0.
    pub liquid: Vec<f32>,
    /// In: right-hand side. During the solve: the residual.
    pub right_side: Vec<f32>,
    /// In: first guess. Out: solution, d/s.
    pub solution: Vec<f32>,
    direction: Vec<f32>,
    product: Vec<f32>,
}

impl Conjugate {
    /// Makes room for a grid.
    pub fn resize(&mut self, len: usize) {
        for field in
            [&mut self.liquid, &mut self.right_side, &mut self.solution, &mut self.direction, &mut self.product]
        {
            field.resize(len, 0.0);
        }
    }

    /// Solves the equation of the hierarchy's finest level.
    #[inline(always)]
    pub fn solve(&mut self, hierarchy: &mut Hierarchy) -> PredictorReport {
        let Self { right_side: residual, solution, direction, product, .. } = self;
        let scale = dot(residual, residual).max(1e-30);
        product.fill(0.0);
        hierarchy.finest().apply(solution, product);
        for (residual, product) in residual.iter_mut().zip(product.iter()) {
            *residual -= *product;
        }
        let mut left = dot(residual, residual);
        let (mut iterations, mut last) = (0, 0.0);
        while iterations < MOST_ITERATIONS && left > TOLERANCE * TOLERANCE * scale {
            hierarchy.finest().b.copy_from_slice(residual);
            hierarchy.cycle();
            let preconditioned = &hierarchy.finest().x;
            let next = dot(residual, preconditioned);
            if iterations == 0 {
                direction.copy_from_slice(preconditioned);
            } else {
                let keep = (next / last) as f32;
                for (direction, preconditioned) in direction.iter_mut().zip(preconditioned) {
                    *direction = *preconditioned + keep * *direction;
                }
            }
            last = next;
            hierarchy.finest().apply(direction, product);
            let curvature = dot(direction, product);
            if curvature <= 0.0 || !curvature.is_finite() {
                break;
            }
            let step = (next / curvature) as f32;
            for (solution, direction) in solution.iter_mut().zip(direction.iter()) {
                *solution += step * *direction;
            }
            for (residual, product) in residual.iter_mut().zip(product.iter()) {
                *residual -= step * *product;
            }
            iterations += 1;
            left = dot(residual, residual);
        }
        if left.is_nan() || left > scale {
            // Worse than no pressure at all: better to leave it all to the constraint than to act on it.
            solution.fill(0.0);
        }
        PredictorReport { liquid: true, iterations, residual: (left / scale).sqrt() as f32 }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let fields = [&self.liquid, &self.right_side, &self.solution, &self.direction, &self.product];
        4 * fields.iter().map(|field| field.capacity()).sum::<usize>()
    }
}

/// Lanes of the dot product: fixed, so that its rounding does not depend on the processor.
const DOT_LANES: usize = 32;
/// Entries that are summed in single precision before they go to the double-precision sum.
const DOT_CHUNK: usize = 1024;

/// `a · b` with a fixed order of sums.
#[inline(always)]
fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut total = 0.0;
    for (a, b) in a.chunks(DOT_CHUNK).zip(b.chunks(DOT_CHUNK)) {
        let mut lanes = [0.0_f32; DOT_LANES];
        let (a_rows, a_rest) = a.as_chunks::<DOT_LANES>();
        let (b_rows, b_rest) = b.as_chunks::<DOT_LANES>();
        for (a, b) in a_rows.iter().zip(b_rows) {
            for lane in 0..DOT_LANES {
                lanes[lane] += a[lane] * b[lane];
            }
        }
        for (lane, (a, b)) in lanes.iter_mut().zip(a_rest.iter().zip(b_rest)) {
            *lane += a * b;
        }
        total += lanes.iter().map(|&lane| f64::from(lane)).sum::<f64>();
    }
    total
}
