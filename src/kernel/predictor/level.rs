//! One level of the pressure equation: the operator, its smoother, and sums over cells.

use crate::{
    parallel::{Band, Rows, Sweep, Team, sweep},
    predictor::pieces::Pieces,
};
use std::ops::Range;

/// Damping of the Jacobi smoother.
const DAMPING: f32 = 0.8;
/// A coarse cell that is coupled to less than this is left out.
const LEAST_DIAGONAL: f32 = 1e-3;
/// Fewer cells than this are not handed to another thread: a sweep takes a fraction of a nanosecond for each.
pub(super) const WORTH_A_PIECE: usize = 1024;

/// The equation `diagonal x_c − Σ coupling x_n = b` on one level. Cells are indexed as in `MacGrid`. In the padding left
/// and right all fields are 0. What the finest level works in holds something else between two solves: the operator's memory
/// ([`Operator::exchange`]), and that of the vectors `x`, `b` and `work` ([`Level::borrow`]).
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub columns: usize,
    pub stride: usize,
    /// What is solved for. Around it all fields are 0; beyond, nothing is read.
    pub wet: Pieces,
    pub operator: Operator,
    /// Unknowns.
    pub x: Vec<f32>,
    /// Right-hand side. On the finest level, conjugate gradients keep their residual here.
    pub b: Vec<f32>,
    /// What [`Level::apply`] found, and the next unknowns while smoothing.
    pub work: Vec<f32>,
}

/// Memory of an operator. What is on the faces of a grid after a solve fits in, two numbers each.
pub(super) type Lent = [Vec<[f32; 2]>; 2];

/// Coefficients of the equation. Those of the finest level are found anew for each solve and read by nobody after it, so that
/// their memory is lent in between.
#[derive(Clone, Debug, Default)]
pub(super) struct Operator(Lent);

impl Operator {
    fn new(cells: usize) -> Self {
        Self([vec![[0.0; 2]; cells], vec![[0.0; 2]; cells]])
    }

    /// Of each cell: the sum of the open shares of its faces (*diagonal*; 0 where there is nothing to solve), damping over that or 0
    /// (*damped*), and how it is coupled to its neighbours to the *right* and *upper*.
    #[inline(always)]
    pub fn fields(&self) -> [&[f32]; 4] {
        let [first, second] = self.0.each_ref().map(|two| two.as_flattened().split_at(two.len()));
        [first.0, first.1, second.0, second.1]
    }

    /// The same, to be changed.
    #[inline(always)]
    pub fn fields_mut(&mut self) -> [&mut [f32]; 4] {
        let [first, second] = self.0.each_mut().map(|two| {
            let cells = two.len();
            two.as_flattened_mut().split_at_mut(cells)
        });
        [first.0, first.1, second.0, second.1]
    }

    /// Whether its memory is lent.
    pub fn is_lent(&self) -> bool {
        self.0[0].is_empty()
    }

    /// Lends its memory, or takes it back.
    pub fn exchange(&mut self, lent: &mut Lent) {
        std::mem::swap(&mut self.0, lent);
    }

    fn memory(&self) -> usize {
        self.0.iter().map(|two| 8 * two.capacity()).sum()
    }
}

impl Level {
    /// The level of `columns × rows` cells that is coarser by `depth` steps than the grid.
    pub fn new(columns: usize, rows: usize, depth: usize) -> Self {
        let stride = columns + 2;
        let field = || if depth > 0 { vec![0.0; stride * (rows + 3)] } else { Vec::new() };
        Self {
            columns,
            stride,
            wet: Pieces::new(columns, rows, depth),
            operator: Operator::new(stride * (rows + 3)),
            x: field(),
            b: field(),
            work: field(),
        }
    }

    /// Takes memory for its vectors of so many cells with the padding: that of `room`, where a number of each particle takes at least
    /// as much, else its own. Were `room` made larger for it, all columns of the particles would be in time, as they go round. What is
    /// in there does not matter. Returns whether it is that of `room`.
    pub fn borrow(&mut self, room: [&mut Vec<f32>; 3], cells: usize, particles: usize) -> bool {
        let fields = [&mut self.x, &mut self.b, &mut self.work];
        let is_large = fields.iter().all(|field| field.is_empty()) && room.iter().all(|room| room.capacity() >= cells);
        let is_lent = is_large || particles >= cells;
        for (field, room) in fields.into_iter().zip(room) {
            if is_lent {
                *field = std::mem::take(room);
            }
            if is_lent && field.capacity() < cells {
                *field = Vec::with_capacity(particles);
            }
            field.resize(cells, 0.0);
        }
        is_lent
    }

