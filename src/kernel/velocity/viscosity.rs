//! XSPH viscosity: `v_i += c Σ (m/ρ_j) (v_j − v_i) W` (Macklin & Müller 2013, eq. 17, with the volume m/ρ_j that makes
//! the sum an average).
//!
//! c is the share of a tick: a substep takes its part `c Δt/tick`, so that a liquid is as thick at many substeps as at one.
//! The kinematic viscosity is `c h²/20` a tick (`∫ y² W = h²/10` for poly6).
//!
//! **The bound.** With the positive weights `w_j = c m/ρ_j W` a new velocity is `(1 − Σ w_j) v_i + Σ w_j v_j`. While
//! `Σ w_j ≤ 1` it is an average of old ones, so no speed can rise; differences shrink up to `Σ w_j ≤ 2` and grow past it.
//! As `Σ m/ρ_j W ≈ 1`, the bound is **`c Δt/tick ≤ 1`**. What is more viscous takes as many passes as that asks for, each with
//! its part of c, 16 at most: a coefficient beyond is cut to what they can do, and counted.
//!
//! Between particles of different masses m each weight is `2 m_j/(m_i + m_j)` times as much, and of two coefficients that of a
//! pair is their harmonic mean (Morris, Fox & Zhu 1997, "Modeling low Reynolds number incompressible flows using SPH": the
//! stress is the same on both sides of a surface), so that one of a pair takes on the momentum that the other gives off. The
//! first is up to 2, and the bound half as much.

use crate::{
    bins::{self, Group},
    element::{ElementId, ElementParams},
    particles::Particles,
    pbf::Solver,
    simd::{Lanes, Pass},
    smoothing::Smoothing,
    units::TICK_SECONDS,
    velocity::StrengthReport,
};

/// Lowest density that a volume is taken from: a lone droplet's own kernel gives about a seventh.
const LEAST_DENSITY: f32 = 0.1;

/// Largest share of its difference to its neighbours that a particle may give up in a pass: the bound.
const MOST_SHARE: f32 = 1.0;

/// Most passes of a substep. What asks for more is as viscous as that leaves it, and counted.
const MOST_PASSES: f32 = 16.0;

/// Applies viscosity over `dt` s; c is the elements'.
pub fn apply_viscosity(
    particles: &mut Particles,
    solver: &mut Solver,
    elements: &ElementParams,
    threads: usize,
    dt: f32,
) -> StrengthReport {
    let coefficients = &elements.viscosity[..];
    let part = dt / TICK_SECONDS;
    let most = if solver.masses.is_empty() { MOST_SHARE } else { 0.5 * MOST_SHARE } / part;
    let report = StrengthReport::of(&particles.element, coefficients, most * MOST_PASSES);
    let passes = (strongest(&particles.element, coefficients, most) / most).ceil().clamp(1.0, MOST_PASSES);
    let Solver { bins, smoothing, instructions, density, masses, next_x, next_y, .. } = solver;
    for _ in 0..passes as u32 {
        let read = &*particles;
        bins::split(bins.groups(), [&mut next_x[..], &mut next_y[..]], threads, &|groups, base, out| {
            let pass = ViscosityPass::<false> {
                smoothing,
                particles: read,
                density,
                masses,
                coefficients,
                most: most * passes,
                part: part / passes,
                groups,
                base,
                out,
            };
            match masses.is_empty() {
                true => instructions.run(pass),
                false => instructions.run(pass.between_masses()),
            }
        });
        std::mem::swap(&mut particles.vx, next_x);
        std::mem::swap(&mut particles.vy, next_y);
    }
    report
}

/// The largest coefficient of the particles' elements, if any is above `most`; else 0.
fn strongest(particles: &[ElementId], coefficients: &[f32], most: f32) -> f32 {
    if coefficients.iter().all(|coefficient| *coefficient <= most) {
        return 0.0;
    }
    particles.iter().map(|element| coefficients[element.index()]).fold(0.0, f32::max)
}

struct ViscosityPass<'a, const MASSES: bool> {
    smoothing: &'a Smoothing,
    particles: &'a Particles,
    density: &'a [f32],
    /// Masses as shares of the heaviest; not read without `MASSES`.
    masses: &'a [f32],
    coefficients: &'a [f32],
    /// Largest coefficient.
    most: f32,
    /// Part of a tick that passes.
    part: f32,
    groups: &'a [Group],
    base: usize,
    /// Out: velocities, d/s.
    out: [&'a mut [f32]; 2],
}

impl<'a> ViscosityPass<'a, false> {
    /// The same where masses differ.
    fn between_masses(self) -> ViscosityPass<'a, true> {
        let Self { smoothing, particles, density, masses, coefficients, most, part, groups, base, out } = self;
        ViscosityPass { smoothing, particles, density, masses, coefficients, most, part, groups, base, out }
    }
}

impl<const MASSES: bool> Pass for ViscosityPass<'_, MASSES> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let zero = L::splat(0.0);
        let h2 = L::splat(self.smoothing.radius * self.smoothing.radius);
        let [out_x, out_y] = self.out;
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.particles.x[own.start..]), L::load(&self.particles.y[own.start..]));
            let (vxi, vyi) = (L::load(&self.particles.vx[own.start..]), L::load(&self.particles.vy[own.start..]));
            let scale = self.smoothing.density_scale * self.part;
            let share = share_of(self.coefficients, self.most, &self.particles.element[own.clone()], scale);
            let share = L::load(&share);
            let mass_i = if MASSES { L::load(&self.masses[own.start..]) } else { zero };
            let (mut sum_x, mut sum_y) = (zero, zero);
            for run in group.movable {
                for j in run.range() {
                    let (dx, dy) = (xi - L::splat(self.particles.x[j]), yi - L::splat(self.particles.y[j]));
                    let w = (h2 - (dx * dx + dy * dy)).max(zero);
                    let volume = 1.0 / self.density[j].max(LEAST_DENSITY);
                    let mut weight = w * w * w * L::splat(volume);
                    if MASSES {
                        // Of a pair, each takes on what the other gives off.
                        let mass = L::splat(self.masses[j]);
                        let coefficient = self.coefficients[self.particles.element[j].index()].min(self.most);
                        let other = L::splat(coefficient * scale);
                        let mean = (other + other) / (share + other).max(L::splat(f32::MIN_POSITIVE));
                        weight = weight * mean * ((mass + mass) / (mass_i + mass));
                    }
                    sum_x = sum_x + weight * (L::splat(self.particles.vx[j]) - vxi);
                    sum_y = sum_y + weight * (L::splat(self.particles.vy[j]) - vyi);
                }
            }
            let out = own.start - self.base..own.end - self.base;
            (vxi + share * sum_x).store(&mut out_x[out.clone()]);
            (vyi + share * sum_y).store(&mut out_y[out]);
        }
    }
}

/// `scale · coefficient` of each particle's element, in lanes; a coefficient counts for `most` at most.
#[inline(always)]
pub(super) fn share_of(coefficients: &[f32], most: f32, elements: &[ElementId], scale: f32) -> [f32; 16] {
    let mut lanes = [0.0; 16];
    for (lane, element) in lanes.iter_mut().zip(elements) {
        let coefficient = coefficients[element.index()];
        *lane = if coefficient < most { coefficient } else { most } * scale;
    }
    lanes
}
