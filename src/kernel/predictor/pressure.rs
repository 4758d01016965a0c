//! The pressure equation: divergence and density feedback in, changes of face velocities out.

use crate::{
    parallel::{Rows, Sweep, Team, sweep},
    predictor::{
        PredictorReport, behind,
        changes::Changes,
        conjugate::{Conjugate, tolerance},
        equation::{
            Around, CHUNK, Sides, couple, fill, keep_volumes, lighten, mark, may_be_sealed, spare_the_heavy, steepness,
            subtract_divergence,
        },
        feedback::feed_back,
        grains::{Bed, Grains},
        grid::MacGrid,
        letting_go::LettingGo,
        level::{Level, WORTH_A_PIECE, damping},
        multigrid::Hierarchy,
        pieces::Pieces,
        pockets::Pockets,
        rock::ClosedFaces,
        slivers,
        stencil::Axis,
        transfer::Faces,
    },
    simd::{Lanes, Pass},
};
use glam::Vec2;
use std::{
    ops::Range,
    sync::atomic::{AtomicBool, Ordering},
};

/// Residual, relative to the right-hand side, up to which the feedback is solved for: a fifth, as much as the rate
/// leaves.
const FEEDBACK_TOLERANCE: f64 = 0.2;
/// How much more exact the pressure is solved for among grains, whose friction goes by it: what is left stirs a bed at rest.
const OF_GRAINS: f64 = 0.2;
/// Share of a full face's particles from which on they stand on both sides of it, so that their mean velocity is the
/// face's. At a free surface a face that is half full has its particles on one side.
const WHOLE: f32 = 0.5;

/// Particles (as weights) from which on a face has them on both sides, where the density `target` (per d²) is aimed at.
pub(super) fn whole(grid: &MacGrid, target: f32) -> f32 {
    WHOLE * target * grid.cell * grid.cell
}

/// One projection. `p` is counted in d/s: a face gains `p_left − p_right`, over its density as a share of the heaviest's.
pub(super) struct Projection<'a> {
    pub grid: &'a MacGrid,
    pub closed: &'a ClosedFaces,
    pub faces: &'a mut Faces,
    pub hierarchy: &'a mut Hierarchy,
    pub conjugate: &'a mut Conjugate,
    pub pockets: &'a mut Pockets,
    pub letting_go: &'a mut LettingGo,
    pub grains: Option<&'a mut Grains>,
    /// What gravity adds in the substep, d/s.
    pub kick: Vec2,
    /// Density that is aimed at, particles per d².
    pub target: f32,
    /// Substep, s.
    pub dt: f32,
    pub team: Team,
    pub report: &'a mut PredictorReport,
}

impl Pass for Projection<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self {
            grid,
            closed,
            faces,
            hierarchy,
            conjugate,
            pockets,
            letting_go,
            mut grains,
            kick,
            target,
            dt,
            team,
            report,
        } = self;
        conjugate.resize(grid.len());
        mark_liquid(grid, closed, faces, conjugate, &mut hierarchy.finest().wet, (target, team));
        faces.find_means(grid, team);
        if conjugate.rows.is_empty() {
            return;
        }
        letting_go.run((grid, closed), faces, grains.as_deref(), conjugate, kick.length());
        let full = target * grid.cell * grid.cell;
        let of = (dt, whole(grid, target));
        let sealed = assemble(grid, closed, faces, hierarchy.finest(), conjugate, of, team);
        if let Some(grains) = &mut grains {
            let bed = Bed::new((grid, closed), conjugate, full, kick, team);
            grains.begin(&bed, faces, &mut hierarchy.finest().b);
        }
        let has_pockets = sealed && pockets.are_there(grid, hierarchy.finest());
        if has_pockets {
            pockets.balance(grid, hierarchy.finest());
        }
        hierarchy.coarsen(team);
        let mut pressure = std::mem::take(&mut conjugate.solution);
        let tolerance = tolerance(dt) * if grains.is_some() { OF_GRAINS } else { 1.0 };
        let velocities = conjugate.solve(hierarchy, &mut pressure, tolerance, team);
        conjugate.solution = pressure;

        let filled = match &mut grains {
            Some(grains) => grains.uneven(&Bed::new((grid, closed), conjugate, full, kick, team), faces),
            None => &faces.filled,
        };
        let cuts = feed_back(grid, closed, filled, hierarchy.finest(), conjugate, team);
        if has_pockets {
            pockets.balance(grid, hierarchy.finest());
        }
        let mut potential = std::mem::take(&mut conjugate.potential);
        let drift = conjugate.solve(hierarchy, &mut potential, FEEDBACK_TOLERANCE, team);
        let potentials = [&conjugate.solution[..], &potential];
        Changes { grid, closed, conjugate, potentials, team }.find(faces, hierarchy.finest());
        if let Some(grains) = grains {
            grains.end(&Bed::new((grid, closed), conjugate, full, kick, team), faces, &conjugate.solution);
        }
        letting_go.note(&mut conjugate.solution);
        conjugate.clear(&mut potential, grid.stride);
        conjugate.potential = potential;
        *report = PredictorReport { unsolved: velocities.unsolved | drift.unsolved, cuts, ..velocities };
    }
}

