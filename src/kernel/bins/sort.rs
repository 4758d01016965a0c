//! The counting sort, in two parallel regions that only write to disjoint pieces of arrays.
//!
//! First every particle finds its cell. Then the cells are cut into segments of whole strips, and each segment counts,
//! places and fetches its own particles. It knows where they come from: particles have moved little since they were
//! sorted last, so most blocks of them belong to one segment as a whole, and the others are searched. Within a cell the
//! order stays, so that the result is the same however the work is cut.

use crate::{
    bins::cells::CellGrid,
    element::ElementId,
    parallel::{cut, piece},
    particles::{Particles, extent},
    simd::{InstructionSet, Lanes, Pass},
};
use std::{mem::swap, ops::Range};

/// Particles in a block.
const BLOCK: usize = 256;
/// Blocks of one and the same cell in a row that are a crowd: 1,024 particles where some two have room. A liquid of the
/// highest rest density, 100, has 450 of them there in the largest cells.
const CROWD: usize = 4;
/// Fewer blocks than this a piece do not pay for another thread when their cells are looked up.
const WORTH_A_LOOK: usize = 32;
/// Fewer particles than this do not pay for a segment of their own.
const WORTH_A_SEGMENT: usize = 2048;

/// The sort's own buffers: 9 bytes a particle and 4 a cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Sort {
    /// Strips that hold particles.
    pub strips: Range<usize>,
    /// Index of the first particle of each cell, for those strips and the one above and below them. In a strip that holds
    /// particles only those of the columns near particles count, and those at both of its ends.
    pub starts: Vec<u32>,
    /// Columns near particles.
    columns: Range<usize>,
    /// Cell of each particle in the order from before; then room for the sorted ids.
    keys: Vec<u32>,
    /// Lowest and highest cell in each block of particles.
    blocks: Vec<[u32; 2]>,
    /// For each place the particle's place before the sort.
    source: Vec<u32>,
    spare_elements: Vec<ElementId>,
    segments: Vec<Segment>,
}

/// Cells of whole strips, and the places of what they hold.
#[derive(Clone, Debug)]
struct Segment {
    cells: Range<usize>,
    places: Range<usize>,
}

/// The sorted positions of a strip, d, to be changed within their cells.
pub(crate) struct Strip<'a> {
    grid: &'a CellGrid,
    /// Ids in the order from before.
    ids: &'a [u32],
    source: &'a [u32],
    pub x: &'a mut [f32],
    pub y: &'a mut [f32],
}

impl Strip<'_> {
    /// The id of a particle of the strip.
    pub fn id(&self, i: usize) -> u32 {
        self.ids[self.source[i] as usize]
    }

    /// An offset, or its mirror image in either coordinate, that leaves a particle of the strip in its cell and in a place
    /// that is `free`; 0 in a coordinate in which there is none.
    pub fn turn_inwards(&self, i: usize, offset: glam::Vec2, free: impl Fn(glam::Vec2) -> bool) -> glam::Vec2 {
        let from = glam::Vec2::new(self.x[i], self.y[i]);
        let own = self.grid.cell(from.x, from.y);
        let stays = |to: glam::Vec2| self.grid.cell(to.x, to.y) == own && free(to);
        let turn = |offset: glam::Vec2| {
            let ways = [offset, -offset];
            ways.into_iter().find(|way| stays(from + way)).unwrap_or_default()
        };
        turn(glam::Vec2::new(offset.x, 0.0)) + turn(glam::Vec2::new(0.0, offset.y))
    }
}

impl Sort {
    /// Sorts all of the particles but their ids by cell. `spare` is room for x, y, vx and vy, and is left with what they
    /// held. `settle` may then change the positions of each strip within their cells.
    pub fn sort(
        &mut self,
        grid: &CellGrid,
        particles: &mut Particles,
        spare: [&mut Vec<f32>; 4],
        instructions: InstructionSet,
        threads: usize,
        settle: &(impl Fn(Strip) + Sync),
    ) {
        let Particles { x, y, vx, vy, id, element } = particles;
        let found = self.find_cells(grid, x, y, instructions, threads);
        self.cut_into_segments(grid, found, x.len(), threads);
        self.columns = grid.columns_near(extent(x));
        let Self { starts, columns, keys, blocks, source, spare_elements, segments, .. } = self;
        source.resize(x.len(), 0);
        spare_elements.resize(x.len(), ElementId(0));
        let mut values = [x, y, vx, vy];
        let mut sorted = spare;
        sorted.iter_mut().for_each(|sorted| sorted.resize(values[0].len(), 0.0));
        let unsorted = Unsorted {
            grid,
            columns,
            keys,
            blocks,
            values: values.each_ref().map(|values| &values[..]),
            ids: id,
            elements: element,
        };
        let outputs = Sorted {
            ends: &mut starts[1..],
            source,
            values: sorted.each_mut().map(|values| &mut values[..]),
            elements: spare_elements,
        };
        if let Some(first) = segments.first() {
            let (_, outputs) = outputs.split(first.cells.start, 0);
            fill_segments(segments, &unsorted, outputs, settle);
        }
        values.iter_mut().zip(&mut sorted).for_each(|(values, sorted)| swap(*values, *sorted));
        swap(element, spare_elements);
    }

