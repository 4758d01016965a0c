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
//! pressure that alternates from cell to cell pushes nothing and stays for ever.
//!
//! All shares are ≥ 0 and sum to 1, hence mass and momentum are conserved and pressure stays ≥ 0; a new velocity is a
//! mean of old ones, hence no speed and no kinetic energy grows here.
//!
//! **How.** A gather: row by row, sources' shares into row buffers, then for each target the sum over its three rows, in
//! an order that a mirror image shares (middle + (one side + other side)), so that mirrored air has mirrored bits.

use super::{
    pressure::shifted,
    second_order::{SecondOrder, Shares},
    shape::Corner,
    source::{Source, product, store_three, sum, three},
};
use crate::simd::{Array, Lanes, lane_starts};
use std::ops::Range;

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

    fn rows(&mut self, n: usize) -> [&mut [f32]; 3] {
        [&mut self.mass[..n], &mut self.x[..n], &mut self.y[..n]]
    }

    /// Adds `mass` from a cell with velocity (u, v).
    #[inline(always)]
    fn add(&mut self, i: usize, mass: f32, u: f32, v: f32) {
        self.mass[i] += mass;
        self.x[i] += mass * u;
        self.y[i] += mass * v;
    }
}

/// What rows of sources bring to the rows around them.
#[derive(Debug)]
struct Carried {
    down: Carry,
    /// Of this row of sources and the one below.
    level: [Carry; 2],
    /// Of this row of sources, the one below and the one below that.
    up: [Carry; 3],
}

impl Carried {
    fn new(stride: usize) -> Self {
        let carry = || Carry::new(stride - 2);
        Self { down: carry(), level: [carry(), carry()], up: [carry(), carry(), carry()] }
    }

    /// Goes on to the next row of sources.
    #[inline(always)]
    fn advance(&mut self) {
        self.level.rotate_right(1);
        self.up.rotate_right(1);
    }

    fn values(&self) -> usize {
        self.down.mass.len() * 18
    }
}

/// Row buffers of pass 1. Faces count with the cell on their right: face k is between the cells k − 1 and k.
#[derive(Debug)]
pub(super) struct Advection {
    /// Share of the cell left of a face that goes right through it.
    right: Vec<f32>,
    /// Share of the cell right of a face that goes left through it.
    left: Vec<f32>,
    /// Share of each cell that goes down: of this row, and of the next.
    sinking: [Vec<f32>; 2],
    /// Share of each cell that goes up.
    rising: Vec<f32>,
    /// Mass that goes down, stays level and goes up.
    down: Vec<f32>,
    level: Vec<f32>,
    up: Vec<f32>,
    /// Heads of this row and of the one above it, in strong air.
    heads: [Vec<f32>; 2],
    second_order: SecondOrder,
    /// With their velocity; and, once the air has been warm, with its warmth as if that were a velocity along either axis.
    carried: Vec<Carried>,
}

impl Advection {
    pub(super) fn new(stride: usize) -> Self {
        let row = || vec![0.0; stride];
        Self {
            right: row(),
            left: row(),
            sinking: [row(), row()],
            rising: row(),
            down: row(),
            level: row(),
            up: row(),
            heads: [row(), row()],
            second_order: SecondOrder::default(),
            carried: vec![Carried::new(stride)],
        }
    }

    /// Values held.
    pub(super) fn values(&self) -> usize {
        let carried: usize = self.carried.iter().map(Carried::values).sum();
        self.right.len() * 10 + carried + self.second_order.values()
    }

    /// Begins with a row of sources of which only the shares that go up are wanted.
    #[inline(always)]
    pub(super) fn begin(&mut self, source: Source, row: usize) {
        self.sinking[0].fill(0.0);
        if let Some(instructions) = source.strong {
            source.find_heads(instructions, row, &mut self.heads[0]);
        }
    }

