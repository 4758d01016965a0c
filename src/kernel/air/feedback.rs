//! Momentum both ways: what drag takes from particles, the air gets, and the other way round.
//!
//! Particle i (mass m, drag rate k, see `kernel::forces`) meets the four cells around it with the bilinear weights w of
//! `sample`. Its share `α = kr Δt/(1 + kr Δt)`, r its speed relative to the air before, is that of the exact solution in
//! air that doesn't yield. Here the air yields: each cell c, of mass M, ends at the common velocity
//!
//! ```text
//! u_c' = (M u_c + Σ w m α v) / (M + Σ w m α)            v' = v + α (Σ w u_c' − v)
//! ```
//!
//! which is the implicit step of the exchange between each cell and each particle's part in it.
//! - **Momentum**: cell c gets `Σ w m α (v − u_c')`, and the same terms, summed the other way, are what the particles lose.
//! - **Energy** never grows: by `a·(a − b) ≥ ½ (a² − b²)` on both sides the sum of both grows by at most
//!   `Σ m α (v·u' − Σ w u_c'² + (u' − v)·v')`, u' the mean `Σ w u_c'`, which is at most `−Σ m α (1 − α) |v − u'|²` because
//!   the mean of squares is no less than the square of the mean.
//! - **Any load**: a new velocity is a mean of old ones, so neither overshoots, however heavy the particles or thin the
//!   air. In air far heavier than they are it is the plain drag.
//!
//! Rock and tiles that sleep are air at rest that doesn't yield, as in plain drag. A sleeping tile wakes when one of its
//! cells would get a speed above [`QUIET_MACH`].

use super::{
    grid::Air,
    meetings::{Feedback, Meeting},
    rooms::QUIET_MACH,
    stencils::{LANES, Stencils, split},
};
use crate::{
    blocks::Reach,
    element::ElementParams,
    forces::LaterDrag,
    parallel::{Rows, Sweep, Team, WORTH_A_PIECE, spread, sweep},
    particles::{Particles, extent},
    simd::{Lanes, Pass, padded},
};
use std::ops::Range;

/// Fewer cells than this are not handed to another thread.
const WORTH_RESOLVING: usize = 512;

/// A drag per substep from which on a particle has the wind's velocity, whatever the rounding.
const MOST_DRAG: f32 = 1.0e30;

/// Particles to a d² that a gate counts on: twice as many as there are in water.
const CROWD: f32 = 2.0;

/// When particles wake air that sleeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rousing {
    /// When they would give it a speed above [`QUIET_MACH`].
    Gusts,
    /// Whenever they would move it at all.
    Breaths,
}

/// Which rows or columns of the grid, counted with the ring, a coordinate reaches.
#[derive(Clone, Copy)]
struct Along {
    per_cell: f32,
    last: u32,
}

impl Reach for Along {
    #[inline(always)]
    fn rows(self, y: f32) -> [u32; 2] {
        let (row, _) = split(y, self.per_cell, self.last);
        [row + 1, row + 3]
    }
}

impl Air {
    /// Whether a crowd of particles of a speed (d/s) could wake air at rest at pressure 1 in a substep of `dt` s. `counts`: how many
    /// there are of each element.
    pub fn may_be_roused(&self, elements: &ElementParams, counts: &[u32], speed: f32, dt: f32) -> bool {
        let present = elements.drag.iter().zip(&elements.mass).zip(counts).filter(|(_, count)| **count > 0);
        let load = present.map(|((rate, mass), _)| CROWD * mass * (rate * speed * dt).min(1.0)).fold(0.0, f32::max);
        speed * load / (self.params.density + load) > QUIET_MACH * self.params.sound_speed
    }

    /// First half of the exchange over `dt` s: finds the velocity that the air gets. [`Air::drag_along`] must follow with
    /// the same particles and the same `later`. The air must be built. `team` changes the time it takes and not a bit of the result.
    pub fn meet(
        &mut self,
        elements: &ElementParams,
        particles: &Particles,
        later: &mut LaterDrag,
        rousing: Rousing,
        team: Team,
        dt: f32,
    ) {
        let mut feedback = std::mem::take(&mut self.scratch.feedback);
        feedback.meetings.resize(self.pressure.len(), Meeting::default());
        let along = |count: usize| Along { per_cell: 1.0 / self.cell, last: count as u32 - 1 };
        feedback.blocks.partition(along(self.rows()), &particles.y, team.instructions, team.threads);
        let [low, high] = extent(&particles.x, team.instructions).map(|x| along(self.columns()).rows(x));
        feedback.columns = low[0] as usize..high[1] as usize;
        let stride = self.stride();
        for row in feedback.blocks.reached() {
            feedback.meetings[row * stride..][feedback.columns.clone()].fill(Meeting::default());
        }
        let air = &*self;
        let shares = later.shares(particles.len());
        spread([&mut shares[..]], WORTH_A_PIECE, team.threads, &|first, [shares]| {
            team.instructions.run(FindShares { air, elements, particles, first, shares, dt });
        });
        let Feedback { blocks, meetings, .. } = &mut feedback;
        blocks.share_out([&mut meetings[..]], stride, team.threads, &|range, first, [meetings]| {
            let first = first * stride;
            team.instructions.run(Bring { air, elements, particles, shares, range, meetings, first });
        });
        self.resolve(&mut feedback, team);
        self.rouse(&mut feedback, rousing);
        self.scratch.feedback = feedback;
    }

