//! What is shared out beyond a wall of the box.

use crate::predictor::{grid::MacGrid, stencil::Axis};
use std::ops::Range;

/// The face that a share of matter at the face `(column, row)` belongs to, and the share: what was shared out beyond a wall of the box
/// belongs to this side of it, and a face on the wall sees only half of its surroundings.
pub(super) fn fold(grid: &MacGrid, axis: Axis, (column, row): (usize, usize), share: f32) -> (usize, usize, f32) {
    let (column, row, on_wall) = match axis {
        Axis::U => (column, row.clamp(1, grid.rows), column == 1 || column == grid.columns + 1),
        Axis::V => (column.clamp(1, grid.columns), row, row == 1 || row == grid.rows + 1),
    };
    (column, row, if on_wall { 2.0 * share } else { share })
}

/// What was shared out beyond a wall belongs to this side of it; a face on the wall sees only half of its surroundings.
/// `reached` are the rows that were shared out to, `across` the columns, with the padding.
pub(super) fn fold_at_walls(
    grid: &MacGrid,
    reached: Range<usize>,
    across: Range<usize>,
    u: &mut [[f32; 2]],
    v: &mut [[f32; 2]],
) {
    let fold = |faces: &mut [[f32; 2]], beyond: usize, onto: usize| {
        let [weight, momentum] = faces[beyond];
        faces[onto][0] += weight;
        faces[onto][1] += momentum;
    };
    let double = |face: &mut [f32; 2]| *face = face.map(|deposit| 2.0 * deposit);
    let (s, columns, rows) = (grid.stride, grid.columns, grid.rows);
    for i in across.clone() {
        if reached.start == 0 {
            fold(u, i, s + i);
        }
        if reached.end > rows + 1 {
            fold(u, (rows + 1) * s + i, rows * s + i);
        }
    }
    for j in reached.clone() {
        if across.start == 0 {
            fold(v, j * s, j * s + 1);
            double(&mut u[j * s + 1]);
        }
        if across.end == s {
            fold(v, j * s + columns + 1, j * s + columns);
            double(&mut u[j * s + columns + 1]);
        }
    }
    for wall in [1, rows + 1].into_iter().filter(|wall| reached.contains(wall)) {
        let cells = across.start.max(1)..across.end.min(columns + 1);
        v[wall * s..][cells].iter_mut().for_each(double);
    }
}
