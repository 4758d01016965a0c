//! A band of rows: both passes over it. Pass 2 follows pass 1 row by row, while the new rows are in the nearest cache.
//!
//! A row of pass 2 needs the new pressure of the rows beside it. So a band also makes the row below its first and the row
//! above its last for itself, and bands can be done in any order and side by side.

use super::{
    advect::Advection,
    law::heads,
    lift::{Lift, highest, share_out},
    pressure::{Peaks, Push, Pushed},
    source::Source,
};
use crate::simd::{Lanes, Pass};
use std::ops::Range;

/// Row buffers of a band.
#[derive(Debug)]
pub(super) struct Band {
    advection: Advection,
    /// New pressure: of the row made last and the two below it, with the ring, which stands at 1.
    pressure: [Vec<f32>; 3],
    /// Their heads, in strong air.
    heads: [Vec<f32>; 3],
    /// Momentum of the row made last and the one below it.
    momentum_x: [Vec<f32>; 2],
    momentum_y: [Vec<f32>; 2],
    /// Mass times warmth of the row made last, and the warmth of that row and the one below it, of warm air.
    warmth_carried: Vec<f32>,
    warmth: [Vec<f32>; 2],
    /// Largest values of its rows after the last substep.
    pub(super) peaks: Peaks,
}

impl Band {
    pub(super) fn new(stride: usize) -> Self {
        let row = |value| vec![value; stride];
        Self {
            advection: Advection::new(stride),
            pressure: [row(1.0), row(1.0), row(1.0)],
            heads: [row(1.0), row(1.0), row(1.0)],
            momentum_x: [row(0.0), row(0.0)],
            momentum_y: [row(0.0), row(0.0)],
            warmth_carried: Vec::new(),
            warmth: [Vec::new(), Vec::new()],
            peaks: Peaks::default(),
        }
    }

    /// Gets ready for the columns of the source; `row` is the first row of sources.
    #[inline(always)]
    fn begin(&mut self, source: Source, row: usize) {
        self.pressure[0].fill(1.0);
        self.heads[0].fill(1.0);
        for row in &mut self.pressure[1..] {
            (row[0], row[source.width - 1]) = (1.0, 1.0);
        }
        if source.warmth.is_some() && self.warmth_carried.is_empty() {
            for row in self.warmth.iter_mut().chain([&mut self.warmth_carried]) {
                row.resize(source.stride, 0.0);
            }
        }
        self.advection.begin(source, row);
        self.peaks = Peaks::default();
    }

    /// Values held.
    pub(super) fn values(&self) -> usize {
        self.advection.values() + self.pressure[0].len() * 10 + self.warmth_carried.len() * 3
    }

    /// Makes the next row of new pressure and momentum.
    #[inline(always)]
    fn sum_up<L: Lanes>(&mut self, source: Source, row: usize) {
        self.rotate();
        let width = source.width;
        let targets = [&mut self.pressure[0], &mut self.momentum_x[0], &mut self.momentum_y[0]];
        let warmth = source.warmth.map(|_| &mut self.warmth_carried[..width]);
        self.advection.sum_up::<L>(source, row, targets.map(|row| &mut row[..width]), warmth);
        if source.warmth.is_some() {
            share_out::<L>(&self.warmth_carried[..width], &self.pressure[0][..width], &mut self.warmth[0][..width]);
        }
        if let Some(instructions) = source.strong {
            let warmth = source.warmth.map(|_| &self.warmth[0][..width]);
            heads(instructions, &self.pressure[0][..width], warmth, &mut self.heads[0]);
        }
    }

    #[inline(always)]
    fn rotate(&mut self) {
        self.pressure.rotate_right(1);
        self.heads.rotate_right(1);
        self.momentum_x.swap(0, 1);
        self.momentum_y.swap(0, 1);
        self.warmth.swap(0, 1);
    }
}

/// A substep of a band of rows, or of the part of it that is awake.
pub(super) struct BandPass<'a> {
    pub(super) band: &'a mut Band,
    /// The columns that are done.
    pub(super) source: Source<'a>,
    pub(super) push: Push,
    pub(super) lift: Lift,
    /// The rows that are done, counted with the ring.
    pub(super) rows: Range<usize>,
    /// The row that the target begins with, counted with the ring.
    pub(super) first: usize,
    /// Out: pressure and velocity. Whole rows, with the ring, of which only the cells of the box are touched.
    pub(super) target: [&'a mut [f32]; 3],
    /// Out: warmth of warm air, likewise.
    pub(super) warmth: &'a mut [f32],
}

impl BandPass<'_> {
    /// Lifts the warm air of the row below the one made last, before it is pushed; `out` are its columns in the target.
    #[inline(always)]
    fn lift(&mut self, out: Range<usize>) {
        let width = out.len();
        let Band { pressure, momentum_x, momentum_y, warmth, .. } = &mut *self.band;
        let [momentum_x, momentum_y] = [momentum_x, momentum_y].map(|rows| &mut rows[1][..width]);
        let warmth = &warmth[1][..width];
        self.lift.run(&pressure[1][..width], warmth, [momentum_x, momentum_y]);
        self.warmth[out][1..width - 1].copy_from_slice(&warmth[1..width - 1]);
    }

    /// Pass 2 for a row, once the row above it is made.
    #[inline(always)]
    fn follow<L: Lanes>(&mut self, row: usize) {
        let Source { stride, left, width, open, strong, .. } = self.source;
        let start = (row - self.first) * stride + left;
        let out = start..start + width;
        if self.source.warmth.is_some() {
            self.lift(out.clone());
        }
        let Band { pressure, heads, momentum_x, momentum_y, warmth, .. } = &*self.band;
        let here = &pressure[1];
        let [above, level, below] = if strong.is_some() { heads } else { pressure };
        let from = Pushed {
            pressure: &here[..width],
            heads: [&below[..width], &level[..width], &above[..width]],
            momentum_x: &momentum_x[1][..width],
            momentum_y: &momentum_y[1][..width],
            open,
            start: self.source.start(row),
            stride,
        };
        let [target, velocity_x, velocity_y] = &mut self.target;
        let to = [&mut target[out.clone()], &mut velocity_x[out.clone()], &mut velocity_y[out]];
        let mut peaks = self.push.run::<L>(from, to);
        if self.source.warmth.is_some() {
            peaks.pressure = highest(&here[1..width - 1], &warmth[1][1..width - 1]);
        }
        self.band.peaks = self.band.peaks.max(peaks);
    }
}

impl Pass for BandPass<'_> {
    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let (source, Range { start: first, end }) = (self.source, self.rows.clone());
        let rows = source.pressure.len() / source.stride - 2;
        let (low, high) = ((first - 1).max(1), end.min(rows));
        self.band.begin(source, low - 1);
        // A row of sources completes the targets below it, and these the push of the row below them.
        for row in low - 1..=high + 1 {
            self.band.advection.share::<L>(source, row, row <= high);
            if row > low {
                self.band.sum_up::<L>(source, row - 1);
            }
            self.band.advection.advance();
            if row > first + 1 {
                self.follow::<L>(row - 2);
            }
        }
        if end > rows {
            self.band.rotate();
            self.band.pressure[0].fill(1.0);
            self.band.heads[0].fill(1.0);
            self.follow::<L>(rows);
        }
    }
}
