//! What has been calm for a second falls asleep.

use super::{Sleep, TURNS};
use crate::{particles::Particles, units::TICK_SECONDS};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Ticks from one look at what is awake to the next. Raising it makes looking cheaper and sleep come later.
pub const LOOK_TICKS: u64 = 8;
/// Looks in a row at which all of a body must be found calm: a second.
pub(super) const LOOKS: u8 = 8;
/// Weight of the last look in a tile's drift, so that it is a mean over about as many ticks as [`LOOKS`] takes.
const LAST_LOOK: f32 = 1.0 / LOOKS as f32;
/// Root mean square speed up to which the particles of a tile are calm, d a tick. In a pool at rest the solver leaves
/// 0.005 to 0.02, and in a tile that holds a few particles of its surface up to 0.05. Raising it lets water sleep that
/// visibly moves.
pub const JITTER: f32 = 0.06;
/// Mean speed of a tile over a second up to which it is calm, d a tick. It bounds the slow motion that sleep stops: waves,
/// eddies, a level that still sinks.
pub const DRIFT: f32 = 0.01;
/// How calm a tile has been.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Calm {
    /// Mean velocity over the last looks, d a tick.
    pub(super) drift: [f32; 2],
    /// Looks in a row at which its whole body was calm.
    looks: u8,
}

/// What a look finds in a tile.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
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

impl Sleep {
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
}
