//! Vorticity confinement (Macklin & Müller 2013, eqs. 15–16): `ω_i = Σ (m/ρ_j) (v_j − v_i) × ∇_j W`,
//! `N = ∇|ω| / |∇|ω||`, and an acceleration `ε (N × ω)`.
//!
//! The direction N is noise where |ω| is even; it is faded in over gradients of `STEADY` of |ω| a spacing, so that
//! confinement acts on eddies and not on the noise of a pool at rest.

use crate::kernel::{
    bins::Group,
    parallel,
    params::GradientKernel,
    particles::Particles,
    pbf::Solver,
    simd::{Lanes, Pass},
    smoothing::{Gradient, Rational, Smoothing, Spiky},
    velocity::viscosity::share_of,
};
use std::marker::PhantomData;

/// Gradient of |ω| at which confinement is half in force, 1/(s d).
const STEADY: f32 = 1.0;

/// Applies vorticity confinement over `dt` s; `strengths` gives ε for each element, d/s.
pub fn apply_vorticity(particles: &mut Particles, solver: &mut Solver, strengths: &[f32], threads: usize, dt: f32) {
    match solver.smoothing.gradient {
        GradientKernel::Spiky => confine::<Spiky>(particles, solver, strengths, threads, dt),
        GradientKernel::Rational => confine::<Rational>(particles, solver, strengths, threads, dt),
    }
}

fn confine<G: Gradient>(particles: &mut Particles, solver: &mut Solver, strengths: &[f32], threads: usize, dt: f32) {
    // ω lives in the array of λ, which is free between two solves.
    let Solver { bins, smoothing, instructions, next_x, next_y, lambda: vorticity, .. } = solver;
    let read = &*particles;
    parallel::split(bins.groups(), [&mut vorticity[..]], threads, &|groups, base, [out]| {
        let gradient = PhantomData::<G>;
        instructions.run(CurlPass { smoothing, particles: read, groups, base, out, gradient });
    });
    let outputs = [&mut next_x[..], &mut next_y[..]];
    parallel::split(bins.groups(), outputs, threads, &|groups, base, out| {
        let gradient = PhantomData::<G>;
        let pass =
            ConfinementPass { smoothing, particles: read, vorticity, strengths, groups, base, out, dt, gradient };
        instructions.run(pass);
    });
    std::mem::swap(&mut particles.vx, next_x);
    std::mem::swap(&mut particles.vy, next_y);
}

/// Finds ω.
struct CurlPass<'a, G> {
    smoothing: &'a Smoothing,
    particles: &'a Particles,
    groups: &'a [Group],
    base: usize,
    /// Out: ω, 1/s.
    out: &'a mut [f32],
    gradient: PhantomData<G>,
}

impl<G: Gradient> Pass for CurlPass<'_, G> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (h, zero) = (L::splat(self.smoothing.radius), L::splat(0.0));
        let (h2, core, scale) = (h * h, L::splat(self.smoothing.core), L::splat(self.smoothing.gradient_scale));
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.particles.x[own.start..]), L::load(&self.particles.y[own.start..]));
            let (vxi, vyi) = (L::load(&self.particles.vx[own.start..]), L::load(&self.particles.vy[own.start..]));
            let mut curl = zero;
            for run in group.movable {
                for j in run.range() {
                    let (dx, dy) = (xi - L::splat(self.particles.x[j]), yi - L::splat(self.particles.y[j]));
                    let (dvx, dvy) = (L::splat(self.particles.vx[j]) - vxi, L::splat(self.particles.vy[j]) - vyi);
                    let r2 = dx * dx + dy * dy;
                    let w = (h2 - r2).max(zero);
                    curl = curl + G::weight(h, core, r2, w * w) * (dvx * dy - dvy * dx);
                }
            }
            (curl * scale).store(&mut self.out[own.start - self.base..own.end - self.base]);
        }
    }
}

/// Finds N and accelerates.
struct ConfinementPass<'a, G> {
    smoothing: &'a Smoothing,
    particles: &'a Particles,
    /// ω, 1/s.
    vorticity: &'a [f32],
    strengths: &'a [f32],
    groups: &'a [Group],
    base: usize,
    /// Out: velocities, d/s.
    out: [&'a mut [f32]; 2],
    dt: f32,
    gradient: PhantomData<G>,
}

impl<G: Gradient> Pass for ConfinementPass<'_, G> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (h, zero) = (L::splat(self.smoothing.radius), L::splat(0.0));
        let (h2, core, scale) = (h * h, L::splat(self.smoothing.core), L::splat(-self.smoothing.gradient_scale));
        let [out_x, out_y] = self.out;
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.particles.x[own.start..]), L::load(&self.particles.y[own.start..]));
            let curl = L::load(&self.vorticity[own.start..]);
            let strength = curl.max(zero - curl);
            let (mut slope_x, mut slope_y) = (zero, zero);
            for run in group.movable {
                for j in run.range() {
                    let (dx, dy) = (xi - L::splat(self.particles.x[j]), yi - L::splat(self.particles.y[j]));
                    let r2 = dx * dx + dy * dy;
                    let w = (h2 - r2).max(zero);
                    let rise = L::splat(self.vorticity[j].abs()) - strength;
                    let g = G::weight(h, core, r2, w * w) * rise;
                    (slope_x, slope_y) = (slope_x + g * dx, slope_y + g * dy);
                }
            }
            let (slope_x, slope_y) = (slope_x * scale, slope_y * scale);
            let length = (slope_x * slope_x + slope_y * slope_y).sqrt() + L::splat(STEADY);
            // N × ω ẑ = (N_y ω, −N_x ω)
            let push =
                L::load(&share_of(self.strengths, &self.particles.element[own.clone()], self.dt)) * curl / length;
            let (vx, vy) = (L::load(&self.particles.vx[own.start..]), L::load(&self.particles.vy[own.start..]));
            let out = own.start - self.base..own.end - self.base;
            (vx + slope_y * push).store(&mut out_x[out.clone()]);
            (vy - slope_x * push).store(&mut out_y[out]);
        }
    }
}
