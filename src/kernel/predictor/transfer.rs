//! Particles to grid and back, with bilinear weights.

use crate::{
    blocks::Blocks,
    parallel::{Rows, Sweep, Team, WORTH_A_PIECE, spread, sweep},
    particles::{Particles, extent},
    predictor::{
        grid::MacGrid,
        rock::fold_at_walls,
        stencil::{Axis, LANES, Stencils},
    },
    simd::{InstructionSet, Lanes, Pass},
};
use glam::{Vec4, Vec4Swizzles};
use std::ops::Range;

/// Fewer faces than this are not handed to another thread to be cleared.
const WORTH_CLEARING: usize = 32_768;

/// Fields on the faces.
#[derive(Clone, Debug, Default)]
pub(super) struct Faces {
    /// At the left faces: number of particles (as weights) and mean velocity, d/s; after the solve change of velocity and
    /// new velocity.
    pub u: Vec<[f32; 2]>,
    /// The same at the lower faces.
    pub v: Vec<[f32; 2]>,
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
        let Self { u, v, filled, reached, area, blocks } = self;
        let Particles { x, y, vx, vy, .. } = particles;
        blocks.partition(grid, y, instructions, threads);
        *reached = blocks.reached();
        let near = reached.start.saturating_sub(2)..(reached.end + 2).min(grid.rows + 3);
        for field in [&mut *u, v] {
            field.resize(grid.len(), [0.0; 2]);
        }
        filled.resize(grid.len(), 0.0);
        *area = grid.columns_near(extent(x));
        let columns = grid.padded(area);
        let work = Clear { columns: columns.start..(columns.end + 1).min(grid.stride) };
        let band = (Rows::new(u, grid.stride, &near), Rows::new(v, grid.stride, &near));
        sweep(&work, near, band, columns.len(), WORTH_CLEARING, Team { instructions, threads });
        blocks.share_out([&mut u[..], &mut v[..]], grid.stride, threads, &|particles, row, [u, v]| {
            let [x, y, vx, vy] = [x, y, vx, vy].map(|values| &values[particles.clone()]);
            instructions.run(Collect { grid, x, y, vx, vy, first: grid.row(row), u, v });
        });
        fold_at_walls(grid, reached.clone(), columns, u, v);
    }

    /// Adds the change of velocity at each particle, and moves its velocity towards the grid's by the share `blend`.
    pub fn hand_back(
        &self,
        grid: &MacGrid,
        particles: &mut Particles,
        instructions: InstructionSet,
        threads: usize,
        blend: f32,
    ) {
        let Particles { x, y, vx, vy, .. } = particles;
        spread([&mut vx[..], &mut vy[..]], WORTH_A_PIECE, threads, &|base, [vx, vy]| {
            let [x, y] = [&*x, &*y].map(|values| &values[base..base + vx.len()]);
            instructions.run(HandBack { grid, faces: self, blend, x, y, vx, vy });
        });
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let pairs = self.u.capacity() + self.v.capacity();
        8 * pairs + 4 * self.filled.capacity() + self.blocks.memory()
    }
}

struct Clear {
    columns: Range<usize>,
}

impl<'b> Sweep<(Rows<'b, [f32; 2]>, Rows<'b, [f32; 2]>)> for Clear {
    #[inline(always)]
    fn run(&self, _: Range<usize>, (mut u, mut v): (Rows<[f32; 2]>, Rows<[f32; 2]>)) {
        u.each().chain(v.each()).for_each(|row| row[self.columns.clone()].fill([0.0; 2]));
    }
}

/// The numbers of a slice from `at` on, as many as there are lanes; lanes past its end are 0.
#[inline(always)]
fn lanes(from: &[f32], at: usize) -> [f32; LANES] {
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

    #[inline(always)]
    fn add(&self, field: &mut [[f32; 2]], first: usize, stride: usize, lane: usize) {
        let corner = self.corner[lane] as usize - first;
        add_to_pair(field, corner, &self.lower[lane]);
        add_to_pair(field, corner + stride, &self.upper[lane]);
    }
}

#[inline(always)]
fn add_to_pair(field: &mut [[f32; 2]], at: usize, shares: &[f32; 4]) {
    let [left, right] = &mut field[at..at + 2] else { return };
    *left = [left[0] + shares[0], left[1] + shares[1]];
    *right = [right[0] + shares[2], right[1] + shares[3]];
}

/// Changes the particles' velocities as the faces around them say.
struct HandBack<'a> {
    grid: &'a MacGrid,
    faces: &'a Faces,
    blend: f32,
    x: &'a [f32],
    y: &'a [f32],
    vx: &'a mut [f32],
    vy: &'a mut [f32],
}

impl Pass for HandBack<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, faces, blend, .. } = self;
        for at in (0..self.x.len()).step_by(LANES) {
            let (x, y) = (lanes(self.x, at), lanes(self.y, at));
            let count = (self.x.len() - at).min(LANES);
            let gained = mean_of_faces(&faces.u, grid, &Stencils::new(grid, &x, &y, Axis::U), count);
            change(&mut self.vx[at..at + count], &gained, blend);
            let gained = mean_of_faces(&faces.v, grid, &Stencils::new(grid, &x, &y, Axis::V), count);
            change(&mut self.vy[at..at + count], &gained, blend);
        }
    }
}

/// Change of velocity and new velocity at the first `count` points: the bilinear means of the faces around them.
#[inline(always)]
fn mean_of_faces(field: &[[f32; 2]], grid: &MacGrid, stencils: &Stencils, count: usize) -> [[f32; 2]; LANES] {
    let mut means = [[0.0; 2]; LANES];
    for lane in 0..count {
        let corner = stencils.corner[lane] as usize;
        let (right, upper) = (stencils.right[lane], stencils.upper[lane]);
        let (left, lower) = (1.0 - right, 1.0 - upper);
        // The means of lower and upper faces, on the left and on the right.
        let sides = lower * pair(field, corner) + upper * pair(field, corner + grid.stride);
        let shares = sides * Vec4::new(left, left, right, right);
        let mean = shares + shares.zwxy();
        means[lane] = [mean.x, mean.y];
    }
    means
}

/// Two faces side by side.
#[inline(always)]
fn pair(field: &[[f32; 2]], at: usize) -> Vec4 {
    Vec4::from_slice(field[at..at + 2].as_flattened())
}

/// Adds the change to velocities and moves them towards the grid's.
#[inline(always)]
fn change(velocity: &mut [f32], means: &[[f32; 2]; LANES], blend: f32) {
    for (velocity, [gained, grid]) in velocity.iter_mut().zip(means) {
        let moved = *velocity + gained;
        *velocity = moved + blend * (grid - moved);
    }
}
