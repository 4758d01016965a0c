//! The counting sort, in parallel regions that only write to disjoint pieces of arrays.
//!
//! First every particle finds its cell. Then the cells are cut into segments of whole strips, and each segment counts and
//! places its own particles. It knows where they come from: particles have moved little since they were sorted last, so
//! most blocks of them belong to one segment as a whole, and the others are searched. Within a cell the order stays, so that
//! the result is the same however the work is cut. The columns of the particles then follow one by one.

use crate::{
    bins::{
        cells::CellGrid,
        strip::{Strip, Strips},
    },
    columns::Spares,
    element::ElementId,
    parallel::{Parts, Rows, fork, piece},
    particles::{Particles, extent},
    simd::{InstructionSet, Lanes, Pass},
};
use std::ops::Range;

/// Particles in a block.
const BLOCK: usize = 256;
/// Fewer blocks than this a piece do not pay for another thread when their cells are looked up.
const WORTH_A_LOOK: usize = 32;
/// Particles of a segment at least, where there are enough of them for the threads: it searches the blocks at both of its ends for its
/// own.
const WHOLE_SEGMENT: usize = 8192;
/// Fewer particles than this do not pay for a segment of their own.
const WORTH_A_SEGMENT: usize = 2048;

/// The sort's own buffers: a byte a particle and 4 a cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Sort {
    /// Strips that hold particles.
    pub strips: Range<usize>,
    /// Index of the first particle of each cell, for those strips and the one above and below them. In a strip that holds
    /// particles only those of the columns near particles count, and those at both of its ends.
    pub starts: Vec<u32>,
    /// Columns near particles.
    columns: Range<usize>,
    /// Lowest and highest cell in each block of particles.
    blocks: Vec<[u32; 2]>,
    spare_elements: Vec<ElementId>,
    segments: Vec<Segment>,
}

/// Cells of whole strips, and the places of what they hold.
#[derive(Clone, Debug)]
struct Segment {
    cells: Range<usize>,
    places: Range<usize>,
}

impl Sort {
    /// Finds the order of the particles by cell: where each cell's begin, the cell of each in the order from before (`keys`), and
    /// for each place which particle comes there (`source`).
    pub fn place(
        &mut self,
        grid: &CellGrid,
        [x, y]: [&[f32]; 2],
        [keys, source]: [&mut [u32]; 2],
        instructions: InstructionSet,
        threads: usize,
    ) {
        let found = self.find_cells(grid, [x, y], keys, instructions, threads);
        self.cut_into_segments(grid, found, keys, threads);
        self.columns = grid.columns_near(extent(x, instructions));
        let Self { starts, columns, blocks, segments, .. } = self;
        if let Some(first) = segments.first() {
            let ends = &mut starts[1 + first.cells.start..];
            let unsorted = Unsorted { stride: grid.columns, columns, keys, blocks };
            fork(Placing { segments, ends, source }, 1, &|part: Placing| {
                part.segments.iter().for_each(|segment| segment.place(&unsorted, part.ends, part.source));
            });
        }
    }

    /// Brings all columns of the particles into the order that was found. `words` is a buffer for one of them, and is left with
    /// what one of them held.
    pub fn reorder(&mut self, particles: &mut Particles, source: &[u32], words: &mut Vec<u32>, threads: usize) {
        particles.reorder(source, Spares { words, elements: &mut self.spare_elements }, threads);
    }

    /// The places of the particles of a strip that holds any, or lies between such.
    pub fn particles(&self, grid: &CellGrid, strip: usize) -> Range<usize> {
        let start = strip * grid.columns;
        self.starts[start] as usize..self.starts[start + grid.columns] as usize
    }

    /// Lets `settle` change the positions of each strip of the sorted particles within their cells.
    pub fn settle(&self, grid: &CellGrid, particles: &mut Particles, threads: usize, settle: &(impl Fn(Strip) + Sync)) {
        let Particles { x, y, id, .. } = particles;
        let strips = Strips { grid, starts: &self.starts, strips: self.strips.clone(), base: 0, id, at: [x, y] };
        fork(strips, piece(id.len(), threads, WORTH_A_SEGMENT), &|part: Strips| part.each(settle));
    }

