//! Pass 1, forward advection: each cell's mass, and its momentum with it, is shared out to the nine cells around.
//!
//! **Which way.** The report moves each cell by its own velocity. Taken to the letter that makes wind out of nothing:
//! seen from pressure, own-velocity shares are `−∂a + ½ ∂²|a|` (a = u·dt/cell), and the second term feeds waves that run
//! against the wind; noise of 0.1 % grows to 30 % in still air. So the *edges* of a cell move, each by the mean velocity
//! of the two cells it parts, and what they sweep over goes to the neighbour:
//!
//! ```text
//! f = ½ (a₀ + a₁) + κ s (p₀ − p₁)        flow through the face between cells 0 and 1, in cells a substep, |f| ≤ ½
//! right = max(f_right, 0)   left = max(−f_left, 0)   stay = 1 − (left + right)        and so for down, level, up
//! ```
//!
//! In even wind this is the report's bilinear share, to the bit. It is the exact counterpart of the push of pass 2 (a
//! pair shares its push in halves, so it shares its flow in halves): what a push gives to motion it takes from pressure.
//! A closed face has f = 0, so a share that would enter rock stays where it is. A diagonal share needs both faces of its
//! cell open; if the cell across is rock, the two cells beside it take half each. Nothing slips through a diagonal wall.
//! `κ s (p₀ − p₁)`, s = c·dt/cell, is a little of what the exact solution of the face's own wave would add; without it a
//! pressure that alternates from cell to cell pushes nobody and stays for ever.
//!
//! All shares are ≥ 0 and sum to 1, hence mass and momentum are conserved and pressure stays ≥ 0; a new velocity is a
//! mean of old ones, hence no speed and no kinetic energy grows here.
//!
//! **How.** A gather: row by row, sources' shares into row buffers, then for each target the sum over its three rows, in
//! an order that a mirror image shares (middle + (one side + other side)), so that mirrored air has mirrored bits.

use super::shape::{Corner, Shape};

/// Part κ of the wave solution that a face follows, 0 … ½. Raising it kills alternating pressure sooner and damps
/// sound: a wave of 20 cells loses `κ` × 0.8 of its height a wavelength. Changing this affects the stability limit
/// (`pressure`).
pub(super) const FACE_FILTER: f32 = 1.0 / 16.0;

/// What pass 1 reads.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) pressure: &'a [f32],
    pub(super) velocity_x: &'a [f32],
    pub(super) velocity_y: &'a [f32],
    pub(super) shape: &'a Shape,
    pub(super) stride: usize,
    /// ½ dt/cell: from the sum of two velocities to a face's flow.
    pub(super) half: f32,
    /// `κ c·dt/cell`.
    pub(super) filter: f32,
}

/// What pass 1 writes: whole rows, with the ring, of which only the cells of the box are touched.
pub(super) struct Target<'a> {
    pub(super) pressure: &'a mut [f32],
    pub(super) momentum_x: &'a mut [f32],
    pub(super) momentum_y: &'a mut [f32],
}

/// Flow through the faces between the cells `0` and the cells `1`, in cells a substep.
struct Faces<'a> {
    open: &'a [f32],
    pressure: [&'a [f32]; 2],
    velocity: [&'a [f32]; 2],
}

impl Faces<'_> {
    fn write(&self, half: f32, filter: f32, flow: &mut [f32]) {
        let n = flow.len();
        let [p0, p1] = self.pressure.map(|row| &row[..n]);
        let [v0, v1] = self.velocity.map(|row| &row[..n]);
        let open = &self.open[..n];
        for i in 0..n {
            flow[i] = face_flow(open[i], v0[i] + v1[i], p0[i] - p1[i], half, filter);
        }
    }
}

/// No face lets more than half a cell pass, so that two can't take more than there is. The substep's length keeps the
/// velocities below that; only the filter can reach it, at a jump of pressure.
#[inline(always)]
fn face_flow(open: f32, velocities: f32, drop: f32, half: f32, filter: f32) -> f32 {
    let flow = open * (velocities * half + drop * filter);
    let flow = if flow > 0.5 { 0.5 } else { flow };
    if flow < -0.5 { -0.5 } else { flow }
}

#[inline(always)]
fn positive(x: f32) -> f32 {
    if x > 0.0 { x } else { 0.0 }
}

/// Mass and momentum that one row of sources brings to each column of a row of targets.
#[derive(Debug, Default)]
struct Carry {
    mass: Vec<f32>,
    x: Vec<f32>,
    y: Vec<f32>,
}