    /// Shares out a row of sources (counted with the ring). What lies above it is left out for the last one, of which
    /// only the shares that go down are wanted.
    #[inline(always)]
    pub(super) fn share<L: Lanes>(&mut self, source: Source, row: usize, above: bool) {
        self.share_sideways::<L>(source, row);
        if above {
            if let Some(instructions) = source.strong {
                source.find_heads(instructions, row + 1, &mut self.heads[1]);
            }
            self.share_upright::<L>(source, row);
        } else {
            self.share_down::<L>(source, row);
        }
        let velocity = [source.velocity_x, source.velocity_y];
        let warmth = source.warmth.map(|warmth| [warmth, warmth]);
        let mut carried = std::mem::take(&mut self.carried);
        if warmth.is_some() && carried.len() == 1 {
            carried.push(Carried::new(source.stride));
        }
        // One loop, as the code of two calls is too long to be inlined whole.
        for ([velocity_x, velocity_y], to) in [Some(velocity), warmth].into_iter().flatten().zip(&mut carried) {
            self.bring::<L>(Source { velocity_x, velocity_y, ..source }, row, to);
        }
        self.carried = carried;
    }

    /// Brings mass and momentum of a row of sources to the rows around it.
    #[inline(always)]
    fn bring<L: Lanes>(&mut self, source: Source, row: usize, to: &mut Carried) {
        let here = source.start(row)..source.start(row) + source.width;
        let (u, v) = (&source.velocity_x[here.clone()], &source.velocity_y[here]);
        if source.second_order {
            self.carry_second::<L>(source, row, to);
        } else {
            self.carry::<L>([u, v], to);
        }
        self.turn_corners(source, row, [u, v], to);
        self.turn_at_fences(source, row, [u, v], to);
    }

    /// Goes on to the next row of sources.
    #[inline(always)]
    pub(super) fn advance(&mut self) {
        self.carried.iter_mut().for_each(Carried::advance);
        self.sinking.swap(0, 1);
        self.heads.swap(0, 1);
    }

    /// Sideways shares of a row of sources.
    #[inline(always)]
    fn share_sideways<L: Lanes>(&mut self, source: Source, row: usize) {
        let last = source.width - 1;
        self.share_faces::<L>(source, row, 1..last + 1);
        if source.second_order {
            for face in [1, last].into_iter().filter(|face| [1, source.stride - 1].contains(&(source.left + face))) {
                self.share_faces::<Array<1>>(source.at_edge(), row, face..face + 1);
            }
        }
    }

    /// Shares that pass these faces of a row of sources.
    #[inline(always)]
    fn share_faces<L: Lanes>(&mut self, source: Source, row: usize, faces: Range<usize>) {
        let behind = source.start(row) + faces.start;
        let (before, n) = (behind - 1, faces.len());
        let u0 = &source.velocity_x[before..before + n];
        let [u1, open] = [source.velocity_x, source.open[0]].map(|field| &field[behind..behind + n]);
        let head = if source.strong.is_some() { &self.heads[0] } else { source.pressures(row) };
        let (h0, h1) = (&head[faces.start - 1..][..n], &head[faces.start..][..n]);
        let (right, left) = (&mut self.right[faces.clone()], &mut self.left[faces]);
        let zero = L::splat(0.0);
        for i in lane_starts::<L>(n) {
            let velocities = [L::of(u0, i), L::of(u1, i)];
            let flow = source.face_flow(L::of(open, i), velocities, L::of(h0, i) - L::of(h1, i));
            flow.max(zero).put(right, i);
            (zero - flow).max(zero).put(left, i);
        }
    }

