//! Friction among grains, as a stress on the cells (after Narain, Golas & Lin 2010, "Free-flowing granular materials with
//! two-way solid coupling"): it takes from the flow what Coulomb's law lets it, and is kept from substep to substep, so that a
//! slope of any height is held.
//!
//! S = s_xx = −s_yy stands in the cells, T = s_xy in their lower left corners, both counted in d/s as the pressure is: a face
//! gains the differences of the stresses around it, times its lightness. Of all stresses with √(S² + T²) ≤ sin φ · p + cos φ · c that one is
//! taken that leaves the flow least energy, by projected gradients with Nesterov's acceleration from the last substep's on.
//!
//! With sin φ and cos φ, Mohr's circle touches the line c + p tan φ: a slope rests up to φ, and with a cohesion of c higher cliffs do.

use crate::{
    parallel::{Rows, Sweep, sweep},
    predictor::{
        grains::{
            bed::Bed,
            fields::{Fields, row, two},
            iteration::{Hold, Limit, Pull},
            limits::{FindLimits, FindPressures},
            near::Near,
            part::{Lighten, TakePart, is_still, lay_by},
            spread::Spread,
        },
        level::WORTH_A_PIECE,
        transfer::Faces,
    },
};
use std::ops::Range;

/// Iterations of a substep.
const ITERATIONS: usize = 20;

