//! The passes of friction's iterations: where they set out from, and in each what a stress leaves of the flow, a step along the
//! gradient, and back into the cone.

use crate::{
    predictor::{
        grains::{
            bed::{At, Bed},
            cells::Cells,
            fields::Fields,
        },
        transfer::Faces,
        wide::{load, store},
    },
    simd::each_lane,
};

/// Velocities without friction on the faces that a stress moves, and the stress to set out from.
pub(super) struct SetOut<'a> {
    pub faces: &'a Faces,
    pub lightness: &'a Fields,
    pub stress: &'a Fields,
}

impl Cells<4> for SetOut<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, _: &Bed, At { column, k, .. }: At, rows: &mut [&mut [f32]; 4]) {
        let Self { faces, lightness, stress } = self;
        let [flow_u, flow_v, before_s, before_t] = rows;
        let means = [&faces.u, &faces.v].into_iter().zip(&faces.ways);
        for (out, ((means, ways), lightness)) in [flow_u, flow_v].into_iter().zip(means.zip(lightness.iter())) {
            let (means, ways, lightness) = (&means[k..k + N], &ways[k..k + N], load::<N>(lightness, k));
            let flow = each_lane(|i| if lightness[i] > 0.0 { means[i][1] + ways[i][0] } else { 0.0 });
            store::<N>(out, column, flow);
        }
        for (out, stress) in [before_s, before_t].into_iter().zip(stress.iter()) {
            store(out, column, load::<N>(stress, k));
        }
    }
}

/// Velocities under the stress that the last two lead to.
pub(super) struct Hold<'a> {
    pub stress: &'a Fields,
    pub before: &'a Fields,
    pub further: f32,
    pub lightness: &'a Fields,
    /// Velocities without it; 0 if there are none.
    pub flow: [&'a [f32]; 2],
}

impl Cells<2> for Hold<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, At { column, k, .. }: At, [out_u, out_v]: &mut [&mut [f32]; 2]) {
        let Self { stress: [s, t], before: [s0, t0], further, lightness: [light_u, light_v], flow: [flow_u, flow_v] } =
            self;
        let (further, stride) = (*further, bed.grid.stride);
        let (s, s_left, s_lower) =
            (ahead::<N>(s, s0, further, k), ahead::<N>(s, s0, further, k - 1), ahead::<N>(s, s0, further, k - stride));
        let (t, t_right, t_upper) =
            (ahead::<N>(t, t0, further, k), ahead::<N>(t, t0, further, k + 1), ahead::<N>(t, t0, further, k + stride));
        let (light_u, light_v) = (load::<N>(light_u, k), load::<N>(light_v, k));
        let u = each_lane::<N, _>(|i| light_u[i] * ((s[i] - s_left[i]) + (t_upper[i] - t[i])));
        let v = each_lane::<N, _>(|i| light_v[i] * ((s_lower[i] - s[i]) + (t_right[i] - t[i])));
        if flow_u.is_empty() {
            store(out_u, column, u);
            store(out_v, column, v);
        } else {
            let (flow_u, flow_v) = (load::<N>(flow_u, k), load::<N>(flow_v, k));
            store(out_u, column, each_lane::<N, _>(|i| u[i] + flow_u[i]));
            store(out_v, column, each_lane::<N, _>(|i| v[i] + flow_v[i]));
        }
    }
}

/// A step along the gradient.
pub(super) struct Pull<'a> {
    pub stress: &'a Fields,
    pub before: &'a Fields,
    pub further: f32,
    pub step: &'a Fields,
    pub held: &'a Fields,
}

impl Cells<2> for Pull<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, At { column, k, .. }: At, [out_s, out_t]: &mut [&mut [f32]; 2]) {
        let Self { stress: [s, t], before: [s0, t0], further, step: [step_s, step_t], held: [u, v] } = self;
        let stride = bed.grid.stride;
        let (s, t) = (ahead::<N>(s, s0, *further, k), ahead::<N>(t, t0, *further, k));
        let (step_s, step_t) = (load::<N>(step_s, k), load::<N>(step_t, k));
        let (u, right, lower) = (load::<N>(u, k), load::<N>(u, k + 1), load::<N>(u, k - stride));
        let (v, left, upper) = (load::<N>(v, k), load::<N>(v, k - 1), load::<N>(v, k + stride));
        store(out_s, column, each_lane::<N, _>(|i| s[i] + step_s[i] * ((right[i] - u[i]) - (upper[i] - v[i]))));
        store(out_t, column, each_lane::<N, _>(|i| t[i] + step_t[i] * ((u[i] - lower[i]) + (v[i] - left[i]))));
    }
}

/// Where the last two of some numbers lead to.
#[inline(always)]
fn ahead<const N: usize>(now: &[f32], before: &[f32], further: f32, k: usize) -> [f32; N] {
    let (now, before) = (load::<N>(now, k), load::<N>(before, k));
    each_lane(|i| now[i] + further * (now[i] - before[i]))
}

/// Back into the cone √(S² + T²) ≤ limit, with the mean square of the other component from around.
pub(super) struct Limit<'a> {
    pub ahead: &'a Fields,
    pub limit: &'a Fields,
    pub inner: &'a [f32],
}

/// Least square of a stress that a share is taken of.
const LEAST_SQUARE: f32 = 1e-20;

impl Cells<2> for Limit<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, At { column, k, .. }: At, [out_s, out_t]: &mut [&mut [f32]; 2]) {
        let Self { ahead: [s, t], limit: [of_cells, of_corners], inner } = self;
        let (below, above) = (k - bed.grid.stride, k + bed.grid.stride);
        let (own, left) = (load::<N>(s, k), load::<N>(s, k - 1));
        let (lower, lower_left) = (load::<N>(s, below), load::<N>(s, below - 1));
        let (corner, right) = (load::<N>(t, k), load::<N>(t, k + 1));
        let (upper, upper_right) = (load::<N>(t, above), load::<N>(t, above + 1));
        let (of_cells, of_corners, inner) = (load::<N>(of_cells, k), load::<N>(of_corners, k), load::<N>(inner, k));
        let corners = mean_square([&corner, &right, &upper, &upper_right]);
        let cells = mean_square([&own, &left, &lower, &lower_left]);
        let s = each_lane::<N, _>(|i| {
            let share = of_cells[i] / (own[i] * own[i] + corners[i] + LEAST_SQUARE).sqrt();
            own[i] * if share < 1.0 { share } else { 1.0 }
        });
        store(out_s, column, s);
        let t = each_lane::<N, _>(|i| {
            let share = of_corners[i] / (corner[i] * corner[i] + inner[i] * cells[i] + LEAST_SQUARE).sqrt();
            corner[i] * if share < 1.0 { share } else { 1.0 }
        });
        store(out_t, column, t);
    }
}

/// Mean square of four stresses.
#[inline(always)]
fn mean_square<const N: usize>([a, b, c, d]: [&[f32; N]; 4]) -> [f32; N] {
    each_lane(|i| 0.25 * ((a[i] * a[i] + b[i] * b[i]) + (c[i] * c[i] + d[i] * d[i])))
}
