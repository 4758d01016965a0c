//! Rock, binned into the same cells as the particles, once for every change of it.

use crate::{
    bins::{
        cells::CellGrid,
        group::{Group, Run},
    },
    solids::{Solids, centre},
};

/// Rock particles sorted by cell.
#[derive(Clone, Debug, Default)]
pub struct RockBins {
    built_for: Option<(CellGrid, u64)>,
    /// Position, d.
    pub x: Vec<f32>,
    /// Position, d.
    pub y: Vec<f32>,
    /// First entry of each cell and the one after the last; empty where there is no rock.
    pub(super) starts: Vec<u32>,
    /// Rock candidates of each group, one run a strip; empty where there is no rock.
    pub(super) runs: Vec<[Run; 3]>,
}

impl RockBins {
    /// Follows the rock and the cells.
    pub(super) fn follow(&mut self, grid: &CellGrid, solids: &Solids) {
        if self.built_for.replace((*grid, solids.shape())) == Some((*grid, solids.shape())) {
            return;
        }
        self.starts.clear();
        self.x.clear();
        self.y.clear();
        if solids.count() == 0 {
            return;
        }
        let rock = || solids.iter().map(|(cell, ..)| centre(cell)).map(|at| (grid.cell(at.x, at.y) as usize, at));
        self.starts.resize(grid.cells() + 1, 0);
        rock().for_each(|(cell, _)| self.starts[cell + 1] += 1);
        for cell in 0..grid.cells() {
            self.starts[cell + 1] += self.starts[cell];
        }
        let mut next = self.starts.clone();
        self.x.resize(solids.count(), 0.0);
        self.y.resize(solids.count(), 0.0);
        rock().for_each(|(cell, at)| {
            let place = next[cell] as usize;
            (self.x[place], self.y[place]) = (at.x, at.y);
            next[cell] += 1;
        });
    }

    /// Runs of rock that may touch any particle of a group.
    #[inline(always)]
    pub fn around(&self, group: &Group) -> [Run; 3] {
        self.runs.get(group.number as usize).copied().unwrap_or_default()
    }

    /// Bytes held.
    pub(super) fn memory(&self) -> usize {
        4 * (self.x.capacity() + self.y.capacity() + self.starts.capacity())
            + size_of::<[Run; 3]>() * self.runs.capacity()
    }
}
