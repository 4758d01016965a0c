//! Friction among grains, as a stress on the cells (after Narain, Golas & Lin 2010, "Free-flowing granular materials with
//! two-way solid coupling"): it takes from the flow what Coulomb's law lets it, and is kept from substep to substep, so that a
//! slope of any height is held.
//!
//! S = s_xx = −s_yy stands in the cells, T = s_xy in their lower left corners, both counted in d/s as the pressure is: a face
//! gains the differences of the stresses around it, times its lightness. Of all stresses with √(S² + T²) ≤ sin φ · p that one is
//! taken that leaves the flow least energy, by projected gradients with Nesterov's acceleration from the last substep's on.
//!
//! With sin φ, Mohr's circle touches the line of the angle φ: a slope rests up to φ.

use crate::{
    parallel::{Rows, Sweep, sweep},
    predictor::{
        grains::{
            bed::{Bed, Touched},
            fields::{Fields, Two, row, two},
            limits::{FindLimits, FindPressures},
            spread::Spread,
        },
        grid::MacGrid,
        level::WORTH_A_PIECE,
        stencil::Axis,
        transfer::Faces,
    },
};
use std::ops::Range;

/// Iterations of a substep.
const ITERATIONS: usize = 20;

/// Least mass of a face, of a full one's: what is lighter would be moved at once by any stress.
const LEAST_MASS: f32 = 0.25;

/// Mass of a face in a bed, of one whose cells are full.
const COMPACT: f32 = 1.08;

/// Stress among grains. The buffers are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Friction {
    /// Where what is below may differ from 0.
    touched: Touched,
    /// S and T, d/s.
    stress: Fields,
    /// S and T of what took part last where nothing does now: what sleeps there wakes with them.
    kept: Fields,
    /// How much was strained in the last substep, d/s a cell.
    strain: Fields,
    /// The iterate before, and the one that is looked ahead to.
    before: Fields,
    ahead: Fields,
    /// Most stress, d/s.
    limit: Fields,
    /// Steps along the gradient.
    step: Fields,
    /// 1 in corners that the stress of cells counts in; 0 at walls.
    inner: Vec<f32>,
    /// What a stress moves a face by: 0 where it moves none.
    pub lightness: Fields,
    /// Velocities without friction, d/s.
    flow: Fields,
    /// Velocities with the stress that is looked ahead to, d/s.
    held: Fields,
    /// What the stress changes, d/s.
    pub gained: Fields,
    /// Pressures that grains press one another with, and the wall, d/s.
    pressed: Fields,
}

impl Friction {
    /// Finds which faces and corners take part, and what the last substep's stress changes on the faces.
    pub fn begin(&mut self, bed: &Bed, faces: &Faces) {
        self.make_room(bed);
        let Self { touched: Touched { rows, columns }, stress, kept, strain, step, lightness, .. } = self;
        let stride = bed.grid.stride;
        let work = Lighten { bed, columns: columns.clone(), faces };
        sweep(&work, rows.clone(), two(lightness, stride, rows), columns.len(), WORTH_A_PIECE, bed.team);
        let work = TakePart { bed, columns: columns.clone(), lightness, strain };
        let band = ((two(stress, stride, rows), two(kept, stride, rows)), two(step, stride, rows));
        sweep(&work, rows.clone(), band, columns.len(), WORTH_A_PIECE, bed.team);
        self.change(bed);
    }

    /// Takes the divergence of what the stress changes off the right-hand side of the pressure.
    pub fn subtract_divergence(&self, bed: &Bed, right_side: &mut [f32]) {
        let work = Diverge { bed, columns: bed.span.clone(), gained: &self.gained };
        let band = Rows::new(right_side, bed.grid.stride, &bed.rows);
        sweep(&work, bed.rows.clone(), band, bed.span.len(), WORTH_A_PIECE, bed.team);
    }

