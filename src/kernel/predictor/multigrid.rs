//! The multigrid V-cycle that preconditions the pressure equation: damped Jacobi, aggregation of 2 × 2 cells, Galerkin
//! coarse operators, an over-weighted coarse correction (aggregation underestimates smooth corrections, Braess 1995).

/// Damping of the Jacobi smoother.
const DAMPING: f32 = 0.8;
/// Weight of the coarse correction.
const CORRECTION: f32 = 1.8;
/// Smoothing steps on the coarsest level.
const COARSEST_STEPS: usize = 12;
/// A coarse cell that is coupled to less than this is left out.
const LEAST_DIAGONAL: f32 = 1e-3;

/// The equation `diagonal x_c − Σ coupling x_n = b` on one level. Cells are indexed as in `MacGrid`.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub columns: usize,
    pub stride: usize,
    /// First and last row with a cell that is solved for.
    pub first: usize,
    pub last: usize,
    /// Σ of the open shares of a cell's faces; 0 where there is nothing to solve.
    pub diagonal: Vec<f32>,
    /// 1/diagonal, or 0.
    inverse: Vec<f32>,
    /// Coupling to the right neighbour.
    pub right: Vec<f32>,
    /// Coupling to the upper neighbour.
    pub upper: Vec<f32>,
    /// Unknowns.
    pub x: Vec<f32>,
    /// Right-hand side.
    pub b: Vec<f32>,
    residual: Vec<f32>,
}

impl Level {
    fn new(columns: usize, rows: usize) -> Self {
        let stride = columns + 2;
        let field = || vec![0.0; stride * (rows + 3)];
        Self {
            columns,
            stride,
            first: 1,
            last: rows,
            diagonal: field(),
            inverse: field(),
            right: field(),
            upper: field(),
            x: field(),
            b: field(),
            residual: field(),
        }
    }

    /// Makes the level empty, with cells to come in rows `first …= last`.
    pub fn clear(&mut self, first: usize, last: usize) {
        (self.first, self.last) = (first, last);
        for field in [
            &mut self.diagonal,
            &mut self.inverse,
            &mut self.right,
            &mut self.upper,
            &mut self.x,
            &mut self.b,
            &mut self.residual,
        ] {
            field.fill(0.0);
        }
    }

    fn invert(&mut self) {
        for (inverse, &diagonal) in self.inverse.iter_mut().zip(&self.diagonal) {
            *inverse = if diagonal > LEAST_DIAGONAL { 1.0 / diagonal } else { 0.0 };
        }
    }

    /// `out = A x` on the rows of the level.
    #[inline(always)]
    pub fn apply(&self, x: &[f32], out: &mut [f32]) {
        self.rows_of(x, out, |out, product, _| *out = product);
    }

    #[inline(always)]
    fn find_residual(&mut self) {
        let mut residual = std::mem::take(&mut self.residual);
        self.rows_of(&self.x, &mut residual, |out, product, b| *out = b - product);
        self.residual = residual;
    }

    /// Calls `set(out, (A x)_c, b_c)` for every cell.
    #[inline(always)]
    fn rows_of(&self, x: &[f32], out: &mut [f32], set: impl Fn(&mut f32, f32, f32)) {
        let (s, n) = (self.stride, self.columns);
        for j in self.first..=self.last {
            let o = j * s + 1;
            let (centre, left, right) = (&x[o..o + n], &x[o - 1..o - 1 + n], &x[o + 1..o + 1 + n]);
            let (lower, upper) = (&x[o - s..o - s + n], &x[o + s..o + s + n]);
            let diagonal = &self.diagonal[o..o + n];
            let (to_right, to_left) = (&self.right[o..o + n], &self.right[o - 1..o - 1 + n]);
            let (to_upper, to_lower) = (&self.upper[o..o + n], &self.upper[o - s..o - s + n]);
            let b = &self.b[o..o + n];
            for (i, out) in out[o..o + n].iter_mut().enumerate() {
                let product = diagonal[i] * centre[i]
                    - to_right[i] * right[i]
                    - to_left[i] * left[i]
                    - to_upper[i] * upper[i]
                    - to_lower[i] * lower[i];
                set(out, product, b[i]);
            }
        }
    }

    fn solved_cells(&self) -> std::ops::Range<usize> {
        self.first * self.stride..(self.last + 1) * self.stride
    }

