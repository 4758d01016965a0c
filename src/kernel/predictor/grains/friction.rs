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
            bed::{At, Bed},
            cells::find,
            fields::{Fields, both},
            iteration::{Hold, Limit, Pull, SetOut},
            limits::{FindLimits, FindPressures},
            near::Near,
            part::{Lighten, TakePart, is_still, lay_by},
            spread::Spread,
            strain::{Hasten, Shear, Strain},
        },
        level::WORTH_A_PIECE,
        stencil::Axis,
        transfer::Faces,
        wide::{Wide, in_lanes, load, store},
    },
    simd::each_lane,
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
        find(&Lighten { faces }, (bed, near), lightness.each_mut());
        let ([s, t], [kept_s, kept_t], [cells, corners]) = (stress, kept, step);
        find(&TakePart { lightness, strain }, (bed, near), [s, t, kept_s, kept_t, cells, corners]);
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
        let hold = Hold { stress, before: stress, further: 0.0, lightness, flow: [&[]; 2] };
        find(&hold, (bed, near), gained.each_mut());
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
        let Self { pressed, stress, strain, step, limit, inner, lightness, flow, before, .. } = self;
        let [along, _] = &*stress;
        let pressures = FindPressures { faces, spread: *spread, pressure, pore, along };
        find(&pressures, (bed, near), pressed.each_mut());
        let ([of_cells, of_corners], takes_part) = (limit, &step[1]);
        let limits = FindLimits { spread: *spread, pressed, strain, takes_part };
        find(&limits, (bed, near), [of_cells, of_corners, inner]);
        find(&SetOut { faces, lightness, stress }, (bed, near), both(flow, before));
        for iteration in 0..ITERATIONS {
            self.iterate((bed, near), iteration as f32 / (iteration as f32 + 3.0));
        }
        self.change(bed, near);
        self.find_strain(bed, near);
    }

    /// One step along the gradient from where the last two lead to, and back into the cone.
    fn iterate(&mut self, work: (&Bed, &Near), further: f32) {
        let Self { stress, before, ahead, limit, step, inner, lightness, flow, held, .. } = self;
        let flow = flow.each_ref().map(|flow| &flow[..]);
        find(&Hold { stress, before, further, lightness, flow }, work, held.each_mut());
        find(&Pull { stress, before, further, step, held }, work, ahead.each_mut());
        find(&Limit { ahead, limit, inner }, work, before.each_mut());
        std::mem::swap(stress, before);
    }

    /// How much is strained, d/s a cell: a cell as much as the most strained of its corners at least.
    fn find_strain(&mut self, bed: &Bed, near: &Near) {
        let Self { strain: [cells, corners], held, flow, gained, step, .. } = self;
        find(&Hasten { flow, gained }, (bed, near), held.each_mut());
        find(&Shear { held, step: &step[1] }, (bed, near), [corners]);
        find(&Strain { held, corners }, (bed, near), [cells]);
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
        let Self { bed, near, gained } = self;
        for (row, out) in rows.zip(right_side.each()).filter(|(row, _)| bed.rows.contains(row)) {
            for columns in near.runs(row).map(|run| bed.within(run)).filter(|columns| !columns.is_empty()) {
                in_lanes(columns, DivergeRow { bed, gained, row, out });
            }
        }
    }
}

struct DivergeRow<'a> {
    bed: &'a Bed<'a>,
    gained: &'a Fields,
    row: usize,
    out: &'a mut [f32],
}

impl Wide for DivergeRow<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, column: usize) {
        let Self { bed, gained: [u, v], row, out } = self;
        let at = At { row: *row, column, k: bed.grid.row(*row) + column };
        let [open_left, open_right] = [column, column + 1].map(|column| bed.open::<N>(Axis::U, At { column, ..at }));
        let [open_lower, open_upper] = [at.row, at.row + 1].map(|row| bed.open::<N>(Axis::V, At { row, ..at }));
        let [left, right] = [at.k, at.k + 1].map(|k| load::<N>(u, k));
        let [lower, upper] = [at.k, at.k + bed.grid.stride].map(|k| load::<N>(v, k));
        let (liquid, before) = (load::<N>(bed.liquid, at.k), load::<N>(out, column));
        let less = each_lane(|i| {
            let along = open_right[i] * right[i] - open_left[i] * left[i];
            before[i] - liquid[i] * (along + (open_upper[i] * upper[i] - open_lower[i] * lower[i]))
        });
        store::<N>(out, column, less);
    }
}
