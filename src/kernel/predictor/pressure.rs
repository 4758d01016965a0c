//! The pressure equation: divergence and density feedback in, changes of face velocities out.

use crate::kernel::{
    predictor::{
        PredictorReport, conjugate::Conjugate, grid::MacGrid, level::Level, multigrid::Hierarchy, pockets::Pockets,
        rock::ClosedFaces, transfer::Faces,
    },
    simd::{Lanes, Pass},
};
use std::ops::Range;

/// A cell is liquid from this share of its open room on.
const LIQUID_SHARE: f32 = 0.5;
/// A cell with more rock than this is not solved for.
const ROCK_SHARE: f32 = 0.9;
/// Share of a density error that one substep is to take away.
const FEEDBACK: f32 = 0.2;
/// Most that a cell's density is taken to be too high, and too low inside the liquid: pulls harder than this make noise.
const FEEDBACK_RANGE: (f32, f32) = (-0.1, 0.3);
/// A cell that is open to less than this has nowhere to go.
const LEAST_DIAGONAL: f32 = 0.05;

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
    pub dt: f32,
    pub report: &'a mut PredictorReport,
}

impl Pass for Projection<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, closed, faces, hierarchy, conjugate, pockets, target, dt, report } = self;
        find_means(grid, faces);
        conjugate.resize(grid.len());
        let rows = mark_liquid(grid, closed, faces, target, conjugate);
        let before = std::mem::replace(&mut conjugate.rows, rows);
        conjugate.keep_guess(grid, before);
        if conjugate.rows.is_empty() {
            return;
        }
        assemble(grid, closed, faces, hierarchy.finest(), conjugate, target, dt);
        pockets.balance(grid, hierarchy.finest(), &mut conjugate.right_side);
        hierarchy.coarsen();
        *report = conjugate.solve(hierarchy);
        change_velocities(grid, closed, faces, conjugate);
    }
}

/// Turns momenta into velocities and finds the density of each cell as the mean of its faces'.
#[inline(always)]
fn find_means(grid: &MacGrid, faces: &mut Faces) {
    let share = 0.25 * grid.per_cell * grid.per_cell;
    let n = grid.columns;
    for j in cells_reached(grid, faces) {
        let o = grid.row(j) + 1;
        let (left, right) = (&faces.u[o..o + n], &faces.u[o + 1..o + 1 + n]);
        let (lower, upper) = (&faces.v[o..o + n], &faces.v[o + grid.stride..o + grid.stride + n]);
        for (i, density) in faces.density[o..o + n].iter_mut().enumerate() {
            *density = share * (left[i][0] + right[i][0] + lower[i][0] + upper[i][0]);
        }
    }
    let reached = grid.rows(faces.reached.clone());
    for field in [&mut faces.u[reached.clone()], &mut faces.v[reached]] {
        for face in field {
            let weight = if face[0] > 1e-12 { face[0] } else { 1e-12 };
            face[1] /= weight;
        }
    }
}

/// Rows of cells that have a particle on one of their faces.
fn cells_reached(grid: &MacGrid, faces: &Faces) -> Range<usize> {
    faces.reached.start.saturating_sub(1).max(1)..faces.reached.end.min(grid.rows + 1)
}

/// Marks the liquid cells with 1; returns the rows from the first to the last that has one.
#[inline(always)]
fn mark_liquid(
    grid: &MacGrid,
    closed: &ClosedFaces,
    faces: &Faces,
    target: f32,
    conjugate: &mut Conjugate,
) -> Range<usize> {
    let (s, n) = (grid.stride, grid.columns);
    conjugate.liquid[grid.rows(conjugate.rows.clone())].fill(0.0);
    let mut rows = 0..0;
    for j in cells_reached(grid, faces) {
        let o = grid.row(j) + 1;
        let (density, rock) = (&faces.density[o..o + n], &closed.rock[o..o + n]);
        let (left, right) = (&closed.open_u[o..o + n], &closed.open_u[o + 1..o + 1 + n]);
        let (lower, upper) = (&closed.open_v[o..o + n], &closed.open_v[o + s..o + s + n]);
        let mut any = false;
        for (i, liquid) in conjugate.liquid[o..o + n].iter_mut().enumerate() {
            let open = left[i] + right[i] + lower[i] + upper[i];
            let is_liquid = (density[i] >= LIQUID_SHARE * target * (1.0 - rock[i]))
                & (rock[i] < ROCK_SHARE)
                & (open >= LEAST_DIAGONAL);
            *liquid = if is_liquid { 1.0 } else { 0.0 };
            any |= is_liquid;
        }
        if any {
            rows = if rows.is_empty() { j } else { rows.start }..j + 1;
        }
    }
    rows
}

