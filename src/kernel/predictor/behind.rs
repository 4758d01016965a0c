//! What thin walls hide: matter is smeared over one and a half cells, through a wall that is thinner than that. A cell beside one
//! gets what is behind the wall, and what it would get if its own liquid went on there it misses.
//!
//! A cell that is full as far as its liquid goes, with air behind the wall, so counts up to a twentieth less, and the density
//! feedback pressed as much more into it. Let F be how full a cell is found to be, r its rock, m what it misses, f how full the
//! room is that its own leads to, and F', r', m' and f' the same of the cell behind the wall in which most of what it misses lies:
//!
//! ```text
//! F = r + (1 − r − m) f + m f'
//! F' = r' + (1 − r' − m') f' + m' f
//! ```
//!
//! How full it is with f in place of f' follows from both:
//!
//! ```text
//! F + m (f − f') = F + m ((1 − r') (F − r) − (1 − r) (F' − r')) / ((1 − r) (1 − r') − m (1 − r') − m' (1 − r))
//! ```
//!
//! With as much on both sides nothing changes at all.

use crate::{
    predictor::{
        grid::MacGrid,
        parts::Parts,
        stencil::{Axis, faces_around},
    },
    solids::{Solids, centre},
};
use glam::IVec2;
use std::ops::Range;

/// Less than this is not looked at: the density feedback leaves more in still water.
const LEAST_MISSING: f32 = 0.004;
/// Least that the divisor must be of what it is where nothing is missed: what is found is as many times less exact.
const LEAST_SHARE: f32 = 0.2;
/// Most rooms along a side of three by three cells. The edge of a cell is up to one and a half kernel radii of up to 4 d.
const MOST_ROOMS: usize = 3 * 6 + 2;

/// What is behind walls for a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Behind {
    pub cell: u32,
    /// Cell in which most of it lies.
    pub other: u32,
    /// How much less than full the cell is where all is that its room leads to.
    pub missing: f32,
}

/// Rooms and rock around a cell of the grid, of the three by three cells in whose middle it is.
struct Surroundings {
    /// Lower left one.
    corner: IVec2,
    rows: usize,
    /// Which of a row are room.
    room: [u32; MOST_ROOMS],
    /// Which of them the cell's own room leads to.
    seen: [u32; MOST_ROOMS],
}

impl Surroundings {
    fn new(grid: &MacGrid, solids: &Solids, parts: &Parts, k: usize) -> Self {
        let span = |index: usize, more: f32| {
            let low = (index as f32 - 1.0 - more) * grid.cell;
            low.floor() as i32..(low + (1.0 + 2.0 * more) * grid.cell).ceil() as i32
        };
        let (column, row) = (k % grid.stride, k / grid.stride);
        let (across, up) = (span(column, 1.0), span(row, 1.0));
        let mut found = Self {
            corner: IVec2::new(across.start, up.start),
            rows: up.len(),
            room: [0; MOST_ROOMS],
            seen: [0; MOST_ROOMS],
        };
        for (room, y) in found.room.iter_mut().zip(up.clone()) {
            let is_room = |x: i32| u32::from(!solids.is_solid(IVec2::new(x, y)));
            *room = across.clone().rev().fold(0, |bits, x| bits << 1 | is_room(x));
        }
        for y in span(row, 0.0) {
            let own = span(column, 0.0).filter(|x| parts.has(k, IVec2::new(*x, y)));
            let own = own.fold(0, |bits, x| bits | 1_u32 << (x - across.start));
            let row = (y - up.start) as usize;
            found.seen[row] = own & found.room[row];
        }
        found.spread();
        found
    }

    /// Sees all that what is seen leads to.
    fn spread(&mut self) {
        let mut goes_on = true;
        while goes_on {
            goes_on = false;
            for row in (0..self.rows).chain((0..self.rows).rev()) {
                let beside = |row: usize| self.seen.get(row).copied().unwrap_or_default();
                let mut seen = self.seen[row] | beside(row + 1) | beside(row.wrapping_sub(1));
                seen &= self.room[row];
                loop {
                    let more = (seen | seen << 1 | seen >> 1) & self.room[row];
                    if more == seen {
                        break;
                    }
                    seen = more;
                }
                goes_on |= seen != self.seen[row];
                self.seen[row] = seen;
            }
        }
    }

    /// The rooms that are not seen.
    fn hidden(&self) -> impl Iterator<Item = IVec2> + '_ {
        (0..self.rows).flat_map(move |y| {
            let mut bits = self.room[y] & !self.seen[y];
            std::iter::from_fn(move || {
                let bit = bits.trailing_zeros();
                bits &= bits.wrapping_sub(1);
                (bit < u32::BITS).then(|| self.corner + IVec2::new(bit as i32, y as i32))
            })
        })
    }
}