    /// Second half of the exchange: the air gets the velocities that [`Air::meet`] found, the particles half of their
    /// changes, and `later` the other half (d/s), which comes after the move.
    pub fn drag_along(&mut self, particles: &mut Particles, later: &mut LaterDrag, team: Team) {
        let feedback = std::mem::take(&mut self.scratch.feedback);
        let (air, meetings) = (&*self, &feedback.meetings[..]);
        let Particles { x, y, vx, vy, .. } = particles;
        let [later_x, later_y] = later.of(x.len());
        spread(
            [&mut vx[..], vy, later_x, later_y],
            WORTH_A_PIECE,
            team.threads,
            &|first, [vx, vy, later_x, later_y]| {
                let own = first..first + vx.len();
                let (place, velocity, later) = ([&x[own.clone()], &y[own]], [vx, vy], [later_x, later_y]);
                team.instructions.run(DragAlong { air, meetings, place, velocity, later });
            },
        );
        for row in feedback.blocks.reached() {
            let cells = row * self.stride() + feedback.columns.start..row * self.stride() + feedback.columns.end;
            let velocities = self.velocity_x[cells.clone()].iter_mut().zip(&mut self.velocity_y[cells.clone()]);
            for ((u, v), meeting) in velocities.zip(&feedback.meetings[cells]) {
                (*u, *v) = (meeting[0], meeting[1]);
            }
        }
        self.scratch.feedback = feedback;
    }

    /// Finds the velocity that each cell gets from what the particles bring.
    fn resolve(&self, feedback: &mut Feedback, team: Team) {
        let Feedback { blocks, columns, meetings, .. } = feedback;
        let (rows, stride) = (blocks.reached(), self.stride());
        let band = Rows::new(meetings, stride, &rows);
        let work = Resolve { air: self, columns, cell_mass: self.params.density * (self.cell * self.cell) };
        sweep(&work, rows, band, columns.len().max(1), WORTH_RESOLVING, team);
    }

    /// Wakes sleeping tiles that would get too fast for that. The others keep still.
    fn rouse(&mut self, feedback: &mut Feedback, rousing: Rousing) {
        let bound = match rousing {
            Rousing::Gusts => QUIET_MACH * self.params.sound_speed,
            Rousing::Breaths => 0.0,
        };
        let (tiling, stride) = (self.tiling(), self.stride());
        let Feedback { blocks, columns: met, meetings, active } = feedback;
        self.find_active(active);
        let reached = blocks.reached();
        for tile in (0..tiling.count()).filter(|tile| !active[*tile]) {
            let rows = tiling.rows(tile);
            // Counted with the ring.
            let rows = (rows.start + 1).max(reached.start)..(rows.end + 1).min(reached.end);
            let columns = tiling.columns(tile);
            let (start, end) = ((columns.start + 1).max(met.start), (columns.end + 1).min(met.end));
            if start >= end {
                continue;
            }
            let cells = |row: usize| row * stride + start..row * stride + end;
            let is_gust = |meeting: &Meeting| meeting[0].abs() > bound || meeting[1].abs() > bound;
            if rows.clone().any(|row| meetings[cells(row)].iter().any(is_gust)) {
                self.wake(tile);
                continue;
            }
            for row in rows {
                for k in cells(row) {
                    meetings[k] = [self.velocity_x[k], self.velocity_y[k], 0.0, 0.0];
                }
            }
        }
    }
}

/// Finds α of particles, by the wind as it is before the exchange.
struct FindShares<'a> {
    air: &'a Air,
    elements: &'a ElementParams,
    particles: &'a Particles,
    /// The particle that `shares` begins with.
    first: usize,
    /// Out: α.
    shares: &'a mut [f32],
    dt: f32,
}

