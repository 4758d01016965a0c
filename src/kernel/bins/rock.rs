//! Rock, binned into the same cells as the particles, once for every change of it.

use crate::{
    bins::cells::CellGrid,
    solids::{Solids, centre},
};
use glam::Vec2;

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
        let mut keyed: Vec<(u32, Vec2)> = solids.iter().map(|(cell, ..)| (0, centre(cell))).collect();
        for (key, at) in &mut keyed {
            *key = grid.cell(at.x, at.y);
        }
        keyed.sort_by_key(|(key, _)| *key);
        self.starts.extend((0..=grid.cells() as u32).scan(0, |next, cell| {
            *next += keyed[*next..].iter().take_while(|(key, _)| *key < cell).count();
            Some(*next as u32)
        }));
        self.x.extend(keyed.iter().map(|(_, at)| at.x));
        self.y.extend(keyed.iter().map(|(_, at)| at.y));
    }

    /// Bytes held.
    pub(super) fn memory(&self) -> usize {
        4 * (self.x.capacity() + self.y.capacity() + self.starts.capacity())
    }
}
