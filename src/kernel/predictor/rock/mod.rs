//! What rock closes: how much of each face is open, and how much of each cell's neighbourhood is rock.

mod close;
#[cfg(test)]
mod tests;

use crate::{
    predictor::{
        behind::MakeUp,
        grid::{MacGrid, Window},
        outline::Outline,
        pockets::ROUNDING,
        slivers::Sliver,
        stencil::Axis,
    },
    solids::Solids,
};
use glam::{IVec2, Vec2};

/// How far a cell's fields go by what rock leaves of other cells: what is shut goes by those around it, rock is left out that
/// reaches what is shut only, its share is smeared over those around it, and slivers and what is behind walls go by the cells
/// beside them.
const GOES_BY: usize = 5;

/// Rock as the grid sees it; follows the rock's shape. Rows that are like the one below share its place in the fields
/// ([`ClosedFaces::row`]), so that a box without rock costs next to nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct ClosedFaces {
    /// The grid, the shape of the rock, and where gravity pulls most.
    built_for: Option<(MacGrid, u64, IVec2)>,
    /// Where the rock stands.
    outline: Outline,
    /// Where each row of the grid stands in the fields.
    rows: Vec<u32>,
    /// Open share of the left face of each cell.
    pub open_u: Vec<f32>,
    /// Open share of the lower face of each cell.
    pub open_v: Vec<f32>,
    /// Share of rock around each cell, smeared as the liquid's density is, 0 … 1; 1 in the padding.
    pub rock: Vec<f32>,
    /// Of the rock of the two cells beside each left face, what stands to its right.
    right_of_u: Vec<f32>,
    /// Of the rock of the two cells beside each lower face, what stands above it.
    above_v: Vec<f32>,
    /// Share of each cell from which it is liquid, its rock counted in; infinite where there is nothing to solve.
    pub liquid_from: Vec<f32>,
    /// Cells beside a wall, those of the grid's index in order: a face of theirs is closed, or a part of it.
    pub beside_walls: Vec<u32>,
    /// Those that go by other cells, in the order of the grid's index.
    pub slivers: Vec<Sliver>,
    /// Other cells with room behind a thin wall, likewise.
    pub behind: Vec<MakeUp>,
}

impl ClosedFaces {
    /// Follows the rock and gravity.
    pub fn update(&mut self, grid: &MacGrid, solids: &Solids, gravity: Vec2) {
        let is_across = gravity.x.abs() > gravity.y.abs();
        let most = if is_across { Vec2::new(gravity.x, 0.0) } else { Vec2::new(0.0, gravity.y) };
        let down = IVec2::new(sign(most.x), sign(most.y));
        let now = (*grid, solids.shape(), down);
        if self.built_for == Some(now) {
            return;
        }
        let changed = self.outline.follow(solids);
        let is_like = |(was, _, then): (MacGrid, u64, IVec2)| (was, then) == (*grid, down);
        let window = match changed {
            _ if !self.built_for.is_some_and(is_like) => Some(grid.all()),
            Some(sites) => Some(grid.widened(&grid.window(sites), GOES_BY)),
            None => None,
        };
        if let Some(window) = window {
            let fresh = Self::built(grid, solids, down, &grid.widened(&window, GOES_BY));
            self.take(grid, &window, fresh);
        }
        self.built_for = Some(now);
    }

    /// Against gravity, along the axis on which it pulls most; 0 without any.
    pub fn up(&self) -> IVec2 {
        self.built_for.map_or(IVec2::ZERO, |(_, _, down)| -down)
    }

    /// Index of cell (0, j) in the fields.
    #[inline(always)]
    pub fn row(&self, j: usize) -> usize {
        self.rows[j] as usize
    }

