//! Pass 2: velocity from momentum, and the push of every neighbour pair by its pressure difference.
//!
//! `du/dt = −c² ∇p`: the pair (0, 1) pushes by `c² (p₀ − p₁)/cell`, half of it to each of its cells. The pressure is the
//! *new* one, after pass 1 (from the old one the scheme is unstable at any step).
//!
//! **Stability**, waves `e^{i(kx + ly)}` about rest at p = 1, a = u·dt/cell, s = c·dt/cell, θ = k·cell, φ = l·cell:
//! ```text
//! p' = (1 − 2κs(1−cos θ) − 2κs(1−cos φ)) p − i sin θ · a − i sin φ · b        (advect)
//! a' = a − s² i sin θ · p'     b' = b − s² i sin φ · p'                        (here)
//! ```
//! With S = s²(sin²θ + sin²φ) and ε = 2κs(2 − cos θ − cos φ) the matrix has trace 2 − ε − S and determinant 1 − ε, so both
//! roots are within the unit circle while `S + 2ε ≤ 4`. The left side is largest at cos θ = cos φ = −2κ/s, where it is
//! 2(s + 2κ)². Hence **`s ≤ √2 − 2κ`**: 1.414 for the plain collocated grid (κ = 0), 1.289 for κ = 1/16.
//!
//! Below the bound an energy falls in every substep, whatever the waves: with D and F for what advection makes of a and p
//! (`p' = p − F p − D a`, F ≥ 0), ⟨·,·⟩ the sum over the cells and ‖x‖² = ⟨x, F x⟩,
//! ```text
//! R = |a|² + s² ⟨p, p'⟩ + ½ s² ‖p‖²         R' − R = −½ s² ‖p + p'‖² ≤ 0
//! ```
//! because `a' = a + s² Dᵀ p'`, D being antisymmetric. It is the energy with both fields at one time: the velocity stands
//! half a substep later than the pressure. R is positive while `S + 2ε < 4`, the same bound.
//!
//! About another pressure p the pass pushes by the slope of the head h (`law`): c is c√(p h′), and κ is κ√(p h′), at most
//! ¼. Wind adds its own part of a cell (`step` counts all three). For even wind (a, b) the eigenvalues of the step, found
//! numerically over all waves for κ from 1/16 to ¼, advection of either order and |a|, |b| ≤ ½, are within the unit circle
//! while `|a| + |b| + s ≤ .9`, and while `s ≤ ½` whatever the wind.

use super::{law, source::FACE_FILTER};
use crate::simd::{Lanes, lane_starts};
use std::hint::black_box;

/// Pressure below which a cell is empty: it has no mass and brings no momentum. Far below a rounding of any mass that matters, far
/// above denormals (which cost a hundred times the time), even when shares multiply it.
pub(super) const VACUUM: f32 = 1.0e-22;

/// Speed, as a part of the speed of sound, below which a velocity is 0: far below f32's resolution of the pressure that
/// would cause it, far above denormals (which cost a hundred times the time), even when shares multiply it.
pub(super) const STILL_MACH: f32 = 1.0e-9;

/// Largest stable Courant number of sound where pressures reach `highest`.
pub(super) fn stable_courant(highest: f32) -> f32 {
    std::f32::consts::SQRT_2 - 2.0 * FACE_FILTER * law::sound(highest)
}

/// Largest values of a band or of the grid: what the next substep's length depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Peaks {
    /// Largest |u|, d/s.
    pub(super) x: f32,
    /// Largest |v|, d/s.
    pub(super) y: f32,
    /// Largest pressure.
    pub(super) pressure: f32,
}

impl Peaks {
    /// The larger of each.
    pub(super) fn max(self, other: Self) -> Self {
        Self { x: self.x.max(other.x), y: self.y.max(other.y), pressure: self.pressure.max(other.pressure) }
    }
}

/// The coefficients of a substep.
#[derive(Clone, Copy)]
pub(super) struct Push {
    /// `½ c²·dt/cell`, d/s.
    pub(super) gain: f32,
    /// dt/cell, s/d.
    pub(super) crossing: f32,
    /// Speeds below are 0, d/s.
    pub(super) still: f32,
}

