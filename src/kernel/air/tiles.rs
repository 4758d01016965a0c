//! Tiles: the air sleeps by parts.
//!
//! A tile is **awake** when a speed in it, or the difference of a pressure to that at which its room comes to rest, is
//! above [`QUIET_MACH`] of the speed of sound or of that pressure; when a fan blows in it; or when something has just
//! touched it. The awake tiles and those around them, sideways and across corners, are **active**: they are stepped. All
//! others sleep: their air stands still at the pressures that it had, so that no mass comes or goes.
//!
//! Faces between active and sleeping tiles are closed (`Shape::fence`): a wave fainter than the bound is thrown back. One
//! that is not wakes the tile around an awake one on its way through it, before it gets to the far side: tiles are looked
//! after at least every [`WATCH`] substeps, and a substep reaches two cells.
//!
//! Which tiles are awake is part of the state. What is active follows from it.

use super::grid::{Air, Scratch};
use super::pressure::peak;
use super::shape::Shape;
use super::step::{QUIET_MACH, Room};
use crate::sources::Wind;
use std::ops::Range;

/// Cells of a tile along x: lanes want long rows. Changing this affects which cells sleep together.
pub(super) const TILE_COLUMNS: usize = 32;

/// Cells of a tile along y. Changing this affects which cells sleep together.
pub(super) const TILE_ROWS: usize = 16;

/// Most substeps from one look after the tiles to the next.
pub(super) const WATCH: u32 = TILE_ROWS as u32 / 2;

/// How a grid is cut into tiles, row by row. The last ones of a row and of a column take what is left over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiling {
    cells: [usize; 2],
    tiles: [usize; 2],
}

fn span(tile: usize, tiles: usize, size: usize, cells: usize) -> Range<usize> {
    tile * size..if tile + 1 == tiles { cells } else { (tile + 1) * size }
}

impl Tiling {
    pub(super) fn new(columns: usize, rows: usize) -> Self {
        Self { cells: [columns, rows], tiles: [(columns / TILE_COLUMNS).max(1), (rows / TILE_ROWS).max(1)] }
    }

    /// Number of tiles.
    pub(super) fn count(self) -> usize {
        self.tiles[0] * self.tiles[1]
    }

    /// Tiles along x and y.
    pub(super) fn size(self) -> [usize; 2] {
        self.tiles
    }

    /// The tile of a cell.
    pub(super) fn of(self, column: usize, row: usize) -> usize {
        let across = (column / TILE_COLUMNS).min(self.tiles[0] - 1);
        (row / TILE_ROWS).min(self.tiles[1] - 1) * self.tiles[0] + across
    }

    /// Columns of a tile.
    pub(super) fn columns(self, tile: usize) -> Range<usize> {
        span(tile % self.tiles[0], self.tiles[0], TILE_COLUMNS, self.cells[0])
    }

    /// Rows of a tile.
    pub(super) fn rows(self, tile: usize) -> Range<usize> {
        span(tile / self.tiles[0], self.tiles[1], TILE_ROWS, self.cells[1])
    }

    /// The tiles with those around them.
    fn widen(self, tiles: &[bool], wider: &mut Vec<bool>) {
        let [width, height] = self.tiles;
        wider.clear();
        wider.resize(self.count(), false);
        for tile in (0..self.count()).filter(|tile| tiles[*tile]) {
            let (i, j) = (tile % width, tile / width);
            for row in j.saturating_sub(1)..(j + 2).min(height) {
                wider[row * width + i.saturating_sub(1)..row * width + (i + 2).min(width)].fill(true);
            }
        }
    }
}

/// Cells that are stepped together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Block {
    pub(super) rows: Range<usize>,
    pub(super) columns: Range<usize>,
}

/// Covers the active tiles with blocks: runs of tiles along x, as high as the same run goes on.
fn cover(tiling: Tiling, active: &[bool], blocks: &mut Vec<Block>) {
    blocks.clear();
    let width = tiling.size()[0];
    let mut above = 0;
    for (row, tiles) in active.chunks(width).enumerate() {
        let (before, first) = (above..blocks.len(), row * width);
        let rows = tiling.rows(first);
        let mut next = 0;
        while let Some(skipped) = tiles[next..].iter().position(|active| *active) {
            let start = next + skipped;
            let end = tiles[start..].iter().position(|active| !*active).map_or(width, |length| start + length);
            let columns = tiling.columns(first + start).start..tiling.columns(first + end - 1).end;
            blocks.push(Block { rows: rows.clone(), columns });
            next = end;
        }
        above = before.end;
        let same = before.len() == blocks.len() - before.end
            && before.clone().zip(before.end..).all(|(old, new)| blocks[old].columns == blocks[new].columns);
        if same {
            blocks.truncate(before.end);
            for block in &mut blocks[before.clone()] {
                block.rows.end = rows.end;
            }
            above = before.start;
        }
    }
}

