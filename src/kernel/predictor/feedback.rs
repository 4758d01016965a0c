//! The density feedback: what is asked for of the divergence so that cells that are too full or not full enough become full.

use crate::{
    parallel::{Rows, Sweep, Team, sweep},
    predictor::{
        conjugate::Conjugate,
        equation::Around,
        grid::MacGrid,
        level::{Level, WORTH_A_PIECE},
        pieces::Pieces,
        rock::ClosedFaces,
        transfer::Faces,
    },
};
use std::{
    ops::Range,
    sync::atomic::{AtomicU64, Ordering},
};

/// Rate at which a density error is to be taken away, 1/s: four fifths of it in a tick, however many substeps that has.
/// It moves particles and gives them no speed: through velocities the same feedback made the flow lag, and stirred
/// still pools.
///
/// **The bound.** The divergence f e that is asked for moves matter for Δt: `e' = e − (1 + e) f Δt e`, to first order
/// `e' = (1 − f Δt) e`. That shrinks for `f Δt ≤ 2` and without a change of sign for **`f Δt ≤ 1`**. A substep is a tick
/// at most, so f Δt ≤ 48/60 = 0.8 always. The errors themselves are cut to [`RANGE`], so that even past the
/// bound no more than f · 0.3 is asked for; every cell in which that acts is counted.
const PER_SECOND: f32 = 48.0;
/// Most that a cell's density is taken to be too high, and too low inside the liquid: pulls harder than this make noise.
const RANGE: (f32, f32) = (-0.1, 0.3);
/// A cell is beneath a ceiling where so much more rock is above than in it: half of what a plate one particle thick makes, in cells of
/// 2.5 d, where it lies upon the cell above.
const CEILING: f32 = 0.1;

/// Puts the density feedback of the liquid cells on the right-hand side. Returns in how many it was cut.
pub(super) fn feed_back(
    grid: &MacGrid,
    closed: &ClosedFaces,
    filled: &[f32],
    finest: &mut Level,
    conjugate: &Conjugate,
    team: Team,
) -> u64 {
    let Conjugate { rows, liquid, solution: pressure, .. } = conjugate;
    let cuts = AtomicU64::new(0);
    let Level { b, wet, .. } = finest;
    let work = FeedBack { grid, closed, filled, liquid, pressure, wet, cuts: &cuts };
    sweep(&work, rows.clone(), Rows::new(b, grid.stride, rows), wet.per_row(), WORTH_A_PIECE, team);
    cuts.into_inner()
}

struct FeedBack<'a> {
    grid: &'a MacGrid,
    closed: &'a ClosedFaces,
    filled: &'a [f32],
    liquid: &'a [f32],
    pressure: &'a [f32],
    /// What is solved for.
    wet: &'a Pieces,
    /// Counts the cells in which the feedback was cut.
    cuts: &'a AtomicU64,
}

impl Sweep<Rows<'_, f32>> for FeedBack<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut b: Rows<f32>) {
        let Self { grid, closed, filled, liquid, pressure, wet, cuts } = *self;
        let mut cut = 0;
        for (j, b) in rows.zip(b.each()) {
            for run in wet.runs(j) {
                let surface = Surface::new(grid, closed, [filled, liquid, pressure], (j, run.clone()));
                cut += ask(&mut b[run], surface, PER_SECOND * grid.cell);
            }
        }
        cuts.fetch_add(u64::from(cut), Ordering::Relaxed);
    }
}

/// Asks for a divergence that takes the density error away. Returns in how many liquid cells the error is out of
/// [`RANGE`] and was cut to it.
#[inline(always)]
fn ask(right_side: &mut [f32], surface: Surface, feedback: f32) -> u32 {
    let n = right_side.len();
    let surface = surface.first(n);
    let Surface { filled, liquid, .. } = surface;
    let mut cuts = 0;
    for i in 0..n {
        let at_surface = surface.is_at(i);
        let (least, most) = (if at_surface { 0.0 } else { RANGE.0 }, RANGE.1);
        let wanted = filled[i] - 1.0;
        let error = if wanted > least { wanted } else { least };
        let error = if error < most { error } else { most };
        right_side[i] = liquid.centre[i] * feedback * error;
        // A surface is no error: what is missing there is air.
        let cut = (wanted > most) | ((wanted < RANGE.0) & !at_surface);
        cuts += u32::from(cut & (liquid.centre[i] > 0.0));
    }
    cuts
}