    /// Finds the cell of every particle; returns the strips that hold any.
    fn find_cells(
        &mut self,
        grid: &CellGrid,
        [x, y]: [&[f32]; 2],
        keys: &mut [u32],
        instructions: InstructionSet,
        threads: usize,
    ) -> Range<usize> {
        self.blocks.resize(x.len().div_ceil(BLOCK), [0; 2]);
        let count = self.blocks.len();
        let band = (Rows { field: keys, stride: BLOCK }, Rows { field: &mut self.blocks[..], stride: 1 });
        fork((0..count, band), piece(count, threads, WORTH_A_LOOK), &|(whole, (keys, blocks))| {
            let own = whole.start * BLOCK..whole.start * BLOCK + keys.field.len();
            instructions.run(FindCells {
                grid,
                x: &x[own.clone()],
                y: &y[own],
                keys: keys.field,
                blocks: blocks.field,
            });
        });
        let lowest = self.blocks.iter().map(|block| block[0]).min();
        let highest = self.blocks.iter().map(|block| block[1]).max();
        let strip = |cell: u32| cell as usize / grid.columns;
        lowest.zip(highest).map_or(1..1, |(lowest, highest)| strip(lowest)..strip(highest) + 1)
    }

    /// Cuts the cells of `found` strips into segments of about as many particles each as the last sort found there.
    fn cut_into_segments(&mut self, grid: &CellGrid, found: Range<usize>, keys: &[u32], threads: usize) {
        let Self { strips, starts, blocks, segments, .. } = self;
        let count = keys.len();
        if starts.len() != grid.cells() + 1 {
            starts.clear();
            starts.resize(grid.cells() + 1, 0);
            *strips = 1..1;
        }
        segments.clear();
        let share = count.div_ceil(threads.max(1)).clamp(WORTH_A_SEGMENT, WHOLE_SEGMENT);
        let most = piece(count, threads, share) as u32;
        let mut next = Segment { cells: found.start * grid.columns..0, places: 0..0 };
        let mut filled = 0;
        for boundary in strips.clone().map(|strip| strip * grid.columns) {
            let is_inside = next.cells.start < boundary && boundary < found.end * grid.columns;
            if is_inside && starts[boundary] - filled >= most {
                filled = starts[boundary];
                next.cells.end = boundary;
                next.places.end = count_below(keys, blocks, boundary as u32);
                let rest = Segment { cells: boundary..0, places: next.places.end..0 };
                segments.push(std::mem::replace(&mut next, rest));
            }
        }
        next.cells.end = found.end * grid.columns;
        next.places.end = count;
        segments.push(next);
        // Cells of the strips around those that hold particles are there, and empty.
        starts[(found.start - 1) * grid.columns..=found.start * grid.columns].fill(0);
        starts[found.end * grid.columns..=(found.end + 1) * grid.columns].fill(count as u32);
        *strips = found;
    }

    /// The places of the particles of each cell that has `most` of them or more.
    pub fn crowds(&self, grid: &CellGrid, most: usize) -> impl Iterator<Item = Range<usize>> {
        let cells = |strip: usize| strip * grid.columns + self.columns.start..=strip * grid.columns + self.columns.end;
        let strips = self.strips.clone().map(move |strip| &self.starts[cells(strip)]);
        // Most strips have none, and that is seen faster than where one is.
        let is_crowded = move |starts: &&[u32]| {
            let counts = starts.iter().zip(&starts[1..]).map(|(start, end)| end - start);
            counts.fold(false, |any, count| any | (count as usize >= most))
        };
        let places = strips.filter(is_crowded).flat_map(|starts| starts.windows(2));
        places.map(|ends| ends[0] as usize..ends[1] as usize).filter(move |places| places.len() >= most)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        4 * self.starts.capacity()
            + 8 * self.blocks.capacity()
            + self.spare_elements.capacity()
            + size_of::<Segment>() * self.segments.capacity()
    }
}

/// Particles in a cell below `cell`.
fn count_below(keys: &[u32], blocks: &[[u32; 2]], cell: u32) -> usize {
    let count = |(keys, [lowest, highest]): (&[u32], &[u32; 2])| {
        if *highest < cell {
            keys.len()
        } else if *lowest >= cell {
            0
        } else {
            keys.iter().map(|&key| u32::from(key < cell)).sum::<u32>() as usize
        }
    };
    keys.chunks(BLOCK).zip(blocks).map(count).sum()
}