/// Sets up `Σ_f w_f (p_c − p_n) = −Σ ± w_f u_f + feedback` over the liquid cells; p = 0 in the air.
#[inline(always)]
fn assemble(
    grid: &MacGrid,
    closed: &ClosedFaces,
    faces: &Faces,
    finest: &mut Level,
    conjugate: &mut Conjugate,
    target: f32,
    dt: f32,
) {
    let (s, n, feedback) = (grid.stride, grid.columns, FEEDBACK * grid.cell / dt);
    let Conjugate { liquid, right_side, rows, .. } = conjugate;
    finest.take_rows(rows.clone());
    for j in rows.clone() {
        let o = grid.row(j) + 1;
        let cells = [o, o - 1, o + 1, o - s, o + s];
        let (liquid, rock) = (cells.map(|o| &liquid[o..o + n]), cells.map(|o| &closed.rock[o..o + n]));
        let density = &faces.density[o..o + n];
        let (left, right) = (&closed.open_u[o..o + n], &closed.open_u[o + 1..o + 1 + n]);
        let (lower, upper) = (&closed.open_v[o..o + n], &closed.open_v[o + s..o + s + n]);
        let (u_left, u_right) = (&faces.u[o..o + n], &faces.u[o + 1..o + 1 + n]);
        let (v_lower, v_upper) = (&faces.v[o..o + n], &faces.v[o + s..o + s + n]);
        let (diagonal, to_right) = (&mut finest.diagonal[o..o + n], &mut finest.right[o..o + n]);
        let (to_upper, right_side) = (&mut finest.upper[o..o + n], &mut right_side[o..o + n]);
        for i in 0..n {
            let divergence =
                right[i] * u_right[i][1] - left[i] * u_left[i][1] + upper[i] * v_upper[i][1] - lower[i] * v_lower[i][1];
            // Neither liquid nor mostly rock: the surface is there.
            let is_free = |side: usize| liquid[side][i] + 2.0 * rock[side][i] < 0.5;
            let at_surface = is_free(1) | is_free(2) | is_free(3) | is_free(4);
            let (least, most) = (if at_surface { 0.0 } else { FEEDBACK_RANGE.0 }, FEEDBACK_RANGE.1);
            let error = density[i] / target + rock[0][i] - 1.0;
            let error = if error > least { error } else { least };
            let error = if error < most { error } else { most };
            let is_liquid = liquid[0][i];
            diagonal[i] = is_liquid * (left[i] + right[i] + lower[i] + upper[i]);
            to_right[i] = is_liquid * right[i] * liquid[2][i];
            to_upper[i] = is_liquid * upper[i] * liquid[4][i];
            right_side[i] = is_liquid * (feedback * error - divergence);
        }
    }
}

/// Finds the change on every face that touches liquid, and fills one layer around them in from its neighbours.
#[inline(always)]
fn change_velocities(grid: &MacGrid, closed: &ClosedFaces, faces: &mut Faces, conjugate: &Conjugate) {
    let Conjugate { liquid, solution: p, rows, .. } = conjugate;
    let Faces { u, v, new_u, new_v, change, known, reached, .. } = faces;
    let (s, n) = (grid.stride, grid.columns + 1);
    // Rows of faces that touch liquid, and with the layer around them.
    let touching = rows.start..rows.end + 1;
    let near = (rows.start - 1).max(1)..(rows.end + 2).min(grid.rows + 2);
    for (old, new, open, step) in [(&*u, new_u, &closed.open_u, 1), (&*v, new_v, &closed.open_v, s)] {
        for field in [&mut *change, known] {
            field[grid.rows(near.start - 1..near.end + 1)].fill(0.0);
        }
        for j in touching.clone() {
            let o = grid.row(j) + 1;
            let [liquid, p] = [liquid, p].map(|field| [&field[o - step..o - step + n], &field[o..o + n]]);
            let (open, old) = (&open[o..o + n], &old[o..o + n]);
            let (change, known) = (&mut change[o..o + n], &mut known[o..o + n]);
            for i in 0..n {
                let touches = if liquid[0][i] + liquid[1][i] > 0.0 { 1.0 } else { 0.0 };
                let gained = if open[i] > 0.0 { p[0][i] - p[1][i] } else { -old[i][1] };
                known[i] = touches;
                change[i] = touches * gained;
            }
        }
        for j in near.clone() {
            let o = grid.row(j);
            let (old, new) = (&old[o..o + s], &mut new[o..o + s]);
            let [(change, around_change), (known, around_known)] = [&*change, &*known]
                .map(|field| (&field[o..o + s], [o - 1, o + 1, o - s, o + s].map(|at| &field[at..at + s])));
            for i in 0..s {
                let sum = |field: &[&[f32]; 4]| (field[0][i] + field[1][i]) + (field[2][i] + field[3][i]);
                let around = sum(&around_known);
                let filled = sum(&around_change) / if around > 0.5 { around } else { 0.5 };
                let gained = if known[i] > 0.0 { change[i] } else { filled };
                new[i] = [gained, old[i][1] + gained];
            }
        }
        // Away from the liquid nothing changes.
        for far in [reached.start..near.start.min(reached.end), near.end.max(reached.start)..reached.end] {
            let far = if far.is_empty() { 0..0 } else { grid.rows(far) };
            for (new, old) in new[far.clone()].iter_mut().zip(&old[far]) {
                *new = [0.0, old[1]];
            }
        }
    }
}
