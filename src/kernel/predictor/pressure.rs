//! The pressure equation: divergence and density feedback in, changes of face velocities out.

use crate::kernel::{
    parallel::Team,
    predictor::{
        PredictorReport,
        conjugate::Conjugate,
        equation::{Around, Sides, couple, feed_back, fill, fill_in, mark, steepen, subtract_divergence, touch},
        grid::MacGrid,
        level::Level,
        multigrid::Hierarchy,
        pockets::Pockets,
        rock::ClosedFaces,
        transfer::Faces,
    },
    simd::{Lanes, Pass},
};
use std::ops::Range;

/// Rate at which a density error is to be taken away, 1/s: a fifth of it in a tick, however many substeps that has. Per
/// substep it would work eight times as hard at eight of them, and stir a still pool.
const FEEDBACK_PER_SECOND: f32 = 12.0;

/// One projection. `p` is counted in d/s: a face gains `p_left − p_right`.
pub(super) struct Projection<'a> {
    pub grid: &'a MacGrid,
    pub closed: &'a ClosedFaces,
    pub faces: &'a mut Faces,
    pub hierarchy: &'a mut Hierarchy,
    pub conjugate: &'a mut Conjugate,
    pub pockets: &'a mut Pockets,
    /// Density that is aimed at, particles per d².
    pub target: f32,
    pub team: Team,
    pub report: &'a mut PredictorReport,
}

impl Pass for Projection<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, closed, faces, hierarchy, conjugate, pockets, target, team, report } = self;
        find_means(grid, closed, faces, target);
        conjugate.resize(grid.len());
        let rows = mark_liquid(grid, closed, faces, conjugate);
        let before = std::mem::replace(&mut conjugate.rows, rows);
        conjugate.keep_guess(grid, before);
        if conjugate.rows.is_empty() {
            return;
        }
        assemble(grid, closed, faces, hierarchy.finest(), conjugate);
        pockets.balance(grid, hierarchy.finest());
        hierarchy.coarsen();
        *report = conjugate.solve(hierarchy, team);
        change_velocities(grid, closed, faces, conjugate);
    }
}

/// Turns momenta into velocities and finds how full each cell is: its density is the mean of its faces'.
#[inline(always)]
fn find_means(grid: &MacGrid, closed: &ClosedFaces, faces: &mut Faces, target: f32) {
    let share = 0.25 * grid.per_cell * grid.per_cell / target;
    for j in cells_reached(grid, faces) {
        let cells = grid.row(j) + 1..grid.row(j) + 1 + grid.columns;
        let weights = Sides::new(&faces.u, &faces.v, cells.clone(), grid.stride);
        fill(&mut faces.filled[cells.clone()], weights, &closed.rock[cells], share);
    }
    let reached = grid.rows(faces.reached.clone());
    for field in [&mut faces.u[reached.clone()], &mut faces.v[reached]] {
        for face in field {
            let weight = if face[0] > 1e-12 { face[0] } else { 1e-12 };
            face[1] /= weight;
        }
    }
}

/// Rows of cells that have a particle on one of their faces, and one more on either side.
fn cells_reached(grid: &MacGrid, faces: &Faces) -> Range<usize> {
    faces.reached.start.saturating_sub(2).max(1)..(faces.reached.end + 1).min(grid.rows + 1)
}

/// Marks the liquid cells with 1; returns the rows from the first to the last that has one.
#[inline(always)]
fn mark_liquid(grid: &MacGrid, closed: &ClosedFaces, faces: &Faces, conjugate: &mut Conjugate) -> Range<usize> {
    conjugate.liquid[grid.rows(conjugate.rows.clone())].fill(0.0);
    let mut rows = 0..0;
    for j in cells_reached(grid, faces) {
        let cells = grid.row(j) + 1..grid.row(j) + 1 + grid.columns;
        let (filled, from) = (&faces.filled[cells.clone()], &closed.liquid_from[cells.clone()]);
        if mark(&mut conjugate.liquid[cells], filled, from) {
            rows = if rows.is_empty() { j } else { rows.start }..j + 1;
        }
    }
    rows
}