    /// Mass of a row of sources that goes down, stays level and goes up.
    #[inline(always)]
    fn share_upright<L: Lanes>(&mut self, source: Source, row: usize) {
        let source = if source.is_inside(row) { source } else { source.at_edge() };
        let n = source.width;
        let (start, above) = (source.start(row), source.start(row + 1));
        let [p0, v0] = [source.pressure, source.velocity_y].map(|field| &field[start..start + n]);
        let [v1, open] = [source.velocity_y, source.open[1]].map(|field| &field[above..above + n]);
        let [h0, h1] = if source.strong.is_some() {
            self.heads.each_ref().map(|row| &row[..n])
        } else {
            [row, row + 1].map(|row| source.pressures(row))
        };
        let [sinking, sinking_next] = &mut self.sinking;
        let (sinking, sinking_next, rises) = (&sinking[..n], &mut sinking_next[..n], &mut self.rising[..n]);
        let (down, level, up) = (&mut self.down[..n], &mut self.level[..n], &mut self.up[..n]);
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        for i in lane_starts::<L>(n) {
            let p = L::of(p0, i);
            let flow = source.face_flow(L::of(open, i), [L::of(v0, i), L::of(v1, i)], L::of(h0, i) - L::of(h1, i));
            let (rising, sinks) = (flow.max(zero), L::of(sinking, i));
            (zero - flow).max(zero).put(sinking_next, i);
            rising.put(rises, i);
            (p * sinks).put(down, i);
            (p * (one - (sinks + rising))).put(level, i);
            (p * rising).put(up, i);
        }
    }

    /// Mass of a row of sources that goes down.
    #[inline(always)]
    fn share_down<L: Lanes>(&mut self, source: Source, row: usize) {
        let (start, n) = (source.start(row), source.width);
        let p = &source.pressure[start..start + n];
        let (sinking, down) = (&self.sinking[0][..n], &mut self.down[..n]);
        for i in lane_starts::<L>(n) {
            (L::of(p, i) * L::of(sinking, i)).put(down, i);
        }
        self.level[..n].fill(0.0);
        self.up[..n].fill(0.0);
    }

    /// Sums what three neighbouring sources bring to each column, for all three rows of targets at once.
    #[inline(always)]
    fn carry<L: Lanes>(&self, [u, v]: [&[f32]; 2], to: &mut Carried) {
        let n = u.len() - 2;
        let (u, v) = (shifted(u, n), shifted(v, n));
        let [_, goes_right, leaves_right] = shifted(&self.right, n);
        let [_, leaves_left, goes_left] = shifted(&self.left, n);
        let Carried { down, level: [level, ..], up: [up, ..] } = to;
        let carries = [down, level, up];
        let [mut down, mut level, mut up] = carries.map(|carry| carry.rows(n));
        let masses = [&self.down, &self.level, &self.up].map(|row| shifted(row, n));
        let one = L::splat(1.0);
        for i in lane_starts::<L>(n) {
            let stays = one - (L::of(leaves_left, i) + L::of(leaves_right, i));
            let parts = [L::of(goes_right, i), stays, L::of(goes_left, i)];
            let (u, v) = (three(u, i), three(v, i));
            store_three(sum_three(three(masses[0], i), parts, u, v), &mut down, i);
            store_three(sum_three(three(masses[1], i), parts, u, v), &mut level, i);
            store_three(sum_three(three(masses[2], i), parts, u, v), &mut up, i);
        }
    }

    /// The same to second order.
    #[inline(always)]
    fn carry_second<L: Lanes>(&mut self, source: Source, row: usize, to: &mut Carried) {
        let n = source.width - 2;
        let Self { right, left, sinking: [sinking, _], rising, down, level, up, .. } = self;
        let shares = Shares { right, left, sinking, rising, masses: [down, level, up] };
        let Carried { down, level: [level, ..], up: [up, ..] } = to;
        let carries = [down, level, up];
        self.second_order.carry::<L>(source, row, shares, carries.map(|carry| carry.rows(n)));
    }

