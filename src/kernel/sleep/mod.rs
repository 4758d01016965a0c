//! Water at rest sleeps: it keeps its place and costs nothing until something touches it.
//!
//! The unit is the **body**: all the particles in tiles that touch each other. A body falls asleep when every tile of it
//! has been calm for a second; it wakes as a whole before anything acts on it. A body is surrounded by a ring of empty
//! tiles, wider than any force between particles reaches: so the particles that are awake are simulated as if those that
//! sleep were not there, and lose nothing by it. As long as nothing comes, the only difference to a world without sleep is
//! that what little moved stands still. That difference is what [`JITTER`] and [`DRIFT`] bound.
//!
//! Why not parts of a body: pressure reaches through the whole of it at once. Were the still end of two communicating
//! vessels to sleep while the other is filled, their levels would part.
//!
//! Where the sleepers are: at the front of the particle store, in the order in which they fell asleep. For the substeps they
//! are taken aside ([`Sleep::set_aside`], [`Sleep::put_back`]), so that no pass sees them.
//!
//! What wakes: an awake particle in a tile of the body or beside it ([`Sleep::wake_touched`], looked at before the first
//! substep and in each after the prediction, before the solver looks for neighbours), wind ([`Sleep::wake_blown`]), any
//! change of the sleepers themselves, as by a brush or an outlet ([`Sleep::check`]), and for all of them a change of the
//! rock, of gravity, of the quality or of the effects ([`Sleep::keep_under`]).

#[cfg(test)]
mod tests;
mod tiles;

use crate::kernel::{air::Air, particles::Particles, units::TICK_SECONDS};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use tiles::TileGrid;

/// Ticks from one look at what is awake to the next. Raising it makes looking cheaper and sleep come later.
pub const LOOK_TICKS: u64 = 8;
/// Looks in a row at which all of a body must be found calm: a second.
const LOOKS: u8 = 8;
/// Weight of the last look in a tile's drift, so that it is a mean over about as many ticks as [`LOOKS`] takes.
const LAST_LOOK: f32 = 1.0 / LOOKS as f32;
/// Root mean square speed up to which the particles of a tile are calm, d a tick. In a pool at rest the solver leaves
/// 0.005 to 0.02, and in a tile that holds a few particles of its surface up to 0.05. Raising it lets water sleep that
/// visibly moves.
pub const JITTER: f32 = 0.06;
/// Mean speed of a tile over a second up to which it is calm, d a tick. It bounds the slow motion that sleep stops: waves,
/// eddies, a level that still sinks.
pub const DRIFT: f32 = 0.01;
/// Acceleration by the air that a sleeper does not feel, as a share of gravity: it would tilt a pool by as much.
pub const BREEZE: f32 = 1e-3;

/// What of the sleep belongs to a world's state: without it, a world that is put back goes on otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SleepRecord {
    /// Particles at the front of the store that sleep.
    pub(crate) asleep: u32,
    /// What they fell asleep under (see [`Sleep::keep_under`]).
    under: u64,
    /// How calm each tile has been; empty before the first look.
    tiles: Vec<Calm>,
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

/// How calm a tile has been.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Calm {
    /// Mean velocity over the last looks, d a tick.
    drift: [f32; 2],
    /// Looks in a row at which its whole body was calm.
    looks: u8,
}

/// What a look finds in a tile.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    count: u32,
    momentum: [f32; 2],
    /// Σ v².
    square: f32,
}

impl Tally {
    /// Follows the tile's drift; returns whether it is calm now.
    fn judge(&self, calm: &mut Calm) -> bool {
        // d/s to d a tick.
        let per = TICK_SECONDS / self.count as f32;
        // The first look sets the mean: to begin at 0 would be to take a new tile for calm.
        let weight = if *calm == Calm::default() { 1.0 } else { LAST_LOOK };
        for (drift, momentum) in calm.drift.iter_mut().zip(self.momentum) {
            *drift += weight * (momentum * per - *drift);
        }
        let [x, y] = calm.drift;
        self.square * per * TICK_SECONDS <= JITTER * JITTER && x * x + y * y <= DRIFT * DRIFT
    }
}

/// A tile of a sleeping body.
const ASLEEP: u8 = 1;
/// A tile of a sleeping body or beside one.
const NEAR: u8 = 2;
/// A tile of a body that is about to wake, or to fall asleep.
const TURNS: u8 = 4;

