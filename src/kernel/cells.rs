//! Some of the particles, sorted into cells, so that what is near stands together.

use crate::{element::ElementId, particles::Particles};
use glam::Vec2;

/// Particles in square cells, in the order of the cells.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Width of a cell, d.
    width: f32,
    /// Cells of a row, with one before and one behind the box.
    stride: usize,
    rows: usize,
    /// The first of each cell in `order`, and the end.
    starts: Vec<u32>,
    /// Particles, cell by cell.
    order: Vec<u32>,
    /// Elements in each cell, as a set that may hold more: see [`mark`].
    marks: Vec<u64>,
}

/// The bit of an element in a set that has one for element e, e + 64, e + 128 …
pub fn mark(element: ElementId) -> u64 {
    1 << (element.index() % 64)
}

impl Cells {
    /// Sorts the particles of the elements that are `wanted` into cells of a width (d), in a box of a size (d).
    pub fn sort(&mut self, particles: &Particles, size: Vec2, width: f32, wanted: impl Fn(ElementId) -> bool) {
        self.width = width;
        (self.stride, self.rows) = ((size.x / width) as usize + 3, (size.y / width) as usize + 3);
        let cells = self.stride * self.rows;
        self.starts.clear();
        self.starts.resize(cells + 2, 0);
        self.marks.clear();
        self.marks.resize(cells, 0);
        let is_wanted = |i: &usize| wanted(particles.element[*i]);
        let mut count = 0;
        for i in (0..particles.len()).filter(is_wanted) {
            let cell = self.cell_of(particles.position(i));
            self.starts[cell + 2] += 1;
            self.marks[cell] |= mark(particles.element[i]);
            count += 1;
        }
        for cell in 2..cells + 2 {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.order.resize(count, 0);
        for i in (0..particles.len()).filter(is_wanted) {
            let cell = self.cell_of(particles.position(i));
            let next = &mut self.starts[cell + 1];
            self.order[*next as usize] = i as u32;
            *next += 1;
        }
    }

    /// The particles, cell by cell.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The three rows of cells around a place: which elements may be there ([`mark`]), and the particles.
    #[inline(always)]
    pub fn around(&self, at: Vec2) -> impl Iterator<Item = (u64, &[u32])> {
        let cell = self.cell_of(at);
        [cell - self.stride, cell, cell + self.stride].into_iter().map(|cell| {
            let marks = self.marks[cell - 1] | self.marks[cell] | self.marks[cell + 1];
            (marks, &self.order[self.starts[cell - 1] as usize..self.starts[cell + 2] as usize])
        })
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        4 * (self.starts.capacity() + self.order.capacity()) + size_of::<u64>() * self.marks.capacity()
    }

    #[inline(always)]
    fn cell_of(&self, at: Vec2) -> usize {
        let along = |at: f32, most: usize| ((at / self.width) as usize + 1).min(most - 2);
        along(at.y, self.rows) * self.stride + along(at.x, self.stride)
    }
}
