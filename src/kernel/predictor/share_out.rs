//! Particles to grid, with bilinear weights.

use crate::{
    blocks::Blocks,
    parallel::{Rows, Sweep, Team, sweep},
    predictor::{
        fold::fold_at_walls,
        grid::MacGrid,
        level,
        stencil::{Axis, LANES, Stencils},
    },
    simd::{Lanes, Pass, padded},
};
use std::ops::Range;

/// Fewer faces than this are not handed to another thread to be cleared.
const WORTH_CLEARING: usize = 8192;

/// Faces with less weight than this have none.
pub(super) const LEAST_WEIGHT: f32 = 1e-12;

/// Shares out on the faces what particles have.
pub(super) struct ShareOut<'a> {
    pub grid: &'a MacGrid,
    pub blocks: &'a Blocks,
    /// Rows that a particle reaches.
    pub reached: &'a Range<usize>,
    /// Columns of cells near particles.
    pub area: &'a Range<usize>,
    pub team: Team,
}

impl ShareOut<'_> {
    /// Adds up on the faces around each particle its weight, 1 if there are none, and its value times that.
    pub fn run(
        &self,
        [x, y]: [&[f32]; 2],
        weights: Option<&[f32]>,
        [to_u, to_v]: [&[f32]; 2],
        [u, v]: [&mut Vec<[f32; 2]>; 2],
    ) {
        let Self { grid, blocks, reached, area, team } = *self;
        let near = reached.start.saturating_sub(2)..(reached.end + 2).min(grid.rows + 3);
        for field in [&mut *u, v] {
            field.resize(grid.len(), [0.0; 2]);
        }
        let columns = grid.padded(area);
        let work = Clear { columns: columns.start..(columns.end + 1).min(grid.stride) };
        let band = (Rows::new(u, grid.stride, &near), Rows::new(v, grid.stride, &near));
        sweep(&work, near.clone(), band, columns.len(), WORTH_CLEARING, team);
        blocks.share_out([&mut u[..], &mut v[..]], grid.stride, team.threads, &|particles, row, [u, v]| {
            let [x, y, to_u, to_v] = [x, y, to_u, to_v].map(|values| &values[particles.clone()]);
            let (values, first) = ([to_u, to_v], grid.row(row));
            match weights {
                Some(weights) => {
                    let weights = &weights[particles];
                    team.instructions.run(Collect::<true> { grid, x, y, values, weights, first, u, v });
                }
                None => team.instructions.run(Collect::<false> { grid, x, y, values, weights: &[], first, u, v }),
            }
        });
        fold_at_walls(grid, reached.clone(), columns, u, v);
    }

    /// Turns weighted sums on faces into means; 0 where nothing is near.
    pub fn find_means(&self, [u, v]: [&mut [[f32; 2]]; 2]) {
        let Self { grid, reached, area, team, .. } = *self;
        let rows = (Rows::new(u, grid.stride, reached), Rows::new(v, grid.stride, reached));
        let work = Divide { columns: grid.padded(area) };
        sweep(&work, reached.clone(), rows, area.len(), level::WORTH_A_PIECE, team);
    }
}

struct Clear {
    columns: Range<usize>,
}

/// Rows of left and of lower faces.
pub(super) type Pair<'a> = (Rows<'a, [f32; 2]>, Rows<'a, [f32; 2]>);

impl<'b> Sweep<Pair<'b>> for Clear {
    #[inline(always)]
    fn run(&self, _: Range<usize>, (mut u, mut v): Pair) {
        u.each().chain(v.each()).for_each(|row| row[self.columns.clone()].fill([0.0; 2]));
    }
}

struct Divide {
    columns: Range<usize>,
}

impl<'b> Sweep<Pair<'b>> for Divide {
    #[inline(always)]
    fn run(&self, _: Range<usize>, (mut u, mut v): Pair) {
        for row in u.each().chain(v.each()) {
            for [weight, value] in &mut row[self.columns.clone()] {
                *value /= if *weight > LEAST_WEIGHT { *weight } else { LEAST_WEIGHT };
            }
        }
    }
}

