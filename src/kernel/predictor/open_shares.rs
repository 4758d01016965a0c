//! How much of a face rock leaves open.

use crate::{
    predictor::{
        grid::MacGrid,
        parts::{Parts, Room},
    },
    solids::Solids,
};
use glam::IVec2;

/// A face that is less open than this is closed: the equation would be stiff, and nothing passes.
const LEAST_OPEN: f32 = 0.1;
/// Half the length of the lines from cell centre to cell centre, cells.
pub(super) const TO_CENTRES: f32 = 0.5;

/// Finds how much of a face is open.
pub(super) struct OpenShares<'a> {
    pub grid: &'a MacGrid,
    pub solids: &'a Solids,
    pub parts: &'a Parts,
    /// Share of the left faces of each row, and of the lower ones of each column, where there is no rock: 1, but for rounding.
    free: [Vec<f32>; 2],
}

impl<'a> OpenShares<'a> {
    pub fn new(grid: &'a MacGrid, solids: &'a Solids, parts: &'a Parts) -> Self {
        let mut shares = Self { grid, solids, parts, free: [Vec::new(), Vec::new()] };
        let free = |index: usize| shares.share(grid.edge(index), |_, _| false, |_, _| true, (0.0, 0.0));
        shares.free = [grid.rows, grid.columns].map(|count| (0..=count).map(free).collect());
        shares
    }

    /// Of a face between two cells, if it is plain from what rock leaves of them.
    fn plain(&self, cells: [usize; 2], free: f32) -> Option<f32> {
        match cells.map(|k| self.parts.room(k)) {
            [Room::All, Room::All] => Some(free),
            [Room::None, _] | [_, Room::None] => Some(0.0),
            _ => None,
        }
    }

    /// Of the left face of cell `k`, by lines that reach so far (cells) to either side.
    pub fn left(&self, k: usize, reach: f32) -> f32 {
        if let Some(share) = self.plain([k - 1, k], self.free[0][k / self.grid.stride]) {
            return share;
        }
        let solid = |along, across| self.solids.is_solid(IVec2::new(across, along));
        let joins = |along, [before, after]: [i32; 2]| {
            self.parts.has(k - 1, IVec2::new(before, along)) && self.parts.has(k, IVec2::new(after, along))
        };
        let [x, y] = self.corner(k);
        self.share(y, solid, joins, (x, reach))
    }

    /// Of the lower face of cell `k`, likewise.
    pub fn lower(&self, k: usize, reach: f32) -> f32 {
        if let Some(share) = self.plain([k - self.grid.stride, k], self.free[1][k % self.grid.stride]) {
            return share;
        }
        let solid = |along, across| self.solids.is_solid(IVec2::new(along, across));
        let joins = |along, [before, after]: [i32; 2]| {
            let below = k - self.grid.stride;
            self.parts.has(below, IVec2::new(along, before)) && self.parts.has(k, IVec2::new(along, after))
        };
        let [x, y] = self.corner(k);
        self.share(x, solid, joins, (y, reach))
    }

    /// Whether all that is rock in cell `k` leads through it across `way`.
    pub fn leads_through(&self, k: usize, way: IVec2) -> bool {
        let [columns, rows] = [k % self.grid.stride, k / self.grid.stride].map(|index| self.grid.sites(index));
        let at = |x: i32, y: i32| self.solids.is_solid(if way.y == 0 { IVec2::new(x, y) } else { IVec2::new(y, x) });
        let (across, along) = if way.y == 0 { (columns, rows) } else { (rows, columns) };
        across.into_iter().all(|x| along.clone().all(|y| at(x, y) == at(x, along.start)))
    }

    /// Lower left corner of cell `k`, d.
    fn corner(&self, k: usize) -> [f32; 2] {
        [k % self.grid.stride, k / self.grid.stride].map(|index| self.grid.edge(index))
    }

    /// Open share of a face that lies at `plane` across its normal and reaches from `start` one cell along itself: the
    /// share of the lines across it, `reach` cells to either side, that meet no rock and join the parts that the two cells
    /// stand for. A wall one particle thick closes every line, a lone rock only its own. `solid(along, across)` tells whether
    /// a rock cell is solid, `joins(along, [before, after])` whether those before and after the plane are in their cells'
    /// parts.
    fn share(
        &self,
        start: f32,
        solid: impl Fn(i32, i32) -> bool,
        joins: impl Fn(i32, [i32; 2]) -> bool,
        (plane, reach): (f32, f32),
    ) -> f32 {
        let MacGrid { cell, per_cell, .. } = *self.grid;
        let end = start + cell;
        let sides = [plane.ceil() as i32 - 1, plane.floor() as i32];
        let met = ((plane - reach * cell).floor() as i32).min(sides[0])
            ..((plane + reach * cell).ceil() as i32).max(sides[1] + 1);
        let mut open = 0.0;
        for along in start.floor() as i32..end.ceil() as i32 {
            let width = (end.min((along + 1) as f32) - start.max(along as f32)).max(0.0);
            let blocked = met.clone().any(|across| solid(along, across));
            open += if blocked || !joins(along, sides) { 0.0 } else { width };
        }
        let share = (open * per_cell).min(1.0);
        if share < LEAST_OPEN { 0.0 } else { share }
    }
}
