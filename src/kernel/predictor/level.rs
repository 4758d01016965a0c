//! One level of the pressure equation: the operator and its smoother.

use crate::kernel::{
    parallel::{Team, by_rows},
    simd::{Lanes, Pass},
};
use std::ops::Range;

/// Damping of the Jacobi smoother.
const DAMPING: f32 = 0.8;
/// A coarse cell that is coupled to less than this is left out.
const LEAST_DIAGONAL: f32 = 1e-3;
/// Fewer cells than this are not handed to another thread: the operator takes a fraction of a nanosecond for each.
const WORTH_A_PIECE: usize = 8192;

/// The equation `diagonal x_c − Σ coupling x_n = b` on one level. Cells are indexed as in `MacGrid`. In the padding left
/// and right all fields are 0.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub columns: usize,
    pub stride: usize,
    /// Rows that are solved for. In the row below and the row above all fields are 0; beyond, nothing is read.
    pub rows: Range<usize>,
    /// Σ of the open shares of a cell's faces; 0 where there is nothing to solve.
    pub diagonal: Vec<f32>,
    /// Damping/diagonal, or 0.
    pub damped: Vec<f32>,
    /// Coupling to the right neighbour.
    pub right: Vec<f32>,
    /// Coupling to the upper neighbour.
    pub upper: Vec<f32>,
    /// Unknowns.
    pub x: Vec<f32>,
    /// Right-hand side. On the finest level, conjugate gradients keep their residual here.
    pub b: Vec<f32>,
    /// What [`Level::apply`] or [`Level::find_residual`] found, and the next unknowns while smoothing.
    pub work: Vec<f32>,
}

impl Level {
    /// A level of `columns × rows` cells.
    pub fn new(columns: usize, rows: usize) -> Self {
        let stride = columns + 2;
        let field = || vec![0.0; stride * (rows + 3)];
        Self {
            columns,
            stride,
            rows: 1..1,
            diagonal: field(),
            damped: field(),
            right: field(),
            upper: field(),
            x: field(),
            b: field(),
            work: field(),
        }
    }

    /// Says which rows are solved for; the caller fills the operator in there.
    pub fn take_rows(&mut self, rows: Range<usize>) {
        let below = (rows.start - 1) * self.stride..rows.start * self.stride;
        let above = rows.end * self.stride..(rows.end + 1) * self.stride;
        for field in [
            &mut self.diagonal,
            &mut self.damped,
            &mut self.right,
            &mut self.upper,
            &mut self.x,
            &mut self.b,
            &mut self.work,
        ] {
            field[below.clone()].fill(0.0);
            field[above.clone()].fill(0.0);
        }
        self.rows = rows;
    }

    /// The indices of the rows that are solved for.
    pub fn cells(&self) -> Range<usize> {
        self.rows.start * self.stride..self.rows.end * self.stride
    }

    /// Follows the diagonal.
    #[inline(always)]
    pub fn invert(&mut self) {
        let cells = self.cells();
        for (damped, &diagonal) in self.damped[cells.clone()].iter_mut().zip(&self.diagonal[cells]) {
            *damped = if diagonal > LEAST_DIAGONAL { DAMPING / diagonal } else { 0.0 };
        }
    }

    /// Finds A x.
    pub fn apply(&mut self, x: &[f32], team: Team) {
        let mut work = std::mem::take(&mut self.work);
        self.for_each(x, &mut work, team, |_, product, _, _| product);
        self.work = work;
    }

    /// Finds b − A x of the level's own unknowns.
    pub fn find_residual(&mut self, team: Team) {
        let mut work = std::mem::take(&mut self.work);
        self.for_each(&self.x, &mut work, team, |_, product, b, _| b - product);
        self.work = work;
    }

    /// The first Jacobi step, from x = 0.
    #[inline(always)]
    pub fn smooth_from_zero(&mut self) {
        let cells = self.cells();
        for ((x, b), damped) in self.x[cells.clone()].iter_mut().zip(&self.b[cells.clone()]).zip(&self.damped[cells]) {
            *x = *damped * *b;
        }
    }

    /// A Jacobi step.
    pub fn smooth(&mut self, team: Team) {
        let mut next = std::mem::take(&mut self.work);
        self.for_each(&self.x, &mut next, team, |x, product, b, damped| x + damped * (b - product));
        self.work = std::mem::replace(&mut self.x, next);
    }

    /// Sets `out_c` to `value(x_c, (A x)_c, b_c, damped_c)` in every cell.
    fn for_each(&self, x: &[f32], out: &mut [f32], team: Team, value: impl Fn(f32, f32, f32, f32) -> f32 + Sync) {
        by_rows(&mut out[self.cells()], self.stride, WORTH_A_PIECE, team.threads, &|row, out| {
            team.instructions.run(Rows { level: self, first: self.rows.start + row, x, out, value: &value });
        });
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        7 * 4 * self.x.capacity()
    }
}

/// Some rows of [`Level::for_each`].
struct Rows<'a, V> {
    level: &'a Level,
    /// First row.
    first: usize,
    x: &'a [f32],
    /// Out: the rows.
    out: &'a mut [f32],
    value: &'a V,
}

impl<V: Fn(f32, f32, f32, f32) -> f32> Pass for Rows<'_, V> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { level, first, x, out, value } = self;
        let (s, n) = (level.stride, level.columns);
        for (j, out) in (first..).zip(out.chunks_exact_mut(s)) {
            let o = j * s + 1;
            let (centre, left, right) = (&x[o..o + n], &x[o - 1..o - 1 + n], &x[o + 1..o + 1 + n]);
            let (lower, upper) = (&x[o - s..o - s + n], &x[o + s..o + s + n]);
            let diagonal = &level.diagonal[o..o + n];
            let (to_right, to_left) = (&level.right[o..o + n], &level.right[o - 1..o - 1 + n]);
            let (to_upper, to_lower) = (&level.upper[o..o + n], &level.upper[o - s..o - s + n]);
            let (b, damped) = (&level.b[o..o + n], &level.damped[o..o + n]);
            for (i, out) in out[1..=n].iter_mut().enumerate() {
                let product = diagonal[i] * centre[i]
                    - to_right[i] * right[i]
                    - to_left[i] * left[i]
                    - to_upper[i] * upper[i]
                    - to_lower[i] * lower[i];
                *out = value(centre[i], product, b[i], damped[i]);
            }
        }
    }
}
