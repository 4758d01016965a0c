//! Lumps that are sorted into cells, so that what is near stands together.

use super::grid::HeatGrid;
use glam::Vec2;
use std::ops::Range;

/// Lumps in the order of their cells, an entry a lump.
#[derive(Clone, Debug, Default)]
pub(super) struct Sorted {
    /// Where they are, d.
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    pub cell: Vec<u32>,
    /// Where they come from.
    pub source: Vec<u32>,
    /// The first lump of each cell, and the end.
    starts: Vec<u32>,
}

impl Sorted {
    /// Number of lumps.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Sorts lumps into so many cells: cell, place (d) and source. In each cell they keep their order.
    pub fn sort(&mut self, cells: usize, lumps: impl Iterator<Item = (usize, Vec2, u32)> + Clone) {
        self.starts.clear();
        self.starts.resize(cells + 2, 0);
        lumps.clone().for_each(|(cell, ..)| self.starts[cell + 2] += 1);
        for cell in 2..cells + 2 {
            self.starts[cell] += self.starts[cell - 1];
        }
        let count = self.starts[cells + 1] as usize;
        self.x.resize(count, 0.0);
        self.y.resize(count, 0.0);
        self.cell.resize(count, 0);
        self.source.resize(count, 0);
        lumps.for_each(|(cell, at, source)| {
            let next = &mut self.starts[cell + 1];
            let k = *next as usize;
            *next += 1;
            (self.x[k], self.y[k]) = (at.x, at.y);
            (self.cell[k], self.source[k]) = (cell as u32, source);
        });
        // Filling moved each start to the end of its cell.
        self.starts.truncate(cells + 1);
    }

    /// Forgets all of them.
    pub fn clear(&mut self) {
        [&mut self.x, &mut self.y].into_iter().for_each(Vec::clear);
        [&mut self.cell, &mut self.source].into_iter().for_each(Vec::clear);
        self.starts.clear();
    }

    /// The lumps of some cells.
    #[inline(always)]
    pub fn of(&self, cells: Range<usize>) -> Range<usize> {
        self.starts[cells.start] as usize..self.starts[cells.end] as usize
    }

    /// The cells with lumps.
    pub fn cells(&self) -> impl Iterator<Item = usize> {
        self.starts.windows(2).enumerate().filter(|(_, ends)| ends[0] < ends[1]).map(|(cell, _)| cell)
    }

    /// The end of the lumps in a cell's row of cells.
    #[inline(always)]
    pub fn row_end(&self, grid: &HeatGrid, cell: usize) -> usize {
        self.starts[grid.first_of(grid.row(cell) + 1)] as usize
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { x, y, cell, source, starts } = self;
        4 * (x.capacity() + y.capacity() + cell.capacity() + source.capacity() + starts.capacity())
    }
}
