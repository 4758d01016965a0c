//! Strips of sorted particles, whose positions may be changed within their cells.

use crate::{
    bins::cells::CellGrid,
    parallel::{Parts, cut},
};
use glam::Vec2;
use std::ops::Range;

/// The sorted positions of a strip, d, to be changed within their cells.
pub(crate) struct Strip<'a> {
    grid: &'a CellGrid,
    ids: &'a [u32],
    pub x: &'a mut [f32],
    pub y: &'a mut [f32],
}

impl Strip<'_> {
    /// The id of a particle of the strip.
    pub fn id(&self, i: usize) -> u32 {
        self.ids[i]
    }

    /// An offset, or its mirror image in either coordinate, that leaves a particle of the strip in its cell and in a place
    /// that is `free`; 0 in a coordinate in which there is none.
    pub fn turn_inwards(&self, i: usize, offset: Vec2, free: impl Fn(Vec2) -> bool) -> Vec2 {
        let from = Vec2::new(self.x[i], self.y[i]);
        let own = self.grid.cell(from.x, from.y);
        let stays = |to: Vec2| self.grid.cell(to.x, to.y) == own && free(to);
        let turn = |offset: Vec2| {
            let ways = [offset, -offset];
            ways.into_iter().find(|way| stays(from + way)).unwrap_or_default()
        };
        turn(Vec2::new(offset.x, 0.0)) + turn(Vec2::new(0.0, offset.y))
    }
}

/// Strips that follow each other, with their particles.
pub(super) struct Strips<'a> {
    pub grid: &'a CellGrid,
    /// Index of the first particle of each cell.
    pub starts: &'a [u32],
    pub strips: Range<usize>,
    /// Index of the first particle at hand.
    pub base: usize,
    pub id: &'a [u32],
    /// Positions, d.
    pub at: [&'a mut [f32]; 2],
}

impl Strips<'_> {
    /// Index of the first particle at hand that is in `strip` or behind it.
    fn start(&self, strip: usize) -> usize {
        self.starts[strip * self.grid.columns] as usize - self.base
    }

    /// Calls `work` with each strip.
    pub fn each(mut self, work: &impl Fn(Strip)) {
        for strip in self.strips.clone() {
            let own = self.start(strip)..self.start(strip + 1);
            let [x, y] = self.at.each_mut().map(|at| &mut at[own.clone()]);
            work(Strip { grid: self.grid, ids: &self.id[own], x, y });
        }
    }
}

impl Parts for Strips<'_> {
    /// Particles, if they are in several strips.
    fn size(&self) -> usize {
        if self.strips.len() > 1 { self.id.len() } else { 0 }
    }

    fn halve(self) -> (Self, Self) {
        let (grid, starts, base) = (self.grid, self.starts, self.base);
        let half = self.id.len() / 2;
        let before = self.strips.clone().take_while(|strip| self.start(*strip) < half).count();
        let middle = self.strips.start + before.clamp(1, self.strips.len() - 1);
        let at = self.start(middle);
        let (lower, upper) = (self.strips.start..middle, middle..self.strips.end);
        let ((lower_id, upper_id), (lower_at, upper_at)) = (self.id.split_at(at), cut(self.at, at));
        (
            Self { grid, starts, strips: lower, base, id: lower_id, at: lower_at },
            Self { grid, starts, strips: upper, base: base + at, id: upper_id, at: upper_at },
        )
    }
}
