//! The pass for Δx.

use crate::{
    bins::{Group, RockBins},
    params::{Domain, FluidParams, WALL_GAP},
    pbf::{limit::CorrectionLimit, walls::wall_sums},
    simd::{Lanes, MOST_LANES, Pass},
    smoothing::{Gradient, Smoothing},
};
use glam::Vec2;
use std::marker::PhantomData;

/// Pairs nearer than this are set apart, d.
const APART_WITHIN: f32 = 0.8;
/// Share of their distance by which the closest are set apart in an iteration.
const APART_SHARE: f32 = 0.5;

/// Moves the particles of `groups` by Δx, within the correction limit of their anchors and within the box.
pub(super) struct CorrectionPass<'a, G, const TENSION: bool, const APART: bool, const MASSES: bool> {
    pub smoothing: &'a Smoothing,
    pub domain: &'a Domain,
    pub fluid: &'a FluidParams,
    /// Density that is aimed at, 1 on the lattice.
    pub rest_density: f32,
    /// Furthest from the anchor.
    pub limit: CorrectionLimit,
    /// Density, 1 on the lattice.
    pub density: &'a [f32],
    /// Positions, d.
    pub x: &'a [f32],
    pub y: &'a [f32],
    /// Masses, as shares of the heaviest; not read without `MASSES`.
    pub masses: &'a [f32],
    /// Predicted positions, d.
    pub anchor: [&'a [f32]; 2],
    /// λ, d².
    pub lambda: &'a [f32],
    pub rock: &'a RockBins,
    pub groups: &'a [Group],
    /// Particle that the outputs begin with.
    pub base: usize,
    /// Out: corrected positions, d.
    pub next: [&'a mut [f32]; 2],
    pub gradient: PhantomData<G>,
}

impl<G: Gradient, const TENSION: bool, const APART: bool, const MASSES: bool> Pass
    for CorrectionPass<'_, G, TENSION, APART, MASSES>
{
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let h_value = self.smoothing.radius;
        let (h, zero) = (L::splat(h_value), L::splat(0.0));
        let (h2, core) = (h * h, L::splat(self.smoothing.core));
        // s_corr = −k (W(r)/W(Δq))⁴ = −k ((h² − r²)/(h² − Δq²))¹²
        let strength = L::splat(self.fluid.tension_strength);
        let distance = self.fluid.tension_distance * h_value;
        let per_reference = L::splat(1.0 / (h_value * h_value - distance * distance));
        let scale = L::splat(-self.smoothing.gradient_scale / self.rest_density);
        // The sums are scaled by `scale` in the end; what sets apart is a length already.
        let per_apart = L::splat(1.0 / (APART_WITHIN * APART_WITHIN));
        let apart = L::splat(-APART_SHARE * self.rest_density / self.smoothing.gradient_scale);
        let (low, high) = (L::splat(WALL_GAP), self.domain.highest());
        let [next_x, next_y] = self.next;
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.x[own.start..]), L::load(&self.y[own.start..]));
            let lambda_i = L::load(&self.lambda[own.start..]);
            let both = lambda_i + lambda_i;
            let (mut sum_x, mut sum_y) = (zero, zero);
            let mass_i = if MASSES { L::load(&self.masses[own.start..]) } else { zero };
            macro_rules! add {
                ($neighbours:expr) => {
                    for (xj, yj, lambda_j, mass_j) in $neighbours {
                        let (dx, dy) = (xi - L::splat(xj), yi - L::splat(yj));
                        let r2 = dx * dx + dy * dy;
                        let w = (h2 - r2).max(zero);
                        let mut pressure = lambda_i + L::splat(lambda_j);
                        // What sets a pair apart, whatever its density, does so by lengths: the lighter goes them.
                        let lighter = if MASSES { mass_i.min(L::splat(mass_j)) } else { zero };
                        if TENSION {
                            let u = w * per_reference;
                            let u2 = u * u;
                            let u4 = u2 * u2;
                            let tension = strength * (u4 * u4 * u4);
                            pressure = pressure - if MASSES { lighter * tension } else { tension };
                        }
                        let mut g = G::weight(h, core, r2, w * w) * pressure;
                        if APART {
                            let close = (L::splat(1.0) - r2 * per_apart).max(zero);
                            let close = close * apart;
                            g = g + if MASSES { lighter * close } else { close };
                        }
                        (sum_x, sum_y) = (sum_x + g * dx, sum_y + g * dy);
                    }
                };
            }
            for run in group.movable {
                let run = run.range();
                let near = self.x[run.clone()].iter().zip(&self.y[run.clone()]).zip(&self.lambda[run.clone()]);
                if MASSES {
                    add!(near.zip(&self.masses[run]).map(|(((x, y), lambda), mass)| (*x, *y, *lambda, *mass)));
                } else {
                    add!(near.map(|((x, y), lambda)| (*x, *y, *lambda, 0.0_f32)));
                }
            }
            for run in self.rock.around(group) {
                for (&xj, &yj) in self.rock.x[run.range()].iter().zip(&self.rock.y[run.range()]) {
                    let (dx, dy) = (xi - L::splat(xj), yi - L::splat(yj));
                    let r2 = dx * dx + dy * dy;
                    let w = (h2 - r2).max(zero);
                    // Rock has no λ of its own: it mirrors the pressure of the particle that it pushes.
                    let g = G::weight(h, core, r2, w * w) * both;
                    (sum_x, sum_y) = (sum_x + g * dx, sum_y + g * dy);
                }
            }
            if group.near_wall {
                let (mut lanes_x, mut lanes_y) = ([0.0_f32; MOST_LANES], [0.0_f32; MOST_LANES]);
                for (lane, i) in own.clone().enumerate() {
                    let (_, push) = wall_sums(self.smoothing, self.domain, Vec2::new(self.x[i], self.y[i]));
                    (lanes_x[lane], lanes_y[lane]) = (push.x, push.y);
                }
                (sum_x, sum_y) = (sum_x + both * L::load(&lanes_x), sum_y + both * L::load(&lanes_y));
            }
            if MASSES {
                (sum_x, sum_y) = (sum_x / mass_i, sum_y / mass_i);
            }
            let anchor_x = L::load(&self.anchor[0][own.start..]);
            let anchor_y = L::load(&self.anchor[1][own.start..]);
            let out = own.start - self.base..own.end - self.base;
            let limit = self.limit.lanes(L::load(&self.density[own.start..]));
            let to_x = keep_near(xi + scale * sum_x, anchor_x, limit, [low, L::splat(high.x)]);
            let to_y = keep_near(yi + scale * sum_y, anchor_y, limit, [low, L::splat(high.y)]);
            group.choose(to_x, || xi).store(&mut next_x[out.clone()]);
            group.choose(to_y, || yi).store(&mut next_y[out]);
        }
    }
}

/// Keeps coordinates within `limit` of their anchors, and then within the box.
#[inline(always)]
fn keep_near<L: Lanes>(at: L, anchor: L, limit: L, [low, high]: [L; 2]) -> L {
    at.max(anchor - limit).min(anchor + limit).max(low).min(high)
}
