//! The air at any point: what particles feel.

use super::grid::Air;
use glam::Vec2;

/// The four cells around a point and how much of each.
pub(super) struct Stencil {
    /// Lower left cell, in the fields.
    pub(super) k: usize,
    /// Share of those on the right.
    pub(super) x: f32,
    /// Share of the upper ones.
    pub(super) y: f32,
}

impl Stencil {
    /// The four cells, in the fields, and how much of each.
    #[inline(always)]
    pub(super) fn corners(&self, stride: usize) -> [(usize, f32); 4] {
        let (left, lower) = (1.0 - self.x, 1.0 - self.y);
        [
            (self.k, left * lower),
            (self.k + 1, self.x * lower),
            (self.k + stride, left * self.y),
            (self.k + stride + 1, self.x * self.y),
        ]
    }

    /// Blend of the lower two cells and the upper two, each from left to right.
    #[inline(always)]
    pub(super) fn mix(&self, low: [f32; 2], high: [f32; 2]) -> f32 {
        mix(mix(low[0], low[1], self.x), mix(high[0], high[1], self.x), self.y)
    }
}

/// Blend that is exact at both ends.
#[inline(always)]
fn mix(a: f32, b: f32, part: f32) -> f32 {
    a * (1.0 - part) + b * part
}

/// A coordinate in cells from the first centre: the cell at or below it and how far beyond. `max` and `min` also turn
/// what is no number into 0.
#[inline(always)]
pub(super) fn split(at: f32, per_cell: f32, last: f32) -> (usize, f32) {
    let at = (at * per_cell - 0.5).max(0.0).min(last);
    let whole = at as u32;
    (whole as usize, at - whole as f32)
}

impl Air {
    #[inline(always)]
    pub(super) fn stencil(&self, x: f32, y: f32, per_cell: f32) -> Stencil {
        let (column, x) = split(x, per_cell, (self.columns - 1) as f32);
        let (row, y) = split(y, per_cell, (self.rows - 1) as f32);
        Stencil { k: self.index(column, row), x, y }
    }

    #[inline(always)]
    pub(super) fn blend(&self, field: &[f32], at: &Stencil) -> f32 {
        let (low, high) = (&field[at.k..at.k + 2], &field[at.k + self.stride()..at.k + self.stride() + 2]);
        at.mix([low[0], low[1]], [high[0], high[1]])
    }

    /// Velocity at a point (d), d/s: bilinear between cell centres, and that of the nearest centre line beyond the
    /// outermost centres. Rock counts as air at rest.
    pub fn sample_velocity(&self, p: Vec2) -> Vec2 {
        if !self.is_built() {
            return Vec2::ZERO;
        }
        let at = self.stencil(p.x, p.y, 1.0 / self.cell);
        Vec2::new(self.blend(&self.velocity_x, &at), self.blend(&self.velocity_y, &at))
    }

    /// [`Air::sample_velocity`] at many points, with the same bits.
    pub fn sample_velocities(&self, x: &[f32], y: &[f32], out_u: &mut [f32], out_v: &mut [f32]) {
        debug_assert!(x.len() == y.len() && x.len() == out_u.len() && x.len() == out_v.len());
        if !self.is_built() {
            out_u.fill(0.0);
            out_v.fill(0.0);
            return;
        }
        let per_cell = 1.0 / self.cell;
        for (((x, y), u), v) in x.iter().zip(y).zip(out_u).zip(out_v) {
            let at = self.stencil(*x, *y, per_cell);
            *u = self.blend(&self.velocity_x, &at);
            *v = self.blend(&self.velocity_y, &at);
        }
    }
}
