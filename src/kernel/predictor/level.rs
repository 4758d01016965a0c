//! One level of the pressure equation: its fields, its smoother, and sums over cells.

use crate::{
    parallel::{Band, Rows, Sweep, Team, sweep},
    predictor::{
        operator::{Equation, EquationRow, Lent, Operator},
        pieces::Pieces,
        wide::{Wide, in_lanes, load, store},
    },
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
        let equation = self.equation();
        self.sweep(&Smooth { x: [equation.damped, equation.b], equation }, band, team);
        self.x = x;
    }

    /// A Jacobi step.
    pub fn smooth(&mut self, team: Team) {
        let mut next = std::mem::take(&mut self.work);
        let band = Rows::new(&mut next, self.stride, &self.wet.rows());
        self.sweep(&Smooth { equation: self.equation(), x: [&self.x] }, band, team);
        self.work = std::mem::replace(&mut self.x, next);
    }

    /// A Jacobi step; returns b · x with the new x.
    pub fn smooth_and_sum(&mut self, sums: &mut RowSums, team: Team) -> f64 {
        let mut next = std::mem::take(&mut self.work);
        let rows = self.wet.rows();
        let band = (Rows::new(&mut next, self.stride, &rows), sums.rows(&rows));
        self.sweep(&Smooth { equation: self.equation(), x: [&self.x] }, band, team);
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

struct Apply<'a> {
    equation: Equation<'a>,
    x: &'a [f32],
}

impl<'b> Sweep<(Rows<'b, f32>, Rows<'b, f64>)> for Apply<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut out, sums): (Rows<f32>, Rows<f64>)) {
        let Self { equation, x } = self;
        for ((j, out), sum) in rows.zip(out.each()).zip(sums.field) {
            let row = equation.row(j, [*x]);
            for run in equation.wet.runs(j) {
                in_lanes(run, Products { row: &row, out });
            }
            *sum = equation.wet.dot(j, out, row.x[0][1]);
        }
    }
}

/// Sets `out` to A x.
struct Products<'a> {
    row: &'a EquationRow<'a, 1>,
    out: &'a mut [f32],
}

impl Wide for Products<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, at: usize) {
        store(self.out, at, self.row.products::<N>(at));
    }
}

struct TakeProductOff<'a> {
    equation: Equation<'a>,
    x: &'a [f32],
}

impl<'b> Sweep<(Rows<'b, f32>, (Rows<'b, f64>, Rows<'b, f64>))> for TakeProductOff<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut b, (before, after)): (Rows<f32>, (Rows<f64>, Rows<f64>))) {
        let Self { equation, x } = self;
        for (((j, b), before), after) in rows.zip(b.each()).zip(before.field).zip(after.field) {
            *before = equation.wet.dot(j, b, b);
            let row = equation.row(j, [*x]);
            for run in equation.wet.runs(j) {
                in_lanes(run, LessProducts { row: &row, b });
            }
            *after = equation.wet.dot(j, b, b);
        }
    }
}

/// Takes A x off `b`.
struct LessProducts<'a> {
    row: &'a EquationRow<'a, 1>,
    b: &'a mut [f32],
}

impl Wide for LessProducts<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, at: usize) {
        let left = self.row.residuals::<N>(self.b, at);
        store(self.b, at, left);
    }
}

/// A Jacobi step.
struct Smooth<'a, const FACTORS: usize> {
    equation: Equation<'a>,
    /// What the unknowns are the product of.
    x: [&'a [f32]; FACTORS],
}

impl<const FACTORS: usize> Smooth<'_, FACTORS> {
    #[inline(always)]
    fn row(&self, row: usize, out: &mut [f32]) {
        let Self { equation, x } = self;
        let (own, b) = (equation.row(row, *x), equation.of(equation.b, row));
        for run in equation.wet.runs(row) {
            in_lanes(run, Step { row: &own, b, out });
        }
    }
}

/// The step in a row.
struct Step<'a, const FACTORS: usize> {
    row: &'a EquationRow<'a, FACTORS>,
    b: &'a [f32],
    out: &'a mut [f32],
}

impl<const FACTORS: usize> Wide for Step<'_, FACTORS> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, at: usize) {
        let (mut x, damped) = (self.row.unknowns::<N>(1, at), load::<N>(self.row.damped, at));
        let residuals = self.row.residuals::<N>(self.b, at);
        for i in 0..N {
            x[i] += damped[i] * residuals[i];
        }
        store(self.out, at, x);
    }
}

impl<const FACTORS: usize> Sweep<Rows<'_, f32>> for Smooth<'_, FACTORS> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut out: Rows<f32>) {
        for (j, out) in rows.zip(out.each()) {
            self.row(j, out);
        }
    }
}

impl<'b, const FACTORS: usize> Sweep<(Rows<'b, f32>, Rows<'b, f64>)> for Smooth<'_, FACTORS> {
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
                    for (fine, out) in [2 * j - 1, 2 * j].into_iter().zip(&mut residuals) {
                        if self.rows.contains(&fine) {
                            let (row, b) = (equation.row(fine, [self.x]), equation.of(equation.b, fine));
                            in_lanes(first..first + n, Residuals { row: &row, b, first, out });
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

/// Sets `out` to the residuals from column `first` on.
struct Residuals<'a> {
    row: &'a EquationRow<'a, 1>,
    b: &'a [f32],
    first: usize,
    out: &'a mut [f32],
}

impl Wide for Residuals<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, at: usize) {
        store(self.out, at - self.first, self.row.residuals::<N>(self.b, at));
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
