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
            bed::{Bed, Touched},
            fields::{Fields, row, two},
            iteration::{Hold, Limit, Pull},
            limits::{FindLimits, FindPressures},
            part::{Lighten, TakePart, is_still, lay_by},
            spread::Spread,
        },
        grid::MacGrid,
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