    /// Gives that memory back.
    pub fn give_back(&mut self, room: [&mut Vec<f32>; 3]) {
        let fields = [&mut self.x, &mut self.b, &mut self.work];
        fields.into_iter().zip(room).for_each(|(field, room)| *room = std::mem::take(field));
    }

    /// Clears around what is wet now; the caller fills the operator in there.
    pub fn take(&mut self) {
        let Self { stride, wet, operator, x, b, work, .. } = self;
        let [diagonal, damped, right, upper] = operator.fields_mut();
        let mut fields = [diagonal, damped, right, upper, x, b, work];
        wet.around(|row, columns| {
            for field in &mut fields {
                field[row * *stride..][columns.clone()].fill(0.0);
            }
        });
    }

    /// The operator and the right-hand side.
    fn equation(&self) -> Equation<'_> {
        let [diagonal, damped, right, upper] = self.operator.fields();
        Equation { wet: &self.wet, stride: self.stride, diagonal, damped, right, upper, b: &self.b }
    }

    /// Takes the operator's memory back, if it is lent, and empties the padding of what may hold something else.
    pub fn take_back(&mut self, lent: &mut Lent) {
        if self.operator.is_lent() {
            self.operator.exchange(lent);
        }
        let Self { columns, stride, wet, operator, x, b, work } = self;
        let [diagonal, damped, right, upper] = operator.fields_mut();
        for field in [diagonal, damped, right, upper, x, b, work] {
            for row in wet.rows_around() {
                (field[row * *stride], field[row * *stride + *columns + 1]) = (0.0, 0.0);
            }
        }
    }

    /// Sets `work` to A x; returns x · A x.
    pub fn apply(&mut self, x: &[f32], sums: &mut RowSums, team: Team) -> f64 {
        let mut work = std::mem::take(&mut self.work);
        let rows = self.wet.rows();
        let band = (Rows::new(&mut work, self.stride, &rows), sums.rows(&rows));
        self.sweep(&Apply { equation: self.equation(), x }, band, team);
        self.work = work;
        sums.total(&rows)
    }

    /// Takes A x off the right-hand side; returns b · b from before and after.
    pub fn take_product_off(&mut self, x: &[f32], sums: [&mut RowSums; 2], team: Team) -> [f64; 2] {
        let mut b = std::mem::take(&mut self.b);
        let ([before, after], rows) = (sums, self.wet.rows());
        let band = (Rows::new(&mut b, self.stride, &rows), (before.rows(&rows), after.rows(&rows)));
        self.sweep(&TakeProductOff { equation: self.equation(), x }, band, team);
        self.b = b;
        [before, after].map(|sums| sums.total(&rows))
    }

    /// The first two Jacobi steps, from x = 0.
    pub fn smooth_from_zero(&mut self, team: Team) {
        let mut x = std::mem::take(&mut self.x);
        let band = Rows::new(&mut x, self.stride, &self.wet.rows());
        self.sweep(&SmoothFromZero(self.equation()), band, team);
        self.x = x;
    }

    /// A Jacobi step.
    pub fn smooth(&mut self, team: Team) {
        let mut next = std::mem::take(&mut self.work);
        let band = Rows::new(&mut next, self.stride, &self.wet.rows());
        self.sweep(&Smooth { equation: self.equation(), x: &self.x }, band, team);
        self.work = std::mem::replace(&mut self.x, next);
    }

    /// A Jacobi step; returns b · x with the new x.
    pub fn smooth_and_sum(&mut self, sums: &mut RowSums, team: Team) -> f64 {
        let mut next = std::mem::take(&mut self.work);
        let rows = self.wet.rows();
        let band = (Rows::new(&mut next, self.stride, &rows), sums.rows(&rows));
        self.sweep(&Smooth { equation: self.equation(), x: &self.x }, band, team);
        self.work = std::mem::replace(&mut self.x, next);
        sums.total(&rows)
    }

    /// The residual's sums over 2 × 2 cells become the right-hand side of the next coarser level.
    pub fn restrict(&self, coarse: &mut Self, team: Team) {
        let (rows, per_row) = (coarse.wet.rows(), 4 * coarse.wet.per_row());
        let work = Restrict {
            equation: self.equation(),
            rows: self.wet.rows(),
            columns: self.columns,
            wet: &coarse.wet,
            x: &self.x,
        };
        let band = Rows::new(&mut coarse.b, coarse.stride, &rows);
        sweep(&work, rows.clone(), band, per_row, WORTH_A_PIECE, team);
    }

    fn sweep<B: Band>(&self, work: &impl Sweep<B>, band: B, team: Team) {
        sweep(work, self.wet.rows(), band, self.wet.per_row(), WORTH_A_PIECE, team);
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        3 * 4 * self.x.capacity() + self.operator.memory() + self.wet.memory()
    }
}

