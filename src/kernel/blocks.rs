//! Blocks of particles that may share out their velocities side by side.
//!
//! Particles were sorted into strips not long ago, so those that follow one another reach a narrow band of grid rows. They
//! are cut into blocks that go in two turns: blocks of one turn reach disjoint rows. The cuts follow from the positions
//! alone, so that every face adds up in the same order whatever the number of threads. Particles that are out of order
//! (just poured, for example) go last, one after the other.

use crate::{
    parallel::{Parts, cut, fork, piece, spread},
    simd::{InstructionSet, Lanes, Pass},
};
use std::ops::Range;

/// Particles in a span, the unit that blocks are made of.
const SPAN: usize = 128;

/// Fewer spans than this are not handed to another thread.
const FEWEST_SPANS: usize = 128;

/// A grid that particles share something out to.
pub(super) trait Reach: Copy + Sync {
    /// First row that a particle at height `y` d reaches, and the one after the last. Implementations are
    /// `#[inline(always)]`, so that they are compiled for the caller's registers.
    fn rows(self, y: f32) -> [u32; 2];
}

/// Consecutive particles and the grid rows that they reach.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Block {
    pub particles: Range<usize>,
    pub rows: Range<usize>,
}

/// A partition of the particles. Buffers are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    /// First row that each span of particles reaches, and the one after the last.
    spans: Vec<[u32; 2]>,
    /// The blocks of the first and of the second turn, each with its rows in ascending order.
    turns: [Vec<Block>; 2],
    /// What fits in neither.
    rest: Vec<Block>,
}

impl Blocks {
    /// Cuts the particles at heights `y` d into blocks.
    pub fn partition(&mut self, grid: impl Reach, y: &[f32], instructions: InstructionSet, threads: usize) {
        self.spans.resize(y.len().div_ceil(SPAN), [0; 2]);
        spread([&mut self.spans[..]], FEWEST_SPANS, threads, &|first, [spans]| {
            instructions.run(FindSpans { grid, y: &y[first * SPAN..], spans });
        });
        let Self { spans, turns, rest } = self;
        for blocks in turns.iter_mut().chain([&mut *rest]) {
            blocks.clear();
            // As many as there can be: room is made when particles come, not when they move.
            blocks.reserve(spans.len());
        }
        let end_of = |block: Option<&Block>| block.map_or(0, |block| block.rows.end);
        // The turn of the block at hand, and whether it may grow.
        let (mut turn, mut grows) = (1, false);
        for (index, span) in spans.iter().enumerate() {
            let particles = index * SPAN..y.len().min((index + 1) * SPAN);
            let rows = span[0] as usize..span[1] as usize;
            let before = turns[turn].len().checked_sub(2).map(|index| &turns[turn][index]);
            if rows.start >= end_of(turns[1 - turn].last()) {
                (turn, grows) = (1 - turn, true);
                turns[turn].push(Block { particles, rows });
            } else if grows && rows.start >= end_of(before) {
                if let Some(block) = turns[turn].last_mut() {
                    block.particles.end = particles.end;
                    block.rows = block.rows.start.min(rows.start)..block.rows.end.max(rows.end);
                }
            } else {
                grows = false;
                rest.push(Block { particles, rows });
            }
        }
    }

    /// The rows that any particle reaches.
    pub fn reached(&self) -> Range<usize> {
        let first = self.spans.iter().map(|span| span[0]).min();
        let end = self.spans.iter().map(|span| span[1]).max();
        first.unwrap_or(0) as usize..end.unwrap_or(0) as usize
    }

    /// Calls `work(particles, first row, rows of each field)` for every block. `fields` have `stride` entries a row.
    pub fn share_out<const K: usize, T, F>(&self, fields: [&mut [T]; K], stride: usize, threads: usize, work: &F)
    where
        T: Send,
        F: Fn(Range<usize>, usize, [&mut [T]; K]) + Sync,
    {
        let mut fields = fields;
        for turn in &self.turns {
            let fields = fields.each_mut().map(|field| &mut **field);
            let rows = BlockRows { blocks: turn, base: 0, stride, fields };
            fork(rows, piece(turn.len(), threads, 1), &|part: BlockRows<K, T>| part.run(work));
        }
        BlockRows { blocks: &self.rest, base: 0, stride, fields }.run(work);
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let blocks = self.turns.iter().chain([&self.rest]).map(Vec::capacity).sum::<usize>();
        size_of::<Block>() * blocks + 8 * self.spans.capacity()
    }
}

/// Blocks in the order of their rows, with the rows of `fields` from `base` on.
struct BlockRows<'a, const K: usize, T> {
    blocks: &'a [Block],
    base: usize,
    stride: usize,
    fields: [&'a mut [T]; K],
}

impl<const K: usize, T> BlockRows<'_, K, T> {
    /// Runs one block after the other.
    fn run(mut self, work: &impl Fn(Range<usize>, usize, [&mut [T]; K])) {
        for Block { particles, rows } in self.blocks {
            let own = (rows.start - self.base) * self.stride..(rows.end - self.base) * self.stride;
            work(particles.clone(), rows.start, self.fields.each_mut().map(|field| &mut field[own.clone()]));
        }
    }
}

