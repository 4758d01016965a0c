//! The operator of the pressure equation on one level, and what it makes of the cells of a row.

use crate::predictor::{pieces::Pieces, wide::load};

/// Memory of an operator. What is on the faces of a grid after a solve fits in, two numbers each.
pub(super) type Lent = [Vec<[f32; 2]>; 2];

/// Coefficients of the equation. Those of the finest level are found anew for each solve and read by nobody after it, so that
/// their memory is lent in between.
#[derive(Clone, Debug, Default)]
pub(super) struct Operator(Lent);

impl Operator {
    /// One of 0 everywhere, for so many cells with the padding.
    pub fn new(cells: usize) -> Self {
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

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.0.iter().map(|two| 8 * two.capacity()).sum()
    }
}

/// The equation as sweeps read it.
pub(super) struct Equation<'a> {
    pub wet: &'a Pieces,
    pub stride: usize,
    pub diagonal: &'a [f32],
    pub damped: &'a [f32],
    pub right: &'a [f32],
    pub upper: &'a [f32],
    pub b: &'a [f32],
}

impl<'a> Equation<'a> {
    /// A row of it, for unknowns that are the product of some fields: they themselves, or damping times right-hand side, which the
    /// first Jacobi step from 0 finds.
    #[inline(always)]
    pub fn row<const FACTORS: usize>(&self, row: usize, x: [&'a [f32]; FACTORS]) -> EquationRow<'a, FACTORS> {
        EquationRow {
            diagonal: self.of(self.diagonal, row),
            damped: self.of(self.damped, row),
            right: self.of(self.right, row),
            upper: self.of(self.upper, row),
            lower: self.of(self.upper, row - 1),
            x: x.map(|x| [row - 1, row, row + 1].map(|row| self.of(x, row))),
        }
    }

    /// A row of a field. All are of one length, of which the compiler knows, so that it looks only once whether cells are within.
    #[inline(always)]
    pub fn of(&self, field: &'a [f32], row: usize) -> &'a [f32] {
        &field[row * self.stride..][..self.stride]
    }
}

/// A row of the equation.
pub(super) struct EquationRow<'a, const FACTORS: usize> {
    diagonal: &'a [f32],
    /// What damps the step of each cell, or 0.
    pub damped: &'a [f32],
    /// Couplings to the right, up and down.
    right: &'a [f32],
    upper: &'a [f32],
    lower: &'a [f32],
    /// What the unknowns are the product of: of the row below, of the row itself and of the row above.
    pub x: [[&'a [f32]; 3]; FACTORS],
}

impl<const FACTORS: usize> EquationRow<'_, FACTORS> {
    /// The `N` unknowns of one of the three rows from a column on.
    #[inline(always)]
    pub fn unknowns<const N: usize>(&self, row: usize, at: usize) -> [f32; N] {
        let mut lanes = load::<N>(self.x[0][row], at);
        for factor in &self.x[1..] {
            let factor = load::<N>(factor[row], at);
            for i in 0..N {
                lanes[i] *= factor[i];
            }
        }
        lanes
    }

    /// A x in the `N` cells from a column on.
    #[inline(always)]
    pub fn products<const N: usize>(&self, at: usize) -> [f32; N] {
        // One by one: arrays of arrays would go through memory.
        let centre = self.unknowns::<N>(1, at);
        let (left, right) = (self.unknowns::<N>(1, at - 1), self.unknowns::<N>(1, at + 1));
        let (lower, upper) = (self.unknowns::<N>(0, at), self.unknowns::<N>(2, at));
        let (to_left, to_right) = (load::<N>(self.right, at - 1), load::<N>(self.right, at));
        let (to_lower, to_upper) = (load::<N>(self.lower, at), load::<N>(self.upper, at));
        let diagonal = load::<N>(self.diagonal, at);
        let mut products = [0.0; N];
        for i in 0..N {
            products[i] = diagonal[i] * centre[i]
                - to_right[i] * right[i]
                - to_left[i] * left[i]
                - to_upper[i] * upper[i]
                - to_lower[i] * lower[i];
        }
        products
    }

    /// b − A x there.
    #[inline(always)]
    pub fn residuals<const N: usize>(&self, b: &[f32], at: usize) -> [f32; N] {
        let (mut residuals, products) = (load::<N>(b, at), self.products::<N>(at));
        for i in 0..N {
            residuals[i] -= products[i];
        }
        residuals
    }
}