impl Behind {
    /// What is behind walls for cell `k` of the grid; `None` if nothing is.
    pub fn new(grid: &MacGrid, solids: &Solids, parts: &Parts, k: usize) -> Option<Self> {
        let share = 0.25 * grid.per_cell * grid.per_cell;
        let (mut missing, mut of_cells) = (0.0, [[0.0_f32; 3]; 3]);
        let around = |row: usize, column: usize| k + grid.row(row) + column - grid.stride - 1;
        for room in Surroundings::new(grid, solids, parts, k).hidden() {
            let (at, mut own) = (centre(room), 0.0);
            for axis in [Axis::U, Axis::V] {
                faces_around(grid, at.x, at.y, axis, |column, row, weight| {
                    let face = grid.row(row) + column;
                    if face == k || face == k + axis.step(grid) {
                        own += share * weight;
                    }
                });
            }
            missing += own;
            let step = |at: f32, index: usize| ((at * grid.per_cell) as usize + 2).saturating_sub(index).min(2);
            let (row, column) = (step(at.y, k / grid.stride), step(at.x, k % grid.stride));
            // A cell that is cut may stand for what is in front of the wall.
            of_cells[row][column] += if parts.has(around(row, column), room) { own } else { 0.0 };
        }
        let mut most = (0.0, 0);
        for (row, of_row) in of_cells.into_iter().enumerate() {
            for (column, own) in of_row.into_iter().enumerate() {
                if own > most.0 {
                    most = (own, around(row, column));
                }
            }
        }
        (most.0 > 0.0).then_some(Self { cell: k as u32, other: most.1 as u32, missing })
    }
}

/// What a cell's fill is to be made up by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MakeUp {
    pub cell: u32,
    other: u32,
    /// Factors of what is liquid in both.
    factors: [f32; 2],
    /// What that adds up to for the rock in both.
    of_rock: f32,
    /// See [`ClosedFaces`](super::rock::ClosedFaces).
    liquid_from: f32,
}

impl MakeUp {
    /// What makes up for what is behind walls, where it counts. `rock`: shares of the cells; `other_misses`: what the other cell does.
    pub fn new(Behind { cell, other, missing }: Behind, rock: &[f32], other_misses: f32) -> Option<Self> {
        let [own_rock, other_rock] = [cell, other].map(|k| rock[k as usize]);
        let (room, other_room) = (1.0 - own_rock, 1.0 - other_rock);
        let divisor = room * other_room - missing * other_room - other_misses * room;
        if missing < LEAST_MISSING || divisor < LEAST_SHARE * room * other_room || divisor <= 0.0 {
            return None;
        }
        let factors = [missing * other_room / divisor, -missing * room / divisor];
        Some(Self { cell, other, factors, of_rock: 0.0, liquid_from: 0.0 })
    }

    /// Follows the shares of rock that the fills have in them, and the shares from which cells are liquid. Returns whether it is
    /// solved for.
    pub fn follow(&mut self, rock: &[f32], liquid_from: &[f32]) -> bool {
        let ([own, other], k) = (self.factors, self.cell as usize);
        self.of_rock = own * rock[k] + other * rock[self.other as usize];
        self.liquid_from = liquid_from[k];
        self.liquid_from < f32::INFINITY
    }
}

/// Makes up the fill of cells in some rows and columns by what is behind walls, and marks those that are liquid (1). The last pressure
/// of others goes. `cells` stand in the order of the grid's index; `buffer` is kept.
pub(super) fn make_up(
    cells: &[MakeUp],
    grid: &MacGrid,
    (rows, columns): (&Range<usize>, &Range<usize>),
    [filled, liquid, solution]: [&mut [f32]; 3],
    buffer: &mut Vec<f32>,
) {
    let place = |cell: u32| (cell as usize / grid.stride, cell as usize % grid.stride);
    let of_rows = cells.partition_point(|one| place(one.cell).0 < rows.start)
        ..cells.partition_point(|one| place(one.cell).0 < rows.end);
    let near = || cells[of_rows.clone()].iter().filter(|one| columns.contains(&place(one.cell).1));
    // What is in rows and columns that nothing is near is left from before.
    let fill = |k: u32| {
        let (row, column) = place(k);
        if rows.contains(&row) && columns.contains(&column) { filled[k as usize] } else { 0.0 }
    };
    buffer.clear();
    // As many as there can be: room is made when rock changes, not when water moves.
    buffer.reserve(cells.len());
    buffer.extend(near().map(|one| {
        let [own, other] = one.factors;
        fill(one.cell) + own * fill(one.cell) + other * fill(one.other) - one.of_rock
    }));
    for (one, fill) in near().zip(buffer) {
        let k = one.cell as usize;
        filled[k] = *fill;
        liquid[k] = if *fill >= one.liquid_from { 1.0 } else { 0.0 };
        solution[k] *= liquid[k];
    }
}
