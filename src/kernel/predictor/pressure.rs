//! The pressure equation: divergence and density feedback in, changes of face velocities out.

use crate::kernel::{
    predictor::{
        PredictorReport, conjugate::Conjugate, grid::MacGrid, multigrid::Hierarchy, pockets::Pockets,
        rock::ClosedFaces, transfer::Faces,
    },
    simd::{Lanes, Pass},
};

/// A cell is liquid from this share of its open room on.
const LIQUID_SHARE: f32 = 0.5;
/// A cell with more rock than this is not solved for.
const ROCK_SHARE: f32 = 0.9;
/// Nearest that the surface is taken to be to a liquid cell's centre, cells: nearer would make the equation stiff.
const LEAST_THETA: f32 = 0.25;
/// Rate at which a density error is to be taken away, 1/s: a fifth of it in a tick, however many substeps that has. Per
/// substep it would work eight times as hard at eight of them, and stir a still pool.
const FEEDBACK_PER_SECOND: f32 = 12.0;
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
    pub report: &'a mut PredictorReport,
}

impl Pass for Projection<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, closed, faces, hierarchy, conjugate, pockets, target, report } = self;
        find_means(grid, faces);
        conjugate.resize(grid.len());
        let Some(rows) = mark_liquid(grid, closed, &faces.density, target, &mut conjugate.liquid) else {
            conjugate.solution.fill(0.0);
            return;
        };
        let rows = rows.0..=rows.1;
        assemble(grid, closed, faces, hierarchy, conjugate, target, rows.clone());
        pockets.balance(grid, hierarchy.finest(), &mut conjugate.right_side);
        hierarchy.coarsen();
        *report = conjugate.solve(hierarchy);
        change_velocities(grid, closed, faces, conjugate, rows);
    }
}

/// Turns momenta into velocities and finds the density of each cell as the mean of its faces'.
#[inline(always)]
fn find_means(grid: &MacGrid, faces: &mut Faces) {
    let share = 0.25 * grid.per_cell * grid.per_cell;
    let n = grid.columns;
    for j in 1..=grid.rows {
        let o = grid.row(j) + 1;
        let (left, right) = (&faces.u[o..o + n], &faces.u[o + 1..o + 1 + n]);
        let (lower, upper) = (&faces.v[o..o + n], &faces.v[o + grid.stride..o + grid.stride + n]);
        for (i, density) in faces.density[o..o + n].iter_mut().enumerate() {
            *density = share * (left[i][0] + right[i][0] + lower[i][0] + upper[i][0]);
        }
    }
    for face in faces.u.iter_mut().chain(&mut faces.v) {
        let weight = if face[0] > 1e-12 { face[0] } else { 1e-12 };
        face[1] /= weight;
    }
}

/// Marks the liquid cells with 1; returns the first and the last row that has one.
#[inline(always)]
fn mark_liquid(
    grid: &MacGrid,
    closed: &ClosedFaces,
    density: &[f32],
    target: f32,
    liquid: &mut [f32],
) -> Option<(usize, usize)> {
    liquid.fill(0.0);
    let mut rows: Option<(usize, usize)> = None;
    for j in 1..=grid.rows {
        let mut any = false;
        for k in grid.row(j) + 1..=grid.row(j) + grid.columns {
            let rock = closed.rock[k];
            let open = closed.open_u[k] + closed.open_u[k + 1] + closed.open_v[k] + closed.open_v[k + grid.stride];
            let is_liquid =
                density[k] >= LIQUID_SHARE * target * (1.0 - rock) && rock < ROCK_SHARE && open >= LEAST_DIAGONAL;
            liquid[k] = f32::from(u8::from(is_liquid));
            any |= is_liquid;
        }
        if any {
            rows = Some((rows.map_or(j, |(first, _)| first), j));
        }
    }
    rows
}

/// 1/θ for a face between a liquid cell and air, with `filled` the liquid shares of both together: the surface, where
/// p = 0, lies θ cells from the liquid cell's centre (Enright et al. 2003; a second-order surface). Without it all
/// surfaces within one cell would be level, and a pool could rest with bumps.
#[inline(always)]
fn steepness(filled: f32) -> f32 {
    1.0 / (filled - 0.5).clamp(LEAST_THETA, 1.0)
}