/// What follows from the tiles that are awake. Kept from look to look.
#[derive(Debug, Default)]
pub(super) struct Watch {
    /// The tiles that are stepped.
    pub(super) active: Vec<bool>,
    /// The same as cells.
    pub(super) blocks: Vec<Block>,
    /// Pressure at which each cell comes to rest, with the ring; 0 in rock and in the ring.
    rest: Vec<f32>,
    /// Tiles that are looked at.
    looked_at: Vec<bool>,
    next_active: Vec<bool>,
}

impl Watch {
    /// Forgets what followed from the rock.
    pub(super) fn forget(&mut self) {
        self.active.clear();
        self.rest.clear();
    }

    /// Cells that are stepped.
    pub(super) fn cells(&self) -> usize {
        self.blocks.iter().map(|block| block.rows.len() * block.columns.len()).sum()
    }

    /// Bytes held.
    pub(super) fn memory_bytes(&self) -> usize {
        self.rest.len() * 4 + self.active.len() * 3 + self.blocks.capacity() * size_of::<Block>()
    }
}

impl Air {
    /// Whether tiles may sleep. If not, all of the grid is stepped until all of it is at rest. `false` at first; not part
    /// of the state.
    pub fn allow_sleep(&mut self, sleeps: bool) {
        self.scratch.sleeps = sleeps;
    }

    /// Tiles that are awake, and all.
    pub fn awake_tiles(&self) -> (usize, usize) {
        (self.awake.iter().filter(|awake| **awake).count(), self.awake.len())
    }

    /// Tiles that the last step left alone, and all; neither if there is no grid.
    pub fn sleeping_tiles(&self) -> (usize, usize) {
        // A copy has not looked yet.
        let active = &self.scratch.watch.active;
        let stepped = if active.len() == self.awake.len() { active } else { &self.awake };
        (stepped.iter().filter(|stepped| !**stepped).count(), self.awake.len())
    }

    pub(super) fn tiling(&self) -> Tiling {
        Tiling::new(self.columns(), self.rows())
    }

    /// The tiles that the next step will do, as things stand.
    pub(super) fn find_active(&self, active: &mut Vec<bool>) {
        self.tiling().widen(&self.awake, active);
        if !self.quiet && !self.scratch.sleeps {
            active.fill(true);
        }
    }

    pub(super) fn wake(&mut self, tile: usize) {
        self.awake[tile] = true;
        self.quiet = false;
    }

    /// Something has changed a cell (an index of the fields).
    pub(super) fn touch(&mut self, k: usize) {
        let (column, row) = (k % self.stride() - 1, k / self.stride() - 1);
        self.wake(self.tiling().of(column, row));
    }

    pub(super) fn wake_all(&mut self) {
        self.awake.fill(true);
        self.quiet = false;
    }

    /// Looks after the tiles: decides which are awake and brings what follows from that up to date. Returns whether
    /// another set of tiles than before is active.
    pub(super) fn tend(&mut self, winds: &[Wind], shape: &mut Shape, scratch: &mut Scratch) -> bool {
        let Scratch { watch, rooms, next_pressure, next_x, next_y, .. } = scratch;
        let tiling = self.tiling();
        if !self.scratch.sleeps {
            self.awake.fill(true);
        } else {
            self.find_rest(shape, watch, rooms);
            for tile in (0..tiling.count()).filter(|tile| watch.looked_at[*tile]) {
                self.awake[tile] = self.is_stirred(tile, &watch.rest);
            }
            self.wake_fans(winds);
        }
        let Watch { active, blocks, looked_at, next_active, .. } = watch;
        tiling.widen(&self.awake, next_active);
        let fresh = active.len() != next_active.len();
        if self.scratch.sleeps {
            // What a tile was before is not known to a grid that was just copied: it was one of these.
            let left = |tile: &usize| !next_active[*tile] && (fresh || looked_at[*tile] || active[*tile]);
            for tile in (0..tiling.count()).filter(left) {
                self.still(tile);
                let columns = tiling.columns(tile);
                for row in tiling.rows(tile) {
                    let cells = self.index(columns.start, row)..self.index(columns.start, row) + columns.len();
                    next_pressure[cells.clone()].copy_from_slice(&self.pressure[cells.clone()]);
                    next_x[cells.clone()].fill(0.0);
                    next_y[cells].fill(0.0);
                }
            }
        }
        if !fresh && active == next_active {
            return false;
        }
        std::mem::swap(active, next_active);
        cover(tiling, active, blocks);
        shape.fence(self, active);
        true
    }