/// What damps the step of a cell of that diagonal.
#[inline(always)]
pub(super) fn damping(diagonal: f32) -> f32 {
    if diagonal > LEAST_DIAGONAL { DAMPING / diagonal } else { 0.0 }
}

/// The equation as sweeps read it.
struct Equation<'a> {
    wet: &'a Pieces,
    stride: usize,
    diagonal: &'a [f32],
    damped: &'a [f32],
    right: &'a [f32],
    upper: &'a [f32],
    b: &'a [f32],
}

impl Equation<'_> {
    /// Calls `take(i, (A x)_i)` for the `len` cells from index `first` on.
    #[inline(always)]
    fn products(&self, x: &[f32], first: usize, len: usize, mut take: impl FnMut(usize, f32)) {
        let (o, n, s) = (first, len, self.stride);
        let (centre, left, right) = (&x[o..o + n], &x[o - 1..o - 1 + n], &x[o + 1..o + 1 + n]);
        let (lower, upper) = (&x[o - s..o - s + n], &x[o + s..o + s + n]);
        let diagonal = &self.diagonal[o..o + n];
        let (to_right, to_left) = (&self.right[o..o + n], &self.right[o - 1..o - 1 + n]);
        let (to_upper, to_lower) = (&self.upper[o..o + n], &self.upper[o - s..o - s + n]);
        for i in 0..n {
            let product = diagonal[i] * centre[i]
                - to_right[i] * right[i]
                - to_left[i] * left[i]
                - to_upper[i] * upper[i]
                - to_lower[i] * lower[i];
            take(i, product);
        }
    }
}

struct Apply<'a> {
    equation: Equation<'a>,
    x: &'a [f32],
}

impl<'b> Sweep<(Rows<'b, f32>, Rows<'b, f64>)> for Apply<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut out, sums): (Rows<f32>, Rows<f64>)) {
        for ((j, out), sum) in rows.zip(out.each()).zip(sums.field) {
            let Equation { wet, stride, .. } = self.equation;
            for run in wet.runs(j) {
                let own = &mut out[run.clone()];
                self.equation.products(self.x, j * stride + run.start, run.len(), |i, product| own[i] = product);
            }
            *sum = wet.dot(j, out, &self.x[j * stride..]);
        }
    }
}

struct TakeProductOff<'a> {
    equation: Equation<'a>,
    x: &'a [f32],
}

impl<'b> Sweep<(Rows<'b, f32>, (Rows<'b, f64>, Rows<'b, f64>))> for TakeProductOff<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut b, (before, after)): (Rows<f32>, (Rows<f64>, Rows<f64>))) {
        for (((j, b), before), after) in rows.zip(b.each()).zip(before.field).zip(after.field) {
            let Equation { wet, stride, .. } = self.equation;
            *before = wet.dot(j, b, b);
            for run in wet.runs(j) {
                let own = &mut b[run.clone()];
                self.equation.products(self.x, j * stride + run.start, run.len(), |i, product| own[i] -= product);
            }
            *after = wet.dot(j, b, b);
        }
    }
}

struct SmoothFromZero<'a>(Equation<'a>);

impl Sweep<Rows<'_, f32>> for SmoothFromZero<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut out: Rows<f32>) {
        let equation = &self.0;
        let s = equation.stride;
        for (j, out) in rows.zip(out.each()) {
            for run in equation.wet.runs(j) {
                let cells = j * s + run.start..j * s + run.end;
                let (o, n) = (cells.start, cells.len());
                let out = &mut out[run];
                // The first step alone is damping times right-hand side, of a cell and of those around it.
                let [damped, d_left, d_right, d_lower, d_upper] = and_around(equation.damped, cells.clone(), s);
                let [b, b_left, b_right, b_lower, b_upper] = and_around(equation.b, cells.clone(), s);
                let diagonal = &equation.diagonal[cells.clone()];
                let (to_right, to_left) = (&equation.right[cells.clone()], &equation.right[o - 1..o - 1 + n]);
                let (to_upper, to_lower) = (&equation.upper[cells], &equation.upper[o - s..o - s + n]);
                for i in 0..n {
                    let first = damped[i] * b[i];
                    let product = diagonal[i] * first
                        - to_right[i] * (d_right[i] * b_right[i])
                        - to_left[i] * (d_left[i] * b_left[i])
                        - to_upper[i] * (d_upper[i] * b_upper[i])
                        - to_lower[i] * (d_lower[i] * b_lower[i]);
                    out[i] = first + damped[i] * (b[i] - product);
                }
            }
        }
    }
}

