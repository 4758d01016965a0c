//! Cells that a thin wall cuts in two. The equation has one pressure for each cell, so such a cell stands for the larger
//! part of its room, and the faces of the other part are closed: else the pressure would go through the cell from one
//! side of the wall to the other, as it would at every slanting wall.

use crate::{predictor::grid::MacGrid, solids::Solids};
use glam::IVec2;

/// The parts that cut cells stand for.
pub(super) struct Parts {
    /// For each cell of the grid, 1 + the index of its part if it is cut, else 0. Empty without rock.
    of_cell: Vec<u32>,
    parts: Vec<Piece>,
    /// Whether rock leaves less than half of each cell, in one piece. Empty without rock.
    slivers: Vec<bool>,
}

impl Parts {
    /// Finds what room cells stand for, and which of them are cut.
    pub fn new(grid: &MacGrid, solids: &Solids) -> Self {
        let mut found = Self { of_cell: Vec::new(), parts: Vec::new(), slivers: Vec::new() };
        if solids.count() == 0 {
            return found;
        }
        found.of_cell.resize(grid.len(), 0);
        found.slivers.resize(grid.len(), false);
        let area = grid.cell * grid.cell;
        for j in 1..=grid.rows {
            for i in 1..=grid.columns {
                let Some(pieces) = Piece::of_cell(grid, solids, [i - 1, j - 1]) else { continue };
                let k = grid.row(j) + i;
                if let [only] = &pieces[..] {
                    found.slivers[k] = only.area < 0.5 * area;
                    continue;
                }
                // Of equal ones the first.
                let largest =
                    pieces.into_iter().reduce(|most, piece| if piece.area > most.area { piece } else { most });
                if let Some(largest) = largest {
                    found.parts.push(largest);
                    found.of_cell[k] = found.parts.len() as u32;
                }
            }
        }
        found
    }

    /// Whether room that the grid's cell `k` reaches is in the part that it stands for.
    pub fn has(&self, k: usize, room: IVec2) -> bool {
        match self.of_cell.get(k) {
            None | Some(0) => true,
            Some(index) => self.parts[*index as usize - 1].has(room),
        }
    }

    /// Whether rock cuts the grid's cell `k`.
    pub fn is_cut(&self, k: usize) -> bool {
        self.of_cell.get(k).is_some_and(|part| *part > 0)
    }

    /// Whether rock leaves less than half of the grid's cell `k`, in one piece.
    pub fn is_sliver(&self, k: usize) -> bool {
        self.slivers.get(k).is_some_and(|is_sliver| *is_sliver)
    }
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
    /// The room of a cell in pieces; `None` without rock in it.
    fn of_cell(grid: &MacGrid, solids: &Solids, [column, row]: [usize; 2]) -> Option<Vec<Self>> {
        let (left, lower) = (column as f32 * grid.cell, row as f32 * grid.cell);
        let (right, upper) = (left + grid.cell, lower + grid.cell);
        let corner = IVec2::new(left.floor() as i32, lower.floor() as i32);
        let (columns, rows) = (right.ceil() as i32 - corner.x, upper.ceil() as i32 - corner.y);
        let at = |k: i32| corner + IVec2::new(k % columns, k / columns);
        if !(0..columns * rows).any(|k| solids.is_solid(at(k))) {
            return None;
        }
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
        Some(pieces)
    }

    fn has(&self, room: IVec2) -> bool {
        let place = room - self.corner;
        let is_inside = (0..self.columns).contains(&place.x) && (0..self.rows).contains(&place.y);
        is_inside && self.has[(place.y * self.columns + place.x) as usize]
    }
}
