//! Hands work to threads: pieces of arrays, and groups with the outputs that belong to them.
//!
//! What an entry gets never depends on where the pieces are cut, so the number of threads does not show in the result.

use crate::kernel::{bins::Group, simd::InstructionSet};
use std::ops::Range;

/// Pieces a thread: some are denser than others, so there is something left to steal.
const PIECES_PER_THREAD: usize = 4;
/// Fewer groups than this a piece do not pay for handing it over (a hand-over costs some microseconds).
const FEWEST_GROUPS: usize = 64;
/// Pieces of arrays begin at multiples of this, so that lanes stay full.
const ALIGNMENT: usize = 16;

/// Runs `work` over pieces of `groups`, on up to `threads` threads of the current rayon pool. Each call gets its groups,
/// the index of their first particle, and the outputs from that particle on, up to its last.
pub(crate) fn split<const K: usize, T, F>(groups: &[Group], outputs: [&mut [T]; K], threads: usize, work: &F)
where
    T: Send,
    F: Fn(&[Group], usize, [&mut [T]; K]) + Sync,
{
    split_groups(groups, 0, outputs, piece(groups.len(), threads, FEWEST_GROUPS), work);
}

fn split_groups<const K: usize, T, F>(groups: &[Group], base: usize, outputs: [&mut [T]; K], piece: usize, work: &F)
where
    T: Send,
    F: Fn(&[Group], usize, [&mut [T]; K]) + Sync,
{
    if groups.len() <= piece {
        return work(groups, base, outputs);
    }
    let (left, right) = groups.split_at(groups.len() / 2);
    let boundary = right[0].first as usize;
    let (left_outputs, right_outputs) = cut(outputs, boundary - base);
    rayon::join(
        || split_groups(left, base, left_outputs, piece, work),
        || split_groups(right, boundary, right_outputs, piece, work),
    );
}

/// Entries that are worth a piece of their own where each takes some nanoseconds; lighter work wants more.
pub(crate) const WORTH_A_PIECE: usize = 2048;

/// Runs `work` over pieces of arrays of one length, of `fewest` entries or more, on up to `threads` threads of the
/// current rayon pool. Each call gets the index of its first entry and its piece of each array.
pub(crate) fn spread<const K: usize, T, F>(arrays: [&mut [T]; K], fewest: usize, threads: usize, work: &F)
where
    T: Send,
    F: Fn(usize, [&mut [T]; K]) + Sync,
{
    let len = arrays.first().map_or(0, |array| array.len());
    debug_assert!(arrays.iter().all(|array| array.len() == len), "arrays of one length");
    spread_from(0, len, arrays, piece(len, threads, fewest), work);
}

fn spread_from<const K: usize, T, F>(base: usize, len: usize, arrays: [&mut [T]; K], piece: usize, work: &F)
where
    T: Send,
    F: Fn(usize, [&mut [T]; K]) + Sync,
{
    if len <= piece {
        return work(base, arrays);
    }
    let half = (len / 2).next_multiple_of(ALIGNMENT);
    let (left, right) = cut(arrays, half);
    rayon::join(
        || spread_from(base, half, left, piece, work),
        || spread_from(base + half, len - half, right, piece, work),
    );
}

/// Runs `work` over pieces of `0 … len`, of `fewest` or more, on up to `threads` threads of the current rayon pool.
pub(crate) fn over(len: usize, fewest: usize, threads: usize, work: &(impl Fn(Range<usize>) + Sync)) {
    over_from(0..len, piece(len, threads, fewest), work);
}

fn over_from(range: Range<usize>, piece: usize, work: &(impl Fn(Range<usize>) + Sync)) {
    if range.len() <= piece {
        return work(range);
    }
    let middle = range.start + range.len() / 2;
    rayon::join(|| over_from(range.start..middle, piece, work), || over_from(middle..range.end, piece, work));
}

/// Who does the work.
#[derive(Clone, Copy, Debug)]
pub struct Team {
    /// Lanes in use.
    pub instructions: InstructionSet,
    /// Threads to use of the current rayon pool; 1 is the calling thread alone.
    pub threads: usize,
}

/// Runs `work` over pieces of a field that are whole rows of `stride` entries, of `fewest` entries or more, on up to
/// `threads` threads of the current rayon pool. Each call gets the index of its first row and its rows.
pub(crate) fn by_rows<T: Send>(
    field: &mut [T],
    stride: usize,
    fewest: usize,
    threads: usize,
    work: &(impl Fn(usize, &mut [T]) + Sync),
) {
    by_rows_from(0, field, stride, piece(field.len(), threads, fewest).max(stride), work);
}

fn by_rows_from<T: Send>(
    first: usize,
    field: &mut [T],
    stride: usize,
    piece: usize,
    work: &(impl Fn(usize, &mut [T]) + Sync),
) {
    if field.len() <= piece {
        return work(first, field);
    }
    let half = field.len() / stride / 2;
    let (lower, upper) = field.split_at_mut(half * stride);
    rayon::join(
        || by_rows_from(first, lower, stride, piece, work),
        || by_rows_from(first + half, upper, stride, piece, work),
    );
}

/// Entries that a piece has at most.
pub(crate) fn piece(len: usize, threads: usize, fewest: usize) -> usize {
    if threads <= 1 { usize::MAX } else { (len / (threads * PIECES_PER_THREAD)).max(fewest) }
}

/// Cuts each array in two at `at`.
pub(crate) fn cut<const K: usize, T>(arrays: [&mut [T]; K], at: usize) -> ([&mut [T]; K], [&mut [T]; K]) {
    let mut right: [&mut [T]; K] = std::array::from_fn(|_| Default::default());
    let mut slots = right.iter_mut();
    let left = arrays.map(|array| {
        let (before, after) = array.split_at_mut(at);
        if let Some(slot) = slots.next() {
            *slot = after;
        }
        before
    });
    (left, right)
}