    /// Finds the cell of every particle; returns the strips that hold any.
    fn find_cells(
        &mut self,
        grid: &CellGrid,
        x: &[f32],
        y: &[f32],
        instructions: InstructionSet,
        threads: usize,
    ) -> Range<usize> {
        self.keys.resize(x.len(), 0);
        self.blocks.resize(x.len().div_ceil(BLOCK), [0; 2]);
        let pieces = Pieces { keys: &mut self.keys, blocks: &mut self.blocks };
        pieces.spread(threads, &|first, Pieces { keys, blocks }| {
            let own = first * BLOCK..first * BLOCK + keys.len();
            instructions.run(FindCells { grid, x: &x[own.clone()], y: &y[own], keys, blocks });
        });
        let lowest = self.blocks.iter().map(|block| block[0]).min();
        let highest = self.blocks.iter().map(|block| block[1]).max();
        let strip = |cell: u32| cell as usize / grid.columns;
        lowest.zip(highest).map_or(1..1, |(lowest, highest)| strip(lowest)..strip(highest) + 1)
    }

    /// Cuts the cells of `found` strips into segments of about as many particles each as the last sort found there.
    fn cut_into_segments(&mut self, grid: &CellGrid, found: Range<usize>, count: usize, threads: usize) {
        let Self { strips, starts, keys, blocks, segments, .. } = self;
        if starts.len() != grid.cells() + 1 {
            starts.clear();
            starts.resize(grid.cells() + 1, 0);
            *strips = 1..1;
        }
        segments.clear();
        let most = piece(count, threads, WORTH_A_SEGMENT) as u32;
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

    /// Whether a crowd was found: so many particles of one cell that whole blocks of the order from before were. One that
    /// formed since then is found the next time, when it has been sorted together.
    pub fn is_crowded(&self) -> bool {
        let full = self.source.len() / BLOCK;
        let blocks = &self.blocks[..full.min(self.blocks.len())];
        blocks.windows(CROWD).any(|run| run.iter().flatten().all(|cell| *cell == run[0][0]))
    }

    /// The places of the particles of each cell that holds a crowd.
    pub fn crowds(&self, grid: &CellGrid) -> impl Iterator<Item = Range<usize>> {
        let cells = |strip: usize| strip * grid.columns + self.columns.start..=strip * grid.columns + self.columns.end;
        let ends = self.strips.clone().flat_map(move |strip| self.starts[cells(strip)].windows(2));
        let places = ends.map(|ends| ends[0] as usize..ends[1] as usize);
        places.filter(|places| places.len() >= CROWD * BLOCK)
    }

    /// The ids in their new order, to be written by pieces; the sort is over with [`Sort::keep_names`].
    pub fn names(&mut self) -> (&[u32], &mut [u32]) {
        (&self.source, &mut self.keys)
    }

    /// Takes the ids over that were written to [`Sort::names`].
    pub fn keep_names(&mut self, ids: &mut Vec<u32>) {
        swap(ids, &mut self.keys);
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        4 * (self.starts.capacity() + self.keys.capacity() + self.source.capacity())
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

/// Whole blocks of particles.
struct Pieces<'a> {
    keys: &'a mut [u32],
    blocks: &'a mut [[u32; 2]],
}

impl Pieces<'_> {
    /// Calls `work` with the index of the first block and some blocks.
    fn spread(self, threads: usize, work: &(impl Fn(usize, Pieces) + Sync)) {
        let most = piece(self.blocks.len(), threads, WORTH_A_LOOK);
        self.spread_from(0, most, work);
    }

    fn spread_from(self, first: usize, most: usize, work: &(impl Fn(usize, Pieces) + Sync)) {
        if self.blocks.len() <= most {
            return work(first, Pieces { keys: self.keys, blocks: self.blocks });
        }
        let half = self.blocks.len() / 2;
        let (left_keys, right_keys) = self.keys.split_at_mut(half * BLOCK);
        let (left_blocks, right_blocks) = self.blocks.split_at_mut(half);
        rayon::join(
            || Pieces { keys: left_keys, blocks: left_blocks }.spread_from(first, most, work),
            || Pieces { keys: right_keys, blocks: right_blocks }.spread_from(first + half, most, work),
        );
    }
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
    grid: &'a CellGrid,
    /// Columns near particles.
    columns: &'a Range<usize>,
    keys: &'a [u32],
    blocks: &'a [[u32; 2]],
    values: [&'a [f32]; 4],
    ids: &'a [u32],
    elements: &'a [ElementId],
}

/// What the sort fills, from some cell and place on.
struct Sorted<'a> {
    /// End of each cell's particles.
    ends: &'a mut [u32],
    source: &'a mut [u32],
    values: [&'a mut [f32]; 4],
    elements: &'a mut [ElementId],
}

impl<'a> Sorted<'a> {
    fn split(self, cells: usize, places: usize) -> (Self, Self) {
        let (left_ends, right_ends) = self.ends.split_at_mut(cells);
        let (left_source, right_source) = self.source.split_at_mut(places);
        let (left_values, right_values) = cut(self.values, places);
        let (left_elements, right_elements) = self.elements.split_at_mut(places);
        (
            Self { ends: left_ends, source: left_source, values: left_values, elements: left_elements },
            Self { ends: right_ends, source: right_source, values: right_values, elements: right_elements },
        )
    }
}

/// Fills segments; `sorted` begins with the first of them.
fn fill_segments(segments: &[Segment], unsorted: &Unsorted, sorted: Sorted, settle: &(impl Fn(Strip) + Sync)) {
    if let [segment] = segments {
        return segment.fill(unsorted, sorted, settle);
    }
    let (left, right) = segments.split_at(segments.len() / 2);
    let cells = right[0].cells.start - left[0].cells.start;
    let places = right[0].places.start - left[0].places.start;
    let (left_sorted, right_sorted) = sorted.split(cells, places);
    rayon::join(
        || fill_segments(left, unsorted, left_sorted, settle),
        || fill_segments(right, unsorted, right_sorted, settle),
    );
}

impl Segment {
    fn fill(&self, unsorted: &Unsorted, sorted: Sorted, settle: &(impl Fn(Strip) + Sync)) {
        let Sorted { ends, source, values, elements } = sorted;
        let (ends, len) = (&mut ends[..self.cells.len()], self.places.len());
        let source = &mut source[..len];
        self.place(unsorted, ends, source);
        let mut values = values.map(|values| &mut values[..len]);
        for (values, from) in values.iter_mut().zip(unsorted.values) {
            fetch(values, from, source);
        }
        fetch(&mut elements[..len], unsorted.elements, source);
        let [x, y, ..] = values;
        let mut first = 0;
        for strip_ends in ends.chunks(unsorted.grid.columns) {
            let end = strip_ends.last().map_or(first, |end| *end as usize - self.places.start);
            settle(Strip {
                grid: unsorted.grid,
                ids: unsorted.ids,
                source: &source[first..end],
                x: &mut x[first..end],
                y: &mut y[first..end],
            });
            first = end;
        }
    }

    /// Finds the end of each cell's particles and where each particle comes from.
    fn place(&self, unsorted: &Unsorted, ends: &mut [u32], source: &mut [u32]) {
        let (base, columns) = (self.places.start as u32, unsorted.columns);
        for strip in ends.chunks_mut(unsorted.grid.columns) {
            strip[columns.clone()].fill(0);
        }
        self.for_each_own(unsorted, |cell, _| ends[cell] += 1);
        let mut sum = base;
        for strip in ends.chunks_mut(unsorted.grid.columns) {
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

/// Sets each value to that of its source.
fn fetch<T: Copy>(values: &mut [T], from: &[T], source: &[u32]) {
    for (value, &source) in values.iter_mut().zip(source) {
        *value = from[source as usize];
    }
}

/// Writes the sorted ids from place `first` on.
pub(super) fn fetch_names(names: &mut [u32], ids: &[u32], source: &[u32]) {
    fetch(names, ids, source);
}
