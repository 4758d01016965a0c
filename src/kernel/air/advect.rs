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

/// Flow through a face, in cells a substep. No face lets more than half a cell pass, so that two can't take more than
/// there is. The substep's length keeps the velocities below that; only the filter can reach it, at a jump of pressure.
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
    fn new(n: usize) -> Self {
        Self { mass: vec![0.0; n], x: vec![0.0; n], y: vec![0.0; n] }
    }

    fn rows(&mut self, n: usize) -> (&mut [f32], &mut [f32], &mut [f32]) {
        (&mut self.mass[..n], &mut self.x[..n], &mut self.y[..n])
    }

    /// Adds `mass` from a cell with velocity (u, v).
    #[inline(always)]
    fn add(&mut self, i: usize, mass: f32, u: f32, v: f32) {
        self.mass[i] += mass;
        self.x[i] += mass * u;
        self.y[i] += mass * v;
    }
}

/// Row buffers of a band of rows. Faces count with the cell on their right: face k is between the cells k − 1 and k.
#[derive(Debug)]
pub(super) struct Band {
    /// Share of the cell left of a face that goes right through it.
    right: Vec<f32>,
    /// Share of the cell right of a face that goes left through it.
    left: Vec<f32>,
    /// Share of each cell that goes down: of this row, and of the next.
    sinking: [Vec<f32>; 2],
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
        let row = || vec![0.0; stride];
        let carry = || Carry::new(stride - 2);
        Self {
            right: row(),
            left: row(),
            sinking: [row(), row()],
            down: row(),
            level: row(),
            up: row(),
            carry_down: carry(),
            carry_level: [carry(), carry()],
            carry_up: [carry(), carry(), carry()],
        }
    }

    /// Values held.
    pub(super) fn values(&self) -> usize {
        self.right.len() * 7 + self.carry_down.mass.len() * 18
    }

    /// Fills the rows of `target`, of which the lowest is `first` (counted with the ring).
    pub(super) fn run(&mut self, source: Source, first: usize, target: Target) {
        let stride = source.stride;
        let end = first + target.pressure.len() / stride;
        self.sinking[0].fill(0.0);
        for row in first - 1..=end {
            self.share_sideways(source, row);
            self.share_upright(source, row, row < end);
            let here = row * stride..(row + 1) * stride;
            let (u, v) = (&source.velocity_x[here.clone()], &source.velocity_y[here]);
            self.carry(u, v);
            self.turn_corners(source.shape, row, u, v);
            if row > first {
                let out = (row - 1 - first) * stride;
                let fields = [&mut *target.pressure, &mut *target.momentum_x, &mut *target.momentum_y];
                self.sum_up(source.shape.struck(row - 1), fields.map(|field| &mut field[out..out + stride]));
            }
            self.carry_level.rotate_right(1);
            self.carry_up.rotate_right(1);
            self.sinking.swap(0, 1);
        }
    }

    /// Sideways shares of a row of sources.
    fn share_sideways(&mut self, source: Source, row: usize) {
        let Source { pressure, velocity_x, shape, stride, half, filter, .. } = source;
        let (start, n) = (row * stride, stride - 1);
        let [p0, u0] = [pressure, velocity_x].map(|field| &field[start..start + n]);
        let [p1, u1, open] = [pressure, velocity_x, &shape.open_x].map(|field| &field[start + 1..start + 1 + n]);
        let (right, left) = (&mut self.right[1..=n], &mut self.left[1..=n]);
        for i in 0..n {
            let flow = face_flow(open[i], u0[i] + u1[i], p0[i] - p1[i], half, filter);
            right[i] = positive(flow);
            left[i] = positive(-flow);
        }
    }

    /// Mass of a row of sources that goes down, stays level and goes up. What lies above is left out for the last row of
    /// a band, of which only the shares that go down are wanted.
    fn share_upright(&mut self, source: Source, row: usize, above: bool) {
        let Source { pressure, velocity_y, shape, stride: n, half, filter, .. } = source;
        let start = row * n;
        let p0 = &pressure[start..start + n];
        let [sinking, sinking_next] = &mut self.sinking;
        let (sinking, sinking_next) = (&sinking[..n], &mut sinking_next[..n]);
        let (down, level, up) = (&mut self.down[..n], &mut self.level[..n], &mut self.up[..n]);
        if !above {
            for i in 0..n {
                down[i] = p0[i] * sinking[i];
            }
            level.fill(0.0);
            up.fill(0.0);
            return;
        }
        let v0 = &velocity_y[start..start + n];
        let [p1, v1, open] = [pressure, velocity_y, &shape.open_y].map(|field| &field[start + n..start + 2 * n]);
        for i in 0..n {
            let flow = face_flow(open[i], v0[i] + v1[i], p0[i] - p1[i], half, filter);
            let rising = positive(flow);
            sinking_next[i] = positive(-flow);
            down[i] = p0[i] * sinking[i];
            level[i] = p0[i] * (1.0 - (sinking[i] + rising));
            up[i] = p0[i] * rising;
        }
    }

    /// Sums what three neighbouring sources bring to each column, for all three rows of targets at once.
    fn carry(&mut self, u: &[f32], v: &[f32]) {
        let n = self.carry_down.mass.len();
        let (u, v) = (&u[..n + 2], &v[..n + 2]);
        let (right, left) = (&self.right[..n + 2], &self.left[..n + 2]);
        let (down, level, up) = (&self.down[..n + 2], &self.level[..n + 2], &self.up[..n + 2]);
        let (down_mass, down_x, down_y) = self.carry_down.rows(n);
        let (level_mass, level_x, level_y) = self.carry_level[0].rows(n);
        let (up_mass, up_x, up_y) = self.carry_up[0].rows(n);
        for i in 0..n {
            let parts = [right[i + 1], 1.0 - (left[i + 1] + right[i + 2]), left[i + 2]];
            let (u, v) = ([u[i], u[i + 1], u[i + 2]], [v[i], v[i + 1], v[i + 2]]);
            (down_mass[i], down_x[i], down_y[i]) = sum_three([down[i], down[i + 1], down[i + 2]], parts, u, v);
            (level_mass[i], level_x[i], level_y[i]) = sum_three([level[i], level[i + 1], level[i + 2]], parts, u, v);
            (up_mass[i], up_x[i], up_y[i]) = sum_three([up[i], up[i + 1], up[i + 2]], parts, u, v);
        }
    }

    /// Gives the shares that strike a corner of rock to the cells beside it. What they brought to the rock itself is
    /// dropped when the rock's row is written. Sums pair opposite sides, so that a mirror image has the same.
    fn turn_corners(&mut self, shape: &Shape, row: usize, u: &[f32], v: &[f32]) {
        let Self { right, left, up, down, .. } = self;
        for Corner { column, weights } in shape.above.row(row) {
            let k = *column as usize;
            let mass = up[k] * (weights[0] * left[k] + weights[1] * right[k + 1]);
            self.carry_up[0].add(k - 1, mass, u[k], v[k]);
        }
        for Corner { column, weights } in shape.below.row(row) {
            let k = *column as usize;
            let mass = down[k] * (weights[0] * left[k] + weights[1] * right[k + 1]);
            self.carry_down.add(k - 1, mass, u[k], v[k]);
        }
        let level = &mut self.carry_level[0];
        for Corner { column, weights } in shape.beside.row(row) {
            let k = *column as usize;
            let from_left = right[k] * (weights[0] * down[k - 1] + weights[1] * up[k - 1]);
            let from_right = left[k + 1] * (weights[2] * down[k + 1] + weights[3] * up[k + 1]);
            level.mass[k - 1] += from_left + from_right;
            level.x[k - 1] += from_left * u[k - 1] + from_right * u[k + 1];
            level.y[k - 1] += from_left * v[k - 1] + from_right * v[k + 1];
        }
    }

    /// Writes a row of targets: level from their own row, up from the row below, down from the row above.
    fn sum_up(&self, struck: &[u32], targets: [&mut [f32]; 3]) {
        let n = self.carry_down.mass.len();
        let [_, level] = &self.carry_level;
        let [_, _, up] = &self.carry_up;
        let down = &self.carry_down;
        let parts = [(&level.mass, &up.mass, &down.mass), (&level.x, &up.x, &down.x), (&level.y, &up.y, &down.y)];
        for (out, (level, up, down)) in targets.into_iter().zip(parts) {
            let (cells, level, up, down) = (&mut out[1..=n], &level[..n], &up[..n], &down[..n]);
            for i in 0..n {
                cells[i] = level[i] + (up[i] + down[i]);
            }
            // What struck rock has gone round the corner.
            for column in struck {
                out[*column as usize] = 0.0;
            }
        }
    }
}

/// Mass and momentum of the given parts of three cells, from left to right: middle + (left + right).
#[inline(always)]
fn sum_three(mass: [f32; 3], parts: [f32; 3], u: [f32; 3], v: [f32; 3]) -> (f32, f32, f32) {
    let from = [mass[0] * parts[0], mass[1] * parts[1], mass[2] * parts[2]];
    (
        from[1] + (from[0] + from[2]),
        from[1] * u[1] + (from[0] * u[0] + from[2] * u[2]),
        from[1] * v[1] + (from[0] * v[0] + from[2] * v[2]),
    )
}