impl Carry {
    fn resize(&mut self, n: usize) {
        for row in [&mut self.mass, &mut self.x, &mut self.y] {
            row.resize(n, 0.0);
        }
    }
}

/// Sideways shares of a row of sources.
#[derive(Debug, Default)]
struct Sideways {
    left: Vec<f32>,
    stay: Vec<f32>,
    right: Vec<f32>,
}

/// Row buffers of a band of rows.
#[derive(Debug, Default)]
pub(super) struct Band {
    flow_x: Vec<f32>,
    flow_below: Vec<f32>,
    flow_above: Vec<f32>,
    sideways: Sideways,
    /// Mass that goes down, stays level and goes up.
    down: Vec<f32>,
    level: Vec<f32>,
    up: Vec<f32>,
    carry_down: Carry,
    /// Of this row of sources and the one below.
    carry_level: [Carry; 2],
    /// Of this row of sources, the one below and the one below that.
    carry_up: [Carry; 3],
}

impl Band {
    pub(super) fn new(stride: usize) -> Self {
        let mut band = Self::default();
        band.flow_x.resize(stride + 1, 0.0);
        let rows = [&mut band.flow_below, &mut band.flow_above, &mut band.down, &mut band.level, &mut band.up];
        let sideways = [&mut band.sideways.left, &mut band.sideways.stay, &mut band.sideways.right];
        for row in rows.into_iter().chain(sideways) {
            row.resize(stride, 0.0);
        }
        band.carry_down.resize(stride - 2);
        for carry in band.carry_level.iter_mut().chain(&mut band.carry_up) {
            carry.resize(stride - 2);
        }
        band
    }

    /// Values held.
    pub(super) fn values(&self) -> usize {
        self.flow_x.len() * 9 + self.carry_down.mass.len() * 18
    }

    /// Fills the rows of `target`, of which the lowest is `first` (counted with the ring).
    pub(super) fn run(&mut self, source: Source, first: usize, target: Target) {
        let stride = source.stride;
        let end = first + target.pressure.len() / stride;
        self.flow_below.fill(0.0);
        for row in first - 1..=end {
            self.share_out(source, row, row < end);
            if row > first {
                let out = (row - 1 - first) * stride;
                let mut target = Target {
                    pressure: &mut target.pressure[out..out + stride],
                    momentum_x: &mut target.momentum_x[out..out + stride],
                    momentum_y: &mut target.momentum_y[out..out + stride],
                };
                self.sum_up(&mut target);
                // What struck rock has gone round the corner already.
                for column in source.shape.struck(row - 1) {
                    for field in [&mut *target.pressure, &mut *target.momentum_x, &mut *target.momentum_y] {
                        field[*column as usize] = 0.0;
                    }
                }
            }
            self.carry_level.rotate_right(1);
            self.carry_up.rotate_right(1);
            std::mem::swap(&mut self.flow_below, &mut self.flow_above);
        }
    }

    /// One row of sources: faces, shares, and what they bring to each column. What lies above is left out for the last
    /// row of a band, of which only the shares that go down are wanted.
    fn share_out(&mut self, source: Source, row: usize, above: bool) {
        let stride = source.stride;
        let here = row * stride..(row + 1) * stride;
        let p = &source.pressure[here.clone()];
        let u = &source.velocity_x[here.clone()];
        let v = &source.velocity_y[here.clone()];
        let faces =
            Faces { open: &source.shape.open_x[here.start + 1..], pressure: [p, &p[1..]], velocity: [u, &u[1..]] };
        faces.write(source.half, source.filter, &mut self.flow_x[1..stride]);
        if above {
            let next = here.end..here.end + stride;
            let faces = Faces {
                open: &source.shape.open_y[next.clone()],
                pressure: [p, &source.pressure[next.clone()]],
                velocity: [v, &source.velocity_y[next]],
            };
            faces.write(source.half, source.filter, &mut self.flow_above);
        } else {
            self.flow_above.fill(0.0);
        }
        self.write_shares(p);
        for (mass, carry) in [
            (&self.down, &mut self.carry_down),
            (&self.level, &mut self.carry_level[0]),
            (&self.up, &mut self.carry_up[0]),
        ] {
            carry_sideways(mass, &self.sideways, u, v, carry);
        }
        self.turn_corners(source.shape.corners(row), u, v);
    }

