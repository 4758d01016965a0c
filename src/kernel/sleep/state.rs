//! Which particles sleep, and where they are kept.

use super::{
    calm::{Calm, Tally},
    tiles::TileGrid,
};
use crate::particles::Particles;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// What of the sleep belongs to a world's state: without it, a world that is put back goes on otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SleepRecord {
    /// Particles at the front of the store that sleep.
    pub(crate) asleep: u32,
    /// What they fell asleep under (see [`Sleep::keep_under`]).
    pub(super) under: u64,
    /// How calm each tile has been; empty before the first look.
    pub(super) tiles: Vec<Calm>,
}

impl SleepRecord {
    /// Whether it fits a world of that many particles in a box of `size` d. The sleepers are the first of them, and still.
    pub fn fits(&self, particles: &Particles, size: Vec2) -> bool {
        let asleep = self.asleep as usize;
        let still = |velocity: &[f32]| velocity[..asleep].iter().all(|velocity| *velocity == 0.0);
        asleep <= particles.len()
            && still(&particles.vx)
            && still(&particles.vy)
            && (self.tiles.is_empty() || self.tiles.len() == TileGrid::new(size).len())
            && self.tiles.iter().all(|tile| tile.drift.iter().all(|drift| drift.is_finite()))
    }
}

/// A tile of a sleeping body.
pub(super) const ASLEEP: u8 = 1;
/// A tile of a sleeping body or beside one.
pub(super) const NEAR: u8 = 2;
/// A tile of a body that is about to wake, or to fall asleep.
pub(super) const CHANGES: u8 = 4;

/// Which particles sleep. Buffers are kept; where none sleeps, nothing in them counts.
#[derive(Clone, Debug, Default)]
pub struct Sleep {
    pub(super) record: SleepRecord,
    pub(super) grid: TileGrid,
    /// Flags of each tile.
    pub(super) flags: Vec<u8>,
    /// The tiles of sleeping bodies.
    pub(super) tiles: Vec<u32>,
    /// Highest rate of drag of the sleepers in each tile, 1/d; known only until other particles sleep.
    pub(super) drag: Vec<f32>,
    pub(super) is_drag_known: bool,
    pub(super) tally: Vec<Tally>,
    /// Tiles of the body at hand.
    pub(super) body: Vec<u32>,
    /// The sleepers as they fell asleep, to see whether anything touched them.
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    pub(super) id: Vec<u32>,
    /// Their densities, for the views and measures.
    pub(super) density: Vec<f32>,
    /// Buffer for the densities of the others.
    pub(super) others: Vec<f32>,
    /// During the substeps the whole store, the sleepers in front; else a buffer.
    pub(super) aside: Particles,
    pub(super) is_aside: bool,
    /// Buffer to change the order.
    pub(super) room: Particles,
    /// Version of the rock that they lie on.
    pub(super) rock: u64,
    /// Tiles in which something became another element.
    pub(super) disturbed: Vec<u32>,
}

impl Sleep {
    /// The sleep of a world that is put back: `record` with its `particles`, in a box of `size` d with rock of that version.
    pub fn resume(record: SleepRecord, particles: &Particles, size: Vec2, rock_version: u64) -> Self {
        let mut sleep = Self { record, rock: rock_version, ..Self::default() };
        sleep.record.asleep = sleep.record.asleep.min(particles.len() as u32);
        sleep.resize(size);
        sleep.remember(particles);
        sleep
    }

    /// What belongs to the world's state.
    pub fn record(&self) -> &SleepRecord {
        &self.record
    }

    /// Number of particles that sleep.
    pub fn asleep(&self) -> usize {
        self.record.asleep as usize
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.flags.capacity()
            + 4 * (self.tiles.capacity() + self.drag.capacity() + self.body.capacity())
            + size_of::<Tally>() * self.tally.capacity()
            + size_of::<Calm>() * self.record.tiles.capacity()
            + 4 * (self.x.capacity() + self.y.capacity() + self.id.capacity())
            + 4 * (self.density.capacity() + self.others.capacity())
            + 4 * self.disturbed.capacity()
            + self.aside.memory()
            + self.room.memory()
    }

    /// Fits the tiles to a box of `size` d.
    pub(super) fn resize(&mut self, size: Vec2) {
        let grid = TileGrid::new(size);
        if self.grid != grid || self.flags.len() != grid.len() {
            self.grid = grid;
            self.flags = vec![0; grid.len()];
            // A flood enters each tile once.
            self.body.reserve(grid.len());
        }
        if self.record.tiles.len() != grid.len() {
            self.record.tiles = vec![Calm::default(); grid.len()];
        }
    }

    /// Says under which conditions the world goes on, as a number that is another one under others: gravity, quality,
    /// effects. Where they differ from those before, all wake.
    pub fn keep_under(&mut self, conditions: u64) {
        if self.record.under != conditions {
            self.record.under = conditions;
            self.wake_all();
        }
    }

    /// Takes the sleepers aside, so that `particles` are those that are awake.
    pub fn set_aside(&mut self, particles: &mut Particles) {
        debug_assert!(!self.is_aside);
        if self.asleep() > 0 {
            self.is_aside = true;
            self.aside.clear();
            self.aside.append(particles, self.asleep()..particles.len());
            std::mem::swap(&mut self.aside, particles);
        }
    }

    /// Puts the sleepers back in front of those that are awake, and their densities in front of theirs.
    pub fn put_back(&mut self, particles: &mut Particles, density: &mut Vec<f32>) {
        if !std::mem::take(&mut self.is_aside) {
            return;
        }
        let is_known = density.len() == particles.len();
        self.aside.truncate(self.asleep());
        self.aside.append(particles, 0..particles.len());
        std::mem::swap(&mut self.aside, particles);
        if is_known {
            density.splice(0..0, self.density[..self.asleep()].iter().copied());
        }
    }

    /// Notes how the sleepers lie.
    pub(super) fn remember(&mut self, particles: &Particles) {
        let asleep = self.asleep();
        // Room for all at once, and not anew for each that falls asleep; none where none does.
        let all = if asleep > 0 { particles.len() } else { 0 };
        for (copy, from) in [(&mut self.x, &particles.x), (&mut self.y, &particles.y)] {
            copy.clear();
            copy.reserve(all);
            copy.extend_from_slice(&from[..asleep]);
        }
        self.id.clear();
        self.id.reserve(all);
        self.density.reserve(all.saturating_sub(self.density.len()));
        self.id.extend_from_slice(&particles.id[..asleep]);
        // Of sleepers that were restored, nothing is known but that they are at rest.
        self.density.resize(asleep, 1.0);
        self.mark();
    }

    /// Marks the tiles of the sleepers and those beside them.
    pub(super) fn mark(&mut self) {
        self.flags.fill(0);
        self.tiles.clear();
        self.is_drag_known = false;
        for (x, y) in self.x.iter().zip(&self.y) {
            let tile = self.grid.tile(*x, *y);
            if self.flags[tile] & ASLEEP == 0 {
                self.flags[tile] |= ASLEEP;
                self.tiles.push(tile as u32);
            }
        }
        for tile in &self.tiles {
            self.grid.around(*tile as usize).for_each(|near| self.flags[near] |= NEAR);
        }
    }
}