    /// The first Jacobi step, from x = 0.
    #[inline(always)]
    fn smooth_from_zero(&mut self) {
        let cells = self.solved_cells();
        for ((x, b), inverse) in self.x[cells.clone()].iter_mut().zip(&self.b[cells.clone()]).zip(&self.inverse[cells])
        {
            *x = DAMPING * *inverse * *b;
        }
    }

    /// A Jacobi step.
    #[inline(always)]
    fn smooth(&mut self) {
        self.find_residual();
        let cells = self.solved_cells();
        for ((x, residual), inverse) in
            self.x[cells.clone()].iter_mut().zip(&self.residual[cells.clone()]).zip(&self.inverse[cells])
        {
            *x += DAMPING * *inverse * *residual;
        }
    }
}

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

    /// Builds the coarse operators from the finest: couplings across the edge of an aggregate add up, those inside one
    /// leave the diagonal.
    #[inline(always)]
    pub fn coarsen(&mut self) {
        self.levels[0].invert();
        for depth in 1..self.levels.len() {
            let (fine, coarse) = self.levels.split_at_mut(depth);
            let (fine, coarse) = (&fine[depth - 1], &mut coarse[0]);
            coarse.clear(fine.first.div_ceil(2), fine.last.div_ceil(2));
            for j in fine.first..=fine.last {
                for i in 1..=fine.columns {
                    let k = j * fine.stride + i;
                    let mut diagonal = fine.diagonal[k];
                    if diagonal == 0.0 {
                        continue;
                    }
                    let c = j.div_ceil(2) * coarse.stride + i.div_ceil(2);
                    if i % 2 == 1 {
                        diagonal -= 2.0 * fine.right[k];
                    } else {
                        coarse.right[c] += fine.right[k];
                    }
                    if j % 2 == 1 {
                        diagonal -= 2.0 * fine.upper[k];
                    } else {
                        coarse.upper[c] += fine.upper[k];
                    }
                    coarse.diagonal[c] += diagonal;
                }
            }
            coarse.invert();
        }
    }

    /// One V(2,2) cycle for the right-hand side in `finest().b`, from 0; the result is in `finest().x`.
    #[inline(always)]
    pub fn cycle(&mut self) {
        let coarsest = self.levels.len() - 1;
        for depth in 0..coarsest {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            let (fine, coarse) = (&mut fine[depth], &mut coarse[0]);
            fine.smooth_from_zero();
            fine.smooth();
            fine.find_residual();
            restrict(fine, coarse);
        }
        let level = &mut self.levels[coarsest];
        level.smooth_from_zero();
        for _ in 0..COARSEST_STEPS {
            level.smooth();
        }
        for depth in (0..coarsest).rev() {
            let (fine, coarse) = self.levels.split_at_mut(depth + 1);
            let (fine, coarse) = (&mut fine[depth], &coarse[0]);
            prolong(coarse, fine);
            fine.smooth();
            fine.smooth();
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.levels.iter().map(|level| 7 * 4 * level.x.capacity()).sum()
    }
}

/// The coarse right-hand side: the sum of an aggregate's residuals.
#[inline(always)]
fn restrict(fine: &Level, coarse: &mut Level) {
    coarse.b.fill(0.0);
    for j in fine.first..=fine.last {
        let from = &fine.residual[j * fine.stride..(j + 1) * fine.stride];
        let o = j.div_ceil(2) * coarse.stride;
        // The padding on the right of a row of odd length is 0.
        for (sum, pair) in coarse.b[o + 1..o + 1 + coarse.columns].iter_mut().zip(from[1..].chunks(2)) {
            *sum += pair[0] + pair.get(1).copied().unwrap_or(0.0);
        }
    }
}

/// Adds the coarse solution to the fine one.
#[inline(always)]
fn prolong(coarse: &Level, fine: &mut Level) {
    for j in fine.first..=fine.last {
        let o = j * fine.stride;
        let from = &coarse.x[j.div_ceil(2) * coarse.stride..];
        for i in 1..=fine.columns {
            // A cell that is not solved for has no inverse.
            let solved = if fine.inverse[o + i] > 0.0 { CORRECTION } else { 0.0 };
            fine.x[o + i] += solved * from[i.div_ceil(2)];
        }
    }
}