    /// The rock around the faces `first … first + n` of a row.
    #[inline(always)]
    pub fn beside(&self, grid: &MacGrid, axis: Axis, first: usize, n: usize) -> Beside<'_> {
        let (j, column) = (first / grid.stride, first % grid.stride);
        let own = self.row(j) + column;
        let (before, after) = match axis {
            Axis::U => (own - 1, &self.right_of_u),
            Axis::V => (self.row(j - 1) + column, &self.above_v),
        };
        let rock = [before, own].map(|at| &self.rock[at..at + n]);
        Beside { rock, after: &after[own..own + n] }
    }

    /// Whether any of a cell's faces is closed, or a part of it.
    #[inline(always)]
    pub fn has_wall(&self, grid: &MacGrid, k: usize) -> bool {
        let [own, above] = [k, k + grid.stride].map(|k| self.row(k / grid.stride) + k % grid.stride);
        let open = self.open_u[own] + self.open_u[own + 1] + self.open_v[own] + self.open_v[above];
        open < 4.0 - ROUNDING
    }

    /// Away from the closed faces of a cell: the difference of the open shares along x and along y.
    #[inline(always)]
    pub fn away(&self, grid: &MacGrid, k: usize) -> Vec2 {
        let [own, above] = [k, k + grid.stride].map(|k| self.row(k / grid.stride) + k % grid.stride);
        Vec2::new(self.open_u[own + 1] - self.open_u[own], self.open_v[above] - self.open_v[own])
    }

    fn fields(&self) -> [&Vec<f32>; 6] {
        let Self { open_u, open_v, rock, right_of_u, above_v, liquid_from, .. } = self;
        [open_u, open_v, rock, right_of_u, above_v, liquid_from]
    }

    fn fields_mut(&mut self) -> [&mut Vec<f32>; 6] {
        let Self { open_u, open_v, rock, right_of_u, above_v, liquid_from, .. } = self;
        [open_u, open_v, rock, right_of_u, above_v, liquid_from]
    }

    /// Takes what is in a window from others whose rows stand one by one. Rows that are like the one below them are stored only once.
    fn take(&mut self, grid: &MacGrid, window: &Window, fresh: Self) {
        if *window == grid.all() {
            // There may be nothing yet, or another grid's.
            *self = Self { outline: std::mem::take(&mut self.outline), ..Self::default() };
        }
        let mut merged: [Vec<f32>; 6] = Default::default();
        let mut rows = Vec::with_capacity(grid.rows + 3);
        let mut row = vec![0.0; grid.stride];
        let mut stored = 0;
        for j in 0..grid.rows + 3 {
            let own = self.rows.get(j).map(|own| *own as usize);
            for ((merged, old), new) in merged.iter_mut().zip(self.fields()).zip(fresh.fields()) {
                if let Some(own) = own {
                    row.copy_from_slice(&old[own..own + grid.stride]);
                }
                if window.rows.contains(&j) {
                    let columns = window.columns.clone();
                    row[columns.clone()].copy_from_slice(&new[grid.row(j)..][columns]);
                }
                merged.extend_from_slice(&row);
            }
            let next = stored + grid.stride;
            if j > 0 && merged.iter().all(|field| field[stored..next] == field[next..]) {
                merged.iter_mut().for_each(|field| field.truncate(next));
            } else if j > 0 {
                stored = next;
            }
            rows.push(stored as u32);
        }
        self.rows = rows;
        for (field, mut merged) in self.fields_mut().into_iter().zip(merged) {
            // What is to the right of the last row is read in lanes, and counts for nothing.
            merged.push(0.0);
            *field = merged;
            field.shrink_to_fit();
        }
        let is_old = |cell: u32| !window.has(grid, cell as usize);
        let Self { beside_walls, slivers, behind, .. } = self;
        beside_walls.retain(|cell| is_old(*cell));
        beside_walls.extend(fresh.beside_walls.iter().filter(|cell| !is_old(**cell)));
        beside_walls.sort_unstable();
        slivers.retain(|sliver| is_old(sliver.cell));
        slivers.extend(fresh.slivers.iter().filter(|sliver| !is_old(sliver.cell)));
        slivers.sort_unstable_by_key(|sliver| sliver.cell);
        behind.retain(|one| is_old(one.cell));
        behind.extend(fresh.behind.iter().filter(|one| !is_old(one.cell)));
        behind.sort_unstable_by_key(|one| one.cell);
        beside_walls.shrink_to_fit();
        slivers.shrink_to_fit();
        behind.shrink_to_fit();
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let fields = [&self.open_u, &self.open_v, &self.rock, &self.right_of_u, &self.above_v, &self.liquid_from];
        4 * (fields.map(Vec::capacity).iter().sum::<usize>() + self.rows.capacity() + self.beside_walls.capacity())
            + self.outline.memory()
            + size_of::<Sliver>() * self.slivers.capacity()
            + size_of::<MakeUp>() * self.behind.capacity()
    }
}

/// The rock around some faces of a row.
#[derive(Clone, Copy)]
pub(super) struct Beside<'a> {
    /// Share of rock of the cells before the faces, and of those after them.
    pub rock: [&'a [f32]; 2],
    /// Of both, what stands after the face.
    pub after: &'a [f32],
}

/// −1, 0 or 1.
fn sign(number: f32) -> i32 {
    i32::from(number > 0.0) - i32::from(number < 0.0)
}