/// Sets up `Σ_f w_f s_f (p_c − p_n) = −Σ ± w_f u_f + feedback` over the liquid cells; p = 0 in the air, and s_f is how
/// much steeper than between liquid cells the pressure falls at the face.
#[inline(always)]
fn assemble(grid: &MacGrid, closed: &ClosedFaces, faces: &mut Faces, finest: &mut Level, conjugate: &mut Conjugate) {
    let (stride, feedback) = (grid.stride, FEEDBACK_PER_SECOND * grid.cell);
    let Conjugate { liquid, rows, .. } = conjugate;
    let Faces { u, v, filled, steep_u, steep_v, .. } = faces;
    for (steep, step) in [(&mut *steep_u, 1), (&mut *steep_v, stride)] {
        for j in rows.start..rows.end + 1 {
            let faces = grid.row(j) + 1..grid.row(j) + 2 + grid.columns;
            let before = faces.start - step..faces.end - step;
            let liquid = [&liquid[before.clone()], &liquid[faces.clone()]];
            steepen(&mut steep[faces.clone()], liquid, [&filled[before], &filled[faces]]);
        }
    }
    finest.take_rows(rows.clone());
    for j in rows.clone() {
        let cells = grid.row(j) + 1..grid.row(j) + 1 + grid.columns;
        let liquid = Around::new(liquid, cells.clone(), stride);
        let open = Sides::new(&closed.open_u, &closed.open_v, cells.clone(), stride);
        let steep = Sides::new(steep_u, steep_v, cells.clone(), stride);
        let (diagonal, to_right) = (&mut finest.diagonal[cells.clone()], &mut finest.right[cells.clone()]);
        couple(diagonal, to_right, &mut finest.upper[cells.clone()], liquid, open, steep);
        let right_side = &mut finest.b[cells.clone()];
        let rock = Around::new(&closed.rock, cells.clone(), stride);
        feed_back(right_side, liquid, rock, &filled[cells.clone()], feedback);
        subtract_divergence(right_side, liquid.centre, open, Sides::new(u, v, cells, stride));
    }
}

/// Finds the change on every face that touches liquid, and fills one layer around them in from its neighbours.
#[inline(always)]
fn change_velocities(grid: &MacGrid, closed: &ClosedFaces, faces: &mut Faces, conjugate: &Conjugate) {
    let Conjugate { liquid, solution: p, rows, .. } = conjugate;
    let Faces { u, v, steep_u, steep_v, change, known, reached, .. } = faces;
    // Rows of faces that touch liquid, and with the layer around them.
    let touching = rows.start..rows.end + 1;
    let near = (rows.start - 1).max(1)..(rows.end + 2).min(grid.rows + 2);
    let (along, up) = ((u, &closed.open_u, steep_u, 1), (v, &closed.open_v, steep_v, grid.stride));
    for (face, open, steep, step) in [along, up] {
        for field in [&mut *change, known] {
            field[grid.rows(near.start - 1..near.end + 1)].fill(0.0);
        }
        for j in touching.clone() {
            let cells = grid.row(j) + 1..grid.row(j) + 2 + grid.columns;
            let before = cells.start - step..cells.end - step;
            let (liquid, p) = ([&liquid[before.clone()], &liquid[cells.clone()]], [&p[before], &p[cells.clone()]]);
            let (open, steep, old) = (&open[cells.clone()], &steep[cells.clone()], &face[cells.clone()]);
            touch(&mut known[cells.clone()], &mut change[cells], liquid, p, [open, steep], old);
        }
        for j in near.clone() {
            let cells = grid.rows(j..j + 1);
            let around = |field| Around::new(field, cells.clone(), grid.stride);
            fill_in(&mut face[cells.clone()], around(change), around(known));
        }
        // Away from the liquid nothing changes.
        for far in [reached.start..near.start.min(reached.end), near.end.max(reached.start)..reached.end] {
            let far = if far.is_empty() { 0..0 } else { grid.rows(far) };
            face[far].iter_mut().for_each(|face| face[0] = 0.0);
        }
    }
}
