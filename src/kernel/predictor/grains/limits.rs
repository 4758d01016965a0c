//! How much stress grains can bear: Coulomb's law, from what presses them together, and cohesion.

use crate::{
    predictor::{
        equation::steepness,
        grains::{
            bed::{At, Bed, is_wall},
            cells::Cells,
            fields::Fields,
            spread::Spread,
        },
        stencil::Axis,
        transfer::Faces,
        wide::{load, store},
    },
    simd::each_lane,
};

/// By how much more what has not moved holds, and the strain of a substep, in g Δt a cell, at which that has ended.
const AT_REST: (f32, f32) = (0.1, 0.5);

/// Finds what grains in each cell press one another with, and what they press a wall beside it with; in cells without pressure beside
/// others that which is 0 at the surface, and nothing.
pub(super) struct FindPressures<'a> {
    pub faces: &'a Faces,
    pub spread: Spread<'a>,
    pub pressure: &'a [f32],
    /// Pressure of the water between grains, d/s.
    pub pore: &'a [f32],
    /// S of the last substep, d/s.
    pub along: &'a [f32],
}

impl Cells<2> for FindPressures<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, at: At, [pressed, at_wall]: &mut [&mut [f32]; 2]) {
        let At { row, column, k } = at;
        let liquid = load::<N>(bed.liquid, k);
        let [mut presses, mut presses_wall] = [[0.0; N]; 2];
        if liquid.iter().any(|liquid| *liquid > 0.0) {
            [presses, presses_wall] = self.within(bed, at);
        }
        if liquid.contains(&0.0) {
            let beside = self.beside::<N>(bed, k);
            for i in 0..N {
                presses[i] = if liquid[i] > 0.0 { presses[i] } else { beside[i] };
                presses_wall[i] = if liquid[i] > 0.0 { presses_wall[i] } else { 0.0 };
            }
        }
        let (along, own) = (load::<N>(self.along, k), bed.rock::<N>(row, column));
        let [left, right] = [column - 1, column + 1].map(|column| bed.rock::<N>(row, column));
        let [lower, upper] = [row - 1, row + 1].map(|row| bed.rock::<N>(row, column));
        let presses_wall = each_lane(|i| {
            let is_beside = !is_wall(upper[i]) & !is_wall(lower[i]);
            let is_above = !is_wall(right[i]) & !is_wall(left[i]);
            let normal = if is_beside {
                -along[i]
            } else if is_above {
                along[i]
            } else {
                0.0
            };
            if is_wall(own[i]) { 0.0 } else { (presses_wall[i] + normal).max(0.0) }
        });
        store::<N>(pressed, column, presses);
        store::<N>(at_wall, column, presses_wall);
    }
}

impl FindPressures<'_> {
    /// Those of cells that have a pressure.
    #[inline(always)]
    fn within<const N: usize>(&self, bed: &Bed, at: At) -> [[f32; N]; 2] {
        let (At { row, column, k }, stride) = (at, bed.grid.stride);
        let [p, pore] = [self.pressure, self.pore].map(|field| load::<N>(field, k));
        let bears = self.spread.bears::<N>(bed.grid, k);
        let mut least = p;
        for (other, axis, face) in [
            (k - 1, Axis::U, at),
            (k + 1, Axis::U, At { column: column + 1, ..at }),
            (k - stride, Axis::V, at),
            (k + stride, Axis::V, At { row: row + 1, ..at }),
        ] {
            let (open, other) = (bed.open::<N>(axis, face), load::<N>(self.pressure, other));
            for i in 0..N {
                least[i] = if (open[i] > 0.0) & (other[i] < least[i]) { other[i] } else { least[i] };
            }
        }
        let presses = each_lane(|i| (bears[i] * (p[i] - pore[i])).max(0.0));
        [presses, each_lane(|i| (bears[i] * (p[i] - pore[i] + 0.5 * (p[i] - least[i]))).max(0.0))]
    }

    /// The pressure of cells that have none by that of those beside them.
    #[inline(always)]
    fn beside<const N: usize>(&self, bed: &Bed, k: usize) -> [f32; N] {
        let (grid, stride) = (bed.grid, bed.grid.stride);
        let [mut sums, mut counts] = [[0.0; N]; 2];
        let sides =
            [(k - 1, Axis::U, k), (k + 1, Axis::U, k + 1), (k - stride, Axis::V, k), (k + stride, Axis::V, k + stride)];
        for (other, axis, face) in sides {
            let [own, wet] = [k, other].map(|k| load::<N>(bed.liquid, k));
            if !(0..N).any(|i| own[i] == 0.0 && wet[i] > 0.0) {
                continue;
            }
            let (mut steep, before) = ([1.0; N], face - axis.step(grid));
            let [liquid, filled] =
                [bed.liquid, &self.faces.filled].map(|field| [before, face].map(|k| &field[k..k + N]));
            steepness(&mut steep, liquid, filled, bed.closed.beside(grid, axis, face, N));
            let pressure = load::<N>(self.pressure, other);
            for i in 0..N {
                let is_wet = wet[i] > 0.0;
                sums[i] += if is_wet { pressure[i] * (1.0 - steep[i]) } else { 0.0 };
                counts[i] += if is_wet { 1.0 } else { 0.0 };
            }
        }
        each_lane(|i| if counts[i] > 0.0 { sums[i] / counts[i] } else { 0.0 })
    }
}

