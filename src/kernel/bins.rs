//! Binned neighbour search: strips as high as the search reaches, cut into thin columns.
//!
//! Particles are counting-sorted by cell (row by row), so that whatever may touch a run of consecutive particles lies in
//! three contiguous runs, one in each of three strips. Runs of consecutive particles are the groups that the passes work
//! on side by side. Rock is binned into the same cells, once for every change of the rock.
//!
//! The search reaches further than the kernel by a margin: particles move on while the solver iterates, and each may move
//! by the correction limit. So no pair is missed, and since pairs beyond the kernel add exact zeros, neither the width of
//! a group nor the search itself shows in the result.

#[cfg(test)]
mod tests;

use crate::kernel::{
    parallel::spread,
    simd::{InstructionSet, Lanes, Pass, whole_below},
    solids::{Solids, centre},
};
use glam::Vec2;
use std::{
    ops::Range,
    sync::atomic::{AtomicU32, Ordering},
};

/// Columns in a strip's height: thin columns keep candidate runs short.
const COLUMNS_PER_RADIUS: f32 = 4.0;
/// Rounding allowance of the search margin, d.
const MARGIN_ROUNDING: f32 = 1e-3;
/// A group ends where its particles would spread wider than this many radii: in thin spray a wide group would draw in
/// everything that lies between.
const GROUP_SPAN_RADII: f32 = 8.0;
/// Fewer particles than this a piece do not pay for another thread when their cells are looked up.
const WORTH_A_LOOK: usize = 16_384;

/// How neighbours are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Neighbours {
    /// By bins.
    #[default]
    Binned,
    /// Every particle with every other, O(n²): the reference for tests and for the binning table.
    Brute,
}

/// A run of consecutive particles with the runs of candidates that may touch any of them. 60 bytes.
#[derive(Clone, Debug, Default)]
pub struct Group {
    /// First particle.
    pub first: u32,
    /// Number of particles, at most the lane width.
    pub len: u32,
    /// Whether the kernel of any of them may reach a wall of the box.
    pub near_wall: bool,
    /// Movable candidates, one run a strip.
    pub movable: [Run; 3],
    /// Rock candidates, one run a strip.
    pub rock: [Run; 3],
}

/// A run of consecutive entries.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run {
    first: u32,
    end: u32,
}

impl Run {
    fn new(first: u32, end: u32) -> Self {
        Self { first, end }
    }

    /// As a range of indices.
    #[inline(always)]
    pub fn range(self) -> Range<usize> {
        self.first as usize..self.end as usize
    }
}

impl Group {
    /// The particles.
    #[inline(always)]
    pub fn particles(&self) -> Range<usize> {
        self.first as usize..(self.first + self.len) as usize
    }
}

/// The cells, what is in them, and the groups. Buffers are kept from substep to substep.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    grid: CellGrid,
    /// Strips that hold particles.
    strips: Range<usize>,
    /// Index of the first particle of each cell, for those strips and the one above and below them.
    starts: Vec<u32>,
    keys: Vec<u32>,
    /// For each particle its place after the sort.
    pub(crate) places: Vec<u32>,
    groups: Vec<Group>,
    rock: RockBins,
}

/// Rock particles sorted by cell.
#[derive(Clone, Debug, Default)]
pub struct RockBins {
    built_for: Option<(CellGrid, u64)>,
    /// Position, d.
    pub x: Vec<f32>,
    /// Position, d.
    pub y: Vec<f32>,
    starts: Vec<u32>,
}

/// Geometry of the cells: one empty strip below and one above the box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct CellGrid {
    size: Vec2,
    columns: usize,
    rows: usize,
    reach: f32,
    per_column: f32,
    per_row: f32,
}

impl CellGrid {
    fn new(size: Vec2, reach: f32) -> Self {
        let column = reach / COLUMNS_PER_RADIUS;
        Self {
            size,
            columns: (size.x / column) as usize + 1,
            rows: (size.y / reach) as usize + 3,
            reach,
            per_column: 1.0 / column,
            per_row: 1.0 / reach,
        }
    }

    fn cells(&self) -> usize {
        self.columns * self.rows
    }

    #[inline(always)]
    fn column(&self, x: f32) -> u32 {
        whole_below(x * self.per_column, 0, self.columns as u32 - 1).0
    }

    #[inline(always)]
    fn cell(&self, x: f32, y: f32) -> u32 {
        let row = whole_below(y * self.per_row + 1.0, 1, self.rows as u32 - 2).0;
        row * self.columns as u32 + self.column(x)
    }

