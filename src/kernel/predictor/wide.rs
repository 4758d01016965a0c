//! Work on cells side by side.
//!
//! A loop over a run of cells is made for registers, with what is left over done one by one: of the short runs of coarse grids, that is
//! nearly all. Arrays of a fixed length have no such rest.

use std::ops::Range;

/// Work on cells of a row.
pub(super) trait Wide {
    /// Does the cells of the columns `at … at + N`. Implementations are `#[inline(always)]`, so that they are compiled for the
    /// caller's registers.
    fn run<const N: usize>(&mut self, at: usize);
}

/// Does the cells of some columns: 16 at once, and of what is left the larger half first.
#[inline(always)]
pub(super) fn in_lanes(columns: Range<usize>, mut work: impl Wide) {
    let Range { start: mut at, end } = columns;
    while end - at >= 16 {
        work.run::<16>(at);
        at += 16;
    }
    if end - at >= 8 {
        work.run::<8>(at);
        at += 8;
    }
    if end - at >= 4 {
        work.run::<4>(at);
        at += 4;
    }
    if end - at >= 2 {
        work.run::<2>(at);
        at += 2;
    }
    if end > at {
        work.run::<1>(at);
    }
}

/// `N` numbers of a row from `at` on.
#[inline(always)]
pub(super) fn load<const N: usize>(row: &[f32], at: usize) -> [f32; N] {
    let mut lanes = [0.0; N];
    lanes.copy_from_slice(&row[at..at + N]);
    lanes
}

/// Puts `N` numbers into a row from `at` on.
#[inline(always)]
pub(super) fn store<const N: usize>(row: &mut [f32], at: usize, lanes: [f32; N]) {
    row[at..at + N].copy_from_slice(&lanes);
}
