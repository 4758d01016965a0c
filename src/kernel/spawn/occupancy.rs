//! Which sites are taken.

use crate::{
    particles::Particles,
    solids::{Solids, centre},
    sources::{BLOCK, Rect},
};
use glam::{IVec2, Vec2};

/// A site is free if no particle is nearer than this, d.
pub(super) const CLEARANCE: f32 = 0.8;

/// Which points near a region are taken: particles in lists by cell. Its buffers are used again and again.
#[derive(Debug, Default)]
pub struct Occupancy {
    /// Lower left cell.
    low: IVec2,
    columns: i32,
    rows: i32,
    /// For each cell the point that came last.
    newest: Vec<u32>,
    /// Points with the one before them in their cell.
    points: Vec<(Vec2, u32)>,
}

/// End of a list.
const NONE: u32 = u32::MAX;

impl Occupancy {
    /// Takes the particles in the cells `low … high` and those around them, and forgets all others.
    pub(crate) fn look(&mut self, particles: &Particles, low: IVec2, high: IVec2) {
        let (low, high) = (low - 1, high + 1);
        (self.low, self.columns, self.rows) = (low, high.x - low.x + 1, high.y - low.y + 1);
        self.newest.clear();
        self.newest.resize((self.columns * self.rows) as usize, NONE);
        self.points.clear();
        let around = Rect { min: low.as_vec2(), max: (high + 1).as_vec2() };
        for (x, y) in particles.x.chunks(BLOCK).zip(particles.y.chunks(BLOCK)) {
            if around.contains_any([x, y]) {
                x.iter().zip(y).for_each(|(x, y)| self.insert(Vec2::new(*x, *y)));
            }
        }
    }

    /// Takes the centres of the rock in the same cells, too.
    pub(crate) fn look_at_rock(&mut self, solids: &Solids, low: IVec2, high: IVec2) {
        for y in low.y - 1..=high.y + 1 {
            for cell in (low.x - 1..=high.x + 1).map(|x| IVec2::new(x, y)) {
                if solids.get(cell).is_some() {
                    self.insert(centre(cell));
                }
            }
        }
    }

    fn index(&self, cell: IVec2) -> Option<usize> {
        let cell = cell - self.low;
        let inside = cell.x >= 0 && cell.y >= 0 && cell.x < self.columns && cell.y < self.rows;
        inside.then(|| (cell.y * self.columns + cell.x) as usize)
    }

    /// Takes a point.
    pub(super) fn insert(&mut self, point: Vec2) {
        if let Some(k) = self.index(Solids::cell_of(point)) {
            self.points.push((point, self.newest[k]));
            self.newest[k] = self.points.len() as u32 - 1;
        }
    }

    /// Whether a taken point is nearer than [`CLEARANCE`].
    pub(super) fn is_near(&self, point: Vec2) -> bool {
        let cell = Solids::cell_of(point);
        (-1..=1).any(|dy| (-1..=1).any(|dx| self.cell_holds_near(cell + IVec2::new(dx, dy), point)))
    }

    /// Whether any taken point is in a cell.
    pub(super) fn holds(&self, cell: IVec2) -> bool {
        self.index(cell).is_some_and(|k| self.newest[k] != NONE)
    }

    /// Whether no taken point is nearer to `point` than the root of `room` (d²), or else than [`CLEARANCE`].
    pub(super) fn has_room(&self, point: Vec2, room: f32) -> bool {
        self.nearest(point, false) >= room.min(CLEARANCE * CLEARANCE)
    }

    /// Square of the distance to the nearest taken point that is another than the one at `point`, d²; that of [`CLEARANCE`] if
    /// none is as near.
    pub(crate) fn room_at(&self, point: Vec2) -> f32 {
        self.nearest(point, true).min(CLEARANCE * CLEARANCE)
    }

    /// Square of the distance to the nearest taken point, besides one that is right there if that `is_own`, d². Far ones are not
    /// looked at.
    fn nearest(&self, point: Vec2, mut is_own: bool) -> f32 {
        let (cell, mut nearest) = (Solids::cell_of(point), f32::MAX);
        for step in (-1..=1).flat_map(|y| (-1..=1).map(move |x| IVec2::new(x, y))) {
            let mut entry = self.index(cell + step).map_or(NONE, |k| self.newest[k]);
            while let Some(&(other, older)) = self.points.get(entry as usize) {
                let distance = (other - point).length_squared();
                if distance == 0.0 && is_own {
                    is_own = false;
                } else {
                    nearest = nearest.min(distance);
                }
                entry = older;
            }
        }
        nearest
    }

    fn cell_holds_near(&self, cell: IVec2, point: Vec2) -> bool {
        let mut entry = self.index(cell).map_or(NONE, |k| self.newest[k]);
        while let Some(&(other, older)) = self.points.get(entry as usize) {
            if (other - point).length_squared() < CLEARANCE * CLEARANCE {
                return true;
            }
            entry = older;
        }
        false
    }
}
