//! What has been calm for a second falls asleep.

use super::{
    calm::{Calm, LOOKS, Tally},
    state::{CHANGES, Sleep},
};
use crate::particles::Particles;
use glam::Vec2;

impl Sleep {
    /// Looks at the particles that are awake, and lets the bodies sleep that have been calm long enough. `density` goes
    /// with the particles where it is theirs; the rock is of version `rock_version`; `rising` tells how fast particle i of those
    /// is about to rise or sink among others, d/s: a heavy layer over a light one may stand still, and is not at rest. Returns
    /// how many fell asleep.
    pub fn watch(
        &mut self,
        particles: &mut Particles,
        density: &mut [f32],
        (size, rock_version): (Vec2, u64),
        rising: impl Fn(&Particles, usize) -> f32,
    ) -> usize {
        self.resize(size);
        self.rock = rock_version;
        self.look(particles, rising);
        let Self { grid, record, tally, flags, body, .. } = &mut *self;
        let mut falls_asleep = false;
        for tile in 0..grid.len() {
            if tally[tile].count == 0 {
                continue;
            }
            let mut is_calm = true;
            grid.flood(tile, body, |tile| {
                let found = std::mem::take(&mut tally[tile]);
                let enters = found.count > 0;
                if enters {
                    is_calm &= found.judge(&mut record.tiles[tile]);
                }
                enters
            });
            let mut looks = LOOKS;
            for &tile in &*body {
                let calm = &mut record.tiles[tile as usize];
                calm.looks = if is_calm { calm.looks.saturating_add(1) } else { 0 };
                looks = looks.min(calm.looks);
            }
            if looks >= LOOKS {
                falls_asleep = true;
                body.iter().for_each(|&tile| flags[tile as usize] |= CHANGES);
            }
        }
        if falls_asleep { self.let_sleep(particles, density) } else { 0 }
    }

    /// Adds up what is awake in each tile. A tile without any begins anew.
    fn look(&mut self, particles: &Particles, rising: impl Fn(&Particles, usize) -> f32) {
        let Self { grid, tally, record, .. } = self;
        tally.clear();
        tally.resize(grid.len(), Tally::default());
        for i in record.asleep as usize..particles.len() {
            let (vx, vy) = (particles.vx[i], particles.vy[i]);
            let tally = &mut tally[grid.tile(particles.x[i], particles.y[i])];
            tally.count += 1;
            tally.momentum = [tally.momentum[0] + vx, tally.momentum[1] + vy];
            tally.square += vx * vx + vy * vy;
            tally.rising += rising(particles, i);
        }
        let empty = record.tiles.iter_mut().zip(tally).filter(|(_, tally)| tally.count == 0);
        empty.for_each(|(calm, _)| *calm = Calm::default());
    }

    /// Puts what is in the marked tiles behind the sleepers, at rest.
    fn let_sleep(&mut self, particles: &mut Particles, density: &mut [f32]) -> usize {
        let (before, is_known) = (self.asleep(), density.len() == particles.len());
        self.room.clear();
        self.others.clear();
        let mut end = before;
        for i in before..particles.len() {
            let own = if is_known { density[i] } else { 1.0 };
            if self.flags[self.grid.tile(particles.x[i], particles.y[i])] & CHANGES != 0 {
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