    /// Gives the shares that strike a corner of rock to the cells beside it. What they brought to the rock itself is
    /// dropped when the rock's row is written. Sums pair opposite sides, so that a mirror image has the same.
    fn turn_corners(&self, source: Source, row: usize, [u, v]: [&[f32]; 2], to: &mut Carried) {
        let Source { shape, left: first, width, .. } = source;
        let Self { right, left, up, down, .. } = self;
        for (corners, part, carry) in [(&shape.above, up, &mut to.up[0]), (&shape.below, down, &mut to.down)] {
            for Corner { column, weights } in corners.row_within(row, first, width) {
                let k = *column as usize - first;
                let mass = part[k] * (weights[0] * left[k] + weights[1] * right[k + 1]);
                carry.add(k - 1, mass, u[k], v[k]);
            }
        }
        let level = &mut to.level[0];
        for Corner { column, weights } in shape.beside.row_within(row, first, width) {
            let k = *column as usize - first;
            let from_left = right[k] * (weights[0] * down[k - 1] + weights[1] * up[k - 1]);
            let from_right = left[k + 1] * (weights[2] * down[k + 1] + weights[3] * up[k + 1]);
            level.mass[k - 1] += from_left + from_right;
            level.x[k - 1] += from_left * u[k - 1] + from_right * u[k + 1];
            level.y[k - 1] += from_left * v[k - 1] + from_right * v[k + 1];
        }
    }

    /// The same for shares that would enter a sleeping tile across its corner.
    fn turn_at_fences(&self, source: Source, row: usize, [u, v]: [&[f32]; 2], to: &mut Carried) {
        let Source { shape, left: first, width, .. } = source;
        let inside = 1..width - 1;
        for turn in shape.turns_of(row) {
            // Negative and too large ones are out of range alike.
            let k = (turn.column as usize).wrapping_sub(first);
            let beside = if turn.right { k.wrapping_add(1) } else { k.wrapping_sub(1) };
            if !(inside.contains(&k) || inside.contains(&beside)) || k >= width {
                continue;
            }
            let sideways = if turn.right { self.right[k + 1] } else { self.left[k] };
            let (upright, carry) = if turn.up { (self.up[k], &mut to.up[0]) } else { (self.down[k], &mut to.down) };
            let half = 0.5 * sideways * upright;
            if inside.contains(&k) {
                carry.add(k - 1, half, u[k], v[k]);
            }
            if inside.contains(&beside) {
                to.level[0].add(beside - 1, half, u[k], v[k]);
            }
        }
    }

    /// Writes a row of targets, of mass, of momentum and, of warm air, of mass times warmth: level from their own row, up from
    /// the row below, down from the row above.
    #[inline(always)]
    pub(super) fn sum_up<L: Lanes>(
        &self,
        source: Source,
        row: usize,
        targets: [&mut [f32]; 3],
        warmth: Option<&mut [f32]>,
    ) {
        let n = source.width - 2;
        let struck = source.shape.struck_within(row, source.left, source.width);
        let from = |nth: usize| {
            let Carried { down, level: [_, level], up: [_, _, up] } = &self.carried[nth];
            [level, up, down]
        };
        let carried = from(0);
        let parts = [carried.map(|carry| &carry.mass), carried.map(|carry| &carry.x), carried.map(|carry| &carry.y)];
        let warm = warmth.map(|out| (out, from(1).map(|carry| &carry.x)));
        for (out, [level, up, down]) in targets.into_iter().zip(parts).chain(warm) {
            let (cells, level, up, down) = (&mut out[1..][..n], &level[..n], &up[..n], &down[..n]);
            for i in lane_starts::<L>(n) {
                let crossing = L::of(up, i) + L::of(down, i);
                (L::of(level, i) + crossing).put(cells, i);
            }
            // What struck rock has gone round the corner.
            for column in struck {
                out[*column as usize - source.left] = 0.0;
            }
        }
    }
}

/// Mass and momentum of the given parts of three cells, from left to right: middle + (left + right).
#[inline(always)]
fn sum_three<L: Lanes>(mass: [L; 3], parts: [L; 3], u: [L; 3], v: [L; 3]) -> [L; 3] {
    let from = product(mass, parts);
    [sum(from), sum(product(from, u)), sum(product(from, v))]
}