impl Pass for FindShares<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { air, elements, particles: Particles { x, y, vx, vy, element, .. }, first, shares, dt } = self;
        let (mut rates, mut found) = ([0.0; LANES], [0.0; LANES]);
        for (index, shares) in shares.chunks_mut(LANES).enumerate() {
            let (start, count) = (first + index * LANES, shares.len());
            let own = start..start + count;
            let [wind_x, wind_y] = air.velocities_around(&x[own.clone()], &y[own.clone()]);
            for (rate, element) in rates.iter_mut().zip(&element[own.clone()]) {
                *rate = elements.drag[element.index()];
            }
            let [vx, vy] = [vx, vy].map(|velocity| padded::<LANES>(&velocity[own.clone()]));
            for k in 0..LANES {
                let (x, y) = (vx[k] - wind_x[k], vy[k] - wind_y[k]);
                let slowing = rates[k] * (x * x + y * y).sqrt() * dt;
                let slowing = if slowing < MOST_DRAG { slowing } else { MOST_DRAG };
                found[k] = slowing / (1.0 + slowing);
            }
            shares.copy_from_slice(&found[..count]);
        }
    }
}

/// Adds up what particles bring to the cells.
struct Bring<'a> {
    air: &'a Air,
    elements: &'a ElementParams,
    particles: &'a Particles,
    /// α of all particles.
    shares: &'a [f32],
    range: Range<usize>,
    /// In and out: sums of the cells from `first` on.
    meetings: &'a mut [Meeting],
    first: usize,
}

impl Pass for Bring<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { air, elements, particles: Particles { x, y, vx, vy, element, .. }, shares, range, .. } = self;
        for start in range.clone().step_by(LANES) {
            let own = start..range.end.min(start + LANES);
            let stencils = Stencils::new(air, &x[own.clone()], &y[own.clone()]);
            for (lane, i) in own.enumerate() {
                let brought = shares[i] * elements.mass[element[i].index()];
                let meeting = [brought * vx[i], brought * vy[i], brought, 0.0];
                for (k, weight) in stencils.corners(lane) {
                    for (sum, value) in self.meetings[k - self.first].iter_mut().zip(meeting) {
                        *sum += weight * value;
                    }
                }
            }
        }
    }
}

/// Changes particles by the velocities that the cells got.
struct DragAlong<'a> {
    air: &'a Air,
    meetings: &'a [Meeting],
    /// Positions, d.
    place: [&'a [f32]; 2],
    /// In and out: velocities, d/s.
    velocity: [&'a mut [f32]; 2],
    /// In: α, along x. Out: the half that comes after the move, d/s.
    later: [&'a mut [f32]; 2],
}

impl Pass for DragAlong<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { air, meetings, place: [x, y], velocity: [vx, vy], later: [later_x, later_y] } = self;
        for start in (0..x.len()).step_by(LANES) {
            let own = start..x.len().min(start + LANES);
            let count = own.len();
            let stencils = Stencils::new(air, &x[own.clone()], &y[own.clone()]);
            let [u, v] = stencils.blend(count, |k| [0, 1].map(|next| [meetings[k + next][0], meetings[k + next][1]]));
            let share = padded::<LANES>(&later_x[own.clone()]);
            for (velocity, later, air) in [(&mut *vx, &mut *later_x, u), (vy, later_y, v)] {
                let mut before = padded::<LANES>(&velocity[own.clone()]);
                let mut half = [0.0; LANES];
                for k in 0..LANES {
                    half[k] = 0.5 * share[k] * (air[k] - before[k]);
                    before[k] += half[k];
                }
                later[own.clone()].copy_from_slice(&half[..count]);
                velocity[own.clone()].copy_from_slice(&before[..count]);
            }
        }
    }
}

struct Resolve<'a> {
    air: &'a Air,
    columns: &'a Range<usize>,
    /// Mass of a cell of air at pressure 1, kg/m² d².
    cell_mass: f32,
}

impl Sweep<Rows<'_, Meeting>> for Resolve<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut meetings: Rows<Meeting>) {
        let Self { air, columns, cell_mass } = *self;
        for (row, meetings) in rows.zip(meetings.each()) {
            let cells = row * air.stride() + columns.start..row * air.stride() + columns.end;
            let [p, u, v] = [&air.pressure, &air.velocity_x, &air.velocity_y].map(|field| &field[cells.clone()]);
            let solid = &air.solid[cells];
            for (i, meeting) in meetings[columns.clone()].iter_mut().enumerate() {
                let [x, y, load, _] = *meeting;
                let mass = p[i] * cell_mass;
                // Rock and cells without particles stay as they are.
                let yields = load > 0.0 && !solid[i];
                let per_mass = 1.0 / if yields { mass + load } else { 1.0 };
                *meeting = if yields {
                    [(mass * u[i] + x) * per_mass, (mass * v[i] + y) * per_mass, load, 0.0]
                } else {
                    [u[i], v[i], load, 0.0]
                };
            }
        }
    }
}