/// Shows `visit` every liquid cell of the last projection, as (column, row) from the lower left, and how much of the
/// feedback's range its density error uses.
pub(super) fn shares(
    grid: &MacGrid,
    closed: &ClosedFaces,
    faces: &Faces,
    conjugate: &Conjugate,
    mut visit: impl FnMut([usize; 2], f32),
) {
    let Conjugate { rows, liquid, solution, .. } = conjugate;
    for j in rows.clone() {
        let surface = Surface::new(grid, closed, [&faces.filled, liquid, solution], (j, 1..1 + grid.columns));
        for i in (0..grid.columns).filter(|i| surface.liquid.centre[*i] > 0.0) {
            visit([i, j - 1], share(surface, i));
        }
    }
}

/// How much of [`RANGE`] the error of a cell uses: past 1 it is cut. `i` counts within the row.
fn share(surface: Surface, i: usize) -> f32 {
    match surface.filled[i] - 1.0 {
        error if error > 0.0 => error / RANGE.1,
        _ if surface.is_at(i) => 0.0,
        error => error / RANGE.0,
    }
}

/// What tells the surface's cells from those inside the liquid, in a row.
#[derive(Clone, Copy)]
struct Surface<'a> {
    /// How full cells are.
    filled: &'a [f32],
    /// Cells that are liquid (1).
    liquid: Around<'a>,
    /// The last pressure, d/s.
    pressure: Around<'a>,
    /// Share of rock.
    rock: Around<'a>,
    above: Above<'a>,
}

/// What is above a row of cells, against gravity; without it the cells themselves.
#[derive(Clone, Copy)]
struct Above<'a> {
    liquid: &'a [f32],
    pressure: &'a [f32],
    rock: &'a [f32],
}

