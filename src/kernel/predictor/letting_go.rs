//! Liquid that lets go of a wall. A wall pushes and does not pull: where air can come between, the pressure is that of the
//! air (the complementarity p ≥ 0, u · n ≥ 0, p u · n = 0 of Batty, Bertails & Bridson 2007, "A fast variational framework
//! for accurate solid-fluid coupling"). Else a jet along a ceiling would stay there and drip off in fingers a few cells
//! wide, others at every spacing, and one from under a gate would cling to the gate or not, as the cells happen to lie.
//!
//! One step of an active set in each substep: a cell beside a wall lets go if the last pressure there pulled, and stays free
//! as long as more sets out of it than into it; and only if air is near, or comes to it through cells that let go, too.
//! What no air comes to in this way keeps its suction. So does liquid that is beside no air and pulls by less than half a row
//! of its particles weighs: a surface is known no better, and under a block that lies on a pool, where the pressure is next to none, cells
//! let go and came back in turn. They have no part in the density feedback, and the pool never came to rest.

use crate::predictor::{conjugate::Conjugate, grains::Grains, grid::MacGrid, rock::ClosedFaces, transfer::Faces};

/// A cell that is fuller than this is pressed together, whatever pulled there last, and needs a pressure. What hangs from a
/// ceiling is off 1 by a few hundredths.
const PRESSED: f32 = 1.1;
/// Marks cells that leave a wall until it is known whether air comes to them.
const LEAVING: f32 = 0.5;

/// Pressure of cells that have let go, d/s: next to none, and less than none. The pressure is what is kept of a world, so that
/// one that is put back goes on to the bit.
const FREE: f32 = -1e-30;

/// Half a row of particles, d.
const HALF_A_ROW: f32 = 0.5;

/// Cells that let go. The buffers are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct LettingGo {
    /// Cells that may, and then those that do.
    leaving: Vec<u32>,
    /// Those that air comes to, until their neighbours are looked at.
    reached: Vec<u32>,
}

impl LettingGo {
    /// Takes the cells that let go out of the liquid. `faces` hold mean velocities; `kick` is what gravity adds in the substep, d/s,
    /// and the pressure of a cell's edge of the heaviest.
    pub fn run(
        &mut self,
        (grid, closed): (&MacGrid, &ClosedFaces),
        faces: &Faces,
        grains: Option<&Grains>,
        conjugate: &mut Conjugate,
        kick: f32,
    ) {
        let Conjugate { rows, liquid, solution, .. } = conjugate;
        let Self { leaving, reached } = self;
        leaving.clear();
        reached.clear();
        // As many as there can be: room is made when rock changes, not when water moves.
        leaving.reserve(closed.beside_walls.len());
        reached.reserve(closed.beside_walls.len());
        let row_of = |k: u32| k as usize / grid.stride;
        let sides = |k: usize| open_sides(grid, closed, k);
        // Grains do not hang together.
        let loose = |k: usize| grains.map_or(0.0, |grains| grains.bear(faces, grid, k));
        let most = |k: usize| kick * HALF_A_ROW * grid.per_cell * faces.density(grid, k) * (1.0 - loose(k));
        let walls = &closed.beside_walls;
        let of_rows =
            walls.partition_point(|k| row_of(*k) < rows.start)..walls.partition_point(|k| row_of(*k) < rows.end);
        for &cell in &walls[of_rows] {
            let k = cell as usize;
            // Most push.
            if solution[k] > FREE {
                continue;
            }
            let is_beside_air = sides(k).any(|other| liquid[other] == 0.0);
            let is_pulled = solution[k] < if is_beside_air { FREE } else { FREE - most(k) };
            let stays_free = solution[k] == FREE && outflow(grid, closed, faces, k) > 0.0;
            if liquid[k] > 0.0 && faces.filled[k] < PRESSED && (is_pulled || stays_free) {
                liquid[k] = LEAVING;
                leaving.push(cell);
            }
        }
        // Next to it, or one cell further: liquid in a corner of rock has a side only to such a cell.
        let is_near_air = |cell: &&u32| {
            sides(**cell as usize).any(|k| liquid[k] == 0.0 || sides(k).any(|other| liquid[other] == 0.0))
        };
        reached.extend(leaving.iter().filter(is_near_air));
        for cell in &*reached {
            liquid[*cell as usize] = 0.0;
        }
        while let Some(cell) = reached.pop() {
            for other in sides(cell as usize) {
                if liquid[other] == LEAVING {
                    liquid[other] = 0.0;
                    reached.push(other as u32);
                }
            }
        }
        leaving.retain(|cell| {
            let k = *cell as usize;
            let has_left = liquid[k] == 0.0;
            (liquid[k], solution[k]) = if has_left { (0.0, 0.0) } else { (1.0, solution[k]) };
            has_left
        });
    }

    /// Notes in the pressure, when all is done with it, which cells have let go.
    pub fn note(&self, solution: &mut [f32]) {
        for cell in &self.leaving {
            solution[*cell as usize] = FREE;
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        4 * (self.leaving.capacity() + self.reached.capacity())
    }
}

/// What flows out of a cell through the open shares of its faces, less what flows in, d/s.
fn outflow(grid: &MacGrid, closed: &ClosedFaces, faces: &Faces, k: usize) -> f32 {
    let j = k / grid.stride;
    let [at, above] = [j, j + 1].map(|j| closed.row(j) + k % grid.stride);
    closed.open_u[at + 1] * faces.u[k + 1][1] - closed.open_u[at] * faces.u[k][1]
        + closed.open_v[above] * faces.v[k + grid.stride][1]
        - closed.open_v[at] * faces.v[k][1]
}

/// Cells that a cell has an open face to.
fn open_sides(grid: &MacGrid, closed: &ClosedFaces, k: usize) -> impl Iterator<Item = usize> {
    let j = k / grid.stride;
    let [at, above] = [j, j + 1].map(|j| closed.row(j) + k % grid.stride);
    let sides = [
        (k - 1, closed.open_u[at]),
        (k + 1, closed.open_u[at + 1]),
        (k - grid.stride, closed.open_v[at]),
        (k + grid.stride, closed.open_v[above]),
    ];
    sides.into_iter().filter(|(_, open)| *open > 0.0).map(|(other, _)| other)
}