/// Sets up `Σ_f w_f s_f (p_c − p_n) = −Σ ± w_f u_f + feedback` over the liquid cells; p = 0 in the air, s_f is 1 between
/// liquid cells and [`steepness`] at the surface.
#[inline(always)]
fn assemble(
    grid: &MacGrid,
    closed: &ClosedFaces,
    faces: &mut Faces,
    hierarchy: &mut Hierarchy,
    conjugate: &mut Conjugate,
    target: f32,
    rows: std::ops::RangeInclusive<usize>,
) {
    let (s, feedback) = (grid.stride, FEEDBACK_PER_SECOND * grid.cell);
    let Conjugate { liquid, right_side, solution, .. } = conjugate;
    let finest = hierarchy.finest();
    finest.clear(*rows.start(), *rows.end());
    right_side.fill(0.0);
    // Neither liquid nor mostly rock: the surface is there.
    let is_free = |k: usize| liquid[k] + 2.0 * closed.rock[k] < 0.5;
    for j in rows.clone() {
        for i in 1..=grid.columns {
            let k = grid.row(j) + i;
            if liquid[k] == 0.0 {
                continue;
            }
            let (left, right, lower, upper) =
                (closed.open_u[k], closed.open_u[k + 1], closed.open_v[k], closed.open_v[k + s]);
            let divergence =
                right * faces.u[k + 1][1] - left * faces.u[k][1] + upper * faces.v[k + s][1] - lower * faces.v[k][1];
            let at_surface = (i > 1 && is_free(k - 1))
                || (i < grid.columns && is_free(k + 1))
                || (j > 1 && is_free(k - s))
                || (j < grid.rows && is_free(k + s));
            let least = if at_surface { 0.0 } else { FEEDBACK_RANGE.0 };
            let error = (faces.density[k] / target + closed.rock[k] - 1.0).clamp(least, FEEDBACK_RANGE.1);
            let fill = |n: usize| faces.density[n] / target + closed.rock[n];
            let steep = |n: usize| if liquid[n] > 0.0 { 1.0 } else { steepness(fill(k) + fill(n)) };
            let steep = [k - 1, k + 1, k - s, k + s].map(steep);
            (faces.steep_u[k], faces.steep_u[k + 1], faces.steep_v[k], faces.steep_v[k + s]) =
                (steep[0], steep[1], steep[2], steep[3]);
            finest.diagonal[k] = left * steep[0] + right * steep[1] + lower * steep[2] + upper * steep[3];
            finest.right[k] = right * liquid[k + 1];
            finest.upper[k] = upper * liquid[k + s];
            right_side[k] = feedback * error - divergence;
        }
    }
    // The last solution is the first guess, where there still is liquid.
    for (p, liquid) in solution.iter_mut().zip(liquid.iter()) {
        *p *= *liquid;
    }
}

/// Finds the change on every face that touches liquid, and fills one layer around them in from its neighbours.
#[inline(always)]
fn change_velocities(
    grid: &MacGrid,
    closed: &ClosedFaces,
    faces: &mut Faces,
    conjugate: &Conjugate,
    rows: std::ops::RangeInclusive<usize>,
) {
    let (liquid, p) = (&conjugate.liquid, &conjugate.solution);
    let Faces { u, v, new_u, new_v, steep_u, steep_v, change, known, .. } = faces;
    let (along, up) = ((&*u, new_u, &closed.open_u, steep_u, 1), (&*v, new_v, &closed.open_v, steep_v, grid.stride));
    for (old, new, open, steep, step) in [along, up] {
        change.fill(0.0);
        known.fill(0.0);
        for j in *rows.start()..=*rows.end() + 1 {
            for k in grid.row(j) + 1..=grid.row(j) + grid.columns + 1 {
                let touches = if liquid[k] + liquid[k - step] > 0.0 { 1.0 } else { 0.0 };
                let gained = if open[k] > 0.0 { steep[k] * (p[k - step] - p[k]) } else { -old[k][1] };
                known[k] = touches;
                change[k] = touches * gained;
            }
        }
        let (s, first, last) =
            (grid.stride, rows.start().saturating_sub(1).max(1), (rows.end() + 2).min(grid.rows + 1));
        for j in first..=last {
            for k in grid.row(j)..=grid.row(j) + grid.columns + 1 {
                let around = known[k - 1] + known[k + 1] + known[k - s] + known[k + s];
                let sum = change[k - 1] + change[k + 1] + change[k - s] + change[k + s];
                let filled = sum / if around > 0.5 { around } else { 0.5 };
                let gained = if known[k] > 0.0 { change[k] } else { filled };
                new[k] = [gained, old[k][1] + gained];
            }
        }
        // Away from the liquid nothing changes.
        for j in (0..first).chain(last + 1..=grid.rows + 2) {
            for k in grid.row(j)..grid.row(j) + grid.stride {
                new[k] = [0.0, old[k][1]];
            }
        }
    }
}
