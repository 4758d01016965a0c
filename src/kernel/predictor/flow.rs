//! What the liquid does around a place, as the last solve left it.

use crate::predictor::{
    grid::MacGrid,
    rock::ClosedFaces,
    stencil::{Axis, LANES, Stencils},
    transfer::Faces,
};
use glam::Vec2;
use std::array::from_fn;

/// The grid's velocity after the solve: on faces that particles reach, their mean velocity and what pressure changed of it. On
/// others nothing is known of it.
#[derive(Clone, Copy, Debug)]
pub struct Flow<'a> {
    grid: &'a MacGrid,
    closed: &'a ClosedFaces,
    faces: &'a Faces,
    /// Which cells are liquid (1); `None` if none is.
    liquid: Option<&'a [f32]>,
}

impl<'a> Flow<'a> {
    pub(super) fn new(grid: &'a MacGrid, closed: &'a ClosedFaces, faces: &'a Faces, liquid: Option<&'a [f32]>) -> Self {
        Self { grid, closed, faces, liquid }
    }

    /// The cell of a place (d).
    #[inline(always)]
    fn cell(&self, at: Vec2) -> usize {
        let cell = |at: f32, cells: usize| ((at * self.grid.per_cell) as usize + 1).min(cells);
        self.grid.row(cell(at.y, self.grid.rows)) + cell(at.x, self.grid.columns)
    }

    #[inline(always)]
    fn is_wet(&self, k: usize) -> bool {
        self.liquid.is_some_and(|liquid| liquid[k] > 0.0)
    }

    #[inline(always)]
    fn is_dry_wall(&self, k: usize) -> bool {
        !self.is_wet(k) && self.closed.has_wall(self.grid, k)
    }

    /// Whether any cell between the least and the most x and y of some places (d) is so ([`Self::is_beside_dry_wall`]).
    #[inline(always)]
    pub fn has_dry_wall(&self, [[left, right], [lower, upper]]: [[f32; 2]; 2]) -> bool {
        let (first, last) = (self.cell(Vec2::new(left, lower)), self.cell(Vec2::new(right, upper)));
        let (stride, across) = (self.grid.stride, last % self.grid.stride - first % self.grid.stride);
        (first..=last).step_by(stride).any(|row| (row..=row + across).any(|k| self.is_dry_wall(k)))
    }

    /// Whether the cell of a place (d) has no pressure, and a wall beside it.
    #[inline(always)]
    pub fn is_beside_dry_wall(&self, at: Vec2) -> bool {
        self.is_dry_wall(self.cell(at))
    }

    /// How far only a wall holds a particle at a place (d) that is pushed along `way` (of any length but 0): not at all except
    /// [beside a dry wall](Self::is_beside_dry_wall). As far as the wall is what it is pushed away from where a cell beside has
    /// pressure; 1 between walls, and where no pressure is near.
    #[inline(always)]
    pub fn held_by_wall(&self, at: Vec2, way: Vec2) -> f32 {
        let (k, stride) = (self.cell(at), self.grid.stride);
        if !self.is_dry_wall(k) {
            return 0.0;
        }
        let away = self.closed.away(self.grid, k);
        let is_near_pressure = [k - 1, k + 1, k - stride, k + stride].into_iter().any(|k| self.is_wet(k));
        if is_near_pressure && away != Vec2::ZERO { away.normalize().dot(way.normalize()).max(0.0) } else { 1.0 }
    }

    /// By how much the flow around some places (d) differs from the velocities of particles there, d/s: as far as it is known, between
    /// 0 and the whole difference.
    #[inline(always)]
    pub fn beside(&self, at: &[[f32; LANES]; 2], [vx, vy]: &[[f32; LANES]; 2]) -> [[f32; LANES]; 2] {
        [self.along(Axis::U, at, vx), self.along(Axis::V, at, vy)]
    }

    #[inline(always)]
    fn along(&self, axis: Axis, [x, y]: &[[f32; LANES]; 2], velocity: &[f32; LANES]) -> [f32; LANES] {
        let Self { grid, faces: Faces { u, v, ways, reached, area, .. }, liquid, .. } = *self;
        let mut difference = [0.0; LANES];
        if liquid.is_none() {
            return difference;
        }
        // Beyond the rows and columns that particles reached lies what is left from before.
        let (columns, stencils) = (grid.padded(area), Stencils::new(grid, x, y, axis));
        let is_reached: [bool; LANES] = from_fn(|lane| {
            let (column, row) = (axis.column(grid, x[lane]).0 as usize, axis.row(grid, y[lane]).0 as usize);
            let is_among = (columns.start <= column) & (column + 1 < columns.end);
            is_among & (reached.start <= row) & (row + 1 < reached.end)
        });
        let (means, ways) = (if axis == Axis::U { u } else { v }, &ways[axis as usize]);
        for (right, upper) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let (mut faces, mut gained) = ([[0.0; 2]; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                let face = stencils.corner[lane] as usize + right + upper * grid.stride;
                (faces[lane], gained[lane]) = (means[face], ways[face][0]);
            }
            for lane in 0..LANES {
                let share = |share: f32, is_far: usize| if is_far == 1 { share } else { 1.0 - share };
                let weight = share(stencils.right[lane], right) * share(stencils.upper[lane], upper);
                let [count, mean] = faces[lane];
                difference[lane] += if count > 0.0 { weight * (mean + gained[lane] - velocity[lane]) } else { 0.0 };
            }
        }
        from_fn(|lane| if is_reached[lane] { difference[lane] } else { 0.0 })
    }
}