    /// Gives the shares that strike a corner of rock to the cells beside it. What they brought to the rock itself is
    /// dropped when the rock's row is written. Sums pair opposite sides, so that a mirror image has the same.
    fn turn_corners(&mut self, corners: &[Corner], u: &[f32], v: &[f32]) {
        let Self { sideways: Sideways { left, right, .. }, up, down, .. } = self;
        let [level, _] = &mut self.carry_level;
        let [above, ..] = &mut self.carry_up;
        let below = &mut self.carry_down;
        for Corner { column, upright, sideways } in corners {
            let k = *column as usize;
            let i = k - 1;
            add(above, i, up[k] * (upright[0] * left[k] + upright[1] * right[k]), u[k], v[k]);
            add(below, i, down[k] * (upright[2] * left[k] + upright[3] * right[k]), u[k], v[k]);
            let from_left = right[k - 1] * (sideways[0] * down[k - 1] + sideways[1] * up[k - 1]);
            let from_right = left[k + 1] * (sideways[2] * down[k + 1] + sideways[3] * up[k + 1]);
            level.mass[i] += from_left + from_right;
            level.x[i] += from_left * u[k - 1] + from_right * u[k + 1];
            level.y[i] += from_left * v[k - 1] + from_right * v[k + 1];
        }
    }

    fn write_shares(&mut self, p: &[f32]) {
        let n = p.len();
        let Sideways { left, stay, right } = &mut self.sideways;
        let (left, stay, right) = (&mut left[..n], &mut stay[..n], &mut right[..n]);
        let flow_x = &self.flow_x[..n + 1];
        for i in 0..n {
            left[i] = positive(-flow_x[i]);
            right[i] = positive(flow_x[i + 1]);
            stay[i] = 1.0 - (left[i] + right[i]);
        }
        let (below, above) = (&self.flow_below[..n], &self.flow_above[..n]);
        let (down, level, up) = (&mut self.down[..n], &mut self.level[..n], &mut self.up[..n]);
        for i in 0..n {
            let (d, u) = (positive(-below[i]), positive(above[i]));
            down[i] = p[i] * d;
            up[i] = p[i] * u;
            level[i] = p[i] * (1.0 - (d + u));
        }
    }

    /// Targets of one row: level from their own row, up from the row below, down from the row above.
    fn sum_up(&self, target: &mut Target) {
        let n = self.carry_down.mass.len();
        let [_, level] = &self.carry_level;
        let [_, _, up] = &self.carry_up;
        let down = &self.carry_down;
        for (out, level, up, down) in [
            (&mut *target.pressure, &level.mass, &up.mass, &down.mass),
            (&mut *target.momentum_x, &level.x, &up.x, &down.x),
            (&mut *target.momentum_y, &level.y, &up.y, &down.y),
        ] {
            let (out, level, up, down) = (&mut out[1..=n], &level[..n], &up[..n], &down[..n]);
            for i in 0..n {
                out[i] = level[i] + (up[i] + down[i]);
            }
        }
    }
}

/// Sums what three neighbouring sources bring to each column.
fn carry_sideways(mass: &[f32], sideways: &Sideways, u: &[f32], v: &[f32], carry: &mut Carry) {
    let n = carry.mass.len();
    let (mass, u, v) = (&mass[..n + 2], &u[..n + 2], &v[..n + 2]);
    let Sideways { left, stay, right } = sideways;
    let (left, stay, right) = (&left[..n + 2], &stay[..n + 2], &right[..n + 2]);
    let (carry_mass, carry_x, carry_y) = (&mut carry.mass[..n], &mut carry.x[..n], &mut carry.y[..n]);
    for i in 0..n {
        let from_left = mass[i] * right[i];
        let stays = mass[i + 1] * stay[i + 1];
        let from_right = mass[i + 2] * left[i + 2];
        carry_mass[i] = stays + (from_left + from_right);
        carry_x[i] = stays * u[i + 1] + (from_left * u[i] + from_right * u[i + 2]);
        carry_y[i] = stays * v[i + 1] + (from_left * v[i] + from_right * v[i + 2]);
    }
}

/// Adds `mass` from a cell with velocity (u, v).
#[inline(always)]
fn add(carry: &mut Carry, i: usize, mass: f32, u: f32, v: f32) {
    carry.mass[i] += mass;
    carry.x[i] += mass * u;
    carry.y[i] += mass * v;
}
