//! Passes over what friction works on: cells with their lower left corners, or faces, side by side in lanes.

use crate::{
    parallel::{Band, Sweep, cut, sweep},
    predictor::{
        grains::{
            bed::{At, Bed},
            near::Near,
        },
        level::WORTH_A_PIECE,
        wide::{Wide, in_lanes},
    },
};
use std::ops::Range;

/// A pass that writes some fields.
pub(super) trait Cells<const FIELDS: usize>: Sync {
    /// Does `N` cells. `rows`: their row of each field. Implementations are `#[inline(always)]`, so that they are compiled for the
    /// caller's registers.
    fn find<const N: usize>(&self, bed: &Bed, at: At, rows: &mut [&mut [f32]; FIELDS]);
}

/// Runs a pass wherever friction works.
pub(super) fn find<const FIELDS: usize>(
    work: &impl Cells<FIELDS>,
    (bed, near): (&Bed, &Near),
    fields: [&mut Vec<f32>; FIELDS],
) {
    let (rows, stride) = (near.rows(bed.grid), bed.grid.stride);
    let fields = fields.map(|field| &mut field[rows.start * stride..rows.end * stride]);
    let work = Pass { work, bed, near };
    sweep(&work, rows, FieldRows { fields, stride }, near.per_row(), WORTH_A_PIECE, bed.team);
}

/// Rows of some fields.
struct FieldRows<'a, const FIELDS: usize> {
    fields: [&'a mut [f32]; FIELDS],
    stride: usize,
}

impl<const FIELDS: usize> Band for FieldRows<'_, FIELDS> {
    fn split(self, rows: usize) -> (Self, Self) {
        let Self { fields, stride } = self;
        let (lower, upper) = cut(fields, rows * stride);
        (Self { fields: lower, stride }, Self { fields: upper, stride })
    }
}

struct Pass<'a, W> {
    work: &'a W,
    bed: &'a Bed<'a>,
    near: &'a Near,
}

impl<'b, const FIELDS: usize, W: Cells<FIELDS>> Sweep<FieldRows<'b, FIELDS>> for Pass<'_, W> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut band: FieldRows<'b, FIELDS>) {
        let Self { work, bed, near } = *self;
        let stride = band.stride;
        for (before, row) in rows.enumerate() {
            let mut own = band.fields.each_mut().map(|field| &mut field[before * stride..][..stride]);
            for columns in near.runs(row) {
                in_lanes(columns, OfRow { work, bed, row, own: &mut own });
            }
        }
    }
}

struct OfRow<'a, 'b, W, const FIELDS: usize> {
    work: &'a W,
    bed: &'a Bed<'a>,
    row: usize,
    own: &'a mut [&'b mut [f32]; FIELDS],
}

impl<const FIELDS: usize, W: Cells<FIELDS>> Wide for OfRow<'_, '_, W, FIELDS> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, column: usize) {
        let at = At { row: self.row, column, k: self.bed.grid.row(self.row) + column };
        self.work.find::<N>(self.bed, at, self.own);
    }
}
