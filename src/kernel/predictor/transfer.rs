//! Particles to grid, with bilinear weights.

use crate::{
    blocks::Blocks,
    parallel::{Rows, Sweep, Team, sweep},
    particles::{Particles, extent},
    predictor::{
        grid::MacGrid,
        rock::fold_at_walls,
        stencil::{Axis, LANES, Stencils},
    },
    simd::{InstructionSet, Lanes, Pass},
};
use std::ops::Range;

/// Fewer faces than this are not handed to another thread to be cleared.
const WORTH_CLEARING: usize = 32_768;

/// What particles near a face do, on their way back from it: the change of velocity, d/s; the mean velocity of before,
/// d/s, and 1, where particles stand on both sides of the face, else twice 0; velocity at which the density feedback
/// moves particles, d/s.
pub(super) type Way = [f32; 4];

/// Fields on the faces.
#[derive(Clone, Debug, Default)]
pub(super) struct Faces {
    /// At the left faces: number of particles (as weights) and their momentum, d/s; in the projection their mean
    /// velocity.
    pub u: Vec<[f32; 2]>,
    /// The same at the lower faces.
    pub v: Vec<[f32; 2]>,
    /// At the left and at the lower faces, after the solve.
    pub ways: [Vec<Way>; 2],
    /// How full the cells are of liquid and rock, 1 at the density aimed at.
    pub filled: Vec<f32>,
    /// Rows that a particle reaches. `u` and `v` are 0 in the two rows on either side; what is in all fields beyond is
    /// left from before.
    pub reached: Range<usize>,
    /// Columns of cells near particles. Beyond them and the faces next to them, too, all is left from before.
    pub area: Range<usize>,
    blocks: Blocks,
}

impl Faces {
    /// Shares out the particles' velocities on the faces.
    pub fn collect(&mut self, grid: &MacGrid, particles: &Particles, instructions: InstructionSet, threads: usize) {
        let Self { u, v, ways: [ways_u, ways_v], filled, reached, area, blocks } = self;
        let Particles { x, y, vx, vy, .. } = particles;
        blocks.partition(grid, y, instructions, threads);
        *reached = blocks.reached();
        let near = reached.start.saturating_sub(2)..(reached.end + 2).min(grid.rows + 3);
        for field in [&mut *u, v] {
            field.resize(grid.len(), [0.0; 2]);
        }
        for field in [ways_u, ways_v] {
            field.resize(grid.len(), [0.0; 4]);
        }
        filled.resize(grid.len(), 0.0);
        *area = grid.columns_near(extent(x, instructions));
        let columns = grid.padded(area);
        let work = Clear { columns: columns.start..(columns.end + 1).min(grid.stride) };
        let band = (Rows::new(u, grid.stride, &near), Rows::new(v, grid.stride, &near));
        sweep(&work, near.clone(), band, columns.len(), WORTH_CLEARING, Team { instructions, threads });
        blocks.share_out([&mut u[..], &mut v[..]], grid.stride, threads, &|particles, row, [u, v]| {
            let [x, y, vx, vy] = [x, y, vx, vy].map(|values| &values[particles.clone()]);
            instructions.run(Collect { grid, x, y, vx, vy, first: grid.row(row), u, v });
        });
        fold_at_walls(grid, reached.clone(), columns, u, v);
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let [u, v] = [&self.u, &self.v].map(|field| 8 * field.capacity());
        let ways = 16 * (self.ways[0].capacity() + self.ways[1].capacity());
        u + v + ways + 4 * self.filled.capacity() + self.blocks.memory()
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

/// The numbers of a slice from `at` on, as many as there are lanes; lanes past its end are 0.
#[inline(always)]
pub(super) fn lanes(from: &[f32], at: usize) -> [f32; LANES] {
    let from = &from[at..];
    from.first_chunk().copied().unwrap_or_else(|| {
        let mut lanes = [0.0; LANES];
        lanes[..from.len()].copy_from_slice(from);
        lanes
    })
}

/// Adds the particles' weights and momenta to the faces around them.
struct Collect<'a> {
    grid: &'a MacGrid,
    x: &'a [f32],
    y: &'a [f32],
    vx: &'a [f32],
    vy: &'a [f32],
    /// Index of the first face of `u` and `v`.
    first: usize,
    u: &'a mut [[f32; 2]],
    v: &'a mut [[f32; 2]],
}

impl Pass for Collect<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, u, v, .. } = self;
        for at in (0..self.x.len()).step_by(LANES) {
            let (x, y) = (lanes(self.x, at), lanes(self.y, at));
            let count = (self.x.len() - at).min(LANES);
            let to_u = Deposits::new(&Stencils::new(grid, &x, &y, Axis::U), &lanes(self.vx, at));
            let to_v = Deposits::new(&Stencils::new(grid, &x, &y, Axis::V), &lanes(self.vy, at));
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

/// What each of some points adds to the faces around it: weight and momentum of the left face and of the right one.
struct Deposits {
    corner: [u32; LANES],
    lower: [[f32; 4]; LANES],
    upper: [[f32; 4]; LANES],
}

impl Deposits {
    #[inline(always)]
    fn new(stencils: &Stencils, velocity: &[f32; LANES]) -> Self {
        let (mut lower, mut upper) = ([[0.0_f32; 4]; LANES], [[0.0_f32; 4]; LANES]);
        for lane in 0..LANES {
            let right = stencils.right[lane];
            let left = 1.0 - right;
            let shares = [left, left * velocity[lane], right, right * velocity[lane]];
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
