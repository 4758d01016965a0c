//! The pressure of the water between grains: it bears a part of the weight, and grains press one another with what is left
//! (Terzaghi's effective stress).
//!
//! Grains that water surrounds stand in its pressure; such that air surrounds are dry. Between, how much of the water's head
//! reaches a cell goes by how near water and air are: head and share are harmonic in the grains (seepage by Darcy's law, without
//! what it takes of the water), with the water's and 1 beside water, with 0 beside air.

use crate::{
    parallel::{Rows, Sweep, sweep},
    predictor::{
        grains::{
            bed::Bed,
            fields::{Fields, Two, row, two},
            near::Near,
            spread::Spread,
        },
        level::WORTH_A_PIECE,
    },
};
use std::ops::Range;

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
        let (rows, per_row, stride) = (near.rows(bed.grid), near.per_row(), bed.grid.stride);
        for field in self.reached.iter_mut().chain(&mut self.next).chain([&mut self.inside, &mut self.pressure]) {
            field.resize(bed.grid.len(), 0.0);
            near.left(bed.grid, |left| field[left].fill(0.0));
        }
        let Self { reached, next, inside, pressure: pore, .. } = self;
        let Some(density) = density else {
            reached.iter_mut().chain([pore]).for_each(|field| field.fill(0.0));
            return;
        };
        let work = Begin { bed, near, spread: *spread, pressure, density };
        let band = ((two(reached, stride, &rows), two(next, stride, &rows)), Rows::new(inside, stride, &rows));
        sweep(&work, rows.clone(), band, per_row, WORTH_A_PIECE, bed.team);
        for _ in 0..SWEEPS {
            let work = Seep { bed, near, reached, inside };
            sweep(&work, rows.clone(), two(next, stride, &rows), per_row, WORTH_A_PIECE, bed.team);
            std::mem::swap(reached, next);
        }
        let work = Finish { bed, near, reached, density };
        sweep(&work, rows.clone(), Rows::new(pore, stride, &rows), per_row, WORTH_A_PIECE, bed.team);
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

/// What the water of a density has lost of its head in a cell, d/s.
#[inline(always)]
fn height(bed: &Bed, density: f32, j: usize, column: usize) -> f32 {
    -density * (bed.kick.x * column as f32 + bed.kick.y * j as f32)
}

/// Marks the cells of grains, and sets head and share in all others.
struct Begin<'a> {
    bed: &'a Bed<'a>,
    near: &'a Near,
    spread: Spread<'a>,
    pressure: &'a [f32],
    density: f32,
}

impl<'b> Sweep<((Two<'b>, Two<'b>), Rows<'b, f32>)> for Begin<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((now, next), mut inside): ((Two, Two), Rows<f32>)) {
        let Self { bed, near, spread, pressure, density } = self;
        let ((mut head, mut share), (mut next_head, mut next_share)) = (now, next);
        let out = head.each().zip(share.each()).zip(next_head.each().zip(next_share.each())).zip(inside.each());
        for (j, (((head, share), (next_head, next_share)), inside)) in rows.zip(out) {
            for columns in near.runs(j) {
                for column in columns {
                    let k = bed.grid.row(j) + column;
                    let is_liquid = bed.is_liquid(k);
                    let is_inside = is_liquid && spread.bears(bed.grid, k) > GRAINS;
                    inside[column] = if is_inside { 1.0 } else { 0.0 };
                    if is_inside {
                        continue;
                    }
                    let value = if is_liquid { pressure[k].max(0.0) + height(bed, *density, j, column) } else { 0.0 };
                    (head[column], share[column]) = (value, if is_liquid { 1.0 } else { 0.0 });
                    (next_head[column], next_share[column]) = (head[column], share[column]);
                }
            }
        }
    }
}

/// Each cell of grains takes the mean of those around it that no wall parts it from.
struct Seep<'a> {
    bed: &'a Bed<'a>,
    near: &'a Near,
    reached: &'a Fields,
    inside: &'a [f32],
}

impl<'b> Sweep<Two<'b>> for Seep<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut head, mut share): Two) {
        let Self { bed, near, reached, inside } = self;
        let (stride, closed) = (bed.grid.stride, bed.closed);
        for (j, (head, share)) in rows.zip(head.each().zip(share.each())) {
            // No cell beyond has a pressure.
            for columns in near.runs(j).map(|run| run.start..run.end.min(bed.grid.columns + 1)) {
                let (n, k) = (columns.len(), bed.grid.row(j) + columns.start);
                let [own, above] = [j, j + 1].map(|j| closed.row(j) + columns.start);
                let (left, right) = (row(&closed.open_u, own, n), row(&closed.open_u, own + 1, n));
                let (lower, upper) = (row(&closed.open_v, own, n), row(&closed.open_v, above, n));
                let inside = row(inside, k, n);
                for (out, field) in [(&mut *head, &reached[0]), (&mut *share, &reached[1])] {
                    let out = &mut out[columns.clone()];
                    let [at, at_left, at_right, at_lower, at_upper] =
                        [k, k - 1, k + 1, k - stride, k + stride].map(|at| row(field, at, n));
                    for i in 0..n {
                        let open = (left[i] + right[i]) + (lower[i] + upper[i]);
                        let sum = (left[i] * at_left[i] + right[i] * at_right[i])
                            + (lower[i] * at_lower[i] + upper[i] * at_upper[i]);
                        let mean = if open > 0.0 { sum / open } else { 0.0 };
                        out[i] = if inside[i] > 0.0 { mean } else { at[i] };
                    }
                }
            }
        }
    }
}

/// From head and share to the pressure.
struct Finish<'a> {
    bed: &'a Bed<'a>,
    near: &'a Near,
    reached: &'a Fields,
    density: f32,
}

impl Sweep<Rows<'_, f32>> for Finish<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut pressure: Rows<f32>) {
        let Self { bed, near, reached: [head, share], density } = self;
        for (j, pressure) in rows.zip(pressure.each()) {
            for columns in near.runs(j) {
                for column in columns {
                    let k = bed.grid.row(j) + column;
                    let left = head[k] - share[k] * height(bed, *density, j, column);
                    pressure[column] = if left > 0.0 { left } else { 0.0 };
                }
            }
        }
    }
}