/// A row of cells and those to the left, to the right, below and above.
#[inline(always)]
fn and_around(field: &[f32], cells: Range<usize>, stride: usize) -> [&[f32]; 5] {
    let Range { start, end } = cells;
    [
        &field[start..end],
        &field[start - 1..end - 1],
        &field[start + 1..end + 1],
        &field[start - stride..end - stride],
        &field[start + stride..end + stride],
    ]
}

struct Smooth<'a> {
    equation: Equation<'a>,
    x: &'a [f32],
}

impl Smooth<'_> {
    #[inline(always)]
    fn row(&self, row: usize, out: &mut [f32]) {
        let Equation { wet, stride, damped, b, .. } = self.equation;
        for run in wet.runs(row) {
            let cells = row * stride + run.start..row * stride + run.end;
            let [x, damped, b] = [self.x, damped, b].map(|field| &field[cells.clone()]);
            let out = &mut out[run];
            self.equation.products(self.x, cells.start, cells.len(), |i, product| {
                out[i] = x[i] + damped[i] * (b[i] - product);
            });
        }
    }
}

impl Sweep<Rows<'_, f32>> for Smooth<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut out: Rows<f32>) {
        for (j, out) in rows.zip(out.each()) {
            self.row(j, out);
        }
    }
}

impl<'b> Sweep<(Rows<'b, f32>, Rows<'b, f64>)> for Smooth<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut out, sums): (Rows<f32>, Rows<f64>)) {
        for ((j, out), sum) in rows.zip(out.each()).zip(sums.field) {
            self.row(j, out);
            let Equation { wet, stride, b, .. } = self.equation;
            *sum = wet.dot(j, out, &b[j * stride..]);
        }
    }
}

/// Cells of a row whose residuals are found before they are summed.
const CHUNK: usize = 64;

struct Restrict<'a> {
    equation: Equation<'a>,
    /// Fine rows that are solved for.
    rows: Range<usize>,
    /// Fine columns that there are.
    columns: usize,
    /// What of the coarse level is solved for.
    wet: &'a Pieces,
    x: &'a [f32],
}

impl Sweep<Rows<'_, f32>> for Restrict<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut out: Rows<f32>) {
        let equation = &self.equation;
        for (j, out) in rows.zip(out.each()) {
            for run in self.wet.runs(j) {
                // Of a pair that the grid's edge cuts, what is outside is 0.
                let end = (2 * run.end - 1).min(self.columns + 1);
                for first in (2 * run.start - 1..end).step_by(CHUNK) {
                    let n = CHUNK.min(end - first);
                    let mut residuals = [[0.0_f32; CHUNK]; 2];
                    for (fine, residual) in [2 * j - 1, 2 * j].into_iter().zip(&mut residuals) {
                        if self.rows.contains(&fine) {
                            let start = fine * equation.stride + first;
                            let (b, residual) = (&equation.b[start..start + n], &mut residual[..n]);
                            equation.products(self.x, start, n, |i, product| residual[i] = b[i] - product);
                        }
                    }
                    let (lower, upper) = (residuals[0].as_chunks::<2>().0, residuals[1].as_chunks::<2>().0);
                    let sums = &mut out[first.div_ceil(2)..][..n.div_ceil(2)];
                    for ((sum, lower), upper) in sums.iter_mut().zip(lower).zip(upper) {
                        *sum = (lower[0] + lower[1]) + (upper[0] + upper[1]);
                    }
                }
            }
        }
    }
}

/// Sums over the cells of a grid, row by row, so that their rounding depends neither on the processor nor on the threads.
#[derive(Clone, Debug, Default)]
pub(super) struct RowSums(Vec<f64>);

impl RowSums {
    /// Room for the sums of `rows`.
    pub fn rows(&mut self, rows: &Range<usize>) -> Rows<'_, f64> {
        if self.0.len() < rows.end {
            self.0.resize(rows.end, 0.0);
        }
        Rows::new(&mut self.0, 1, rows)
    }

    /// The sum over `rows`.
    pub fn total(&self, rows: &Range<usize>) -> f64 {
        self.0[rows.clone()].iter().sum()
    }
}
