//! What rock leaves of each cell. The equation has one pressure for each, so a cell that a thin wall cuts in two stands for the larger
//! part of its room, and the faces of the other part are closed: else the pressure would go through the cell from one
//! side of the wall to the other, as it would at every slanting wall.

use crate::{
    predictor::grid::{MacGrid, Window},
    solids::Solids,
};
use glam::IVec2;
use std::ops::Range;

/// What rock leaves of a cell of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Room {
    /// All of it.
    All,
    /// Half of it or more, in one piece.
    Most,
    /// Less than half, in one piece.
    Sliver,
    /// Several pieces, of which it stands for one: its place among the parts.
    Cut(u32),
    /// Nothing.
    None,
}

/// The room of cells, and the parts that cut ones stand for.
pub(super) struct Parts {
    /// Of each cell of the grid. What lies beyond the box, or where nothing is asked for, has none.
    rooms: Vec<Room>,
    parts: Vec<Piece>,
}

impl Parts {
    /// Finds what room cells in a window stand for, and which of them are cut.
    pub fn new(grid: &MacGrid, solids: &Solids, window: &Window) -> Self {
        let mut found = Self { rooms: vec![Room::None; grid.len()], parts: Vec::new() };
        let columns: Vec<Range<i32>> = (0..=grid.columns).map(|i| grid.sites(i)).collect();
        for k in grid.cells_in(window) {
            let (i, j) = (k % grid.stride, k / grid.stride);
            let sites = [columns[i].clone(), grid.sites(j)];
            let solid = solids.count_solid(sites[0].clone(), sites[1].clone());
            found.rooms[k] = if solid == 0 {
                Room::All
            } else if solid == sites[0].len() * sites[1].len() {
                Room::None
            } else {
                found.take(Piece::of_cell(grid, solids, [i, j], sites), grid.cell * grid.cell)
            };
        }
        found
    }

    /// The room that is in these pieces, of a cell of this area (d²).
    fn take(&mut self, pieces: Vec<Piece>, area: f32) -> Room {
        match &pieces[..] {
            [only] if only.area < 0.5 * area => Room::Sliver,
            [_] => Room::Most,
            _ => {
                // Of equal ones the first.
                let largest =
                    pieces.into_iter().reduce(|most, piece| if piece.area > most.area { piece } else { most });
                self.parts.extend(largest);
                Room::Cut(self.parts.len() as u32 - 1)
            }
        }
    }

    /// Whether room that the grid's cell `k` reaches is in the part that it stands for.
    pub fn has(&self, k: usize, room: IVec2) -> bool {
        match self.rooms[k] {
            Room::Cut(part) => self.parts[part as usize].has(room),
            _ => true,
        }
    }

    /// What rock leaves of the grid's cell `k`.
    pub fn room(&self, k: usize) -> Room {
        self.rooms[k]
    }

    /// Whether rock leaves nothing of a cell of the grid and those around it, so that no face of it is open and none beside it.
    pub fn shut(&self, grid: &MacGrid, window: &Window) -> Vec<bool> {
        let is_full: Vec<bool> = self.rooms.iter().map(|room| *room == Room::None).collect();
        all_around(grid, &is_full, window)
    }

    /// Whether rock cuts the grid's cell `k`.
    pub fn is_cut(&self, k: usize) -> bool {
        matches!(self.rooms[k], Room::Cut(_))
    }
}

/// Whether something is so of a cell of the grid in a window and of all around it; beyond the grid it is, and beyond the window.
pub(super) fn all_around(grid: &MacGrid, is: &[bool], window: &Window) -> Vec<bool> {
    let along = |is: &[bool], step: usize| -> Vec<bool> {
        let at = |k: Option<usize>| k.and_then(|k| is.get(k)).is_none_or(|is| *is);
        let mut all = vec![true; is.len()];
        for k in grid.indices(window) {
            all[k] = is[k] && at(k.checked_sub(step)) && at(Some(k + step));
        }
        all
    };
    along(&along(is, 1), grid.stride)
}

/// Room of a cell of the grid in one piece.
struct Piece {
    /// Lower left cell of rock or room that the grid's cell reaches, and how many it reaches each way.
    corner: IVec2,
    columns: i32,
    rows: i32,
    /// Whether the room is in the piece, row by row.
    has: Vec<bool>,
    /// What of it is in the grid's cell, d².
    area: f32,
}

impl Piece {
    /// The room of a cell in pieces.
    fn of_cell(grid: &MacGrid, solids: &Solids, [column, row]: [usize; 2], [across, up]: [Range<i32>; 2]) -> Vec<Self> {
        let (left, lower) = (grid.edge(column), grid.edge(row));
        let (right, upper) = (left + grid.cell, lower + grid.cell);
        let corner = IVec2::new(across.start, up.start);
        let (columns, rows) = (across.len() as i32, up.len() as i32);
        let at = |k: i32| corner + IVec2::new(k % columns, k / columns);
        // How much of each room lies in the cell.
        let share = |low: f32, high: f32, from: i32| (high.min((from + 1) as f32) - low.max(from as f32)).max(0.0);
        let area_of = |k: i32| share(left, right, at(k).x) * share(lower, upper, at(k).y);
        let mut pieces = Vec::new();
        let mut seen: Vec<bool> = (0..columns * rows).map(|k| solids.is_solid(at(k))).collect();
        for start in 0..columns * rows {
            if std::mem::replace(&mut seen[start as usize], true) {
                continue;
            }
            let (mut has, mut area, mut next) = (vec![false; seen.len()], 0.0, vec![start]);
            while let Some(k) = next.pop() {
                has[k as usize] = true;
                area += area_of(k);
                let (x, y) = (k % columns, k / columns);
                let around =
                    [(x > 0, k - 1), (x + 1 < columns, k + 1), (y > 0, k - columns), (y + 1 < rows, k + columns)];
                for (is_inside, other) in around {
                    if is_inside && !std::mem::replace(&mut seen[other as usize], true) {
                        next.push(other);
                    }
                }
            }
            pieces.push(Self { corner, columns, rows, has, area });
        }
        pieces
    }

    fn has(&self, room: IVec2) -> bool {
        let place = room - self.corner;
        let is_inside = (0..self.columns).contains(&place.x) && (0..self.rows).contains(&place.y);
        is_inside && self.has[(place.y * self.columns + place.x) as usize]
    }
}
