//! The pressure at any place, as the last solve left it.

use crate::predictor::{
    equation::steepness, grid::MacGrid, pressure::beside, rock::ClosedFaces, stencil::Axis, steps::Predictor,
};
use glam::Vec2;

/// Pressure, liquid cells and walls of a solve.
struct Field<'a> {
    grid: &'a MacGrid,
    closed: &'a ClosedFaces,
    /// 1 in liquid cells, else 0.
    liquid: &'a [f32],
    /// How full the cells are.
    filled: &'a [f32],
    /// Pressure, d/s; 0 where there is no liquid.
    pressure: &'a [f32],
}

impl Predictor {
    /// Pressure over that of the surroundings at a place (d) after a substep of `dt` s, over the density of the heaviest matter
    /// there is, d²/s². `None` where neither the cell of the place nor one beside it is liquid.
    ///
    /// Between the centres of liquid cells it is bilinear. Towards a surface it falls to 0 where the solve has the surface, and
    /// towards a wall it goes on as on the other side of the cell: in water at rest both are exact.
    pub fn pressure_at(&self, at: Vec2, dt: f32) -> Option<f32> {
        let (field, cell) = (self.field()?, self.cell());
        let place = at / cell;
        let k = field.nearest_liquid(place)?;
        let offset = place - field.centre(k);
        Some(field.value(k, offset).max(0.0) * cell / dt)
    }

    fn field(&self) -> Option<Field<'_>> {
        let (grid, closed, faces, conjugate) = self.solved()?;
        let (liquid, filled, pressure) = (&conjugate.liquid[..], &faces.filled[..], &conjugate.solution[..]);
        let is_whole = [liquid, filled, pressure].iter().all(|field| field.len() == grid.len());
        is_whole.then_some(Field { grid, closed, liquid, filled, pressure })
    }
}

impl Field<'_> {
    fn is_wet(&self, k: usize) -> bool {
        self.liquid[k] > 0.0
    }

    /// Centre of a cell, cells.
    fn centre(&self, k: usize) -> Vec2 {
        Vec2::new((k % self.grid.stride) as f32, (k / self.grid.stride) as f32) - 0.5
    }

    /// The cell of a place (cells) if it is liquid, or the nearest beside it that is.
    fn nearest_liquid(&self, place: Vec2) -> Option<usize> {
        let MacGrid { columns, rows, stride, .. } = *self.grid;
        let index = |at: f32, cells: usize| (at.max(0.0) as usize + 1).min(cells);
        let k = self.grid.row(index(place.y, rows)) + index(place.x, columns);
        if self.is_wet(k) {
            return Some(k);
        }
        let distance = |k: usize| (place - self.centre(k)).length_squared();
        let beside = [k - stride, k - 1, k + 1, k + stride].into_iter().filter(|k| self.is_wet(*k));
        beside.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
    }

    /// Pressure at `offset` (cells) from the centre of liquid cell `k`, d/s.
    fn value(&self, k: usize, offset: Vec2) -> f32 {
        let (own, [s, t]) = (self.pressure[k], offset.abs().to_array());
        let step = |way: f32, step: usize| if way < 0.0 { k.wrapping_sub(step) } else { k + step };
        let (across, along) = (step(offset.x, 1), step(offset.y, self.grid.stride));
        let corner = (across + along).wrapping_sub(k);
        if s <= 1.0 && t <= 1.0 && [across, along, corner].iter().all(|k| self.is_wet(*k)) {
            let [across, along, corner] = [across, along, corner].map(|k| self.pressure[k]);
            let (near, far) = (own + s * (across - own), along + s * (corner - along));
            return near + t * (far - near);
        }
        own + self.change(k, Axis::U, offset.x) + self.change(k, Axis::V, offset.y)
    }

    /// By how much the pressure changes from the centre of liquid cell `k` by so many cells along an axis, d/s.
    fn change(&self, k: usize, axis: Axis, way: f32) -> f32 {
        let (after, distance) = (way >= 0.0, way.abs());
        let slope = self.slope(k, axis, after).or_else(|| self.slope(k, axis, !after).map(|slope| -slope));
        distance * slope.unwrap_or(0.0)
    }

    /// By how much the pressure changes in a cell's breadth towards one side of liquid cell `k`, d/s; `None` if that is closed.
    fn slope(&self, k: usize, axis: Axis, after: bool) -> Option<f32> {
        let step = axis.step(self.grid);
        let (next, face) = if after { (k + step, k + step) } else { (k - step, k) };
        if self.is_wet(next) {
            return Some(self.pressure[next] - self.pressure[k]);
        }
        let open = if axis == Axis::U { &self.closed.open_u } else { &self.closed.open_v };
        if open[self.closed.row(face / self.grid.stride) + face % self.grid.stride] <= 0.0 {
            return None;
        }
        let mut steep = [0.0];
        let of = |field| beside(field, face, 1, step);
        steepness(&mut steep, of(self.liquid), of(self.filled), self.closed.beside(self.grid, axis, face, 1));
        Some(-steep[0] * self.pressure[k])
    }
}