    /// Room for the grid, with 0 wherever nothing takes part any more.
    fn make_room(&mut self, bed: &Bed) {
        let Self { touched, stress, kept, strain, .. } = self;
        for ((stress, kept), strain) in stress.iter_mut().zip(kept).zip(strain) {
            for field in [&mut *stress, kept, strain] {
                field.resize(bed.grid.len(), 0.0);
            }
            touched.left(bed, |left| {
                for k in left {
                    lay_by(&mut stress[k], &mut kept[k], is_still(bed, strain[k]));
                    strain[k] = 0.0;
                }
            });
        }
        let fields = [&mut self.before, &mut self.ahead, &mut self.limit, &mut self.step];
        let on_faces = [&mut self.lightness, &mut self.flow, &mut self.held, &mut self.gained, &mut self.pressed];
        for field in fields.into_iter().chain(on_faces).flatten().chain([&mut self.inner]) {
            // What is above and to the right of the last is read, and counts for nothing.
            field.resize(bed.grid.len() + 1, 0.0);
            self.touched.left(bed, |left| field[left].fill(0.0));
        }
        self.touched = bed.touched();
    }

    /// What the next substep sets out from.
    pub fn kept(&self) -> [&Vec<f32>; 6] {
        let ([s, t], [kept_s, kept_t], [cells, corners]) = (&self.stress, &self.kept, &self.strain);
        [s, t, kept_s, kept_t, cells, corners]
    }

    /// One that sets out from what was kept on a grid.
    pub fn resume(grid: &MacGrid, [s, t, kept_s, kept_t, cells, corners]: [Vec<f32>; 6]) -> Self {
        let touched = Touched { rows: 0..grid.rows + 3, columns: 0..grid.stride };
        Self { touched, stress: [s, t], kept: [kept_s, kept_t], strain: [cells, corners], ..Self::default() }
    }

    /// What the stress changes on the faces.
    fn change(&mut self, bed: &Bed) {
        let Self { touched: Touched { rows, columns }, stress, lightness, gained, .. } = self;
        let (columns, flow) = (columns.clone(), [&[][..]; 2]);
        let work = Hold { bed, columns: columns.clone(), stress, before: stress, further: 0.0, lightness, flow };
        sweep(&work, rows.clone(), two(gained, bed.grid.stride, rows), columns.len(), WORTH_A_PIECE, bed.team);
    }

    /// Finds the stress under a pressure (d/s), and what it changes on the faces.
    pub fn solve(&mut self, bed: &Bed, faces: &Faces, spread: &Spread, pressure: &[f32], pore: &[f32]) {
        let Touched { rows, columns } = self.touched.clone();
        let (stride, team) = (bed.grid.stride, bed.team);
        let work = FindPressures { bed, columns: columns.clone(), faces, spread: *spread, pressure, pore };
        sweep(&work, rows.clone(), two(&mut self.pressed, stride, &rows), columns.len(), WORTH_A_PIECE, team);
        let Self { pressed, stress, strain, step, limit, inner, .. } = self;
        let [along, _] = &*stress;
        let work =
            FindLimits { bed, columns: columns.clone(), spread: *spread, pressed, along, strain, takes_part: &step[1] };
        sweep(
            &work,
            rows.clone(),
            (two(limit, stride, &rows), Rows::new(inner, stride, &rows)),
            columns.len(),
            WORTH_A_PIECE,
            team,
        );
        for (axis, flow) in self.flow.iter_mut().enumerate() {
            for k in self.touched.all(bed.grid) {
                let mean = [&faces.u, &faces.v][axis][k][1];
                flow[k] = if self.lightness[axis][k] > 0.0 { mean + faces.ways[axis][k][0] } else { 0.0 };
            }
        }
        for (before, stress) in self.before.iter_mut().zip(&self.stress) {
            before[bed.grid.rows(rows.clone())].copy_from_slice(&stress[bed.grid.rows(rows.clone())]);
        }
        for iteration in 0..ITERATIONS {
            self.iterate(bed, iteration as f32 / (iteration as f32 + 3.0));
        }
        self.change(bed);
        self.find_strain(bed);
    }

