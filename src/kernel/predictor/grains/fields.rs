//! Pairs of fields, and their rows.

use crate::parallel::Rows;
use std::ops::Range;

/// Values of cells and of their lower left corners, or of left and of lower faces.
pub(super) type Fields = [Vec<f32>; 2];

/// Rows of two fields.
pub(super) type Two<'a> = (Rows<'a, f32>, Rows<'a, f32>);

/// These rows of both fields.
pub(super) fn two<'a>([first, second]: &'a mut Fields, stride: usize, rows: &Range<usize>) -> Two<'a> {
    (Rows::new(first, stride, rows), Rows::new(second, stride, rows))
}

/// What of a row is read: `n` entries from `first` on.
#[inline(always)]
pub(super) fn row(field: &[f32], first: usize, n: usize) -> &[f32] {
    &field[first..first + n]
}
