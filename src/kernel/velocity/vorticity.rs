//! Vorticity confinement (Macklin & Müller 2013, eqs. 15–16): `ω_i = Σ (m/ρ_j) (v_j − v_i) × ∇_j W`,
//! `N = ∇|ω| / |∇|ω||`, and an acceleration `ε (N × ω)`.
//!
//! The direction N is noise where |ω| is even; it is faded in over gradients of `STEADY` of |ω| a spacing, so that
//! confinement acts on eddies and not on the noise of a pool at rest.
//!
//! **The bound.** A shear wave `v = V sin(kx) ŷ` has `ω = k Ŵ(k) V cos(kx)`, Ŵ being the smoothing of the kernel, and the
//! push on it is `ε Δt k Ŵ V sign(sin kx) |cos kx|`, of which `2/π` is along the wave itself: a substep makes it
//! `1 + (2/π) ε Δt k Ŵ` times as high. For spiky `∫ r² W = h²/7`, so `Ŵ ≈ e^{−k²h²/28}`, and `k Ŵ` is largest, `2.27/h`,
//! at a wavelength of 1.7 h: no wave grows faster than by `1.45 ε Δt/h` of itself. Viscosity c takes `c (1 − Ŵ₆) ≈ ½ c` a tick off the same wave and so wins, short
//! waves over long, for `ε ≤ 0.34 c h/tick`. What a step must not do is to make more of a wave than a small part of it:
//! **`ε Δt ≤ 0.07 h`**, a tenth. A strength beyond it is cut to it, and counted.
//!
//! **Energy.** That growth is what confinement is for: it gives eddies back what solving took from them. It gives no more
//! than that: the pushes of a substep are shortened together until the energy that they add is no more than what the
//! substep lost before. So the energy of the liquid never rises by confinement, at any strength, in crowds and in shear.
//!
//! That bound on ε Δt holds where particles stand as far apart as the liquid's density has it. In a crowd that is pressed together ω, a
//! sum, is larger by as much as the crowd is denser, and so is the push. No push changes a speed by more than a tenth of
//! the longest move of a substep; one beyond it is cut to it, and counted.

use crate::{
    bins::{self, Group},
    element::ElementParams,
    params::GradientKernel,
    particles::Particles,
    pbf::Solver,
    predict::MOVE_RADII,
    simd::{Lanes, Pass},
    smoothing::{Gradient, Rational, Smoothing, Spiky},
    velocity::{StrengthReport, energy, viscosity::share_of},
};
use std::{
    marker::PhantomData,
    sync::atomic::{AtomicU64, Ordering},
};

/// Gradient of |ω| at which confinement is half in force, 1/(s d).
const STEADY: f32 = 1.0;

/// Largest ε Δt as a share of the kernel radius: the bound.
const MOST_GAIN: f32 = 0.07;

/// Largest change of a particle's speed, longest moves a substep.
const MOST_CHANGE: f32 = 0.1;

/// Applies vorticity confinement over `dt` s, with the ε of the elements, and adds no more than the energy `most` (as
/// [`energy()`](crate::velocity::energy()) counts it).
pub fn apply_vorticity(
    particles: &mut Particles,
    solver: &mut Solver,
    elements: &ElementParams,
    most: f64,
    threads: usize,
    dt: f32,
) -> StrengthReport {
    let strengths = &elements.vorticity[..];
    let mut report = StrengthReport::of(&particles.element, strengths, most_strength(solver, dt));
    report.clamps += match solver.smoothing.gradient {
        GradientKernel::Spiky => confine::<Spiky>(particles, solver, strengths, threads, dt),
        GradientKernel::Rational => confine::<Rational>(particles, solver, strengths, threads, dt),
    };
    let Solver { next_x, next_y, instructions, .. } = solver;
    let before = [&particles.vx[..], &particles.vy];
    let changed = energy::change(particles, elements, before, [next_x, next_y], *instructions);
    let share = share_within(changed, most) as f32;
    if share < 1.0 {
        for (before, after) in [(&particles.vx, &mut *next_x), (&particles.vy, &mut *next_y)] {
            after.iter_mut().zip(before).for_each(|(after, before)| *after = before + share * (*after - before));
        }
    }
    std::mem::swap(&mut particles.vx, next_x);
    std::mem::swap(&mut particles.vy, next_y);
    report
}

/// Largest share s ≤ 1 of a change for which `s first + s² second` is at most `most`; `second` is not below 0.
fn share_within([first, second]: [f64; 2], most: f64) -> f64 {
    let most = most.max(0.0);
    if first + second <= most {
        return 1.0;
    }
    // The larger root of s² second + s first = most. Where `first` is above 0, the form that loses no digits.
    let root = (first * first + 4.0 * second * most).sqrt();
    let share = if first > 0.0 { 2.0 * most / (first + root) } else { (root - first) / (2.0 * second) };
    share.clamp(0.0, 1.0)
}