    /// One step along the gradient from where the last two lead to, and back into the cone.
    fn iterate(&mut self, bed: &Bed, further: f32) {
        let Self {
            touched: Touched { rows, columns },
            stress,
            before,
            ahead,
            limit,
            step,
            inner,
            lightness,
            flow,
            held,
            ..
        } = self;
        let stride = bed.grid.stride;
        let flow = flow.each_ref().map(|flow| &flow[..]);
        let hold = Hold { bed, columns: columns.clone(), stress, before, further, lightness, flow };
        sweep(&hold, rows.clone(), two(held, stride, rows), columns.len(), WORTH_A_PIECE, bed.team);
        let pull = Pull { bed, columns: columns.clone(), stress, before, further, step, held };
        sweep(&pull, rows.clone(), two(ahead, stride, rows), columns.len(), WORTH_A_PIECE, bed.team);
        let limit = Limit { bed, columns: columns.clone(), ahead, limit, inner };
        sweep(&limit, rows.clone(), two(before, stride, rows), columns.len(), WORTH_A_PIECE, bed.team);
        std::mem::swap(stress, before);
    }

    /// How much is strained, d/s a cell: a cell as much as the most strained of its corners at least.
    fn find_strain(&mut self, bed: &Bed) {
        let stride = bed.grid.stride;
        let Self { touched, strain: [cells, corners], held: [u, v], flow, gained, step, .. } = self;
        let all = || touched.all(bed.grid);
        for k in all() {
            (u[k], v[k]) = (flow[0][k] + gained[0][k], flow[1][k] + gained[1][k]);
        }
        for k in all() {
            let sheared = (u[k] - u[k - stride] + v[k] - v[k - 1]).abs();
            corners[k] = if step[1][k] > 0.0 { sheared } else { 0.0 };
        }
        for k in all() {
            cells[k] = 0.0;
            if bed.is_liquid(k) {
                let own = (u[k + 1] - u[k] - v[k + stride] + v[k]).abs();
                let around = [k, k + 1, k + stride, k + stride + 1];
                cells[k] = around.iter().fold(own, |most, k| most.max(corners[*k]));
            }
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let pairs =
            [&self.stress, &self.kept, &self.strain, &self.before, &self.ahead, &self.limit, &self.step, &self.pressed];
        let faces = [&self.lightness, &self.flow, &self.held, &self.gained];
        4 * (pairs.into_iter().chain(faces).flatten().map(Vec::capacity).sum::<usize>() + self.inner.capacity())
    }
}

/// Finds what a stress moves faces by.
struct Lighten<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    faces: &'a Faces,
}

impl<'b> Sweep<Two<'b>> for Lighten<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut u, mut v): Two) {
        let Self { bed, columns, faces } = self;
        for (j, (u, v)) in rows.zip(u.each().zip(v.each())) {
            for (axis, lightness, counts) in [(Axis::U, u, &faces.u), (Axis::V, v, &faces.v)] {
                for column in columns.clone() {
                    let k = bed.grid.row(j) + column;
                    let is_moved = bed.is_touched(axis, k) && bed.open(axis, k) > 0.0;
                    let mass = (COMPACT * counts[k][0] / bed.full).clamp(LEAST_MASS, 1.0);
                    let density = faces.matter.as_ref().map_or(1.0, |matter| matter.of(axis)[k][1]);
                    lightness[column] = if is_moved { density / mass } else { 0.0 };
                }
            }
        }
    }
}

/// Takes a divergence off the right-hand side of the pressure.
struct Diverge<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    gained: &'a Fields,
}

impl Sweep<Rows<'_, f32>> for Diverge<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut right_side: Rows<f32>) {
        let Self { bed, columns, gained: [u, v] } = self;
        let (n, stride, closed) = (columns.len(), bed.grid.stride, bed.closed);
        for (j, out) in rows.zip(right_side.each()) {
            let (k, out) = (bed.grid.row(j) + columns.start, &mut out[columns.clone()]);
            let [own, above] = [j, j + 1].map(|j| closed.row(j) + columns.start);
            let (open_left, open_right) = (row(&closed.open_u, own, n), row(&closed.open_u, own + 1, n));
            let (open_lower, open_upper) = (row(&closed.open_v, own, n), row(&closed.open_v, above, n));
            let (left, right) = (row(u, k, n), row(u, k + 1, n));
            let (lower, upper, liquid) = (row(v, k, n), row(v, k + stride, n), row(bed.liquid, k, n));
            for i in 0..n {
                let along = open_right[i] * right[i] - open_left[i] * left[i];
                out[i] -= liquid[i] * (along + (open_upper[i] * upper[i] - open_lower[i] * lower[i]));
            }
        }
    }
}

