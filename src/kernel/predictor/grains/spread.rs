//! Where grains are.

use crate::predictor::{grains::bed::Bed, grid::MacGrid, stencil::Axis};
use std::ops::Range;

/// Share of the particles of a cell that are grains from which on they touch, and that from which on they bear all.
const TOUCHING: [f32; 2] = [0.3, 0.7];

/// Where grains are among all particles.
#[derive(Clone, Copy)]
pub(super) struct Spread<'a> {
    /// At left and lower faces: number of grains (as weights), and that times sin φ.
    pub grains: &'a [Vec<[f32; 2]>; 2],
    /// The same with the stress that they bear without pressure (d/s) in place of sin φ, if any does.
    pub bound: Option<&'a [Vec<[f32; 2]>; 2]>,
    /// Number of all particles (as weights).
    pub all: [&'a [[f32; 2]]; 2],
}

impl Spread<'_> {
    /// Whether grains reach any of some left or lower faces.
    #[inline(always)]
    pub fn any(&self, faces: Range<usize>) -> bool {
        self.grains.iter().any(|of| of[faces.clone()].iter().fold(false, |any, face| any | (face[0] > 0.0)))
    }

    /// Whether grains touch in any of some cells side by side that have a pressure.
    #[inline(always)]
    pub fn any_touch(&self, bed: &Bed, mut cells: Range<usize>) -> bool {
        cells.any(|k| bed.is_liquid(k) && self.bears(bed.grid, k) > 0.0)
    }

    /// Mean sin φ around a cell or its lower left corner; 0 where no grain is.
    #[inline(always)]
    pub fn sine(&self, grid: &MacGrid, k: usize) -> f32 {
        mean(self.grains, grid, k)
    }

    /// Mean stress (d/s) around a cell or its lower left corner that grains bear without pressure; 0 where they do not touch.
    #[inline(always)]
    pub fn bond(&self, grid: &MacGrid, k: usize) -> f32 {
        self.bound.map_or(0.0, |bound| mean(bound, grid, k) * self.bears(grid, k))
    }

    /// How much of the pressure of a cell its grains bear: none where they do not touch.
    #[inline(always)]
    pub fn bears(&self, grid: &MacGrid, k: usize) -> f32 {
        let (mut grains, mut all) = (0.0, 0.0);
        for (axis, face) in sides(grid, k) {
            grains += self.grains[axis as usize][face][0];
            all += self.all[axis as usize][face][0];
        }
        let share = if all > 0.0 { grains / all } else { 0.0 };
        let share = (share - TOUCHING[0]) / (TOUCHING[1] - TOUCHING[0]);
        let share = if share > 0.0 { share } else { 0.0 };
        if share < 1.0 { share } else { 1.0 }
    }
}

/// Mean of what grains have around a cell or its lower left corner; 0 where no grain is.
#[inline(always)]
fn mean(of: &[Vec<[f32; 2]>; 2], grid: &MacGrid, k: usize) -> f32 {
    let (mut weight, mut sum) = (0.0, 0.0);
    for (axis, face) in sides(grid, k) {
        let at = of[axis as usize][face];
        (weight, sum) = (weight + at[0], sum + at[1]);
    }
    if weight > 0.0 { sum / weight } else { 0.0 }
}

/// The faces of a cell.
#[inline(always)]
fn sides(grid: &MacGrid, k: usize) -> [(Axis, usize); 4] {
    [(Axis::U, k), (Axis::U, k + 1), (Axis::V, k), (Axis::V, k + grid.stride)]
}
