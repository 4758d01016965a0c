//! XSPH viscosity: `v_i += c Σ (m/ρ_j) (v_j − v_i) W` (Macklin & Müller 2013, eq. 17, with the volume m/ρ_j that makes
//! the sum an average).
//!
//! c is the share of a tick: a substep takes its part `c Δt/tick`, so that a liquid is as thick at many substeps as at one.
//! The kinematic viscosity is `c h²/20` a tick (`∫ y² W = h²/10` for poly6).
//!
//! **The bound.** With the positive weights `w_j = c m/ρ_j W` a new velocity is `(1 − Σ w_j) v_i + Σ w_j v_j`. While
//! `Σ w_j ≤ 1` it is an average of old ones, so no speed can rise; differences shrink up to `Σ w_j ≤ 2` and grow past it.
//! As `Σ m/ρ_j W ≈ 1`, the bound is **`c Δt/tick ≤ 1`**. A coefficient beyond it is cut to it, and counted.

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

/// Largest share of its difference to its neighbours that a particle may give up in a substep: the bound.
const MOST_SHARE: f32 = 1.0;

/// Applies viscosity over `dt` s; c is the elements'.
pub fn apply_viscosity(
    particles: &mut Particles,
    solver: &mut Solver,
    elements: &ElementParams,
    threads: usize,
    dt: f32,
) -> StrengthReport {
    let coefficients = &elements.viscosity[..];
    // One substep a tick takes exactly c.
    let part = dt / TICK_SECONDS;
    let most = MOST_SHARE / part;
    let report = StrengthReport::of(&particles.element, coefficients, most);
    let Solver { bins, smoothing, instructions, density, next_x, next_y, .. } = solver;
    let read = &*particles;
    bins::split(bins.groups(), [&mut next_x[..], &mut next_y[..]], threads, &|groups, base, out| {
        instructions.run(ViscosityPass {
            smoothing,
            particles: read,
            density,
            coefficients,
            most,
            part,
            groups,
            base,
            out,
        });
    });
    std::mem::swap(&mut particles.vx, next_x);
    std::mem::swap(&mut particles.vy, next_y);
    report
}

struct ViscosityPass<'a> {
    smoothing: &'a Smoothing,
    particles: &'a Particles,
    density: &'a [f32],
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

impl Pass for ViscosityPass<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let zero = L::splat(0.0);
        let h2 = L::splat(self.smoothing.radius * self.smoothing.radius);
        let [out_x, out_y] = self.out;
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.particles.x[own.start..]), L::load(&self.particles.y[own.start..]));
            let (vxi, vyi) = (L::load(&self.particles.vx[own.start..]), L::load(&self.particles.vy[own.start..]));
            let (mut sum_x, mut sum_y) = (zero, zero);
            for run in group.movable {
                for j in run.range() {
                    let (dx, dy) = (xi - L::splat(self.particles.x[j]), yi - L::splat(self.particles.y[j]));
                    let w = (h2 - (dx * dx + dy * dy)).max(zero);
                    let volume = 1.0 / self.density[j].max(LEAST_DENSITY);
                    let weight = w * w * w * L::splat(volume);
                    sum_x = sum_x + weight * (L::splat(self.particles.vx[j]) - vxi);
                    sum_y = sum_y + weight * (L::splat(self.particles.vy[j]) - vyi);
                }
            }
            let scale = self.smoothing.density_scale * self.part;
            let share = share_of(self.coefficients, self.most, &self.particles.element[own.clone()], scale);
            let share = L::load(&share);
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