/// Strain of a substep up to which grains are still, in g Δt a cell.
const STILL: f32 = 0.1;

/// Whether a strain (d/s a cell) is next to none.
#[inline(always)]
fn is_still(bed: &Bed, strain: f32) -> bool {
    strain <= STILL * bed.kick.length()
}

/// Takes the stress of what takes no part any more, and lays it by if it was still: it may have fallen asleep. What moved is gone,
/// and its stress would stir what comes there next.
#[inline(always)]
fn lay_by(stress: &mut f32, kept: &mut f32, is_still: bool) {
    if *stress != 0.0 {
        (*stress, *kept) = (0.0, if is_still { *stress } else { 0.0 });
    }
}

/// Finds how far cells and corners step along the gradient, not at all those that take no part: these have no stress.
struct TakePart<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    lightness: &'a Fields,
    strain: &'a Fields,
}

impl<'b> Sweep<((Two<'b>, Two<'b>), Two<'b>)> for TakePart<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((stress, kept), (mut cells, mut corners)): ((Two, Two), Two)) {
        let Self { bed, columns, lightness: [u, v], strain } = self;
        let stride = bed.grid.stride;
        let ((mut s, mut t), (mut kept_s, mut kept_t)) = (stress, kept);
        let stress = s.each().zip(kept_s.each()).zip(t.each().zip(kept_t.each()));
        for (j, (((s, kept_s), (t, kept_t)), (cells, corners))) in
            rows.zip(stress.zip(cells.each().zip(corners.each())))
        {
            for column in columns.clone() {
                let k = bed.grid.row(j) + column;
                // Corners of which a face is neither moved nor closed are beside the air: nothing is held there.
                let is_held = |axis, k, lightness: f32| lightness > 0.0 || bed.open(axis, k) == 0.0;
                let around = u[k] + u[k - stride] + v[k] + v[k - 1];
                let takes_part = around > 0.0
                    && is_held(Axis::U, k, u[k])
                    && is_held(Axis::U, k - stride, u[k - stride])
                    && is_held(Axis::V, k, v[k])
                    && is_held(Axis::V, k - 1, v[k - 1]);
                corners[column] = if takes_part { 0.5 / around } else { 0.0 };
                let around = u[k] + u[k + 1] + v[k] + v[k + stride];
                cells[column] = if bed.is_liquid(k) && around > 0.0 { 0.5 / around } else { 0.0 };
                let fields = [(cells[column], &mut *s, &mut *kept_s), (corners[column], &mut *t, &mut *kept_t)];
                for ((step, stress, kept), strain) in fields.into_iter().zip(strain.iter()) {
                    let (stress, kept) = (&mut stress[column], &mut kept[column]);
                    if step == 0.0 {
                        lay_by(stress, kept, is_still(bed, strain[k]));
                    } else if *kept != 0.0 {
                        (*stress, *kept) = (*kept, 0.0);
                    }
                }
            }
        }
    }
}

/// Velocities under the stress that the last two lead to.
struct Hold<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    stress: &'a Fields,
    before: &'a Fields,
    further: f32,
    lightness: &'a Fields,
    /// Velocities without it; 0 if there are none.
    flow: [&'a [f32]; 2],
}