impl<'a> Surface<'a> {
    /// In some columns of row `j`, by how full cells are, which of them are liquid, and the last pressure.
    #[inline(always)]
    fn new(
        grid: &MacGrid,
        closed: &'a ClosedFaces,
        [filled, liquid, pressure]: [&'a [f32]; 3],
        (j, columns): (usize, Range<usize>),
    ) -> Self {
        let cells = grid.row(j) + columns.start..grid.row(j) + columns.end;
        let [liquid, pressure] = [liquid, pressure].map(|field| Around::new(field, cells.clone(), grid.stride));
        let [below, at, above] = [j - 1, j, j + 1].map(|j| closed.row(j) + columns.start);
        let (n, rock) = (columns.len(), &closed.rock);
        let rock = Around::of_rows(&rock[below..below + n], &rock[at - 1..at + n + 1], &rock[above..above + n]);
        let up = closed.up();
        let above = Above { liquid: liquid.on(up), pressure: pressure.on(up), rock: rock.on(up) };
        Self { filled: &filled[cells], liquid, pressure, rock, above }
    }

    /// The first `n` cells. The compiler sees from it that all is as long.
    #[inline(always)]
    fn first(self, n: usize) -> Self {
        let Self { filled, liquid, pressure, rock, above } = self;
        let above = Above { liquid: &above.liquid[..n], pressure: &above.pressure[..n], rock: &above.rock[..n] };
        let [liquid, pressure, rock] = [liquid, pressure, rock].map(|field| field.first(n));
        Self { filled: &filled[..n], liquid, pressure, rock, above }
    }

    /// Whether the surface is beside liquid cell `i`, or in it.
    #[inline(always)]
    fn is_at(self, i: usize) -> bool {
        self.touches_air(i) | self.ends_within(i) | self.ends_above(i)
    }

    /// Whether cell `i` has no liquid above it and is short by more than [`RANGE`], or has under a ceiling liquid that hangs, as the
    /// pressure has fallen to 0 on the way. Beneath rock nothing else shows the surface: taken for liquid that is too thin, a film in
    /// a crevice drew together until it filled it, and a pool went round for ever beneath a nook that its surface just reached.
    #[inline(always)]
    fn ends_above(self, i: usize) -> bool {
        let Above { liquid, pressure, rock } = self.above;
        let is_empty = (liquid[i] < 0.5) & (self.filled[i] < 1.0 + RANGE.0);
        let hangs = (self.pressure.centre[i] > 0.0) & (pressure[i] < 0.0);
        is_empty | (hangs & (rock[i] - self.rock.centre[i] > CEILING))
    }

    /// Whether a side of liquid cell `i` is neither liquid nor mostly rock: the surface is there.
    #[inline(always)]
    fn touches_air(self, i: usize) -> bool {
        let Self { liquid, rock, .. } = self;
        let is_free = |liquid: f32, rock: f32| liquid + 2.0 * rock < 0.5;
        is_free(liquid.left[i], rock.left[i])
            | is_free(liquid.right[i], rock.right[i])
            | is_free(liquid.lower[i], rock.lower[i])
            | is_free(liquid.upper[i], rock.upper[i])
    }

    /// Whether the pressure of liquid cell `i` falls to 0 before a side of it where no liquid is, if it falls on as it falls
    /// towards the cell from the other side: the surface is in the cell.
    #[inline(always)]
    fn ends_within(self, i: usize) -> bool {
        let Self { liquid, pressure, .. } = self;
        let ends =
            |wet: f32, from: f32, to: f32| (wet > 0.5) & (from > 0.0) & (from > 3.0 * pressure.centre[i]) & (to < 0.5);
        ends(liquid.lower[i], pressure.lower[i], liquid.upper[i])
            | ends(liquid.upper[i], pressure.upper[i], liquid.lower[i])
            | ends(liquid.left[i], pressure.left[i], liquid.right[i])
            | ends(liquid.right[i], pressure.right[i], liquid.left[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::IVec2;

    /// What is asked of a liquid cell in the middle of liquid, as a share of the rate, by how full it is, its pressure, and the
    /// pressure of the liquid above it, if there is some. What is above it is half rock.
    fn asked(filled: f32, pressure: f32, above: Option<f32>) -> f32 {
        let (mut liquid, mut pressures, mut rock) = ([1.0; 9], [0.0; 9], [0.0; 9]);
        (liquid[7], rock[7]) = (if above.is_some() { 1.0 } else { 0.0 }, 0.5);
        (pressures[4], pressures[7]) = (pressure, above.unwrap_or_default());
        let [liquid, pressure, rock] = [&liquid, &pressures, &rock].map(|field| Around::new(field, 4..5, 3));
        let [l, p, r] = [liquid, pressure, rock].map(|field| field.on(IVec2::Y));
        let above = Above { liquid: l, pressure: p, rock: r };
        let mut asked = [0.0];
        ask(&mut asked, Surface { filled: &[filled], liquid, pressure, rock, above }, 1.0);
        asked[0]
    }

    #[test]
    fn beneath_a_ceiling_nothing_is_too_thin_where_the_pressure_ends() {
        let close = |found: f32, wanted: f32| assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}");
        close(asked(0.95, 1.0, Some(0.5)), -0.05);
        close(asked(0.95, 1.0, Some(-0.3)), 0.0);
        // A vessel that is full to its lid, and one that is not.
        close(asked(0.95, 1.0, None), -0.05);
        close(asked(0.85, 1.0, None), 0.0);
        // What hangs as a whole, as in a glass that is upside down, has no surface in it.
        close(asked(0.95, -0.2, Some(-0.8)), -0.05);
        // What is pressed together gives way in any case.
        close(asked(1.05, 1.0, Some(-0.3)), 0.05);
        close(asked(1.05, 1.0, None), 0.05);
    }
}
