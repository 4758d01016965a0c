//! The smoothing kernels in 2-D, normalised for the lattice of spacing 1, and what box walls add to their sums.
//!
//! Density uses poly6, `W = 4/(π h⁸) (h² − r²)³` (Müller et al. 2003, in its 2-D normalisation; the 3-D factor
//! 315/(64 π h⁹) is wrong here). Gradients use spiky, `∇W = −30/(π h⁵) (h − r)² r̂`, or a rational form close to it.
//! The passes sum the bare powers and scale the sums once.

use crate::{params::GradientKernel, simd::Lanes};
use std::f64::consts::PI;

/// Shape of the rational gradient kernel: `(h − r)²/r ≈ (h² − r²)² / (STEEPNESS h (r² + CORE h²))` for r > 0.3 h.
const RATIONAL_STEEPNESS: f64 = 3.84;
/// See [`RATIONAL_STEEPNESS`].
const RATIONAL_CORE: f64 = 0.165 / 3.84;
/// Keeps the spiky direction finite at r = 0, d².
const TINY: f32 = 1e-12;

/// A kernel radius with the factors that belong to it.
#[derive(Clone, Debug)]
pub struct Smoothing {
    /// Kernel radius h, d.
    pub radius: f32,
    /// Gradient kernel.
    pub gradient: GradientKernel,
    /// Turns `Σ (h² − r²)³` into a density that is 1 on the square lattice of spacing 1.
    pub density_scale: f32,
    /// Turns `Σ g(r) (x_i − x_j)` into `−∇ρ`.
    pub gradient_scale: f32,
    /// Core of the rational kernel, d².
    pub core: f32,
    walls: WallTable,
}

impl Smoothing {
    /// Kernels of radius `radius` d.
    pub fn new(radius: f32, gradient: GradientKernel) -> Self {
        let h = f64::from(radius);
        let spiky_scale = 30.0 / (PI * h * h * h * h * h);
        let gradient_scale = match gradient {
            GradientKernel::Spiky => spiky_scale,
            GradientKernel::Rational => spiky_scale / (RATIONAL_STEEPNESS * h),
        };
        let mut smoothing = Self {
            radius,
            gradient,
            density_scale: (1.0 / lattice_sum(h)) as f32,
            gradient_scale: gradient_scale as f32,
            core: (RATIONAL_CORE * h * h) as f32,
            walls: WallTable { sums: Vec::new(), per_spacing: 0.0 },
        };
        smoothing.walls = WallTable::new(&smoothing);
        smoothing
    }

    /// Density of the half plane beyond a wall at distance `distance` d (0 … h), and the sum of `g(r) (x_i − x_j)` over
    /// it along the wall's normal. Both 0 from h on.
    #[inline(always)]
    pub fn wall(&self, distance: f32) -> (f32, f32) {
        if distance >= self.radius { (0.0, 0.0) } else { self.walls.at(distance) }
    }

    /// The bare gradient weight g(r) in double precision.
    fn gradient_weight(&self, r2: f64) -> f64 {
        let h = f64::from(self.radius);
        match self.gradient {
            _ if r2 >= h * h => 0.0,
            GradientKernel::Spiky => {
                let r = r2.max(f64::from(TINY)).sqrt();
                (h - r) * (h - r) / r
            }
            GradientKernel::Rational => {
                let w = h * h - r2;
                w * w / (r2 + RATIONAL_CORE * h * h)
            }
        }
    }
}

/// `Σ (h² − r²)³` over the square lattice of spacing 1, its own site included.
fn lattice_sum(h: f64) -> f64 {
    let reach = h.ceil() as i32;
    let mut sum = 0.0;
    for j in -reach..=reach {
        for i in -reach..=reach {
            let w = (h * h - f64::from(i * i + j * j)).max(0.0);
            sum += w * w * w;
        }
    }
    sum
}

/// How a gradient kernel weighs a pair.
pub(crate) trait Gradient {
    /// `g(r)`, so that `∇W = −scale · g(r) · (x_i − x_j)`; `w2 = max(h² − r², 0)²`. Zero from r = h on.
    fn weight<L: Lanes>(h: L, core: L, r2: L, w2: L) -> L;
}

/// The paper's gradient: `(h − r)² / r`.
pub(crate) struct Spiky;

/// The rational gradient: `(h² − r²)² / (r² + core)`.
pub(crate) struct Rational;

impl Gradient for Spiky {
    #[inline(always)]
    fn weight<L: Lanes>(h: L, _core: L, r2: L, _w2: L) -> L {
        let r = r2.max(L::splat(TINY)).sqrt();
        let q = (h - r).max(L::splat(0.0));
        q * q / r
    }
}

impl Gradient for Rational {
    #[inline(always)]
    fn weight<L: Lanes>(_h: L, core: L, r2: L, w2: L) -> L {
        w2 / (r2 + core)
    }
}

/// Sums over the half plane beyond a wall, tabulated over the distance to it. A box wall is the limit of many fixed
/// particles: its density is the integral of W, so that the lattice that ends half a spacing before it rests.
#[derive(Clone, Debug)]
struct WallTable {
    /// Density and gradient.
    sums: Vec<[f32; 2]>,
    per_spacing: f32,
}

/// Intervals of the table.
const WALL_INTERVALS: usize = 64;
/// Quadrature steps (midpoint rule) in an interval, and along the wall.
const WALL_STEPS: (usize, usize) = (8, 256);

