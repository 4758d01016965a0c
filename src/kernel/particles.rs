//! The store of movable particles: one array per quantity, sorted by cell each substep, with ids that survive the sort.

use crate::element::ElementId;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Movable particles. All arrays have one entry per particle, in the same order; the order changes with every sort.
/// 21 bytes a particle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Particles {
    /// Position, d.
    pub x: Vec<f32>,
    /// Position, d.
    pub y: Vec<f32>,
    /// Velocity, d/s.
    pub vx: Vec<f32>,
    /// Velocity, d/s.
    pub vy: Vec<f32>,
    /// Number that stays with the particle for life, unique in its world.
    pub id: Vec<u32>,
    /// What it is made of.
    pub element: Vec<ElementId>,
}

impl Particles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Appends a particle.
    pub fn push(&mut self, id: u32, element: ElementId, position: Vec2, velocity: Vec2) {
        self.x.push(position.x);
        self.y.push(position.y);
        self.vx.push(velocity.x);
        self.vy.push(velocity.y);
        self.id.push(id);
        self.element.push(element);
    }

    /// Position of particle `i`, d.
    pub fn position(&self, i: usize) -> Vec2 {
        Vec2::new(self.x[i], self.y[i])
    }

    /// Velocity of particle `i`, d/s.
    pub fn velocity(&self, i: usize) -> Vec2 {
        Vec2::new(self.vx[i], self.vy[i])
    }

    /// Keeps the particles for which `keep(i)` holds, in their order; returns how many went.
    pub fn retain(&mut self, keep: impl Fn(&Self, usize) -> bool) -> usize {
        let before = self.len();
        let mut kept = 0;
        for i in 0..before {
            if keep(self, i) {
                self.copy(i, kept);
                kept += 1;
            }
        }
        self.truncate(kept);
        before - kept
    }

    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        self.truncate(0);
    }

    /// Appends those of `other` in `range`, in their order.
    pub(crate) fn append(&mut self, other: &Self, range: Range<usize>) {
        self.x.extend_from_slice(&other.x[range.clone()]);
        self.y.extend_from_slice(&other.y[range.clone()]);
        self.vx.extend_from_slice(&other.vx[range.clone()]);
        self.vy.extend_from_slice(&other.vy[range.clone()]);
        self.id.extend_from_slice(&other.id[range.clone()]);
        self.element.extend_from_slice(&other.element[range]);
    }

    /// Overwrites particle `to` with particle `i`.
    pub(crate) fn copy(&mut self, i: usize, to: usize) {
        self.x[to] = self.x[i];
        self.y[to] = self.y[i];
        self.vx[to] = self.vx[i];
        self.vy[to] = self.vy[i];
        self.id[to] = self.id[i];
        self.element[to] = self.element[i];
    }

    /// Overwrites particle `to` with particle `i` of `other`.
    pub(crate) fn copy_from(&mut self, other: &Self, i: usize, to: usize) {
        self.x[to] = other.x[i];
        self.y[to] = other.y[i];
        self.vx[to] = other.vx[i];
        self.vy[to] = other.vy[i];
        self.id[to] = other.id[i];
        self.element[to] = other.element[i];
    }

    /// Keeps the first `len`.
    pub(crate) fn truncate(&mut self, len: usize) {
        self.x.truncate(len);
        self.y.truncate(len);
        self.vx.truncate(len);
        self.vy.truncate(len);
        self.id.truncate(len);
        self.element.truncate(len);
    }

    /// Indices in the order of the ids: the order in which states are hashed and written.
    pub fn in_id_order(&self) -> Vec<u32> {
        let mut order: Vec<u32> = (0..self.len() as u32).collect();
        order.sort_unstable_by_key(|&i| self.id[i as usize]);
        order
    }
}

/// Numbers that are compared side by side.
const EXTENT_LANES: usize = 16;

/// The lowest and the highest of some numbers; the other way round if there is none.
pub(crate) fn extent(numbers: &[f32]) -> [f32; 2] {
    let (blocks, rest) = numbers.as_chunks::<EXTENT_LANES>();
    let (mut low, mut high) = ([f32::MAX; EXTENT_LANES], [f32::MIN; EXTENT_LANES]);
    for block in blocks {
        for lane in 0..EXTENT_LANES {
            low[lane] = low[lane].min(block[lane]);
            high[lane] = high[lane].max(block[lane]);
        }
    }
    let low = low.iter().chain(rest).fold(f32::MAX, |low, x| low.min(*x));
    [low, high.iter().chain(rest).fold(f32::MIN, |high, x| high.max(*x))]
}