/// Stress among grains. The buffers are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Friction {
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
    pub fn begin(&mut self, bed: &Bed, near: &Near, faces: &Faces) {
        self.make_room(bed, near);
        let Self { stress, kept, strain, step, lightness, .. } = self;
        let (rows, per_row, stride) = (near.rows(bed.grid), near.per_row(), bed.grid.stride);
        let work = Lighten { bed, near, faces };
        sweep(&work, rows.clone(), two(lightness, stride, &rows), per_row, WORTH_A_PIECE, bed.team);
        let work = TakePart { bed, near, lightness, strain };
        let band = ((two(stress, stride, &rows), two(kept, stride, &rows)), two(step, stride, &rows));
        sweep(&work, rows, band, per_row, WORTH_A_PIECE, bed.team);
        self.change(bed, near);
    }

    /// Whether any of some cells, or of their lower left corners, has a stress, or may get one that was laid by.
    #[inline(always)]
    pub fn is_stressed(&self, bed: &Bed, cells: Range<usize>) -> bool {
        let any = |fields: &Fields| {
            let of = |field: &[f32]| field.iter().fold(false, |any, stress| any | (*stress != 0.0));
            fields.iter().any(|field| field.get(cells.clone()).is_some_and(of))
        };
        let stride = bed.grid.stride;
        let is_by_liquid = |k: usize| [k, k - 1, k - stride, k - stride - 1].into_iter().any(|k| bed.is_liquid(k));
        let is_laid_by = |k: &usize| self.kept.iter().any(|kept| kept[*k] != 0.0);
        any(&self.stress) || any(&self.kept) && cells.clone().filter(is_laid_by).any(is_by_liquid)
    }

    /// Takes the divergence of what the stress changes off the right-hand side of the pressure.
    pub fn subtract_divergence(&self, bed: &Bed, near: &Near, right_side: &mut [f32]) {
        let rows = near.rows(bed.grid);
        let band = Rows::new(right_side, bed.grid.stride, &rows);
        sweep(&Diverge { bed, near, gained: &self.gained }, rows, band, near.per_row(), WORTH_A_PIECE, bed.team);
    }

    /// Room for the grid, with 0 wherever nothing takes part any more.
    fn make_room(&mut self, bed: &Bed, near: &Near) {
        let Self { stress, kept, strain, .. } = self;
        for ((stress, kept), strain) in stress.iter_mut().zip(kept).zip(strain) {
            for field in [&mut *stress, kept, strain] {
                field.resize(bed.grid.len(), 0.0);
            }
            near.left(bed.grid, |left| {
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
            near.left(bed.grid, |left| field[left].fill(0.0));
        }
    }

    /// What the next substep sets out from.
    pub fn kept(&self) -> [&Vec<f32>; 6] {
        let ([s, t], [kept_s, kept_t], [cells, corners]) = (&self.stress, &self.kept, &self.strain);
        [s, t, kept_s, kept_t, cells, corners]
    }

    /// One that sets out from what was kept.
    pub fn resume([s, t, kept_s, kept_t, cells, corners]: [Vec<f32>; 6]) -> Self {
        Self { stress: [s, t], kept: [kept_s, kept_t], strain: [cells, corners], ..Self::default() }
    }

    /// What the stress changes on the faces.
    fn change(&mut self, bed: &Bed, near: &Near) {
        let Self { stress, lightness, gained, .. } = self;
        let (rows, flow) = (near.rows(bed.grid), [&[][..]; 2]);
        let work = Hold { bed, near, stress, before: stress, further: 0.0, lightness, flow };
        let band = two(gained, bed.grid.stride, &rows);
        sweep(&work, rows, band, near.per_row(), WORTH_A_PIECE, bed.team);
    }

    /// Finds the stress under a pressure (d/s), and what it changes on the faces.
    pub fn solve(
        &mut self,
        (bed, near): (&Bed, &Near),
        faces: &Faces,
        spread: &Spread,
        pressure: &[f32],
        pore: &[f32],
    ) {
        let (rows, per_row, stride, team) = (near.rows(bed.grid), near.per_row(), bed.grid.stride, bed.team);
        let work = FindPressures { bed, near, faces, spread: *spread, pressure, pore };
        sweep(&work, rows.clone(), two(&mut self.pressed, stride, &rows), per_row, WORTH_A_PIECE, team);
        let Self { pressed, stress, strain, step, limit, inner, .. } = self;
        let [along, _] = &*stress;
        let work = FindLimits { bed, near, spread: *spread, pressed, along, strain, takes_part: &step[1] };
        let band = (two(limit, stride, &rows), Rows::new(inner, stride, &rows));
        sweep(&work, rows, band, per_row, WORTH_A_PIECE, team);
        for (axis, flow) in self.flow.iter_mut().enumerate() {
            let (means, ways, lightness) = ([&faces.u, &faces.v][axis], &faces.ways[axis], &self.lightness[axis]);
            for run in near.indices(bed.grid) {
                let of = means[run.clone()].iter().zip(&ways[run.clone()]).zip(&lightness[run.clone()]);
                for (flow, ((mean, way), lightness)) in flow[run].iter_mut().zip(of) {
                    *flow = if *lightness > 0.0 { mean[1] + way[0] } else { 0.0 };
                }
            }
        }
        for (before, stress) in self.before.iter_mut().zip(&self.stress) {
            near.indices(bed.grid).for_each(|run| before[run.clone()].copy_from_slice(&stress[run]));
        }
        for iteration in 0..ITERATIONS {
            self.iterate((bed, near), iteration as f32 / (iteration as f32 + 3.0));
        }
        self.change(bed, near);
        self.find_strain(bed, near);
    }

    /// One step along the gradient from where the last two lead to, and back into the cone.
    fn iterate(&mut self, (bed, near): (&Bed, &Near), further: f32) {
        let Self { stress, before, ahead, limit, step, inner, lightness, flow, held, .. } = self;
        let (rows, per_row, stride) = (near.rows(bed.grid), near.per_row(), bed.grid.stride);
        let flow = flow.each_ref().map(|flow| &flow[..]);
        let hold = Hold { bed, near, stress, before, further, lightness, flow };
        sweep(&hold, rows.clone(), two(held, stride, &rows), per_row, WORTH_A_PIECE, bed.team);
        let pull = Pull { bed, near, stress, before, further, step, held };
        sweep(&pull, rows.clone(), two(ahead, stride, &rows), per_row, WORTH_A_PIECE, bed.team);
        let limit = Limit { bed, near, ahead, limit, inner };
        sweep(&limit, rows.clone(), two(before, stride, &rows), per_row, WORTH_A_PIECE, bed.team);
        std::mem::swap(stress, before);
    }

    /// How much is strained, d/s a cell: a cell as much as the most strained of its corners at least.
    fn find_strain(&mut self, bed: &Bed, near: &Near) {
        let stride = bed.grid.stride;
        let Self { strain: [cells, corners], held: [u, v], flow, gained, step, .. } = self;
        for run in near.indices(bed.grid) {
            for (out, (flow, gained)) in [&mut *u, v].into_iter().zip(flow.iter().zip(&*gained)) {
                let both = flow[run.clone()].iter().zip(&gained[run.clone()]);
                out[run.clone()].iter_mut().zip(both).for_each(|(out, (flow, gained))| *out = flow + gained);
            }
        }
        for run in near.indices(bed.grid) {
            let n = run.len();
            let [u, u_lower] = [run.start, run.start - stride].map(|k| row(u, k, n));
            let [v, v_left] = [run.start, run.start - 1].map(|k| row(v, k, n));
            let (step, corners) = (row(&step[1], run.start, n), &mut corners[run]);
            for i in 0..n {
                let sheared = (u[i] - u_lower[i] + v[i] - v_left[i]).abs();
                corners[i] = if step[i] > 0.0 { sheared } else { 0.0 };
            }
        }
        // The last of all has nothing above and to its right, and no pressure.
        let last = bed.grid.len() - stride - 1;
        for run in near.indices(bed.grid).map(|run| run.start..run.end.min(last)) {
            let n = run.len();
            let [u, u_right] = [run.start, run.start + 1].map(|k| row(u, k, n));
            let [v, v_upper] = [run.start, run.start + stride].map(|k| row(v, k, n));
            let around = [0, 1, stride, stride + 1].map(|further| row(corners, run.start + further, n));
            let (liquid, cells) = (row(bed.liquid, run.start, n), &mut cells[run]);
            for i in 0..n {
                let own = (u_right[i] - u[i] - v_upper[i] + v[i]).abs();
                let most = around.iter().fold(own, |most, corners| most.max(corners[i]));
                cells[i] = if liquid[i] > 0.0 { most } else { 0.0 };
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

/// Takes a divergence off the right-hand side of the pressure.
struct Diverge<'a> {
    bed: &'a Bed<'a>,
    near: &'a Near,
    gained: &'a Fields,
}

impl Sweep<Rows<'_, f32>> for Diverge<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut right_side: Rows<f32>) {
        let Self { bed, near, gained: [u, v] } = self;
        let (stride, closed) = (bed.grid.stride, bed.closed);
        for (j, out) in rows.zip(right_side.each()).filter(|(j, _)| bed.rows.contains(j)) {
            let of_bed = |run: Range<usize>| run.start.max(bed.span.start)..run.end.min(bed.span.end);
            for columns in near.runs(j).map(of_bed).filter(|columns| !columns.is_empty()) {
                let (n, k) = (columns.len(), bed.grid.row(j) + columns.start);
                let [own, above] = [j, j + 1].map(|j| closed.row(j) + columns.start);
                let (open_left, open_right) = (row(&closed.open_u, own, n), row(&closed.open_u, own + 1, n));
                let (open_lower, open_upper) = (row(&closed.open_v, own, n), row(&closed.open_v, above, n));
                let (left, right) = (row(u, k, n), row(u, k + 1, n));
                let (lower, upper, liquid) = (row(v, k, n), row(v, k + stride, n), row(bed.liquid, k, n));
                for (i, out) in out[columns].iter_mut().enumerate() {
                    let along = open_right[i] * right[i] - open_left[i] * left[i];
                    *out -= liquid[i] * (along + (open_upper[i] * upper[i] - open_lower[i] * lower[i]));
                }
            }
        }
    }
}