/// Rows of cells that have a particle on one of their faces, and one more on either side.
fn cells_reached(grid: &MacGrid, faces: &Faces) -> Range<usize> {
    let first = faces.reached.start.saturating_sub(2).max(1);
    first..(faces.reached.end + 1).min(grid.rows + 1).max(first)
}

/// Finds how full the cells are, marks the liquid ones with 1 and notes the rows from the first to the last that has
/// one. The last solution stays as the first guess where there still is liquid.
fn mark_liquid(
    grid: &MacGrid,
    closed: &ClosedFaces,
    faces: &mut Faces,
    conjugate: &mut Conjugate,
    wet: &mut Pieces,
    (target, team): (f32, Team),
) {
    let rows = cells_reached(grid, faces);
    let Conjugate { rows: before, area, span, liquid, solution, .. } = conjugate;
    for far in
        [before.start..rows.start.clamp(before.start, before.end), rows.end.clamp(before.start, before.end)..before.end]
    {
        liquid[grid.rows(far.clone())].fill(0.0);
        solution[grid.rows(far)].fill(0.0);
    }
    if *area != faces.area {
        // In columns that nothing is near any more.
        for row in before.clone() {
            for column in area.clone().filter(|column| !faces.area.contains(column)) {
                (liquid[grid.row(row) + column], solution[grid.row(row) + column]) = (0.0, 0.0);
            }
        }
        area.clone_from(&faces.area);
    }
    let share = 0.25 * grid.per_cell * grid.per_cell / target;
    let Faces { u, v, filled, made_up, .. } = faces;
    let band = |field| Rows::new(field, grid.stride, &rows);
    let band = (band(filled), (band(liquid), band(solution)));
    let work = Mark { grid, closed, area, weights: [u, v], share };
    sweep(&work, rows.clone(), band, area.len(), WORTH_A_PIECE, team);
    behind::make_up(&closed.behind, grid, (&rows, area), [filled, liquid, solution], made_up);
    slivers::follow_hosts(&closed.slivers, grid, (&rows, area), [filled, liquid, solution]);
    wet.find(liquid, grid.stride, rows, area.clone());
    *before = if wet.rows().is_empty() { 0..0 } else { wet.rows() };
    *span = grid.whole_pieces(wet.columns());
}

struct Mark<'a> {
    grid: &'a MacGrid,
    closed: &'a ClosedFaces,
    /// Columns that are looked at.
    area: &'a Range<usize>,
    /// Weights of the faces.
    weights: [&'a [[f32; 2]]; 2],
    /// Share of a cell that a face's weight stands for.
    share: f32,
}

/// Rows of the cells' filling and liquid, and of the solution.
type Marks<'a> = (Rows<'a, f32>, (Rows<'a, f32>, Rows<'a, f32>));

impl Sweep<Marks<'_>> for Mark<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut filled, (mut liquid, mut solution)): Marks) {
        let Self { grid, closed, area, weights: [u, v], share } = *self;
        let out = filled.each().zip(liquid.each()).zip(solution.each());
        for (j, ((filled, liquid), solution)) in rows.zip(out) {
            let (cells, own) = (grid.row(j) + area.start..grid.row(j) + area.end, area.clone());
            let (filled, liquid) = (&mut filled[own.clone()], &mut liquid[own.clone()]);
            let stored = closed.row(j) + area.start..closed.row(j) + area.end;
            fill(filled, Sides::new(u, v, cells, grid.stride), &closed.rock[stored.clone()], share);
            mark(liquid, filled, &closed.liquid_from[stored]);
            for (p, liquid) in solution[own].iter_mut().zip(&*liquid) {
                *p *= *liquid;
            }
        }
    }
}

/// Sets up `Σ_f w_f s_f (p_c − p_n) = −Σ ± w_f u_f − Δt c det ∇u` over the liquid cells of edge c; p = 0 in the air,
/// and s_f is how much steeper than between liquid cells the pressure falls at the face. The last term is that of
/// [`keep_volumes`]. Returns whether any of it may be sealed off.
fn assemble(
    grid: &MacGrid,
    closed: &ClosedFaces,
    faces: &mut Faces,
    finest: &mut Level,
    conjugate: &Conjugate,
    (dt, whole): (f32, f32),
    team: Team,
) -> bool {
    let Conjugate { rows, liquid, .. } = conjugate;
    finest.take_back(&mut faces.ways);
    finest.take();
    let sealed = AtomicBool::new(false);
    let Level { operator, b, wet, .. } = finest;
    let [diagonal, damped, right, upper] = operator.fields_mut();
    let work = Assemble { grid, closed, faces, liquid, wet, dt, whole, sealed: &sealed };
    let band = |field| Rows::new(field, grid.stride, rows);
    let band = ((band(diagonal), band(damped)), ((band(right), band(upper)), band(b)));
    sweep(&work, rows.clone(), band, wet.per_row(), WORTH_A_PIECE, team);
    sealed.into_inner()
}

