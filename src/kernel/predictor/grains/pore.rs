//! The pressure of the water between grains: it bears a part of the weight, and grains press one another with what is left
//! (Terzaghi's effective stress).
//!
//! Grains that water surrounds stand in its pressure; such that air surrounds are dry. Between, how much of the water's head
//! reaches a cell goes by how near water and air are: head and share are harmonic in the grains (seepage by Darcy's law, without
//! what it takes of the water), with the water's and 1 beside water, with 0 beside air.

use crate::{
    predictor::{
        grains::{
            bed::{At, Bed},
            cells::{Cells, find},
            fields::Fields,
            near::Near,
            spread::Spread,
        },
        stencil::Axis,
        wide::{load, store},
    },
    simd::each_lane,
};

/// Sweeps of a substep: what is far from the water becomes wet in the course of some ticks.
const SWEEPS: usize = 20;

/// Share of a cell's pressure that grains bear from which on it is no water.
const GRAINS: f32 = 0.5;

/// Water between grains. The buffers are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Pore {
    /// Head of the water that reaches a cell, d/s, times the share that does; and that share.
    reached: Fields,
    /// The same after the next sweep.
    next: Fields,
    /// 1 in cells of grains, 0 in others, where nothing changes.
    inside: Vec<f32>,
    /// Pressure of the water in each cell, d/s.
    pressure: Vec<f32>,
}

impl Pore {
    /// Finds the pressure between grains under that of the substep (d/s). Where grains come together far from all others, they are
    /// dry before. `density`: of the liquids, as a share of the heaviest;
    /// none if there are none.
    pub fn solve(&mut self, bed: &Bed, near: &Near, spread: &Spread, pressure: &[f32], density: Option<f32>) {
        for field in self.reached.iter_mut().chain(&mut self.next).chain([&mut self.inside, &mut self.pressure]) {
            field.resize(bed.grid.len(), 0.0);
            near.left(bed.grid, |left| field[left].fill(0.0));
        }
        let Self { reached, next, inside, pressure: pore, .. } = self;
        let Some(density) = density else {
            reached.iter_mut().chain([pore]).for_each(|field| field.fill(0.0));
            return;
        };
        let ([head, share], [next_head, next_share]) = (&mut *reached, &mut *next);
        let begin = Begin { spread: *spread, pressure, density };
        find(&begin, (bed, near), [head, share, next_head, next_share, inside]);
        for _ in 0..SWEEPS {
            find(&Seep { reached, inside }, (bed, near), next.each_mut());
            std::mem::swap(reached, next);
        }
        find(&Finish { reached, density }, (bed, near), [pore]);
    }

    /// Pressure of the water in each cell, d/s.
    pub fn pressure(&self) -> &[f32] {
        &self.pressure
    }

    /// What the next substep sets out from.
    pub fn kept(&self) -> [&Vec<f32>; 2] {
        self.reached.each_ref()
    }

    /// One that sets out from what was kept.
    pub fn resume(reached: Fields) -> Self {
        Self { reached, ..Self::default() }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let fields = self.reached.iter().chain(&self.next).chain([&self.inside, &self.pressure]);
        4 * fields.map(Vec::capacity).sum::<usize>()
    }
}

/// What the water of a density has lost of its head in cells side by side, d/s.
#[inline(always)]
fn heights<const N: usize>(bed: &Bed, density: f32, At { row, column, .. }: At) -> [f32; N] {
    each_lane(|i| -density * (bed.kick.x * (column + i) as f32 + bed.kick.y * row as f32))
}

/// Marks the cells of grains, and sets head and share in all others.
struct Begin<'a> {
    spread: Spread<'a>,
    pressure: &'a [f32],
    density: f32,
}

impl Cells<5> for Begin<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, at: At, rows: &mut [&mut [f32]; 5]) {
        let Self { spread, pressure, density } = self;
        let At { column, k, .. } = at;
        let (liquid, pressure) = (load::<N>(bed.liquid, k), load::<N>(pressure, k));
        let (bears, heights) = (spread.bears::<N>(bed.grid, k), heights::<N>(bed, *density, at));
        let is_inside = each_lane::<N, _>(|i| if (liquid[i] > 0.0) & (bears[i] > GRAINS) { 1.0 } else { 0.0 });
        let head: [f32; N] = each_lane(|i| if liquid[i] > 0.0 { pressure[i].max(0.0) + heights[i] } else { 0.0 });
        let share: [f32; N] = each_lane(|i| if liquid[i] > 0.0 { 1.0 } else { 0.0 });
        let [own_head, own_share, next_head, next_share, inside] = rows;
        for (row, values) in [(own_head, head), (next_head, head), (own_share, share), (next_share, share)] {
            let before = load::<N>(row, column);
            store::<N>(row, column, each_lane(|i| if is_inside[i] > 0.0 { before[i] } else { values[i] }));
        }
        store(inside, column, is_inside);
    }
}

/// Each cell of grains takes the mean of those around it that no wall parts it from.
struct Seep<'a> {
    reached: &'a Fields,
    inside: &'a [f32],
}

impl Cells<2> for Seep<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, at: At, rows: &mut [&mut [f32]; 2]) {
        let Self { reached, inside } = self;
        let (At { row, column, k }, stride) = (at, bed.grid.stride);
        let [left, right] = [column, column + 1].map(|column| bed.open::<N>(Axis::U, At { column, ..at }));
        let [lower, upper] = [row, row + 1].map(|row| bed.open::<N>(Axis::V, At { row, ..at }));
        let inside = load::<N>(inside, k);
        for (out, field) in rows.iter_mut().zip(reached.iter()) {
            let own = load::<N>(field, k);
            let [at_left, at_right] = [k - 1, k + 1].map(|k| load::<N>(field, k));
            let [at_lower, at_upper] = [k - stride, k + stride].map(|k| load::<N>(field, k));
            let next = each_lane(|i| {
                let open = (left[i] + right[i]) + (lower[i] + upper[i]);
                let sum =
                    (left[i] * at_left[i] + right[i] * at_right[i]) + (lower[i] * at_lower[i] + upper[i] * at_upper[i]);
                let mean = if open > 0.0 { sum / open } else { 0.0 };
                if inside[i] > 0.0 { mean } else { own[i] }
            });
            store::<N>(out, column, next);
        }
    }
}

/// From head and share to the pressure.
struct Finish<'a> {
    reached: &'a Fields,
    density: f32,
}

impl Cells<1> for Finish<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, at: At, [pressure]: &mut [&mut [f32]; 1]) {
        let [head, share] = self.reached.each_ref().map(|field| load::<N>(field, at.k));
        let heights = heights::<N>(bed, self.density, at);
        let left = each_lane(|i| head[i] - share[i] * heights[i]);
        store::<N>(pressure, at.column, left.map(|left| if left > 0.0 { left } else { 0.0 }));
    }
}