/// Adds the particles' weights and weighted values to the faces around them.
struct Collect<'a, const WEIGHTED: bool> {
    grid: &'a MacGrid,
    x: &'a [f32],
    y: &'a [f32],
    /// For the left and for the lower faces.
    values: [&'a [f32]; 2],
    /// Not read without `WEIGHTED`.
    weights: &'a [f32],
    /// Index of the first face of `u` and `v`.
    first: usize,
    u: &'a mut [[f32; 2]],
    v: &'a mut [[f32; 2]],
}

impl<const WEIGHTED: bool> Pass for Collect<'_, WEIGHTED> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, values: [for_u, for_v], u, v, .. } = self;
        for at in (0..self.x.len()).step_by(LANES) {
            let (x, y) = (padded(&self.x[at..]), padded(&self.y[at..]));
            let count = (self.x.len() - at).min(LANES);
            let weights = if WEIGHTED { padded(&self.weights[at..]) } else { [1.0; LANES] };
            // Where grains are shared out, most are none.
            if WEIGHTED && weights == [0.0; LANES] {
                continue;
            }
            let to_u = Stencils::new(grid, &x, &y, Axis::U);
            let to_u = Deposits::new::<WEIGHTED>(&to_u, &weights, &padded(&for_u[at..]));
            let to_v = Stencils::new(grid, &x, &y, Axis::V);
            let to_v = Deposits::new::<WEIGHTED>(&to_v, &weights, &padded(&for_v[at..]));
            // Neighbours in the order add to the same faces, and each sum waits for the one before: far and near ones
            // in turn wait less.
            for turn in 0..LANES {
                let lane = turn / 2 + turn % 2 * (LANES / 2);
                if lane < count {
                    to_u.add(u, self.first, grid.stride, lane);
                    to_v.add(v, self.first, grid.stride, lane);
                }
            }
        }
    }
}

/// What each of some points adds to the faces around it: weight and weighted value of the left face and of the right one.
struct Deposits {
    corner: [u32; LANES],
    lower: [[f32; 4]; LANES],
    upper: [[f32; 4]; LANES],
}

impl Deposits {
    #[inline(always)]
    fn new<const WEIGHTED: bool>(stencils: &Stencils, weights: &[f32; LANES], values: &[f32; LANES]) -> Self {
        let (mut lower, mut upper) = ([[0.0_f32; 4]; LANES], [[0.0_f32; 4]; LANES]);
        for lane in 0..LANES {
            let (right, value) = (stencils.right[lane], values[lane]);
            let (right, left) = match WEIGHTED {
                true => (weights[lane] * right, weights[lane] * (1.0 - right)),
                false => (right, 1.0 - right),
            };
            let shares = [left, left * value, right, right * value];
            let (to_upper, to_lower) = (stencils.upper[lane], 1.0 - stencils.upper[lane]);
            lower[lane] = shares.map(|share| share * to_lower);
            upper[lane] = shares.map(|share| share * to_upper);
        }
        Self { corner: stencils.corner, lower, upper }
    }

    /// Face by face, left and right ones in turn: a sum that is read again at once is then just what was written last,
    /// for which the processor need not wait as it has to for a part of two faces that were written together.
    #[inline(always)]
    fn add(&self, field: &mut [[f32; 2]], first: usize, stride: usize, lane: usize) {
        let corner = self.corner[lane] as usize - first;
        let (lower, upper) = (&self.lower[lane], &self.upper[lane]);
        add_to(&mut field[corner], [lower[0], lower[1]]);
        add_to(&mut field[corner + stride], [upper[0], upper[1]]);
        add_to(&mut field[corner + 1], [lower[2], lower[3]]);
        add_to(&mut field[corner + stride + 1], [upper[2], upper[3]]);
    }
}

#[inline(always)]
fn add_to(face: &mut [f32; 2], share: [f32; 2]) {
    *face = [face[0] + share[0], face[1] + share[1]];
}
