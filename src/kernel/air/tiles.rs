//! Tiles: the air sleeps by parts.
//!
//! A tile is **awake** when a speed in it, or the difference of a pressure to that at which its room comes to rest, is
//! above [`QUIET_MACH`] of the speed of sound or of that pressure; when it is warmer or colder than the surroundings by more
//! than [`QUIET_WARMTH`] of their temperature; when a wind blows in it; or when something has just
//! touched it. The awake tiles and those around them, sideways and across corners, are **active**: they are stepped. All
//! others sleep: their air stands still at the pressures that it had, so that no mass comes or goes.
//!
//! Faces between active and sleeping tiles are closed (`Shape::fence`): a wave fainter than the bound is thrown back. One
//! that is not wakes the tile around an awake one on its way through it, before it gets to the far side: tiles are looked
//! after at least every `WATCH` substeps, and a substep reaches two cells.
//!
//! Which tiles are awake is part of the state. What is active follows from it.

use super::{
    grid::{Air, Scratch},
    pressure::peak,
    rooms::{QUIET_MACH, Room, count_rooms},
    shape::Shape,
    tiling::{Watch, cover},
    warmth::QUIET_WARMTH,
};
use crate::sources::Wind;
use std::ops::Range;

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

    /// Decides which tiles are awake and brings what follows from that up to date. Returns whether another set of tiles than
    /// before is active.
    pub(super) fn update_tiles(&mut self, winds: &[Wind], shape: &mut Shape, scratch: &mut Scratch) -> bool {
        let Scratch { watch, rooms, ledger, next_pressure, next_x, next_y, next_warmth, .. } = scratch;
        let tiling = self.tiling();
        let known = self.know_rests(shape, rooms);
        if !known {
            ledger.forget();
        }
        if !self.scratch.sleeps {
            self.awake.fill(true);
        } else {
            self.find_rest(shape, watch, known);
            for tile in (0..tiling.count()).filter(|tile| watch.looked_at[*tile]) {
                self.awake[tile] = self.is_stirred(tile, &watch.rest);
            }
            self.wake_winds(winds);
        }
        let Watch { active, blocks, looked_at, next_active, .. } = watch;
        tiling.widen(&self.awake, next_active);
        let fresh = active.len() != next_active.len();
        if self.scratch.sleeps {
            // What a tile was before is not known to a grid that was just copied: it was one of these.
            let left = |tile: &usize| !next_active[*tile] && (fresh || looked_at[*tile] || active[*tile]);
            for tile in (0..tiling.count()).filter(left) {
                self.still(tile);
                for cells in tiling.cells_of(tile) {
                    next_pressure[cells.clone()].copy_from_slice(&self.pressure[cells.clone()]);
                    next_x[cells.clone()].fill(0.0);
                    next_y[cells.clone()].fill(0.0);
                    if let Some(warmth) = next_warmth.get_mut(cells) {
                        warmth.fill(0.0);
                    }
                }
            }
        }
        ledger.note(next_active);
        if !fresh && active == next_active {
            return false;
        }
        std::mem::swap(active, next_active);
        cover(tiling, active, blocks);
        shape.fence(tiling, &self.solid, active);
        true
    }

    /// Makes sure that the pressures of rest are known. Returns whether they were.
    pub(super) fn know_rests(&mut self, shape: &Shape, rooms: &mut Vec<Room>) -> bool {
        let known = self.rests.len() == shape.room_open.len() && !self.rests.is_empty();
        if !known {
            count_rooms(shape, &self.pressure, rooms);
            self.rests.clear();
            self.rests.extend(rooms.iter().map(Room::rest));
        }
        known
    }

    /// Marks the tiles that must be looked at: those that may move, or all if the rest was not `known`.
    fn find_rest(&mut self, shape: &Shape, watch: &mut Watch, known: bool) {
        self.tiling().widen(&self.awake, &mut watch.looked_at);
        if !known {
            watch.looked_at.fill(true);
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
        let stirs = |cells: Range<usize>| {
            let speeds = [&self.velocity_x, &self.velocity_y].map(|field| peak(&field[cells.clone()]));
            let warmth = self.warmth.get(cells.clone()).map_or(0.0, peak);
            speeds[0].max(speeds[1]) > bound
                || warmth > QUIET_WARMTH
                || is_uneven(&self.pressure[cells.clone()], &rest[cells])
        };
        self.tiling().cells_of(tile).any(stirs)
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
        for cells in self.tiling().cells_of(tile) {
            self.velocity_x[cells.clone()].fill(0.0);
            self.velocity_y[cells.clone()].fill(0.0);
            if let Some(warmth) = self.warmth.get_mut(cells) {
                warmth.fill(0.0);
            }
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
