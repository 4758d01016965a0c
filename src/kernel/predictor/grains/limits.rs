//! How much stress grains can bear: Coulomb's law, from what presses them together, and cohesion.

use crate::{
    parallel::{Rows, Sweep},
    predictor::{
        equation::steepness,
        grains::{bed::Bed, fields::Fields, near::Near, spread::Spread},
        stencil::Axis,
        transfer::Faces,
    },
};
use std::ops::Range;

/// By how much more what has not moved holds, and the strain of a substep, in g Δt a cell, at which that has ended.
const AT_REST: (f32, f32) = (0.1, 0.5);

/// Finds the pressure of the grains in each cell, and what they press walls with; in cells without pressure beside others that
/// which is 0 at the surface.
pub(super) struct FindPressures<'a> {
    pub bed: &'a Bed<'a>,
    pub near: &'a Near,
    pub faces: &'a Faces,
    pub spread: Spread<'a>,
    pub pressure: &'a [f32],
    /// Pressure of the water between grains, d/s.
    pub pore: &'a [f32],
}

impl<'b> Sweep<(Rows<'b, f32>, Rows<'b, f32>)> for FindPressures<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut pressed, mut at_wall): (Rows<f32>, Rows<f32>)) {
        let Self { bed, near, faces, spread, pressure: p, pore } = self;
        let (grid, stride) = (bed.grid, bed.grid.stride);
        for (j, (pressed, at_wall)) in rows.zip(pressed.each().zip(at_wall.each())) {
            for columns in near.runs(j) {
                for column in columns {
                    let k = grid.row(j) + column;
                    // Each side's cell, and the face to it.
                    let sides = [
                        (k - 1, Axis::U, k),
                        (k + 1, Axis::U, k + 1),
                        (k - stride, Axis::V, k),
                        (k + stride, Axis::V, k + stride),
                    ];
                    if bed.is_liquid(k) {
                        let open = sides.iter().filter(|(_, axis, face)| bed.open(*axis, *face) > 0.0);
                        let least = open.fold(p[k], |least, (other, ..)| least.min(p[*other]));
                        let own = spread.bears(grid, k);
                        pressed[column] = (own * (p[k] - pore[k])).max(0.0);
                        at_wall[column] = (own * (p[k] - pore[k] + 0.5 * (p[k] - least))).max(0.0);
                        continue;
                    }
                    let (mut sum, mut count) = (0.0, 0.0);
                    for (other, axis, face) in sides.into_iter().filter(|(other, ..)| bed.is_liquid(*other)) {
                        let (mut steep, before) = ([1.0], face - axis.step(grid));
                        let [liquid, filled] =
                            [bed.liquid, &faces.filled].map(|field| [before, face].map(|k| &field[k..=k]));
                        steepness(&mut steep, liquid, filled, bed.closed.beside(grid, axis, face, 1));
                        sum += p[other] * (1.0 - steep[0]);
                        count += 1.0;
                    }
                    (pressed[column], at_wall[column]) = (if count > 0.0 { sum / count } else { 0.0 }, 0.0);
                }
            }
        }
    }
}

/// Finds the most stress that cells and corners can have, and which corners are away from walls (1).
pub(super) struct FindLimits<'a> {
    pub bed: &'a Bed<'a>,
    pub near: &'a Near,
    pub spread: Spread<'a>,
    /// What grains press one another and walls with, d/s.
    pub pressed: &'a Fields,
    /// S of the last substep, d/s.
    pub along: &'a [f32],
    /// How much was strained in it, d/s a cell.
    pub strain: &'a Fields,
    /// More than 0 in corners that take part.
    pub takes_part: &'a [f32],
}

impl<'b> Sweep<((Rows<'b, f32>, Rows<'b, f32>), Rows<'b, f32>)> for FindLimits<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((mut cells, mut corners), mut inner): ((Rows<f32>, Rows<f32>), Rows<f32>)) {
        let Self { bed, near, spread, pressed: [pressed, at_wall], along, strain, takes_part } = self;
        let (grid, stride) = (bed.grid, bed.grid.stride);
        let ended = AT_REST.1 * bed.kick.length();
        // Without gravity nothing rests on anything.
        let holds = |strain: f32| 1.0 + if strain < ended { AT_REST.0 * (1.0 - strain / ended) } else { 0.0 };
        for (j, ((cells, corners), inner)) in rows.zip(cells.each().zip(corners.each()).zip(inner.each())) {
            for columns in near.runs(j) {
                for column in columns {
                    let k = grid.row(j) + column;
                    let (sine, bond) = (spread.sine(grid, k), spread.bond(grid, k));
                    cells[column] = if bed.is_liquid(k) { sine * pressed[k] * holds(strain[0][k]) + bond } else { 0.0 };
                    if takes_part[k] == 0.0 {
                        (corners[column], inner[column]) = (0.0, 0.0);
                        continue;
                    }
                    let (mut inside, mut outside, mut count) = (0.0, 0.0, 0.0);
                    for cell in [k, k - 1, k - stride, k - stride - 1] {
                        if bed.is_wall(cell) {
                            continue;
                        }
                        let is_beside = !bed.is_wall(cell + stride) && !bed.is_wall(cell - stride);
                        let is_above = !bed.is_wall(cell + 1) && !bed.is_wall(cell - 1);
                        let normal = match (is_beside, is_above) {
                            (true, _) => -along[cell],
                            (false, true) => along[cell],
                            _ => 0.0,
                        };
                        inside += pressed[cell];
                        outside += (at_wall[cell] + normal).max(0.0);
                        count += 1.0;
                    }
                    let is_inner = count == 4.0;
                    let presses = if is_inner { 0.25 * inside } else { outside / f32::max(count, 1.0) };
                    // What holds grains together does not hold them to walls.
                    let bond = if is_inner { bond } else { 0.0 };
                    corners[column] = sine * presses.max(0.0) * holds(strain[1][k]) + bond;
                    inner[column] = if is_inner { 1.0 } else { 0.0 };
                }
            }
        }
    }
}