struct Assemble<'a> {
    grid: &'a MacGrid,
    closed: &'a ClosedFaces,
    faces: &'a Faces,
    liquid: &'a [f32],
    /// What is solved for.
    wet: &'a Pieces,
    /// Substep, s.
    dt: f32,
    /// Particles from which on a face has them on both sides.
    whole: f32,
    /// Out: whether any liquid may be sealed off. It is not if all that is under no liquid is open to air on some side:
    /// the way up from any cell, as far as there is liquid, ends at such a cell.
    sealed: &'a AtomicBool,
}

/// Rows of diagonal and damping, of the couplings to the right and up, and of the right-hand side.
type System<'a> = ((Rows<'a, f32>, Rows<'a, f32>), ((Rows<'a, f32>, Rows<'a, f32>), Rows<'a, f32>));

impl Sweep<System<'_>> for Assemble<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, system: System) {
        let Self { grid, closed, faces, liquid, wet, dt, whole, sealed } = *self;
        let ((mut diagonal, mut damped), ((mut right, mut upper), mut b)) = system;
        let stride = grid.stride;
        let mut any_sealed = false;
        let out = diagonal.each().zip(damped.each()).zip(right.each().zip(upper.each())).zip(b.each());
        for (j, (((diagonal, damped), (right, upper)), b)) in rows.zip(out) {
            let chunks = |run: Range<usize>| {
                let end = grid.row(j) + run.end;
                (grid.row(j) + run.start..end).step_by(CHUNK).map(move |start| start..end.min(start + CHUNK))
            };
            for cells in wet.runs(j).flat_map(chunks) {
                let start = cells.start;
                let (n, own) = (cells.len(), start - grid.row(j)..start - grid.row(j) + cells.len());
                let [mut steep_u, mut steep_lower, mut steep_upper] = [[0.0_f32; CHUNK + 1]; 3];
                for (axis, first, steep) in [
                    (Axis::U, start, &mut steep_u[..n + 1]),
                    (Axis::V, start, &mut steep_lower[..n]),
                    (Axis::V, start + stride, &mut steep_upper[..n]),
                ] {
                    let n = steep.len();
                    let of = |field| beside(field, first, n, axis.step(grid));
                    steepness(steep, of(liquid), of(&faces.filled), closed.beside(grid, axis, first, n));
                    if let Some(matter) = &faces.matter {
                        lighten(steep, &matter.of(axis)[first..first + n]);
                    }
                }
                let around = Around::new(liquid, cells.clone(), stride);
                let [at, above] = [j, j + 1].map(|j| closed.row(j) + own.start);
                let (open_u, open_v) = (&closed.open_u[at..at + n + 1], &closed.open_v);
                let open = Sides::of_rows(open_u, &open_v[at..at + n], &open_v[above..above + n]);
                let steep = Sides::of_rows(&steep_u[..n + 1], &steep_lower[..n], &steep_upper[..n]);
                let (diagonal, to_right) = (&mut diagonal[own.clone()], &mut right[own.clone()]);
                let to_upper = &mut upper[own.clone()];
                couple(diagonal, to_right, to_upper, around, open, steep);
                let damped = &mut damped[own.clone()];
                for i in 0..n {
                    damped[i] = damping(diagonal[i]);
                }
                any_sealed |= may_be_sealed(diagonal, to_right, to_upper, around, open, steep);
                let right_side = &mut b[own];
                keep_volumes(right_side, [&faces.u, &faces.v], cells.clone(), stride, dt / grid.cell, whole);
                if let Some(matter) = &faces.matter {
                    let densities = Sides::new(matter.of(Axis::U), matter.of(Axis::V), cells.clone(), stride);
                    spare_the_heavy(right_side, densities);
                }
                let velocities = Sides::new(&faces.u, &faces.v, cells, stride);
                subtract_divergence(right_side, around.centre, open, velocities);
            }
        }
        sealed.fetch_or(any_sealed, Ordering::Relaxed);
    }
}

/// The cells before and after `n` faces from `first` on.
#[inline(always)]
pub(super) fn beside(field: &[f32], first: usize, n: usize, step: usize) -> [&[f32]; 2] {
    [&field[first - step..first - step + n], &field[first..first + n]]
}