    /// Makes sure that the pressures of rest are known, and marks the tiles that must be looked at: those that may move,
    /// or all if the rest has changed.
    fn find_rest(&mut self, shape: &Shape, watch: &mut Watch, rooms: &mut Vec<Room>) {
        self.tiling().widen(&self.awake, &mut watch.looked_at);
        let known = self.rests.len() == shape.room_open.len() && !self.rests.is_empty();
        if !known {
            watch.looked_at.fill(true);
            self.count_rooms(shape, rooms);
            self.rests.clear();
            self.rests.extend(rooms.iter().map(Room::rest));
        }
        if !known || watch.rest.len() != self.pressure.len() {
            let rests = &self.rests;
            watch.rest.clear();
            watch.rest.extend(shape.room.iter().map(|room| rests.get(*room as usize).copied().unwrap_or(0.0)));
        }
    }

    /// Whether anything in a tile is above the bound.
    fn is_stirred(&self, tile: usize, rest: &[f32]) -> bool {
        let bound = QUIET_MACH * self.params.sound_speed;
        let (tiling, stride) = (self.tiling(), self.stride());
        let columns = tiling.columns(tile);
        let stirs = |row: usize| {
            let cells = (row + 1) * stride + columns.start + 1..(row + 1) * stride + columns.end + 1;
            let speeds = [&self.velocity_x, &self.velocity_y].map(|field| peak(&field[cells.clone()]));
            speeds[0].max(speeds[1]) > bound || is_uneven(&self.pressure[cells.clone()], &rest[cells])
        };
        tiling.rows(tile).any(stirs)
            || self.slots_beside(tile).into_iter().any(|slots| peak(&self.outside[slots]) > bound)
    }

    /// Places in `outside` of the open air beside a tile.
    fn slots_beside(&self, tile: usize) -> [Range<usize>; 4] {
        let (tiling, open) = (self.tiling(), self.params.open);
        let (columns, rows) = (tiling.columns(tile), tiling.rows(tile));
        let below_columns = 2 * self.rows();
        let slots = |first: usize, range: &Range<usize>, there: bool| {
            if there { first + range.start..first + range.end } else { 0..0 }
        };
        [
            slots(0, &rows, open.left && columns.start == 0),
            slots(self.rows(), &rows, open.right && columns.end == self.columns()),
            slots(below_columns, &columns, open.bottom && rows.start == 0),
            slots(below_columns + self.columns(), &columns, open.top && rows.end == self.rows()),
        ]
    }

    /// Stops the wind in a tile.
    fn still(&mut self, tile: usize) {
        let (tiling, stride) = (self.tiling(), self.stride());
        let columns = tiling.columns(tile);
        for row in tiling.rows(tile) {
            let cells = (row + 1) * stride + columns.start + 1..(row + 1) * stride + columns.end + 1;
            self.velocity_x[cells.clone()].fill(0.0);
            self.velocity_y[cells].fill(0.0);
        }
        for slots in self.slots_beside(tile) {
            self.outside[slots].fill(0.0);
        }
    }
}

/// Whether a pressure is further from that of rest than the bound lets it. Sixteen running maxima, so that the compiler
/// uses lanes.
fn is_uneven(pressure: &[f32], rest: &[f32]) -> bool {
    let excess = |p: f32, rest: f32| (p - rest).abs() - QUIET_MACH * rest;
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let mut lanes = [0.0_f32; 16];
    let (chunks, last) = pressure.as_chunks::<16>();
    let (rests, last_rest) = rest.as_chunks::<16>();
    for (chunk, rest) in chunks.iter().zip(rests) {
        for ((lane, p), rest) in lanes.iter_mut().zip(chunk).zip(rest) {
            *lane = larger(excess(*p, *rest), *lane);
        }
    }
    lanes.into_iter().any(|lane| lane > 0.0) || last.iter().zip(last_rest).any(|(p, rest)| excess(*p, *rest) > 0.0)
}
