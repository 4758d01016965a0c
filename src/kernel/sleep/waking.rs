//! What is touched, or about to be, wakes.

use super::{
    calm::Calm,
    state::{ASLEEP, CHANGES, NEAR, Sleep},
};
use crate::{air::Air, particles::Particles};
use glam::Vec2;
use std::ops::Range;

/// Acceleration by the air that a sleeper does not feel, as a share of gravity: it would tilt a pool by as much.
pub const BREEZE: f32 = 1e-3;

impl Sleep {
    /// Wakes all.
    pub fn wake_all(&mut self) {
        self.record.asleep = 0;
        self.disturbed.clear();
        self.record.tiles.fill(Calm::default());
        self.flags.fill(0);
        self.tiles.clear();
        [&mut self.x, &mut self.y, &mut self.density].into_iter().for_each(Vec::clear);
        self.id.clear();
    }

    /// Notes that something became another element at places (d): what sleeps there wakes at the next [`Sleep::check`].
    pub fn disturb(&mut self, places: &[Vec2]) {
        if self.asleep() > 0 {
            self.disturbed.extend(places.iter().map(|at| self.grid.tile(at.x, at.y) as u32));
        }
    }

    /// Looks whether anything touched the sleepers since the last tick, as brushes, drains and a change of the rock do, and
    /// wakes the bodies that are concerned. What was taken away is found by its gap in the order, which removing keeps.
    pub fn check(&mut self, particles: &mut Particles, rock_version: u64) {
        if self.rock != rock_version {
            self.wake_all();
        }
        let asleep = self.asleep();
        let is_untouched = self.disturbed.is_empty()
            && particles.len() >= asleep
            && particles.id[..asleep] == self.id[..asleep]
            && are_same(&particles.x[..asleep], &self.x)
            && are_same(&particles.y[..asleep], &self.y)
            && is_still(&particles.vx[..asleep])
            && is_still(&particles.vy[..asleep]);
        if is_untouched {
            return;
        }
        for k in 0..self.disturbed.len() {
            self.mark_around(self.disturbed[k] as usize);
        }
        self.disturbed.clear();
        let mut left = 0;
        for k in 0..asleep {
            let is_there = particles.id.get(left) == Some(&self.id[k]);
            let (x, y) = (self.x[k], self.y[k]);
            let is_same =
                is_there && (particles.x[left], particles.y[left]) == (x, y) && particles.velocity(left) == Vec2::ZERO;
            if !is_same {
                self.mark_around(self.grid.tile(x, y));
            }
            if is_there {
                // Where it fell asleep says which body it belongs to.
                (self.x[left], self.y[left], self.density[left]) = (x, y, self.density[k]);
                left += 1;
            }
        }
        self.record.asleep = left as u32;
        self.wake_marked(particles);
    }

    /// While the sleepers are aside: wakes the bodies that the wind reaches, to which `particles` are added. `drags` are the
    /// rates of drag of the elements, 1/d, `gravity` in d/s².
    pub fn wake_blown(&mut self, particles: &mut Particles, air: &Air, drags: &[f32], gravity: Vec2) {
        if air.is_quiet() {
            return;
        }
        self.find_drag(drags);
        let mut any = false;
        for k in 0..self.tiles.len() {
            let tile = self.tiles[k] as usize;
            // dv/dt = k v²
            let is_felt = |speed2: f32| self.drag[tile] * speed2 > BREEZE * gravity.length();
            if self.flags[tile] & CHANGES == 0 && is_felt(fastest2(air, self.grid.area(tile))) {
                self.mark_body(tile);
                any = true;
            }
        }
        if any {
            self.wake_marked_aside(particles);
        }
    }

    /// While the sleepers are aside: finds how easily the wind moves what lies in each tile. Water does not feel a breath that
    /// lifts dust.
    fn find_drag(&mut self, drags: &[f32]) {
        if std::mem::replace(&mut self.is_drag_known, true) {
            return;
        }
        let Self { grid, drag, aside, x, y, .. } = self;
        drag.resize(grid.len(), 0.0);
        drag.fill(0.0);
        for ((x, y), element) in x.iter().zip(&*y).zip(&aside.element) {
            let most = &mut drag[grid.tile(*x, *y)];
            *most = most.max(drags[element.index()]);
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
                self.mark_around(tile);
            }
        }
        self.wake_marked_aside(particles);
    }

    /// Marks the bodies in a tile or beside it as to wake.
    fn mark_around(&mut self, tile: usize) {
        for near in self.grid.around(tile) {
            if self.flags[near] & (ASLEEP | CHANGES) == ASLEEP {
                self.mark_body(near);
            }
        }
    }

    /// Marks the body that has a tile as to wake.
    fn mark_body(&mut self, tile: usize) {
        let Self { grid, flags, body, .. } = self;
        grid.flood(tile, body, |tile| {
            let enters = flags[tile] & (ASLEEP | CHANGES) == ASLEEP;
            flags[tile] |= if enters { CHANGES } else { 0 };
            enters
        });
    }

    /// Wakes the bodies that are to: moves them behind the other sleepers at the front of `particles`, each in their order.
    /// Returns where they are then.
    fn wake_marked(&mut self, particles: &mut Particles) -> Range<usize> {
        let end = self.asleep();
        let mut kept = 0;
        // What woke is not calm because it was so before.
        let marked = self.record.tiles.iter_mut().zip(&self.flags).filter(|(_, flags)| **flags & CHANGES != 0);
        marked.for_each(|(calm, _)| *calm = Calm::default());
        self.room.clear();
        for i in 0..end {
            if self.flags[self.grid.tile(self.x[i], self.y[i])] & CHANGES != 0 {
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
    fn wake_marked_aside(&mut self, particles: &mut Particles) {
        let mut aside = std::mem::take(&mut self.aside);
        let woken = self.wake_marked(&mut aside);
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
