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
//! 2(s + 2κ)². Hence **`s ≤ √2 − 2κ`**: 1.414 for the plain collocated grid (κ = 0), 1.289 for κ = 1/16. About another
//! pressure p, c is c√p; wind adds its own part of a cell (`step` counts all three).

use super::grid::Peaks;
use super::shape::Shape;

/// Stands in the division of momentum by mass, so that a cell without mass has no velocity and none a division by 0.
/// Far below a rounding of any mass that matters.
const VACUUM: f32 = 1.0e-30;

/// Speed, as a part of the speed of sound, below which a velocity is 0: far below f32's resolution of the pressure that
/// would cause it, far above denormals (which cost a hundred times the time), even when shares multiply it.
pub(super) const STILL_MACH: f32 = 1.0e-9;

/// What pass 2 reads: the new pressure with the ring, and the coefficients of the substep.
#[derive(Clone, Copy)]
pub(super) struct Push<'a> {
    pub(super) pressure: &'a [f32],
    pub(super) momentum_x: &'a [f32],
    pub(super) momentum_y: &'a [f32],
    pub(super) shape: &'a Shape,
    pub(super) stride: usize,
    /// `½ c²·dt/cell`, d/s.
    pub(super) gain: f32,
    /// dt/cell, s/d.
    pub(super) crossing: f32,
    /// Speeds below are 0, d/s.
    pub(super) still: f32,
}

impl Push<'_> {
    /// Writes the velocities of a row (counted with the ring) and returns its peaks.
    pub(super) fn run(&self, row: usize, velocity_x: &mut [f32], velocity_y: &mut [f32]) -> Peaks {
        let stride = self.stride;
        let n = stride - 2;
        let start = row * stride + 1;
        let here = &self.pressure[start..start + n];
        let left = &self.pressure[start - 1..start - 1 + n];
        let right = &self.pressure[start + 1..start + 1 + n];
        let below = &self.pressure[start - stride..start - stride + n];
        let above = &self.pressure[start + stride..start + stride + n];
        let open_left = &self.shape.open_x[start..start + n];
        let open_right = &self.shape.open_x[start + 1..start + 1 + n];
        let open_below = &self.shape.open_y[start..start + n];
        let open_above = &self.shape.open_y[start + stride..start + stride + n];
        let (momentum_x, momentum_y) = (&self.momentum_x[start..start + n], &self.momentum_y[start..start + n]);
        let (velocity_x, velocity_y) = (&mut velocity_x[1..=n], &mut velocity_y[1..=n]);
        for i in 0..n {
            let p = here[i];
            let per_mass = 1.0 / (p + VACUUM);
            let rise_x = open_right[i] * (right[i] - p) + open_left[i] * (p - left[i]);
            let rise_y = open_above[i] * (above[i] - p) + open_below[i] * (p - below[i]);
            let u = momentum_x[i] * per_mass - self.gain * rise_x;
            let v = momentum_y[i] * per_mass - self.gain * rise_y;
            velocity_x[i] = self.settle(u, open_left[i], open_right[i]);
            velocity_y[i] = self.settle(v, open_below[i], open_above[i]);
        }
        Peaks { x: peak(velocity_x), y: peak(velocity_y), pressure: peak(here) }
    }

    /// A component after the push. The air that would have crossed a closed face in this substep has struck it and lost
    /// its speed: the part |u|·dt/cell of the cell. So wind pressed against a wall dies within the time it takes to
    /// cross a cell, and faint sound, whose part is next to nothing, is thrown back whole. Energy only falls.
    #[inline(always)]
    fn settle(&self, velocity: f32, open_low: f32, open_high: f32) -> f32 {
        let towards_high = if velocity > 0.0 { velocity } else { 0.0 };
        let towards_low = towards_high - velocity;
        let struck = ((1.0 - open_high) * towards_high + (1.0 - open_low) * towards_low) * self.crossing;
        let struck = if struck < 1.0 { struck } else { 1.0 };
        let velocity = velocity - velocity * struck;
        if velocity.abs() < self.still { 0.0 } else { velocity }
    }
}

/// Largest magnitude in a row. Eight running maxima, so that the compiler uses lanes; a maximum has no order.
pub(super) fn peak(row: &[f32]) -> f32 {
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let mut lanes = [0.0_f32; 8];
    let (chunks, rest) = row.as_chunks::<8>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = larger(value.abs(), *lane);
        }
    }
    let rest = rest.iter().fold(0.0, |peak, value| larger(value.abs(), peak));
    lanes.into_iter().fold(rest, larger)
}
