//! Rock: fixed particles that stand on the sites of the square lattice of spacing d, one site a cell.
//!
//! A cell with rock is solid as a whole, `[i, i+1) × [j, j+1)` in d. Water collides with the cells (`sweep`), and
//! the solver reads the particles at their centres for density.

use crate::kernel::element::ElementId;
use glam::{IVec2, Vec2};
use serde::{Deserialize, Serialize};

const EMPTY: u8 = u8::MAX;

/// Which cells of the box are rock. Cells outside the box count as solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solids {
    columns: i32,
    rows: i32,
    element: Vec<u8>,
    id: Vec<u32>,
    count: usize,
    version: u64,
}

impl Solids {
    /// A box of `columns × rows` cells without rock.
    pub fn new(columns: u32, rows: u32) -> Self {
        let cells = columns as usize * rows as usize;
        Self {
            columns: columns as i32,
            rows: rows as i32,
            element: vec![EMPTY; cells],
            id: vec![0; cells],
            count: 0,
            version: 0,
        }
    }

    /// Cells along x.
    pub fn columns(&self) -> i32 {
        self.columns
    }

    /// Cells along y.
    pub fn rows(&self) -> i32 {
        self.rows
    }

    /// Number of rock particles.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Changes with every change of the rock, so that what is derived from it knows when to follow.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The cell of a point in d.
    pub fn cell_of(position: Vec2) -> IVec2 {
        IVec2::new(position.x.floor() as i32, position.y.floor() as i32)
    }

    /// Whether the cell is in the box.
    pub fn contains(&self, cell: IVec2) -> bool {
        cell.x >= 0 && cell.y >= 0 && cell.x < self.columns && cell.y < self.rows
    }

    fn index(&self, cell: IVec2) -> Option<usize> {
        self.contains(cell).then(|| cell.y as usize * self.columns as usize + cell.x as usize)
    }

    /// Whether water and air can't be there: rock, or outside the box.
    pub fn is_solid(&self, cell: IVec2) -> bool {
        self.index(cell).is_none_or(|k| self.element[k] != EMPTY)
    }

    /// The rock in the cell: its element and id.
    pub fn get(&self, cell: IVec2) -> Option<(ElementId, u32)> {
        let k = self.index(cell)?;
        (self.element[k] != EMPTY).then(|| (ElementId(self.element[k]), self.id[k]))
    }

    /// Puts rock into a free cell of the box; `false` if the cell is taken or outside.
    pub fn insert(&mut self, cell: IVec2, element: ElementId, id: u32) -> bool {
        let Some(k) = self.index(cell) else { return false };
        if self.element[k] != EMPTY {
            return false;
        }
        self.element[k] = element.0;
        self.id[k] = id;
        self.count += 1;
        self.version += 1;
        true
    }

    /// Takes the rock out of the cell; `false` if there was none.
    pub fn remove(&mut self, cell: IVec2) -> bool {
        let Some(k) = self.index(cell) else { return false };
        if self.element[k] == EMPTY {
            return false;
        }
        self.element[k] = EMPTY;
        self.count -= 1;
        self.version += 1;
        true
    }

    /// All rock, row by row from the bottom: cell, element, id.
    pub fn iter(&self) -> impl Iterator<Item = (IVec2, ElementId, u32)> + '_ {
        self.element.iter().enumerate().filter(|(_, element)| **element != EMPTY).map(|(k, element)| {
            let cell = IVec2::new(k as i32 % self.columns, k as i32 / self.columns);
            (cell, ElementId(*element), self.id[k])
        })
    }
}

/// Centre of a cell, d: where its rock particle stands.
pub fn centre(cell: IVec2) -> Vec2 {
    cell.as_vec2() + Vec2::splat(0.5)
}
