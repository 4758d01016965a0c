//! Particles to grid and back, with bilinear weights.

use crate::{
    blocks::Blocks,
    parallel::{Rows, Sweep, Team, WORTH_A_PIECE, spread, sweep},
    params::{Domain, WALL_GAP},
    particles::{Particles, extent},
    predictor::{
        grid::MacGrid,
        rock::fold_at_walls,
        stencil::{Axis, LANES, Stencils},
    },
    simd::{InstructionSet, Lanes, Pass},
    solids::Solids,
};
use glam::{Vec2, Vec4, Vec4Swizzles};
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
    /// At the left and at the lower faces, after the solve: velocity at which the density feedback moves particles, d/s,
    /// and 1 where particles stand on both sides of the face, 0 elsewhere.
    pub drift: [Vec<[f32; 2]>; 2],
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
        let Self { u, v, drift: [drift_u, drift_v], filled, reached, area, blocks } = self;
        let Particles { x, y, vx, vy, .. } = particles;
        blocks.partition(grid, y, instructions, threads);
        *reached = blocks.reached();
        let near = reached.start.saturating_sub(2)..(reached.end + 2).min(grid.rows + 3);
        for field in [&mut *u, v, drift_u, drift_v] {
            field.resize(grid.len(), [0.0; 2]);
        }
        filled.resize(grid.len(), 0.0);
        *area = grid.columns_near(extent(x));
        let columns = grid.padded(area);
        let work = Clear { columns: columns.start..(columns.end + 1).min(grid.stride) };
        let band = |field| Rows::new(field, grid.stride, &near);
        let band = ((band(u), band(v)), (band(drift_u), band(drift_v)));
        sweep(&work, near, band, columns.len(), WORTH_CLEARING, Team { instructions, threads });
        blocks.share_out([&mut u[..], &mut v[..]], grid.stride, threads, &|particles, row, [u, v]| {
            let [x, y, vx, vy] = [x, y, vx, vy].map(|values| &values[particles.clone()]);
            instructions.run(Collect { grid, x, y, vx, vy, first: grid.row(row), u, v });
        });
        fold_at_walls(grid, reached.clone(), columns, u, v);
    }

    /// Adds the change of velocity at each particle, and half of it to what is added after the move; moves the velocity
    /// towards the grid's by the share `blend`, and the particle as the density feedback wants it.
    pub fn hand_back(&self, grid: &MacGrid, particles: &mut Particles, way: &WayBack, team: Team) {
        let Particles { x, y, vx, vy, push_x, push_y, .. } = particles;
        let arrays = [&mut x[..], y, vx, vy, push_x, push_y];
        spread(arrays, WORTH_A_PIECE, team.threads, &|_, [x, y, vx, vy, push_x, push_y]| {
            let (position, velocity, push) = ([x, y], [vx, vy], [push_x, push_y]);
            team.instructions.run(HandBack { grid, faces: self, way, position, velocity, push });
        });
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let [drift_u, drift_v] = &self.drift;
        let pairs: usize = [&self.u, &self.v, drift_u, drift_v].map(Vec::capacity).into_iter().sum();
        8 * pairs + 4 * self.filled.capacity() + self.blocks.memory()
    }
}

struct Clear {
    columns: Range<usize>,
}

/// Rows of two fields on the faces.
pub(super) type Pair<'a> = (Rows<'a, [f32; 2]>, Rows<'a, [f32; 2]>);

impl<'b> Sweep<(Pair<'b>, Pair<'b>)> for Clear {
    #[inline(always)]
    fn run(&self, _: Range<usize>, ((mut u, mut v), (mut drift_u, mut drift_v)): (Pair, Pair)) {
        let rows = u.each().chain(v.each()).chain(drift_u.each()).chain(drift_v.each());
        rows.for_each(|row| row[self.columns.clone()].fill([0.0; 2]));
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

/// How the particles follow the faces.
pub(super) struct WayBack<'a> {
    /// Share of the difference to the grid's velocity that a particle gives up.
    pub blend: f32,
    /// Substep, s.
    pub dt: f32,
    pub domain: &'a Domain,
    pub solids: &'a Solids,
}

/// Longest move of the density feedback along an axis in a substep, d. It is no motion and has no speed, so that no harm comes of it
/// but that particles get among others; half a spacing keeps them beside their neighbours.
const LONGEST_DRIFT: f32 = 0.5;

/// A coordinate of a way, cut to [`LONGEST_DRIFT`].
#[inline(always)]
fn shorten(way: f32) -> f32 {
    keep(way, -LONGEST_DRIFT, LONGEST_DRIFT)
}

/// A number, cut to `low … high`.
#[inline(always)]
fn keep(number: f32, low: f32, high: f32) -> f32 {
    let number = if number > low { number } else { low };
    if number < high { number } else { high }
}

/// Changes particles as the faces around them say.
struct HandBack<'a> {
    grid: &'a MacGrid,
    faces: &'a Faces,
    way: &'a WayBack<'a>,
    position: [&'a mut [f32]; 2],
    velocity: [&'a mut [f32]; 2],
    push: [&'a mut [f32]; 2],
}

impl Pass for HandBack<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, faces, way, position: [x, y], velocity: [vx, vy], push: [push_x, push_y] } = self;
        let WayBack { blend, dt, domain, solids } = *way;
        let rock = (solids.count() > 0).then_some(solids);
        for at in (0..x.len()).step_by(LANES) {
            let (from_x, from_y) = (lanes(x, at), lanes(y, at));
            let count = (x.len() - at).min(LANES);
            let own = at..at + count;
            let stencils = [Axis::U, Axis::V].map(|axis| Stencils::new(grid, &from_x, &from_y, axis));
            let drift_x = mean_of_faces(&faces.drift[0], grid, &stencils[0], count);
            let drift_y = mean_of_faces(&faces.drift[1], grid, &stencils[1], count);
            let gained = mean_of_faces(&faces.u, grid, &stencils[0], count);
            change(&mut vx[own.clone()], &mut push_x[own.clone()], &gained, &drift_x, blend);
            let gained = mean_of_faces(&faces.v, grid, &stencils[1], count);
            change(&mut vy[own.clone()], &mut push_y[own.clone()], &gained, &drift_y, blend);
            let (low, high) = (Vec2::splat(WALL_GAP), domain.highest());
            let (x, y) = (&mut x[own.clone()], &mut y[own]);
            for k in 0..count {
                x[k] = keep(from_x[k] + shorten(drift_x[k][0] * dt), low.x, high.x);
                y[k] = keep(from_y[k] + shorten(drift_y[k][0] * dt), low.y, high.y);
            }
            if let Some(rock) = rock {
                for k in 0..count {
                    let to = rock.sweep(Vec2::new(from_x[k], from_y[k]), Vec2::new(x[k], y[k]));
                    (x[k], y[k]) = (to.x, to.y);
                }
            }
        }
    }
}

/// Both numbers at the first `count` points: the bilinear means of the faces around them.
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

/// Adds the change to velocities, and half of it to the pushes; moves the velocities towards the grid's as far as the faces
/// around have particles on both sides.
#[inline(always)]
fn change(velocity: &mut [f32], push: &mut [f32], means: &[[f32; 2]; LANES], drift: &[[f32; 2]; LANES], blend: f32) {
    for ((velocity, push), ([gained, grid], [_, known])) in velocity.iter_mut().zip(push).zip(means.iter().zip(drift)) {
        let moved = *velocity + gained;
        *velocity = moved + blend * known * (grid - moved);
        *push += 0.5 * gained;
    }
}
