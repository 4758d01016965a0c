//! How much the grains are strained in a substep.

use crate::{
    predictor::{
        grains::{
            bed::{At, Bed},
            cells::Cells,
            fields::Fields,
        },
        wide::{load, store},
    },
    simd::each_lane,
};

/// Velocities with what the stress changes.
pub(super) struct Hasten<'a> {
    pub flow: &'a Fields,
    pub gained: &'a Fields,
}

impl Cells<2> for Hasten<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, _: &Bed, At { column, k, .. }: At, rows: &mut [&mut [f32]; 2]) {
        for (out, (flow, gained)) in rows.iter_mut().zip(self.flow.iter().zip(self.gained)) {
            let (flow, gained) = (load::<N>(flow, k), load::<N>(gained, k));
            store::<N>(out, column, each_lane(|i| flow[i] + gained[i]));
        }
    }
}

/// How much is sheared about corners that take part, d/s a cell.
pub(super) struct Shear<'a> {
    pub held: &'a Fields,
    pub step: &'a [f32],
}

impl Cells<1> for Shear<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, At { column, k, .. }: At, [out]: &mut [&mut [f32]; 1]) {
        let Self { held: [u, v], step } = self;
        let [u, u_lower] = [k, k - bed.grid.stride].map(|k| load::<N>(u, k));
        let [v, v_left] = [k, k - 1].map(|k| load::<N>(v, k));
        let step = load::<N>(step, k);
        let sheared = each_lane(|i| {
            let sheared = (u[i] - u_lower[i] + v[i] - v_left[i]).abs();
            if step[i] > 0.0 { sheared } else { 0.0 }
        });
        store::<N>(out, column, sheared);
    }
}

/// How much cells with a pressure are strained, d/s a cell: as much as the most strained of their corners at least.
pub(super) struct Strain<'a> {
    pub held: &'a Fields,
    pub corners: &'a [f32],
}

impl Cells<1> for Strain<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, At { row, column, k }: At, [out]: &mut [&mut [f32]; 1]) {
        // What is above the last row has no pressure, and the last of it no corner to its upper right.
        if row > bed.grid.rows {
            return;
        }
        let Self { held: [u, v], corners } = self;
        let stride = bed.grid.stride;
        let [u, u_right] = [k, k + 1].map(|k| load::<N>(u, k));
        let [v, v_upper] = [k, k + stride].map(|k| load::<N>(v, k));
        let around = [k, k + 1, k + stride, k + stride + 1].map(|k| load::<N>(corners, k));
        let liquid = load::<N>(bed.liquid, k);
        let strained = each_lane(|i| {
            let own = (u_right[i] - u[i] - v_upper[i] + v[i]).abs();
            let most = around.iter().fold(own, |most, corners| most.max(corners[i]));
            if liquid[i] > 0.0 { most } else { 0.0 }
        });
        store::<N>(out, column, strained);
    }
}