/// What pass 2 reads for a row of cells, each with the ring.
pub(super) struct Pushed<'a> {
    /// New pressures.
    pub(super) pressure: &'a [f32],
    /// Their heads: of the row below, this row and the row above.
    pub(super) heads: [&'a [f32]; 3],
    pub(super) momentum_x: &'a [f32],
    pub(super) momentum_y: &'a [f32],
    /// What the left and the lower face of each cell let through.
    pub(super) open: [&'a [f32]; 2],
    /// Where the columns at hand of the row begin in the fields.
    pub(super) start: usize,
    /// Values between a cell and the one above it.
    pub(super) stride: usize,
}

impl Push {
    /// Writes pressures and velocities of a row (with the ring) and returns its peaks.
    #[inline(always)]
    pub(super) fn run<L: Lanes>(&self, from: Pushed, [pressure, x, y]: [&mut [f32]; 3]) -> Peaks {
        let n = from.momentum_x.len() - 2;
        let (start, stride) = (from.start + 1, from.stride);
        let [below, row, above] = from.heads;
        let [left, level, right] = shifted(row, n);
        let here = &from.pressure[1..][..n];
        let (below, above) = (&below[1..][..n], &above[1..][..n]);
        let [_, open_left, open_right] = shifted(&from.open[0][start - 1..], n);
        let open_below = &from.open[1][start..start + n];
        let open_above = &from.open[1][start + stride..start + stride + n];
        let (momentum_x, momentum_y) = (&from.momentum_x[1..][..n], &from.momentum_y[1..][..n]);
        let (kept, velocity_x, velocity_y) = (&mut pressure[1..][..n], &mut x[1..][..n], &mut y[1..][..n]);
        let (gain, zero, one, vacuum) = (L::splat(self.gain), L::splat(0.0), L::splat(1.0), L::splat(VACUUM));
        for i in lane_starts::<L>(n) {
            let (p, h) = (L::of(here, i), L::of(level, i));
            let (left, right) = (L::of(left, i), L::of(right, i));
            let (below, above) = (L::of(below, i), L::of(above, i));
            let (open_left, open_right) = (L::of(open_left, i), L::of(open_right, i));
            let (open_below, open_above) = (L::of(open_below, i), L::of(open_above, i));
            let per_mass = p.if_less(vacuum, zero, one / p);
            let rise_x = open_right * (right - h) + open_left * (h - left);
            let rise_y = open_above * (above - h) + open_below * (h - below);
            let u = L::of(momentum_x, i) * per_mass - gain * rise_x;
            let v = L::of(momentum_y, i) * per_mass - gain * rise_y;
            let (u, v) = (self.settle(u, open_left, open_right), self.settle(v, open_below, open_above));
            p.if_less(vacuum, zero, p).put(kept, i);
            u.put(velocity_x, i);
            v.put(velocity_y, i);
        }
        Peaks { x: peak(velocity_x), y: peak(velocity_y), pressure: peak(here) }
    }

    /// A component after the push. The air that would have crossed a closed face in this substep has struck it and lost
    /// its speed: the part |u|·dt/cell of the cell. So wind pressed against a wall dies within the time it takes to
    /// cross a cell, and faint sound, whose part is next to nothing, is thrown back whole. Energy only falls.
    #[inline(always)]
    fn settle<L: Lanes>(&self, velocity: L, open_low: L, open_high: L) -> L {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let towards_high = velocity.max(zero);
        let towards_low = towards_high - velocity;
        let struck = ((one - open_high) * towards_high + (one - open_low) * towards_low) * L::splat(self.crossing);
        let velocity = velocity - velocity * struck.min(one);
        velocity.abs().if_less(L::splat(self.still), zero, velocity)
    }
}

/// `n` entries of a row from its first, second and third on. The compiler is kept from seeing that they overlap: it would
/// put lanes together from others, which takes longer than loading them.
#[inline(always)]
pub(super) fn shifted(row: &[f32], n: usize) -> [&[f32]; 3] {
    // Not by a closure, which would not be inlined in so long a pass.
    let [first, second, third] = [row, &row[1..], &row[2..]];
    [&black_box(first)[..n], &black_box(second)[..n], &black_box(third)[..n]]
}

/// Largest magnitude in a row. Sixteen running maxima, so that the compiler uses lanes; a maximum has no order.
#[inline(always)]
pub(super) fn peak(row: &[f32]) -> f32 {
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let mut lanes = [0.0_f32; 16];
    let (chunks, rest) = row.as_chunks::<16>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = larger(value.abs(), *lane);
        }
    }
    let rest = rest.iter().fold(0.0, |peak, value| larger(value.abs(), peak));
    lanes.into_iter().fold(rest, larger)
}