impl WallTable {
    fn new(smoothing: &Smoothing) -> Self {
        let h = f64::from(smoothing.radius);
        let step = h / (WALL_INTERVALS * WALL_STEPS.0) as f64;
        let poly6 = 4.0 / (PI * h * h * h * h * h * h * h * h);
        let mut sums = vec![[0.0; 2]; WALL_INTERVALS + 1];
        let (mut density_sum, mut gradient_sum) = (0.0, 0.0);
        for interval in (0..WALL_INTERVALS).rev() {
            for k in (0..WALL_STEPS.0).rev() {
                let normal = ((interval * WALL_STEPS.0 + k) as f64 + 0.5) * step;
                let half_width = (h * h - normal * normal).sqrt();
                let along_step = half_width / WALL_STEPS.1 as f64;
                for m in 0..WALL_STEPS.1 {
                    let along = (m as f64 + 0.5) * along_step;
                    let r2 = normal * normal + along * along;
                    let w = h * h - r2;
                    density_sum += 2.0 * poly6 * w * w * w * along_step * step;
                    gradient_sum += 2.0 * smoothing.gradient_weight(r2) * normal * along_step * step;
                }
            }
            sums[interval] = [density_sum as f32, gradient_sum as f32];
        }
        Self { sums, per_spacing: (WALL_INTERVALS as f64 / h) as f32 }
    }

    #[inline]
    fn at(&self, distance: f32) -> (f32, f32) {
        let place = (distance * self.per_spacing).max(0.0);
        let interval = place as usize;
        let Some([near, far]) = self.sums.get(interval..interval + 2) else { return (0.0, 0.0) };
        let share = place - interval as f32;
        let between = |sum: usize| near[sum] + share * (far[sum] - near[sum]);
        (between(0), between(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poly6(h: f64, r2: f64) -> f64 {
        4.0 / (PI * h.powi(8)) * (h * h - r2).max(0.0).powi(3)
    }

    #[test]
    fn poly6_integrates_to_one_over_the_plane() {
        let (h, n) = (2.5, 400);
        let step = 2.0 * h / f64::from(n);
        let mut sum = 0.0;
        for j in 0..n {
            for i in 0..n {
                let (x, y) = (-h + (f64::from(i) + 0.5) * step, -h + (f64::from(j) + 0.5) * step);
                sum += poly6(h, x * x + y * y) * step * step;
            }
        }
        assert!((sum - 1.0).abs() < 1e-4, "integral of W is {sum}");
    }

    #[test]
    fn both_gradients_belong_to_a_kernel_that_integrates_to_one() {
        // ∫ |∇W| r dA = 2 ∫ W dA for every radial kernel that vanishes at h.
        for (gradient, tolerance) in [(GradientKernel::Spiky, 1e-4), (GradientKernel::Rational, 0.05)] {
            let smoothing = Smoothing::new(2.5, gradient);
            let (h, n) = (2.5, 20_000);
            let mut sum = 0.0;
            for k in 0..n {
                let r = (f64::from(k) + 0.5) * h / f64::from(n);
                sum +=
                    f64::from(smoothing.gradient_scale) * smoothing.gradient_weight(r * r) * r * r * 2.0 * PI * r * h
                        / f64::from(n);
            }
            assert!((sum - 2.0).abs() < 2.0 * tolerance, "{gradient:?}: {sum} instead of 2");
        }
    }

    #[test]
    fn the_rational_gradient_follows_spiky() {
        let (spiky, rational) =
            (Smoothing::new(2.5, GradientKernel::Spiky), Smoothing::new(2.5, GradientKernel::Rational));
        for k in 30..95 {
            let r = 2.5 * f64::from(k) / 100.0;
            let exact = f64::from(spiky.gradient_scale) * spiky.gradient_weight(r * r) * r;
            let close = f64::from(rational.gradient_scale) * rational.gradient_weight(r * r) * r;
            let largest = f64::from(spiky.gradient_scale) * 0.49 * 2.5 * 2.5;
            assert!((exact - close).abs() < 0.03 * largest, "r = {r}: {close} instead of {exact}");
        }
    }

    #[test]
    fn a_lattice_that_ends_at_a_wall_has_the_density_of_the_whole_lattice() {
        for gradient in [GradientKernel::Spiky, GradientKernel::Rational] {
            for radius in [2.0, 2.5, 3.0, 4.0] {
                let smoothing = Smoothing::new(radius, gradient);
                let h2 = f64::from(radius * radius);
                for layer in 0..4 {
                    let distance = 0.5 + layer as f32;
                    let (mut density, mut push) = (0.0, 0.0);
                    for j in 0..12 {
                        for i in -6..=6 {
                            let (dx, dy) = (f64::from(-i), f64::from(distance) - 0.5 - f64::from(j));
                            let r2 = dx * dx + dy * dy;
                            density += f64::from(smoothing.density_scale) * (h2 - r2).max(0.0).powi(3);
                            push += if r2 > 0.0 { smoothing.gradient_weight(r2) * dy } else { 0.0 };
                        }
                    }
                    let (wall_density, wall_push) = smoothing.wall(distance);
                    let total = density + f64::from(wall_density);
                    assert!((total - 1.0).abs() < 0.02, "h {radius}, layer {layer}: density {total}");
                    let net = (push + f64::from(wall_push)) * f64::from(smoothing.gradient_scale);
                    assert!(net.abs() < 0.02, "h {radius}, layer {layer}: net gradient {net}");
                }
            }
        }
    }
}