/// Finds the cells of some blocks of particles.
struct FindCells<'a> {
    grid: &'a CellGrid,
    x: &'a [f32],
    y: &'a [f32],
    /// Out: cells.
    keys: &'a mut [u32],
    /// Out: lowest and highest cell of each block.
    blocks: &'a mut [[u32; 2]],
}

impl Pass for FindCells<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let positions = self.x.chunks(BLOCK).zip(self.y.chunks(BLOCK));
        for ((block, keys), (x, y)) in self.blocks.iter_mut().zip(self.keys.chunks_mut(BLOCK)).zip(positions) {
            let (mut lowest, mut highest) = (u32::MAX, 0);
            for ((key, &x), &y) in keys.iter_mut().zip(x).zip(y) {
                *key = self.grid.cell(x, y);
                (lowest, highest) = (lowest.min(*key), highest.max(*key));
            }
            *block = [lowest, highest];
        }
    }
}

/// The particles as they were.
struct Unsorted<'a> {
    /// Cells in a strip.
    stride: usize,
    /// Columns near particles.
    columns: &'a Range<usize>,
    keys: &'a [u32],
    blocks: &'a [[u32; 2]],
}

/// Segments with what they fill.
struct Placing<'a> {
    segments: &'a [Segment],
    /// End of each cell's particles.
    ends: &'a mut [u32],
    source: &'a mut [u32],
}

impl Parts for Placing<'_> {
    fn size(&self) -> usize {
        self.segments.len()
    }

    fn halve(self) -> (Self, Self) {
        let (left, right) = self.segments.split_at(self.segments.len() / 2);
        let (left_ends, right_ends) = self.ends.split_at_mut(right[0].cells.start - left[0].cells.start);
        let (left_source, right_source) = self.source.split_at_mut(right[0].places.start - left[0].places.start);
        (
            Self { segments: left, ends: left_ends, source: left_source },
            Self { segments: right, ends: right_ends, source: right_source },
        )
    }
}

impl Segment {
    /// Finds the end of each cell's particles and where each particle comes from. `ends` and `source` begin with the
    /// segment's own.
    fn place(&self, unsorted: &Unsorted, ends: &mut [u32], source: &mut [u32]) {
        let (base, columns) = (self.places.start as u32, unsorted.columns);
        let (ends, source) = (&mut ends[..self.cells.len()], &mut source[..self.places.len()]);
        for strip in ends.chunks_mut(unsorted.stride) {
            strip[columns.clone()].fill(0);
        }
        self.for_each_own(unsorted, |cell, _| ends[cell] += 1);
        let mut sum = base;
        for strip in ends.chunks_mut(unsorted.stride) {
            // Where the first of the columns begins, the cell before it ends.
            if let Some(before) = columns.start.checked_sub(1) {
                strip[before] = sum;
            }
            for end in &mut strip[columns.clone()] {
                sum += std::mem::replace(end, sum);
            }
            if columns.end < strip.len() {
                strip[strip.len() - 1] = sum;
            }
        }
        debug_assert_eq!(sum as usize, self.places.end);
        // Handing out places moves each start on to the cell's end.
        self.for_each_own(unsorted, |cell, i| {
            let next = &mut ends[cell];
            source[(*next - base) as usize] = i;
            *next += 1;
        });
    }

    /// Calls `work` with the cell, counted from the segment's first, and the index of all of its particles.
    #[inline(always)]
    fn for_each_own(&self, unsorted: &Unsorted, mut work: impl FnMut(usize, u32)) {
        let own = self.cells.start as u32..self.cells.end as u32;
        for (index, (keys, &[lowest, highest])) in unsorted.keys.chunks(BLOCK).zip(unsorted.blocks).enumerate() {
            let first = (index * BLOCK) as u32;
            if own.start <= lowest && highest < own.end {
                (first..).zip(keys).for_each(|(i, key)| work((key - own.start) as usize, i));
            } else if lowest < own.end && own.start <= highest {
                for (i, key) in (first..).zip(keys).filter(|(_, key)| own.contains(key)) {
                    work((key - own.start) as usize, i);
                }
            }
        }
    }
}
