//! Second-order advection: a share has the velocity of the part of the cell that it is, and is as wide as its own velocity
//! carries it.
//!
//! **Why.** Shares that carry their cell's mean velocity smear it: along an axis forward advection diffuses with
//! `½ |u| (1 − |f|) Δx`, which in an eddy of some cells is more than any viscosity of real air. Within a cell the velocity
//! is now a plane of slopes s and t along x and y (van Leer 1979; MUSCL). What leaves to the right is the strip of width
//! `r` at that face, what leaves to the left one of width `l`, what stays is between them, and the mean of each is that in
//! its middle:
//!
//! ```text
//! right: u + ½ (1 − r) s      stays: u + ½ (l − r) s      left: u − ½ (1 − l) s
//! ```
//!
//! and likewise upright, so that each of the nine shares has a velocity of its own. Together they have the cell's momentum.
//!
//! s is the *monotonised central* slope of the differences a, b to the cells on either side (van Leer 1977): the smallest
//! of 2a, 2b and ½ (a + b), 0 where a and b differ in sign. So along an axis no share is faster or slower than the cells
//! around it, nothing rings at a jump, and a peak is only smeared as before. A closed face has no difference to look
//! across, nor has one at the edge of the box: what stands in the ring is no velocity of air there (`edges`).
//!
//! The strip ends where the air that just reaches the face has started, so that its width obeys
//! `w = u(x − w) dt`: to first order `w = u dt (1 − ∂u/∂x dt)`. To leave out the bracket is an error of first order in time
//! that in the exam's vortex smears more than all else together.
//!
//! Mass is shared out as before: its differences are those of the pressure, which the push of pass 2 evens out within a
//! few cells anyway, and shares of positive parts keep it positive. To air at rest both add terms of second order in its
//! motion only, so that the stability of sound is what it was (`pressure`).

use super::{
    pressure::shifted,
    source::{Source, product, store_three, sum, three},
};
use crate::simd::{Array, Lanes, lane_starts};
use std::ops::Range;

/// A value for u and one for v in each column at hand.
#[derive(Debug, Default)]
struct Pair {
    u: Vec<f32>,
    v: Vec<f32>,
}

impl Pair {
    fn resize(&mut self, n: usize) {
        self.u.resize(n, 0.0);
        self.v.resize(n, 0.0);
    }

    fn rows_mut(&mut self, columns: Range<usize>) -> [&mut [f32]; 2] {
        [&mut self.u[columns.clone()], &mut self.v[columns]]
    }
}

/// Row buffers.
#[derive(Debug, Default)]
pub(super) struct SecondOrder {
    /// Slope s.
    slope: Pair,
    /// Momentum of what goes down, stays level and goes up, at the cell's middle along x.
    momentum: [Pair; 3],
}

/// Shares of a row of sources.
#[derive(Clone, Copy)]
pub(super) struct Shares<'a> {
    /// Share of the cell left of a face that goes right through it; faces count with the cell on their right.
    pub(super) right: &'a [f32],
    /// Share of the cell right of a face that goes left through it.
    pub(super) left: &'a [f32],
    /// Share of each cell that goes down.
    pub(super) sinking: &'a [f32],
    /// Share of each cell that goes up.
    pub(super) rising: &'a [f32],
    /// Mass that goes down, stays level and goes up.
    pub(super) masses: [&'a [f32]; 3],
}

impl SecondOrder {
    /// Values held.
    pub(super) fn values(&self) -> usize {
        self.slope.u.len() * 8
    }

    /// Sums what three neighbouring sources bring to each column, for the rows of targets below, level and above: mass and
    /// momentum.
    #[inline(always)]
    pub(super) fn carry<L: Lanes>(&mut self, source: Source, row: usize, shares: Shares, to: [[&mut [f32]; 3]; 3]) {
        if self.slope.u.len() != source.stride {
            self.slope.resize(source.stride);
            self.momentum.iter_mut().for_each(|pair| pair.resize(source.stride));
        }
        self.part::<L>(source, row, shares);

        let n = source.width - 2;
        let [_, goes_right, leaves_right] = shifted(shares.right, n);
        let [_, leaves_left, goes_left] = shifted(shares.left, n);
        let [slope_u, slope_v] = [&self.slope.u, &self.slope.v].map(|row| shifted(row, n));
        let [down, level, up] = shares.masses.map(|row| shifted(row, n));
        let [of_down, of_level, of_up] = self.momentum.each_ref().map(|Pair { u, v }| [shifted(u, n), shifted(v, n)]);
        let [mut to_down, mut to_level, mut to_up] = to;
        let (half, one) = (L::splat(0.5), L::splat(1.0));
        for i in lane_starts::<L>(n) {
            let (from_left, from_right) = (L::of(goes_right, i), L::of(goes_left, i));
            let (to_left, to_right) = (L::of(leaves_left, i), L::of(leaves_right, i));
            let stays = one - (to_left + to_right);
            let parts = [from_left, stays, from_right];
            // The parts' first moments about the middle of their cells.
            let moments = [
                half * (from_left * (one - from_left)),
                half * (stays * (to_left - to_right)),
                half * (from_right * (from_right - one)),
            ];
            let tilted = [product(three(slope_u, i), moments), product(three(slope_v, i), moments)];
            store_three(gather(down, of_down, parts, tilted, i), &mut to_down, i);
            store_three(gather(level, of_level, parts, tilted, i), &mut to_level, i);
            store_three(gather(up, of_up, parts, tilted, i), &mut to_up, i);
        }
    }

