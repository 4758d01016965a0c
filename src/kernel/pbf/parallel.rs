//! Hands groups and the outputs that belong to them to threads.

use crate::kernel::bins::Group;

/// Pieces a thread: some are denser than others, so there is something left to steal.
const PIECES_PER_THREAD: usize = 4;
/// Fewer groups than this a piece do not pay for handing it over (a hand-over costs some microseconds).
const SMALLEST_PIECE: usize = 64;

/// Runs `work` over pieces of `groups`, on up to `threads` threads of the current rayon pool. Each call gets its groups,
/// the index of their first particle, and the outputs from that particle on, up to its last. What a particle gets does
/// not depend on the cutting.
pub(crate) fn split<const K: usize, F>(groups: &[Group], outputs: [&mut [f32]; K], threads: usize, work: &F)
where
    F: Fn(&[Group], usize, [&mut [f32]; K]) + Sync,
{
    let piece =
        if threads <= 1 { usize::MAX } else { (groups.len() / (threads * PIECES_PER_THREAD)).max(SMALLEST_PIECE) };
    halve(groups, 0, outputs, piece, work);
}

fn halve<const K: usize, F>(groups: &[Group], base: usize, outputs: [&mut [f32]; K], piece: usize, work: &F)
where
    F: Fn(&[Group], usize, [&mut [f32]; K]) + Sync,
{
    if groups.len() <= piece {
        return work(groups, base, outputs);
    }
    let (left, right) = groups.split_at(groups.len() / 2);
    let boundary = right[0].first as usize;
    let mut right_outputs: [&mut [f32]; K] = std::array::from_fn(|_| Default::default());
    let mut slots = right_outputs.iter_mut();
    let left_outputs = outputs.map(|output| {
        let (before, after) = output.split_at_mut(boundary - base);
        if let Some(slot) = slots.next() {
            *slot = after;
        }
        before
    });
    rayon::join(|| halve(left, base, left_outputs, piece, work), || halve(right, boundary, right_outputs, piece, work));
}
