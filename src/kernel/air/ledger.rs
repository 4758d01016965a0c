//! The mass of each room in each tile, kept from step to step (`balance`).

use super::{shape::Shape, tiling::Tiling};
use std::ops::Range;

/// Drift of a room's mass up to which it is left alone, as a part of it: 14 roundings. Changing this affects after how much
/// moving about air is touched, and how well its mass is kept.
pub(super) const MOST_DRIFT: f64 = 14.0 / (1_u32 << 24) as f64;

/// What a tile has of a room.
#[derive(Clone, Copy, Debug)]
struct Part {
    room: u32,
    mass: f64,
}

/// Mass of each room in each tile, cells at pressure 1. Follows from the state.
#[derive(Debug, Default)]
pub(super) struct Ledger {
    parts: Vec<Part>,
    /// Where the parts of each tile begin, and their end; empty if all is to be found anew.
    start: Vec<usize>,
    /// Cells of each room.
    cells: Vec<u32>,
    /// Tiles whose air has moved since their mass was summed.
    moved: Vec<bool>,
    /// Of each room: mass, and how much of it is in tiles that are stepped.
    rooms: Vec<[f64; 2]>,
}

/// What is in the rooms.
pub(super) struct Counted<'a> {
    /// Of each room: mass, and how much of it is in tiles that are stepped.
    pub(super) rooms: &'a mut [[f64; 2]],
    /// Cells of each room.
    pub(super) cells: &'a [u32],
}

impl Ledger {
    /// Forgets all: rock, rooms or masses have changed.
    pub(super) fn forget(&mut self) {
        self.start.clear();
    }

    /// Notes which tiles are stepped from now on.
    pub(super) fn note(&mut self, active: &[bool]) {
        self.moved.resize(active.len(), true);
        for (moved, active) in self.moved.iter_mut().zip(active) {
            *moved |= active;
        }
    }

    /// Brings the sums up to date with the pressures. Returns of each room its mass and how much of it is in `active` tiles.
    pub(super) fn count(&mut self, tiling: Tiling, shape: &Shape, pressure: &[f32], active: &[bool]) -> Counted<'_> {
        if self.start.is_empty() {
            self.find_parts(tiling, shape);
        }
        self.rooms.clear();
        self.rooms.resize(self.cells.len(), [0.0; 2]);
        for (tile, active) in active.iter().enumerate() {
            if std::mem::take(&mut self.moved[tile]) {
                self.sum(tiling, shape, pressure, tile);
            }
            for part in &self.parts[self.start[tile]..self.start[tile + 1]] {
                let [all, moving] = &mut self.rooms[part.room as usize];
                *all += part.mass;
                *moving += if *active { part.mass } else { 0.0 };
            }
        }
        Counted { rooms: &mut self.rooms, cells: &self.cells }
    }

    /// Bytes held.
    pub(super) fn memory_bytes(&self) -> usize {
        let parts = self.parts.capacity() * size_of::<Part>() + self.start.capacity() * size_of::<usize>();
        parts + self.cells.capacity() * 4 + self.moved.capacity() + self.rooms.capacity() * size_of::<[f64; 2]>()
    }

    fn parts_of(&self, tile: usize) -> Range<usize> {
        self.start[tile]..self.start[tile + 1]
    }

    /// Finds which rooms have a part of which tile.
    fn find_parts(&mut self, tiling: Tiling, shape: &Shape) {
        self.parts.clear();
        self.start.clear();
        self.cells.clear();
        self.cells.resize(shape.room_open.len(), 0);
        for tile in 0..tiling.count() {
            self.start.push(self.parts.len());
            let first = self.parts.len();
            let runs = tiling.cells_of(tile).flat_map(|cells| shape.room[cells].chunk_by(|a, b| a == b));
            for run in runs.filter(|run| run[0] != u32::MAX) {
                let room = run[0];
                self.cells[room as usize] += run.len() as u32;
                if !self.parts[first..].iter().any(|part| part.room == room) {
                    self.parts.push(Part { room, mass: 0.0 });
                }
            }
        }
        self.start.push(self.parts.len());
        self.moved.clear();
        self.moved.resize(tiling.count(), true);
    }

    /// Sums the mass of a tile.
    fn sum(&mut self, tiling: Tiling, shape: &Shape, pressure: &[f32], tile: usize) {
        let parts = self.parts_of(tile);
        let cells = tiling.cells_of(tile);
        match &mut self.parts[parts] {
            // All but rock, which has none.
            [part] => part.mass = cells.map(|cells| total(&pressure[cells])).sum(),
            parts => {
                parts.iter_mut().for_each(|part| part.mass = 0.0);
                for k in cells.flatten() {
                    if let Some(part) = parts.iter_mut().find(|part| part.room == shape.room[k]) {
                        part.mass += f64::from(pressure[k]);
                    }
                }
            }
        }
    }
}

/// Sum of some pressures. Eight running sums, so that the compiler uses lanes.
fn total(pressure: &[f32]) -> f64 {
    let mut lanes = [0.0_f64; 8];
    let (chunks, rest) = pressure.as_chunks::<8>();
    for chunk in chunks {
        for (lane, p) in lanes.iter_mut().zip(chunk) {
            *lane += f64::from(*p);
        }
    }
    lanes.into_iter().sum::<f64>() + rest.iter().map(|p| f64::from(*p)).sum::<f64>()
}