    /// Columns that hold everything within reach of `low … high`. The column never falls where x rises, and the reach
    /// has an allowance for the rounding of the sums here.
    #[inline(always)]
    fn columns_around(&self, low: f32, high: f32) -> Range<usize> {
        self.column(low - self.reach) as usize..self.column(high + self.reach) as usize + 1
    }
}

impl Bins {
    /// Lays the cells over a box of `size` d for a kernel of radius `radius` d whose particles may each move by
    /// `correction_limit` d while they are binned, and bins the rock if it or the cells changed.
    pub fn lay(&mut self, size: Vec2, radius: f32, correction_limit: f32, solids: &Solids) {
        self.grid = CellGrid::new(size, radius + 2.0 * correction_limit + MARGIN_ROUNDING);
        if self.rock.built_for != Some((self.grid, solids.version())) {
            self.rock.build(&self.grid, solids);
        }
    }

    /// Bins the rock anew next time, whatever its version: another world's rock may have the same.
    pub fn forget_rock(&mut self) {
        self.rock.built_for = None;
    }

    /// Counts the particles into cells and notes in `places` where each goes; the caller moves its arrays there.
    /// Within a cell the order stays.
    pub fn sort(&mut self, x: &[f32], y: &[f32], instructions: InstructionSet, threads: usize) {
        debug_assert_eq!(x.len(), y.len());
        let Self { grid, strips, starts, keys, places, .. } = self;
        keys.resize(x.len(), 0);
        let (lowest, highest) = (AtomicU32::new(u32::MAX), AtomicU32::new(0));
        spread([&mut keys[..]], WORTH_A_LOOK, threads, &|base, [keys]| {
            let [x, y] = [x, y].map(|from| &from[base..base + keys.len()]);
            instructions.run(FindCells { grid, x, y, keys, lowest: &lowest, highest: &highest });
        });
        let strip_of = |key: u32| key as usize / grid.columns;
        *strips = if x.is_empty() { 1..1 } else { strip_of(lowest.into_inner())..strip_of(highest.into_inner()) + 1 };
        // Cells of the strips around those that hold particles are there, and empty.
        let first = (strips.start - 1) * grid.columns;
        starts.resize(grid.cells() + 1, 0);
        let starts = &mut starts[first..(strips.end + 1) * grid.columns + 1];
        starts.fill(0);
        count_into_places(keys, first as u32, starts, places);
    }

    /// Builds the groups over the sorted particles, of at most `width` particles each.
    pub fn group(&mut self, x: &[f32], width: usize, neighbours: Neighbours) {
        self.groups.clear();
        if neighbours == Neighbours::Brute {
            return self.group_with_all(x.len(), width);
        }
        let (grid, starts, rock) = (&self.grid, &self.starts, &self.rock.starts);
        let span = GROUP_SPAN_RADII * grid.reach;
        for row in self.strips.clone() {
            let row_start = row * grid.columns;
            // The strip reaches from `bottom` to one reach above it.
            let bottom = (row - 1) as f32 * grid.reach;
            let near_floor_or_top = bottom < grid.reach || bottom + 2.0 * grid.reach > grid.size.y;
            let (mut first, end) = (starts[row_start] as usize, starts[row_start + grid.columns] as usize);
            while first < end {
                let mut next = end.min(first + width);
                let (mut low, mut high) = extent(&x[first..next]);
                if high - low > span {
                    (next, low, high) = shorter(x, first..next, span);
                }
                let columns = grid.columns_around(low, high);
                let runs = |starts: &[u32]| {
                    [row - 1, row, row + 1].map(|strip| {
                        let start = strip * grid.columns;
                        Run::new(starts[start + columns.start], starts[start + columns.end])
                    })
                };
                self.groups.push(Group {
                    first: first as u32,
                    len: (next - first) as u32,
                    near_wall: near_floor_or_top || low < grid.reach || high > grid.size.x - grid.reach,
                    movable: runs(starts),
                    rock: if rock.is_empty() { Default::default() } else { runs(rock) },
                });
                first = next;
            }
        }
    }

    fn group_with_all(&mut self, particles: usize, width: usize) {
        let all = |len: usize| [Run::new(0, len as u32), Run::default(), Run::default()];
        for first in (0..particles).step_by(width) {
            self.groups.push(Group {
                first: first as u32,
                len: width.min(particles - first) as u32,
                near_wall: true,
                movable: all(particles),
                rock: all(self.rock.x.len()),
            });
        }
    }