impl<const K: usize, T: Send> Parts for BlockRows<'_, K, T> {
    fn size(&self) -> usize {
        self.blocks.len()
    }

    fn halve(self) -> (Self, Self) {
        let Self { blocks, base, stride, fields } = self;
        let (lower, upper) = blocks.split_at(blocks.len() / 2);
        let boundary = upper[0].rows.start;
        let (lower_rows, upper_rows) = cut(fields, (boundary - base) * stride);
        (
            Self { blocks: lower, base, stride, fields: lower_rows },
            Self { blocks: upper, base: boundary, stride, fields: upper_rows },
        )
    }
}

/// Finds the rows that spans of particles reach.
struct FindSpans<'a, R> {
    grid: R,
    y: &'a [f32],
    spans: &'a mut [[u32; 2]],
}

impl<R: Reach> Pass for FindSpans<'_, R> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        for (span, y) in self.spans.iter_mut().zip(self.y.chunks(SPAN)) {
            let (mut first, mut end) = (u32::MAX, 0);
            for &y in y {
                let [low, high] = self.grid.rows(y);
                first = first.min(low);
                end = end.max(high);
            }
            *span = [first, end];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::whole_below;

    /// 160 rows, 2.5 d high, with a stencil of two rows at each of two heights half a row apart, as on a staggered grid.
    #[derive(Clone, Copy)]
    struct Staggered;

    impl Reach for Staggered {
        #[inline(always)]
        fn rows(self, y: f32) -> [u32; 2] {
            let row = |at: f32| whole_below(at, 0, 159).0;
            [row(y / 2.5 - 0.5), row(y / 2.5) + 2]
        }
    }

    fn partition(heights: &[f32]) -> Blocks {
        let mut blocks = Blocks::default();
        blocks.partition(Staggered, heights, InstructionSet::Baseline, 1);
        blocks
    }

    fn all(blocks: &Blocks) -> Vec<Block> {
        let mut all: Vec<Block> = blocks.turns.iter().flatten().chain(&blocks.rest).cloned().collect();
        all.sort_by_key(|block| block.particles.start);
        all
    }

    fn check(heights: &[f32]) -> Blocks {
        let blocks = partition(heights);
        let mut next = 0;
        for block in all(&blocks) {
            assert_eq!(block.particles.start, next, "a particle is left out or comes twice");
            next = block.particles.end;
        }
        assert_eq!(next, heights.len());
        for turn in &blocks.turns {
            for pair in turn.windows(2) {
                assert!(pair[0].rows.end <= pair[1].rows.start, "two blocks of a turn share rows: {pair:?}");
            }
        }
        blocks
    }

    #[test]
    fn sorted_particles_go_in_two_turns_of_many_blocks() {
        let heights: Vec<f32> = (0..20_000).map(|k| k as f32 * 0.018 + (k * 7919 % 27) as f32 * 0.1).collect();
        let blocks = check(&heights);
        assert!(blocks.rest.is_empty(), "{} blocks are out of order", blocks.rest.len());
        assert!(blocks.turns.iter().all(|turn| turn.len() > 20), "{} blocks only", all(&blocks).len());
    }

    #[test]
    fn what_was_just_poured_goes_last_and_the_others_as_before() {
        let mut heights: Vec<f32> = (0..20_000).map(|k| k as f32 * 0.018).collect();
        let sorted = check(&heights);
        heights.extend((0..500).map(|k| 50.0 + (k % 10) as f32));
        let poured = check(&heights);
        assert!(poured.rest.len() <= 5);
        assert_eq!(poured.turns[0][..20], sorted.turns[0][..20]);
    }

    #[test]
    fn any_order_is_taken() {
        check(&[]);
        check(&[1.0]);
        check(&(0..5_000).map(|k| (k * 7919 % 4000) as f32 * 0.1).collect::<Vec<_>>());
        check(&(0..5_000).map(|k| (5_000 - k) as f32 * 0.07).collect::<Vec<_>>());
        check(&[f32::NAN, f32::INFINITY, -1e9, 1e30]);
    }

    #[test]
    fn every_block_gets_its_rows_on_any_number_of_threads() {
        let heights: Vec<f32> = (0..20_000).map(|k| (k - k % 7 * 300).max(0) as f32 * 0.018).collect();
        let blocks = partition(&heights);
        let runs = [1, 2, 5].map(|threads| {
            let mut rows = vec![0_u64; 170];
            blocks.share_out([&mut rows[..]], 1, threads, &|particles, first, [rows]| {
                for (index, row) in rows.iter_mut().enumerate() {
                    *row = *row * 31 + (particles.start * (first + index)) as u64;
                }
            });
            rows
        });
        assert!(runs[0] == runs[1] && runs[0] == runs[2]);
    }
}