    /// Finds the slopes and the momenta of the parts of each cell that go down, stay level and go up.
    #[inline(always)]
    fn part<L: Lanes>(&mut self, source: Source, row: usize, shares: Shares) {
        self.part_columns::<L>(source, row, shares, 1..source.width - 1, true);
        self.part_ends(source, row, shares);
    }

    /// The same for the outermost columns. Kept apart, so that the code of the others stays small enough to be inlined.
    #[inline(never)]
    fn part_ends(&mut self, source: Source, row: usize, shares: Shares) {
        let n = source.width - 2;
        for column in [0, 1, n, n + 1] {
            let k = source.left + column;
            let inside = k > 1 && k + 2 < source.stride;
            if !inside || column == 0 || column == n + 1 {
                self.part_columns::<Array<1>>(source, row, shares, column..column + 1, inside);
            }
        }
    }

    /// The same for some columns, which have a neighbour in the box on either side or are `inside` it not.
    #[inline(always)]
    fn part_columns<L: Lanes>(
        &mut self,
        source: Source,
        row: usize,
        shares: Shares,
        columns: Range<usize>,
        inside: bool,
    ) {
        let n = columns.len();
        let stride = source.stride;
        let start = source.start(row) + columns.start;
        let upright = row > 1 && (row + 2) * stride < source.pressure.len();
        let [open_x, open_y] = source.open;
        let [sinking, rising] = [shares.sinking, shares.rising].map(|row| &row[columns.clone()]);
        let [down, level, up] = shares.masses.map(|row| &row[columns.clone()]);
        let slopes = self.slope.rows_mut(columns.clone());
        let [below, beside, above] = self.momentum.each_mut().map(|pair| pair.rows_mut(columns.clone()));
        let fields = [source.velocity_x, source.velocity_y];
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        for ((((field, slope), below), beside), above) in
            fields.into_iter().zip(slopes).zip(below).zip(beside).zip(above)
        {
            let across = |step: usize| [start - step, start, start + step].map(|k| &field[k..k + n]);
            let sideways = if inside { across(1) } else { [&field[..n]; 3] };
            let upwards = if upright { across(stride) } else { [&field[..n]; 3] };
            let [left, right] = if inside { [start, start + 1] } else { [0; 2] }.map(|k| &open_x[k..k + n]);
            let [low, high] = if upright { [start, start + stride] } else { [0; 2] }.map(|k| &open_y[k..k + n]);
            let here = &field[start..start + n];
            for i in lane_starts::<L>(n) {
                let along = if inside { limited_at([L::of(left, i), L::of(right, i)], sideways, i) } else { zero };
                along.put(slope, i);
                let tilt = if upright { limited_at([L::of(low, i), L::of(high, i)], upwards, i) } else { zero };
                let (value, tilt) = (L::of(here, i), half * tilt);
                let (sinks, rises) = (L::of(sinking, i), L::of(rising, i));
                (L::of(down, i) * (value - (one - sinks) * tilt)).put(below, i);
                (L::of(level, i) * (value + (sinks - rises) * tilt)).put(beside, i);
                (L::of(up, i) * (value + (one - rises) * tilt)).put(above, i);
            }
        }
    }
}

/// Mass and momentum of the given parts of three cells, of whose velocities `tilted` is the part that slopes add.
#[inline(always)]
fn gather<L: Lanes>(
    mass: [&[f32]; 3],
    [u, v]: [[&[f32]; 3]; 2],
    parts: [L; 3],
    [tilted_u, tilted_v]: [[L; 3]; 2],
    i: usize,
) -> [L; 3] {
    let mass = three(mass, i);
    [
        sum(product(mass, parts)),
        sum(product(three(u, i), parts)) + sum(product(mass, tilted_u)),
        sum(product(three(v, i), parts)) + sum(product(mass, tilted_v)),
    ]
}

/// The slope in the middle one of three cells whose faces are open (1) or closed (0).
#[inline(always)]
fn limited_at<L: Lanes>(open: [L; 2], [low, here, high]: [&[f32]; 3], i: usize) -> L {
    let value = L::of(here, i);
    limited(open[0] * (value - L::of(low, i)), open[1] * (L::of(high, i) - value))
}

/// The monotonised central slope of two differences: with all three of one sign the one nearest to 0.
#[inline(always)]
fn limited<L: Lanes>(low: L, high: L) -> L {
    let (zero, middle) = (L::splat(0.0), L::splat(0.5) * (low + high));
    let (low, high) = (low + low, high + high);
    low.min(high).min(middle).max(zero) + low.max(high).max(middle).min(zero)
}
