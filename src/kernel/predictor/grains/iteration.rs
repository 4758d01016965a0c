//! The passes of an iteration of friction: what a stress leaves of the flow, a step along the gradient, and back into the cone.

use crate::{
    parallel::Sweep,
    predictor::grains::{
        bed::Bed,
        fields::{Fields, Two, row},
    },
};
use std::ops::Range;

/// Velocities under the stress that the last two lead to.
pub(super) struct Hold<'a> {
    pub bed: &'a Bed<'a>,
    pub columns: Range<usize>,
    pub stress: &'a Fields,
    pub before: &'a Fields,
    pub further: f32,
    pub lightness: &'a Fields,
    /// Velocities without it; 0 if there are none.
    pub flow: [&'a [f32]; 2],
}

impl<'b> Sweep<Two<'b>> for Hold<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut u, mut v): Two) {
        let Self { bed, columns, stress: [s, t], before: [s0, t0], further, lightness, flow } = self;
        let (n, stride, further) = (columns.len(), bed.grid.stride, *further);
        for (j, (u, v)) in rows.zip(u.each().zip(v.each())) {
            let k = bed.grid.row(j) + columns.start;
            let (u, v) = (&mut u[columns.clone()], &mut v[columns.clone()]);
            let (light_u, light_v) = (row(&lightness[0], k, n), row(&lightness[1], k, n));
            let [s_own, s_left, s_lower] = [k, k - 1, k - stride].map(|at| (row(s, at, n), row(s0, at, n)));
            let [t_own, t_upper, t_right] = [k, k + stride, k + 1].map(|at| (row(t, at, n), row(t0, at, n)));
            let ahead = |(now, before): (&[f32], &[f32]), i: usize| now[i] + further * (now[i] - before[i]);
            for i in 0..n {
                let (s, t) = (ahead(s_own, i), ahead(t_own, i));
                u[i] = light_u[i] * ((s - ahead(s_left, i)) + (ahead(t_upper, i) - t));
                v[i] = light_v[i] * ((ahead(s_lower, i) - s) + (ahead(t_right, i) - t));
            }
            if flow[0].is_empty() {
                continue;
            }
            for (out, flow) in [(u, flow[0]), (v, flow[1])] {
                out.iter_mut().zip(row(flow, k, n)).for_each(|(out, flow)| *out += flow);
            }
        }
    }
}

/// A step along the gradient.
pub(super) struct Pull<'a> {
    pub bed: &'a Bed<'a>,
    pub columns: Range<usize>,
    pub stress: &'a Fields,
    pub before: &'a Fields,
    pub further: f32,
    pub step: &'a Fields,
    pub held: &'a Fields,
}

impl<'b> Sweep<Two<'b>> for Pull<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut s, mut t): Two) {
        let Self { bed, columns, stress, before, further, step, held: [u, v] } = self;
        let (n, stride, further) = (columns.len(), bed.grid.stride, *further);
        for (j, (s, t)) in rows.zip(s.each().zip(t.each())) {
            let k = bed.grid.row(j) + columns.start;
            let (s, t) = (&mut s[columns.clone()], &mut t[columns.clone()]);
            let [now, last, step] = [stress, before, step].map(|[s, t]| (row(s, k, n), row(t, k, n)));
            let [u_own, u_right, u_lower] = [k, k + 1, k - stride].map(|at| row(u, at, n));
            let [v_own, v_upper, v_left] = [k, k + stride, k - 1].map(|at| row(v, at, n));
            for i in 0..n {
                let ahead = now.0[i] + further * (now.0[i] - last.0[i]);
                s[i] = ahead + step.0[i] * ((u_right[i] - u_own[i]) - (v_upper[i] - v_own[i]));
                let ahead = now.1[i] + further * (now.1[i] - last.1[i]);
                t[i] = ahead + step.1[i] * ((u_own[i] - u_lower[i]) + (v_own[i] - v_left[i]));
            }
        }
    }
}

/// Back into the cone √(S² + T²) ≤ limit, with the mean square of the other component from around.
pub(super) struct Limit<'a> {
    pub bed: &'a Bed<'a>,
    pub columns: Range<usize>,
    pub ahead: &'a Fields,
    pub limit: &'a Fields,
    pub inner: &'a [f32],
}

/// Least square of a stress that a share is taken of.
const LEAST_SQUARE: f32 = 1e-20;

impl<'b> Sweep<Two<'b>> for Limit<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut s, mut t): Two) {
        let Self { bed, columns, ahead: [from_s, from_t], limit, inner } = self;
        let (n, stride) = (columns.len(), bed.grid.stride);
        for (j, (s, t)) in rows.zip(s.each().zip(t.each())) {
            let k = bed.grid.row(j) + columns.start;
            let (s, t) = (&mut s[columns.clone()], &mut t[columns.clone()]);
            let (of_cells, of_corners, inner) = (row(&limit[0], k, n), row(&limit[1], k, n), row(inner, k, n));
            let [a, left, lower, lower_left] = [k, k - 1, k - stride, k - stride - 1].map(|at| row(from_s, at, n));
            let [b, right, upper, upper_right] = [k, k + 1, k + stride, k + stride + 1].map(|at| row(from_t, at, n));
            for i in 0..n {
                let square = |field: &[f32]| field[i] * field[i];
                let corners = 0.25 * ((square(b) + square(right)) + (square(upper) + square(upper_right)));
                let cells = 0.25 * ((square(a) + square(left)) + (square(lower) + square(lower_left)));
                let share_s = of_cells[i] / (square(a) + corners + LEAST_SQUARE).sqrt();
                let share_t = of_corners[i] / (square(b) + inner[i] * cells + LEAST_SQUARE).sqrt();
                s[i] = a[i] * if share_s < 1.0 { share_s } else { 1.0 };
                t[i] = b[i] * if share_t < 1.0 { share_t } else { 1.0 };
            }
        }
    }
}