/// Largest ε, d/s.
fn most_strength(solver: &Solver, dt: f32) -> f32 {
    MOST_GAIN * solver.smoothing.radius / dt
}

/// Leaves the velocities after confinement in the solver's `next` arrays; counts the particles whose push was cut.
fn confine<G: Gradient>(particles: &Particles, solver: &mut Solver, strengths: &[f32], threads: usize, dt: f32) -> u64 {
    let most = most_strength(solver, dt);
    let most_change = MOST_CHANGE * MOVE_RADII * solver.smoothing.radius / dt;
    let cuts = AtomicU64::new(0);
    // ω lives in the array of λ, which is free between two solves.
    let Solver { bins, smoothing, instructions, next_x, next_y, lambda: vorticity, .. } = solver;
    bins::split(bins.groups(), [&mut vorticity[..]], threads, &|groups, base, [out]| {
        let gradient = PhantomData::<G>;
        instructions.run(CurlPass { smoothing, particles, groups, base, out, gradient });
    });
    let outputs = [&mut next_x[..], &mut next_y[..]];
    bins::split(bins.groups(), outputs, threads, &|groups, base, out| {
        let gradient = PhantomData::<G>;
        let mut own_cuts = 0;
        instructions.run(ConfinementPass {
            smoothing,
            particles,
            vorticity,
            strengths,
            most,
            most_change,
            groups,
            base,
            out,
            cuts: &mut own_cuts,
            dt,
            gradient,
        });
        cuts.fetch_add(own_cuts, Ordering::Relaxed);
    });
    cuts.into_inner()
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
            let Particles { x, y, vx, vy, .. } = self.particles;
            for run in group.movable {
                let run = run.range();
                let places = x[run.clone()].iter().zip(&y[run.clone()]);
                for (((xj, yj), vxj), vyj) in places.zip(&vx[run.clone()]).zip(&vy[run]) {
                    let (dx, dy) = (xi - L::splat(*xj), yi - L::splat(*yj));
                    let (dvx, dvy) = (L::splat(*vxj) - vxi, L::splat(*vyj) - vyi);
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
    /// Largest strength.
    most: f32,
    /// Largest change of speed, d/s.
    most_change: f32,
    groups: &'a [Group],
    base: usize,
    /// Out: velocities, d/s.
    out: [&'a mut [f32]; 2],
    /// Out: particles whose change was cut.
    cuts: &'a mut u64,
    dt: f32,
    gradient: PhantomData<G>,
}

impl<G: Gradient> Pass for ConfinementPass<'_, G> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (h, zero) = (L::splat(self.smoothing.radius), L::splat(0.0));
        let (h2, core, scale) = (h * h, L::splat(self.smoothing.core), L::splat(-self.smoothing.gradient_scale));
        let (most, least, one) = (L::splat(self.most_change), L::splat(f32::MIN_POSITIVE), L::splat(1.0));
        let [out_x, out_y] = self.out;
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.particles.x[own.start..]), L::load(&self.particles.y[own.start..]));
            let curl = L::load(&self.vorticity[own.start..]);
            let strength = curl.max(zero - curl);
            let (mut slope_x, mut slope_y) = (zero, zero);
            let Particles { x, y, .. } = self.particles;
            for run in group.movable {
                let run = run.range();
                let places = x[run.clone()].iter().zip(&y[run.clone()]);
                for ((xj, yj), curl_j) in places.zip(&self.vorticity[run]) {
                    let (dx, dy) = (xi - L::splat(*xj), yi - L::splat(*yj));
                    let r2 = dx * dx + dy * dy;
                    let w = (h2 - r2).max(zero);
                    let rise = L::splat(curl_j.abs()) - strength;
                    let g = G::weight(h, core, r2, w * w) * rise;
                    (slope_x, slope_y) = (slope_x + g * dx, slope_y + g * dy);
                }
            }
            let (slope_x, slope_y) = (slope_x * scale, slope_y * scale);
            let length = (slope_x * slope_x + slope_y * slope_y).sqrt() + L::splat(STEADY);
            // N × ω ẑ = (N_y ω, −N_x ω)
            let elements = &self.particles.element[own.clone()];
            let push = L::load(&share_of(self.strengths, self.most, elements, self.dt)) * curl / length;
            let (vx, vy) = (L::load(&self.particles.vx[own.start..]), L::load(&self.particles.vy[own.start..]));
            let out = own.start - self.base..own.end - self.base;
            let (change_x, change_y) = (slope_y * push, slope_x * push);
            let size = (change_x * change_x + change_y * change_y).sqrt();
            let kept = (most / size.max(least)).min(one);
            let mut shares = [1.0; 16];
            kept.store(&mut shares[..own.len()]);
            *self.cuts += shares.iter().filter(|kept| **kept < 1.0).count() as u64;
            (vx + change_x * kept).store(&mut out_x[out.clone()]);
            (vy - change_y * kept).store(&mut out_y[out]);
        }
    }
}
