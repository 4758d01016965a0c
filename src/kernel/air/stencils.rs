//! Where points lie between the centres of cells, several at a time.

use super::grid::Air;
use crate::simd::{each_lane, padded, whole_below};

/// Points that are looked at side by side.
pub(super) const LANES: usize = 16;

/// The four cells around each of some points and how much of each.
pub(super) struct Stencils {
    /// Lower left cells, in the fields.
    corner: [u32; LANES],
    /// Shares of those on the right.
    right: [f32; LANES],
    /// Shares of the upper ones.
    upper: [f32; LANES],
    /// Cells of a row of the fields.
    stride: usize,
}

impl Stencils {
    /// The cells around up to [`LANES`] points (d) in the air, which must be built.
    #[inline(always)]
    pub(super) fn new(air: &Air, x: &[f32], y: &[f32]) -> Self {
        let (per_cell, stride) = (1.0 / air.cell(), air.stride());
        let last = [air.columns() - 1, air.rows() - 1].map(|last| last as u32);
        let origin = air.index(0, 0) as u32;
        let mut stencils = Self { corner: [0; LANES], right: [0.0; LANES], upper: [0.0; LANES], stride };
        let (x, y): ([f32; LANES], [f32; LANES]) = (padded(x), padded(y));
        for lane in 0..LANES {
            let (column, right) = split(x[lane], per_cell, last[0]);
            let (row, upper) = split(y[lane], per_cell, last[1]);
            stencils.corner[lane] = origin + row * stride as u32 + column;
            (stencils.right[lane], stencils.upper[lane]) = (right, upper);
        }
        stencils
    }

    /// The four cells around a point, in the fields, and how much of each.
    #[inline(always)]
    pub(super) fn corners(&self, lane: usize) -> [(usize, f32); 4] {
        let (k, right, upper) = (self.corner[lane] as usize, self.right[lane], self.upper[lane]);
        let (left, lower) = (1.0 - right, 1.0 - upper);
        [
            (k, left * lower),
            (k + 1, right * lower),
            (k + self.stride, left * upper),
            (k + self.stride + 1, right * upper),
        ]
    }

    /// Two values of the cells around each of the first `count` points, blended; 0 for the others.
    #[inline(always)]
    pub(super) fn blend(&self, count: usize, of: impl Fn(usize) -> [[f32; 2]; 2]) -> [[f32; LANES]; 2] {
        let mut around = [[[0.0; LANES]; 4]; 2];
        for lane in 0..count {
            let k = self.corner[lane] as usize;
            let (low, high) = (of(k), of(k + self.stride));
            for (axis, around) in around.iter_mut().enumerate() {
                let corners = [low[0][axis], low[1][axis], high[0][axis], high[1][axis]];
                around.iter_mut().zip(corners).for_each(|(lanes, corner)| lanes[lane] = corner);
            }
        }
        let [along_x, along_y] = &around;
        [self.mixed(along_x), self.mixed(along_y)]
    }

    /// What is around the points, in each of the four cells, blended.
    #[inline(always)]
    fn mixed(&self, [left, right, upper_left, upper_right]: &[[f32; LANES]; 4]) -> [f32; LANES] {
        each_lane(|lane| {
            let (x, y) = (self.right[lane], self.upper[lane]);
            mix(mix(left[lane], right[lane], x), mix(upper_left[lane], upper_right[lane], x), y)
        })
    }
}

/// Blend that is exact at both ends.
#[inline(always)]
fn mix(a: f32, b: f32, part: f32) -> f32 {
    a * (1.0 - part) + b * part
}

/// A coordinate in cells from the first centre: the cell at or below it and how far beyond. What is no number counts as 0.
#[inline(always)]
pub(super) fn split(at: f32, per_cell: f32, last: u32) -> (u32, f32) {
    let at = at * per_cell - 0.5;
    let at = if at > 0.0 { at } else { 0.0 };
    whole_below(if at < last as f32 { at } else { last as f32 }, 0, last)
}