/// Finds the most stress that cells and corners can have, and which corners are away from walls (1).
pub(super) struct FindLimits<'a> {
    pub spread: Spread<'a>,
    /// What grains press one another and walls with, d/s.
    pub pressed: &'a Fields,
    /// How much was strained in the last substep, d/s a cell.
    pub strain: &'a Fields,
    /// More than 0 in corners that take part.
    pub takes_part: &'a [f32],
}

impl Cells<3> for FindLimits<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, at: At, [cells, corners, inner]: &mut [&mut [f32]; 3]) {
        let Self { spread, pressed: [pressed, at_wall], strain, takes_part } = self;
        let (At { row, column, k }, stride) = (at, bed.grid.stride);
        let ended = AT_REST.1 * bed.kick.length();
        // Without gravity nothing rests on anything.
        let holds = |strain: f32| 1.0 + if strain < ended { AT_REST.0 * (1.0 - strain / ended) } else { 0.0 };
        let (sines, bonds) = (spread.sines::<N>(bed.grid, k), spread.bonds::<N>(bed.grid, k));
        let (liquid, presses) = (load::<N>(bed.liquid, k), load::<N>(pressed, k));
        let [of_cells, of_corners] = strain.each_ref().map(|strain| load::<N>(strain, k));
        let limits =
            each_lane(|i| if liquid[i] > 0.0 { sines[i] * presses[i] * holds(of_cells[i]) + bonds[i] } else { 0.0 });
        store::<N>(cells, column, limits);

        let [mut inside, mut outside, mut counts] = [[0.0; N]; 3];
        let around = [
            (k, row, column),
            (k - 1, row, column - 1),
            (k - stride, row - 1, column),
            (k - stride - 1, row - 1, column - 1),
        ];
        for (k, row, column) in around {
            let (rock, presses, presses_wall) =
                (bed.rock::<N>(row, column), load::<N>(pressed, k), load::<N>(at_wall, k));
            for i in 0..N {
                let is_room = !is_wall(rock[i]);
                inside[i] += if is_room { presses[i] } else { 0.0 };
                outside[i] += if is_room { presses_wall[i] } else { 0.0 };
                counts[i] += if is_room { 1.0 } else { 0.0 };
            }
        }
        let takes_part = load::<N>(takes_part, k);
        let is_inner = each_lane(|i| if (takes_part[i] != 0.0) & (counts[i] == 4.0) { 1.0 } else { 0.0 });
        let limits = each_lane(|i| {
            let presses = if counts[i] == 4.0 { 0.25 * inside[i] } else { outside[i] / f32::max(counts[i], 1.0) };
            // What holds grains together does not hold them to walls.
            let bond = if counts[i] == 4.0 { bonds[i] } else { 0.0 };
            let limit = sines[i] * presses.max(0.0) * holds(of_corners[i]) + bond;
            if takes_part[i] == 0.0 { 0.0 } else { limit }
        });
        store::<N>(corners, column, limits);
        store::<N>(inner, column, is_inner);
    }
}