impl<'b> Sweep<Two<'b>> for Hold<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut u, mut v): Two) {
        let Self { bed, columns, stress: [s, t], before: [s0, t0], further, lightness, flow } = self;
        let (n, stride, further) = (columns.len(), bed.grid.stride, *further);
        for (j, (u, v)) in rows.zip(u.each().zip(v.each())) {
            let k = bed.grid.row(j) + columns.start;
            let (u, v) = (&mut u[columns.clone()], &mut v[columns.clone()]);
            let (light_u, light_v) = (row(&lightness[0], k, n), row(&lightness[1], k, n));
            let [s_own, s_left, s_lower] = [k, k - 1, k - stride].map(|at| (row(s, at, n), row(s0, at, n)));
            let [t_own, t_upper, t_right] = [k, k + stride, k + 1].map(|at| (row(t, at, n), row(t0, at, n)));
            let ahead = |(now, before): (&[f32], &[f32]), i: usize| now[i] + further * (now[i] - before[i]);
            for i in 0..n {
                let (s, t) = (ahead(s_own, i), ahead(t_own, i));
                u[i] = light_u[i] * ((s - ahead(s_left, i)) + (ahead(t_upper, i) - t));
                v[i] = light_v[i] * ((ahead(s_lower, i) - s) + (ahead(t_right, i) - t));
            }
            if flow[0].is_empty() {
                continue;
            }
            for (out, flow) in [(u, flow[0]), (v, flow[1])] {
                out.iter_mut().zip(row(flow, k, n)).for_each(|(out, flow)| *out += flow);
            }
        }
    }
}

/// A step along the gradient.
struct Pull<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    stress: &'a Fields,
    before: &'a Fields,
    further: f32,
    step: &'a Fields,
    held: &'a Fields,
}

impl<'b> Sweep<Two<'b>> for Pull<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut s, mut t): Two) {
        let Self { bed, columns, stress, before, further, step, held: [u, v] } = self;
        let (n, stride, further) = (columns.len(), bed.grid.stride, *further);
        for (j, (s, t)) in rows.zip(s.each().zip(t.each())) {
            let k = bed.grid.row(j) + columns.start;
            let (s, t) = (&mut s[columns.clone()], &mut t[columns.clone()]);
            let [now, last, step] = [stress, before, step].map(|[s, t]| (row(s, k, n), row(t, k, n)));
            let [u_own, u_right, u_lower] = [k, k + 1, k - stride].map(|at| row(u, at, n));
            let [v_own, v_upper, v_left] = [k, k + stride, k - 1].map(|at| row(v, at, n));
            for i in 0..n {
                let ahead = now.0[i] + further * (now.0[i] - last.0[i]);
                s[i] = ahead + step.0[i] * ((u_right[i] - u_own[i]) - (v_upper[i] - v_own[i]));
                let ahead = now.1[i] + further * (now.1[i] - last.1[i]);
                t[i] = ahead + step.1[i] * ((u_own[i] - u_lower[i]) + (v_own[i] - v_left[i]));
            }
        }
    }
}

/// Back into the cone √(S² + T²) ≤ limit, with the mean square of the other component from around.
struct Limit<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    ahead: &'a Fields,
    limit: &'a Fields,
    inner: &'a [f32],
}

/// Least square of a stress that a share is taken of.
const LEAST_SQUARE: f32 = 1e-20;

impl<'b> Sweep<Two<'b>> for Limit<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut s, mut t): Two) {
        let Self { bed, columns, ahead: [from_s, from_t], limit, inner } = self;
        let (n, stride) = (columns.len(), bed.grid.stride);
        for (j, (s, t)) in rows.zip(s.each().zip(t.each())) {
            let k = bed.grid.row(j) + columns.start;
            let (s, t) = (&mut s[columns.clone()], &mut t[columns.clone()]);
            let (of_cells, of_corners, inner) = (row(&limit[0], k, n), row(&limit[1], k, n), row(inner, k, n));
            let [a, left, lower, lower_left] = [k, k - 1, k - stride, k - stride - 1].map(|at| row(from_s, at, n));
            let [b, right, upper, upper_right] = [k, k + 1, k + stride, k + stride + 1].map(|at| row(from_t, at, n));
            for i in 0..n {
                let square = |field: &[f32]| field[i] * field[i];
                let corners = 0.25 * ((square(b) + square(right)) + (square(upper) + square(upper_right)));
                let cells = 0.25 * ((square(a) + square(left)) + (square(lower) + square(lower_left)));
                let share_s = of_cells[i] / (square(a) + corners + LEAST_SQUARE).sqrt();
                let share_t = of_corners[i] / (square(b) + inner[i] * cells + LEAST_SQUARE).sqrt();
                s[i] = a[i] * if share_s < 1.0 { share_s } else { 1.0 };
                t[i] = b[i] * if share_t < 1.0 { share_t } else { 1.0 };
            }
        }
    }
}
