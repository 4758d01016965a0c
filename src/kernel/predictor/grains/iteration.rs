//! The passes of an iteration of friction: what a stress leaves of the flow, a step along the gradient, and back into the cone.

use crate::{
    parallel::Sweep,
    predictor::{
        grains::{
            bed::Bed,
            fields::{Fields, Two},
            near::Near,
        },
        grid::MacGrid,
        pieces::PIECE,
    },
};
use std::{array, ops::Range};

/// A pass over cells (or faces) and their corners: a whole piece at once, so that its loops are as long as known, or one by one.
trait Cells: Sync {
    /// Where it works.
    fn grid(&self) -> (&MacGrid, &Near);

    /// What it finds for `N` cells from index `k` on.
    fn find<const N: usize>(&self, k: usize) -> [[f32; N]; 2];
}

impl<'b, T: Cells> Sweep<Two<'b>> for T {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut first, mut second): Two) {
        let (grid, near) = self.grid();
        for (j, (first, second)) in rows.zip(first.each().zip(second.each())) {
            for Range { mut start, end } in near.runs(j) {
                let mut put = |at: usize, [one, other]: [&[f32]; 2]| {
                    first[at..at + one.len()].copy_from_slice(one);
                    second[at..at + one.len()].copy_from_slice(other);
                };
                while start + PIECE <= end {
                    let [one, other] = self.find::<PIECE>(grid.row(j) + start);
                    put(start, [&one, &other]);
                    start += PIECE;
                }
                for column in start..end {
                    let [one, other] = self.find::<1>(grid.row(j) + column);
                    put(column, [&one, &other]);
                }
            }
        }
    }
}

/// The numbers of `N` cells from index `k` on.
#[inline(always)]
fn cells<const N: usize>(field: &[f32], k: usize) -> [f32; N] {
    let mut cells = [0.0; N];
    cells.copy_from_slice(&field[k..k + N]);
    cells
}

/// Velocities under the stress that the last two lead to.
pub(super) struct Hold<'a> {
    pub bed: &'a Bed<'a>,
    pub near: &'a Near,
    pub stress: &'a Fields,
    pub before: &'a Fields,
    pub further: f32,
    pub lightness: &'a Fields,
    /// Velocities without it; 0 if there are none.
    pub flow: [&'a [f32]; 2],
}

impl Cells for Hold<'_> {
    #[inline(always)]
    fn grid(&self) -> (&MacGrid, &Near) {
        (self.bed.grid, self.near)
    }

    #[inline(always)]
    fn find<const N: usize>(&self, k: usize) -> [[f32; N]; 2] {
        let Self { bed, stress: [s, t], before: [s0, t0], further, lightness, flow, .. } = self;
        let stride = bed.grid.stride;
        let ahead = |now: &[f32], before: &[f32], k: usize| -> [f32; N] {
            let (now, before) = (cells::<N>(now, k), cells::<N>(before, k));
            array::from_fn(|i| now[i] + further * (now[i] - before[i]))
        };
        let [s, s_left, s_lower] = [k, k - 1, k - stride].map(|k| ahead(s, s0, k));
        let [t, t_upper, t_right] = [k, k + stride, k + 1].map(|k| ahead(t, t0, k));
        let [light_u, light_v] = lightness.each_ref().map(|field| cells::<N>(field, k));
        let u = array::from_fn(|i| light_u[i] * ((s[i] - s_left[i]) + (t_upper[i] - t[i])));
        let v = array::from_fn(|i| light_v[i] * ((s_lower[i] - s[i]) + (t_right[i] - t[i])));
        if flow[0].is_empty() {
            return [u, v];
        }
        let [flow_u, flow_v] = flow.map(|field| cells::<N>(field, k));
        [array::from_fn(|i| u[i] + flow_u[i]), array::from_fn(|i| v[i] + flow_v[i])]
    }
}

/// A step along the gradient.
pub(super) struct Pull<'a> {
    pub bed: &'a Bed<'a>,
    pub near: &'a Near,
    pub stress: &'a Fields,
    pub before: &'a Fields,
    pub further: f32,
    pub step: &'a Fields,
    pub held: &'a Fields,
}

impl Cells for Pull<'_> {
    #[inline(always)]
    fn grid(&self) -> (&MacGrid, &Near) {
        (self.bed.grid, self.near)
    }

    #[inline(always)]
    fn find<const N: usize>(&self, k: usize) -> [[f32; N]; 2] {
        let Self { bed, stress, before, further, step, held: [u, v], .. } = self;
        let stride = bed.grid.stride;
        let [u, u_right, u_lower] = [k, k + 1, k - stride].map(|k| cells::<N>(u, k));
        let [v, v_upper, v_left] = [k, k + stride, k - 1].map(|k| cells::<N>(v, k));
        let along = array::from_fn(|i| (u_right[i] - u[i]) - (v_upper[i] - v[i]));
        let across = array::from_fn(|i| (u[i] - u_lower[i]) + (v[i] - v_left[i]));
        let pulled = |of: usize, by: [f32; N]| {
            let [now, before, step] = [stress, before, step].map(|fields| cells::<N>(&fields[of], k));
            array::from_fn(|i| now[i] + further * (now[i] - before[i]) + step[i] * by[i])
        };
        [pulled(0, along), pulled(1, across)]
    }
}

/// Back into the cone √(S² + T²) ≤ limit, with the mean square of the other component from around.
pub(super) struct Limit<'a> {
    pub bed: &'a Bed<'a>,
    pub near: &'a Near,
    pub ahead: &'a Fields,
    pub limit: &'a Fields,
    pub inner: &'a [f32],
}

/// Least square of a stress that a share is taken of.
const LEAST_SQUARE: f32 = 1e-20;

impl Cells for Limit<'_> {
    #[inline(always)]
    fn grid(&self) -> (&MacGrid, &Near) {
        (self.bed.grid, self.near)
    }

    #[inline(always)]
    fn find<const N: usize>(&self, k: usize) -> [[f32; N]; 2] {
        let Self { bed, ahead: [s, t], limit, inner, .. } = self;
        let stride = bed.grid.stride;
        let [a, left, lower, lower_left] = [k, k - 1, k - stride, k - stride - 1].map(|k| cells::<N>(s, k));
        let [b, right, upper, upper_right] = [k, k + 1, k + stride, k + stride + 1].map(|k| cells::<N>(t, k));
        let [of_cells, of_corners, inner] = [&limit[0][..], &limit[1], inner].map(|field| cells::<N>(field, k));
        let square = |of: &[f32; N], i: usize| of[i] * of[i];
        let s = array::from_fn(|i| {
            let corners = 0.25 * ((square(&b, i) + square(&right, i)) + (square(&upper, i) + square(&upper_right, i)));
            let share = of_cells[i] / (square(&a, i) + corners + LEAST_SQUARE).sqrt();
            a[i] * if share < 1.0 { share } else { 1.0 }
        });
        let t = array::from_fn(|i| {
            let cells = 0.25 * ((square(&a, i) + square(&left, i)) + (square(&lower, i) + square(&lower_left, i)));
            let share = of_corners[i] / (square(&b, i) + inner[i] * cells + LEAST_SQUARE).sqrt();
            b[i] * if share < 1.0 { share } else { 1.0 }
        });
        [s, t]
    }
}