/// Who sleeps. Buffers are kept; without sleepers there is nothing in them that counts.
#[derive(Clone, Debug, Default)]
pub struct Sleep {
    record: SleepRecord,
    grid: TileGrid,
    /// Flags of each tile.
    flags: Vec<u8>,
    /// The tiles of sleeping bodies.
    tiles: Vec<u32>,
    tally: Vec<Tally>,
    /// Tiles of the body at hand.
    body: Vec<u32>,
    waiting: Vec<u32>,
    /// The sleepers as they fell asleep, to see whether anyone touched them.
    x: Vec<f32>,
    y: Vec<f32>,
    id: Vec<u32>,
    /// Their densities, for who looks at them.
    density: Vec<f32>,
    /// Room for the densities of the others.
    others: Vec<f32>,
    /// During the substeps the whole store, the sleepers in front; else room.
    aside: Particles,
    is_aside: bool,
    /// Room to change the order.
    room: Particles,
    /// Version of the rock that they lie on.
    rock: u64,
}

impl Sleep {
    /// The sleep of a world that is put back: `record` with its `particles`, in a box of `size` d with rock of that version.
    pub fn resume(record: SleepRecord, particles: &Particles, size: Vec2, rock_version: u64) -> Self {
        let mut sleep = Self { record, rock: rock_version, ..Self::default() };
        sleep.record.asleep = sleep.record.asleep.min(particles.len() as u32);
        sleep.lay(size);
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

    /// Number of tiles that sleep.
    pub fn tiles_asleep(&self) -> usize {
        self.tiles.len()
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.flags.capacity()
            + 4 * (self.tiles.capacity() + self.waiting.capacity() + self.body.capacity())
            + size_of::<Tally>() * self.tally.capacity()
            + size_of::<Calm>() * self.record.tiles.capacity()
            + 4 * (self.x.capacity() + self.y.capacity() + self.id.capacity())
            + 4 * (self.density.capacity() + self.others.capacity())
            + 21 * (self.aside.x.capacity() + self.room.x.capacity())
    }

    /// Lays the tiles over a box of `size` d.
    fn lay(&mut self, size: Vec2) {
        let grid = TileGrid::new(size);
        if self.grid != grid || self.flags.len() != grid.len() {
            self.grid = grid;
            self.flags = vec![0; grid.len()];
            // A flood enters each tile once.
            self.waiting.reserve(grid.len());
            self.body.reserve(grid.len());
        }
        if self.record.tiles.len() != grid.len() {
            self.record.tiles = vec![Calm::default(); grid.len()];
        }
    }

    /// Wakes all.
    pub fn wake_all(&mut self) {
        self.record.asleep = 0;
        self.record.tiles.fill(Calm::default());
        self.flags.fill(0);
        self.tiles.clear();
        [&mut self.x, &mut self.y, &mut self.density].into_iter().for_each(Vec::clear);
        self.id.clear();
    }

    /// Says under which conditions the world goes on, as a number that is another one under others: gravity, quality,
    /// effects. Where they are not those from before, all wake.
    pub fn keep_under(&mut self, conditions: u64) {
        if self.record.under != conditions {
            self.record.under = conditions;
            self.wake_all();
        }
    }

    /// Looks whether anyone touched the sleepers since the last tick, as brushes, outlets and a change of the rock do, and
    /// wakes the bodies that are concerned. What was taken away is found by its gap in the order, which removing keeps.
    pub fn check(&mut self, particles: &mut Particles, rock_version: u64) {
        if self.rock != rock_version {
            self.wake_all();
        }
        let asleep = self.asleep();
        let is_untouched = particles.len() >= asleep
            && particles.id[..asleep] == self.id[..asleep]
            && are_same(&particles.x[..asleep], &self.x)
            && are_same(&particles.y[..asleep], &self.y)
            && is_still(&particles.vx[..asleep])
            && is_still(&particles.vy[..asleep]);
        if is_untouched {
            return;
        }
        let mut left = 0;
        for k in 0..asleep {
            let is_there = particles.id.get(left) == Some(&self.id[k]);
            let (x, y) = (self.x[k], self.y[k]);
            let is_same =
                is_there && (particles.x[left], particles.y[left]) == (x, y) && particles.velocity(left) == Vec2::ZERO;
            if !is_same {
                self.turn_around(self.grid.tile(x, y));
            }
            if is_there {
                // Where it fell asleep says which body it belongs to.
                (self.x[left], self.y[left], self.density[left]) = (x, y, self.density[k]);
                left += 1;
            }
        }
        self.record.asleep = left as u32;
        self.wake_turned(particles);
    }

    /// While the sleepers are aside: wakes the bodies that the wind reaches, to which `particles` are added. `drag` is the
    /// highest rate of drag there is, 1/d, `gravity` in d/s².
    pub fn wake_blown(&mut self, particles: &mut Particles, air: &Air, drag: f32, gravity: Vec2) {
        if air.is_quiet() {
            return;
        }
        // dv/dt = k v²
        let is_felt = |speed2: f32| drag * speed2 > BREEZE * gravity.length();
        let mut any = false;
        for k in 0..self.tiles.len() {
            let tile = self.tiles[k] as usize;
            if self.flags[tile] & TURNS == 0 && is_felt(fastest2(air, self.grid.area(tile))) {
                self.turn_body(tile);
                any = true;
            }
        }
        if any {
            self.wake_turned_aside(particles);
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

    /// While the sleepers are aside: wakes the bodies that any of `particles` is about to touch.
    pub fn wake_touched(&mut self, particles: &mut Particles) {
        if self.asleep() == 0 {
            return;
        }
        let Self { grid, flags, .. } = &*self;
        let touches = |(x, y): (&f32, &f32)| flags[grid.tile(*x, *y)] & NEAR != 0;
        if !particles.x.iter().zip(&particles.y).any(touches) {
            return;
        }
        for i in 0..particles.len() {
            let tile = self.grid.tile(particles.x[i], particles.y[i]);
            if self.flags[tile] & NEAR != 0 {
                self.turn_around(tile);
            }
        }
        self.wake_turned_aside(particles);
    }

    /// Looks at the particles that are awake, and lets the bodies sleep that have been calm long enough. `density` goes
    /// with the particles where it is theirs; the rock is of version `rock_version`. Returns how many fell asleep.
    pub fn watch(&mut self, particles: &mut Particles, density: &mut [f32], size: Vec2, rock_version: u64) -> usize {
        self.lay(size);
        self.rock = rock_version;
        self.look(particles);
        let Self { grid, record, tally, flags, waiting, body, .. } = &mut *self;
        let mut falls_asleep = false;
        for tile in 0..grid.len() {
            if tally[tile].count == 0 {
                continue;
            }
            body.clear();
            let mut is_calm = true;
            grid.flood(tile, waiting, |tile| {
                let found = std::mem::take(&mut tally[tile]);
                if found.count == 0 {
                    return false;
                }
                is_calm &= found.judge(&mut record.tiles[tile]);
                body.push(tile as u32);
                true
            });
            let mut looks = LOOKS;
            for &tile in &*body {
                let calm = &mut record.tiles[tile as usize];
                calm.looks = if is_calm { calm.looks.saturating_add(1) } else { 0 };
                looks = looks.min(calm.looks);
            }
            if looks >= LOOKS {
                falls_asleep = true;
                body.iter().for_each(|&tile| flags[tile as usize] |= TURNS);
            }
        }
        if falls_asleep { self.let_sleep(particles, density) } else { 0 }
    }

    /// Adds up what is awake in each tile. A tile without any begins anew.
    fn look(&mut self, particles: &Particles) {
        let Self { grid, tally, record, .. } = self;
        tally.clear();
        tally.resize(grid.len(), Tally::default());
        for i in record.asleep as usize..particles.len() {
            let (vx, vy) = (particles.vx[i], particles.vy[i]);
            let tally = &mut tally[grid.tile(particles.x[i], particles.y[i])];
            tally.count += 1;
            tally.momentum = [tally.momentum[0] + vx, tally.momentum[1] + vy];
            tally.square += vx * vx + vy * vy;
        }
        let empty = record.tiles.iter_mut().zip(tally).filter(|(_, tally)| tally.count == 0);
        empty.for_each(|(calm, _)| *calm = Calm::default());
    }

    /// Puts what is in the tiles that turn behind the sleepers, at rest.
    fn let_sleep(&mut self, particles: &mut Particles, density: &mut [f32]) -> usize {
        let (before, is_known) = (self.asleep(), density.len() == particles.len());
        self.room.clear();
        self.others.clear();
        let mut end = before;
        for i in before..particles.len() {
            let own = if is_known { density[i] } else { 1.0 };
            if self.flags[self.grid.tile(particles.x[i], particles.y[i])] & TURNS != 0 {
                particles.copy(i, end);
                (particles.vx[end], particles.vy[end]) = (0.0, 0.0);
                self.density.push(own);
                end += 1;
            } else {
                self.room.append(particles, i..i + 1);
                self.others.push(own);
            }
        }
        for i in 0..self.room.len() {
            particles.copy_from(&self.room, i, end + i);
        }
        if is_known {
            density[..end].copy_from_slice(&self.density);
            density[end..].copy_from_slice(&self.others);
        }
        self.record.asleep = end as u32;
        self.remember(particles);
        end - before
    }

    /// Notes how the sleepers lie.
    fn remember(&mut self, particles: &Particles) {
        let asleep = self.asleep();
        for (copy, from) in [(&mut self.x, &particles.x), (&mut self.y, &particles.y)] {
            copy.clear();
            copy.extend_from_slice(&from[..asleep]);
        }
        self.id.clear();
        self.id.extend_from_slice(&particles.id[..asleep]);
        // Of those who were put back asleep, no one knows more than that they are at rest.
        self.density.resize(asleep, 1.0);
        self.mark();
    }

    /// Marks the tiles of the sleepers and those beside them.
    fn mark(&mut self) {
        self.flags.fill(0);
        self.tiles.clear();
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

    /// The bodies in a tile or beside it are to wake.
    fn turn_around(&mut self, tile: usize) {
        for near in self.grid.around(tile) {
            if self.flags[near] & (ASLEEP | TURNS) == ASLEEP {
                self.turn_body(near);
            }
        }
    }

    /// The body that has a tile is to wake.
    fn turn_body(&mut self, tile: usize) {
        let Self { grid, flags, waiting, .. } = self;
        grid.flood(tile, waiting, |tile| {
            let enters = flags[tile] & (ASLEEP | TURNS) == ASLEEP;
            flags[tile] |= if enters { TURNS } else { 0 };
            enters
        });
    }

    /// Wakes the bodies that are to: moves them behind the other sleepers at the front of `particles`, each in their order.
    /// Returns where they are then.
    fn wake_turned(&mut self, particles: &mut Particles) -> Range<usize> {
        let end = self.asleep();
        let mut kept = 0;
        // What woke is not calm because it was so before.
        let turned = self.record.tiles.iter_mut().zip(&self.flags).filter(|(_, flags)| **flags & TURNS != 0);
        turned.for_each(|(calm, _)| *calm = Calm::default());
        self.room.clear();
        for i in 0..end {
            if self.flags[self.grid.tile(self.x[i], self.y[i])] & TURNS != 0 {
                self.room.append(particles, i..i + 1);
            } else {
                particles.copy(i, kept);
                (self.x[kept], self.y[kept], self.density[kept]) = (self.x[i], self.y[i], self.density[i]);
                kept += 1;
            }
        }
        for i in 0..self.room.len() {
            particles.copy_from(&self.room, i, kept + i);
        }
        [&mut self.x, &mut self.y, &mut self.density].into_iter().for_each(|copy| copy.truncate(kept));
        self.id.clear();
        self.id.extend_from_slice(&particles.id[..kept]);
        self.record.asleep = kept as u32;
        self.mark();
        kept..end
    }

    /// The same while they are aside: the woken join the `particles` that are awake.
    fn wake_turned_aside(&mut self, particles: &mut Particles) {
        let mut aside = std::mem::take(&mut self.aside);
        let woken = self.wake_turned(&mut aside);
        particles.append(&aside, woken);
        self.aside = aside;
    }
}

/// Entries that are compared together: to stop at the first that differs would be to compare one by one.
const BLOCK: usize = 256;

/// Whether two arrays of one length are equal.
fn are_same(a: &[f32], b: &[f32]) -> bool {
    a.chunks(BLOCK).zip(b.chunks(BLOCK)).all(|(a, b)| a.iter().zip(b).fold(true, |same, (a, b)| same & (a == b)))
}

/// Whether nothing moves.
fn is_still(velocity: &[f32]) -> bool {
    velocity.chunks(BLOCK).all(|block| block.iter().fold(true, |still, velocity| still & (*velocity == 0.0)))
}

/// Square of the highest speed of the air in the cells that what lies in an area may feel, (d/s)².
fn fastest2(air: &Air, (low, high): (Vec2, Vec2)) -> f32 {
    // Bilinear between the centres of cells: half a cell more on every side, and one for rounding.
    let cells = |low: f32, high: f32, count: usize| {
        let first = (low / air.cell() - 1.0).max(0.0) as usize;
        first..((high / air.cell() + 2.0).max(0.0) as usize).min(count)
    };
    let (columns, rows) = (cells(low.x, high.x, air.columns()), cells(low.y, high.y, air.rows()));
    let mut fastest = 0.0_f32;
    for row in rows {
        let (u, v) = (&air.velocity_x_row(row)[columns.clone()], &air.velocity_y_row(row)[columns.clone()]);
        for (u, v) in u.iter().zip(v) {
            fastest = fastest.max(u * u + v * v);
        }
    }
    fastest
}