    /// The groups, in the order of their particles; together they hold each particle once.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The binned rock.
    pub fn rock(&self) -> &RockBins {
        &self.rock
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        4 * (self.starts.capacity()
            + self.keys.capacity()
            + self.places.capacity()
            + self.rock.x.capacity()
            + self.rock.y.capacity()
            + self.rock.starts.capacity())
            + size_of::<Group>() * self.groups.capacity()
    }
}

impl RockBins {
    fn build(&mut self, grid: &CellGrid, solids: &Solids) {
        self.built_for = Some((*grid, solids.version()));
        self.starts.clear();
        self.x.clear();
        self.y.clear();
        if solids.count() == 0 {
            return;
        }
        let positions: Vec<Vec2> = solids.iter().map(|(cell, ..)| centre(cell)).collect();
        let keys: Vec<u32> = positions.iter().map(|p| grid.cell(p.x, p.y)).collect();
        self.starts.resize(grid.cells() + 1, 0);
        let mut places = Vec::new();
        count_into_places(&keys, 0, &mut self.starts, &mut places);
        self.x.resize(positions.len(), 0.0);
        self.y.resize(positions.len(), 0.0);
        for (position, place) in positions.iter().zip(places) {
            (self.x[place as usize], self.y[place as usize]) = (position.x, position.y);
        }
    }
}

/// Lowest and highest of at least one value.
fn extent(values: &[f32]) -> (f32, f32) {
    /// Values that are compared side by side.
    const LANES: usize = 8;
    let (mut low, mut high) = ([values[0]; LANES], [values[0]; LANES]);
    for values in values.chunks(LANES) {
        for ((low, high), &value) in low.iter_mut().zip(&mut high).zip(values) {
            *low = if value < *low { value } else { *low };
            *high = if value > *high { value } else { *high };
        }
    }
    (low.into_iter().fold(values[0], f32::min), high.into_iter().fold(values[0], f32::max))
}

/// Cuts a range where its values would spread wider than `span`: its end, lowest and highest.
fn shorter(x: &[f32], range: Range<usize>, span: f32) -> (usize, f32, f32) {
    let (mut low, mut high) = (x[range.start], x[range.start]);
    for next in range.clone() {
        let (wider_low, wider_high) = (low.min(x[next]), high.max(x[next]));
        if wider_high - wider_low > span {
            return (next, low, high);
        }
        (low, high) = (wider_low, wider_high);
    }
    (range.end, low, high)
}

/// Finds the cells of a piece of the particles.
struct FindCells<'a> {
    grid: &'a CellGrid,
    x: &'a [f32],
    y: &'a [f32],
    /// Out: cells.
    keys: &'a mut [u32],
    /// Lowest and highest cell of all pieces.
    lowest: &'a AtomicU32,
    highest: &'a AtomicU32,
}

impl Pass for FindCells<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (mut lowest, mut highest) = (u32::MAX, 0);
        for ((key, &x), &y) in self.keys.iter_mut().zip(self.x).zip(self.y) {
            *key = self.grid.cell(x, y);
            (lowest, highest) = (lowest.min(*key), highest.max(*key));
        }
        self.lowest.fetch_min(lowest, Ordering::Relaxed);
        self.highest.fetch_max(highest, Ordering::Relaxed);
    }
}

/// Counting sort: `starts` (zeros, one longer than the number of cells from `first_cell` on) becomes the first place of
/// each cell, `places` the place of each entry.
fn count_into_places(keys: &[u32], first_cell: u32, starts: &mut [u32], places: &mut Vec<u32>) {
    // Counts stand two cells ahead, so that after the running sum `starts[k + 1]` is the first place of cell k, and
    // handing out places moves it on to the first place of cell k + 1: the table ends up in place without a shift.
    let cells = starts.len() - 1;
    let mut last = 0;
    for &key in keys {
        match starts.get_mut((key - first_cell) as usize + 2) {
            Some(count) => *count += 1,
            None => last += 1,
        }
    }
    let mut sum = 0;
    for start in &mut *starts {
        sum += *start;
        *start = sum;
    }
    debug_assert_eq!(sum as usize + last, keys.len());
    places.clear();
    places.extend(keys.iter().map(|&key| {
        let start = &mut starts[(key - first_cell) as usize + 1];
        *start += 1;
        *start - 1
    }));
    debug_assert_eq!(starts[cells] as usize, keys.len());
}

/// Moves `values[i]` to `places[i]`, by way of `spare`.
pub(crate) fn permute<T: Copy + Default>(values: &mut Vec<T>, places: &[u32], spare: &mut Vec<T>) {
    spare.resize(values.len(), T::default());
    for (&value, &place) in values.iter().zip(places) {
        spare[place as usize] = value;
    }
    std::mem::swap(values, spare);
}
