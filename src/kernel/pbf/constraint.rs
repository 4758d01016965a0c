//! The pass for λ.

use crate::{
    bins::{Group, RockBins},
    params::{Domain, FluidParams},
    pbf::walls::wall_sums,
    simd::{Lanes, MOST_LANES, Pass},
    smoothing::{Gradient, Smoothing},
};
use glam::Vec2;
use std::marker::PhantomData;

/// Finds density and λ of the particles of `groups`.
pub(super) struct ConstraintPass<'a, G, const MASSES: bool> {
    pub smoothing: &'a Smoothing,
    pub domain: &'a Domain,
    pub fluid: &'a FluidParams,
    /// Density that is aimed at, 1 on the lattice.
    pub rest_density: f32,
    /// ε, 1/d².
    pub relaxation: f32,
    /// Positions, d.
    pub x: &'a [f32],
    pub y: &'a [f32],
    /// Masses, as shares of the heaviest; not read without `MASSES`.
    pub masses: &'a [f32],
    pub rock: &'a RockBins,
    pub groups: &'a [Group],
    /// Particle that the outputs begin with.
    pub base: usize,
    /// Out: λ, d². What the groups leave out keeps its own.
    pub lambda: &'a mut [f32],
    /// Out: density, 1 on the lattice, likewise.
    pub density: &'a mut [f32],
    pub gradient: PhantomData<G>,
}

/// Sums over neighbours, before scaling.
struct Sums<L> {
    /// Σ (h² − r²)³
    density: L,
    /// Σ g (x_i − x_j)
    gradient: [L; 2],
    /// Σ g² r² over movable neighbours: their own gradients of C_i.
    others: L,
    /// The same, each times its inverse mass.
    light: L,
}

/// Squared slope that stands in for that of a particle without neighbours, 1/d², so that its mean inverse mass is its own.
const LEAST_SLOPE: f32 = 1e-6;

impl<G: Gradient, const MASSES: bool> Pass for ConstraintPass<'_, G, MASSES> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (h, zero) = (L::splat(self.smoothing.radius), L::splat(0.0));
        let (h2, core) = (h * h, L::splat(self.smoothing.core));
        let density_scale = L::splat(self.smoothing.density_scale);
        let gradient_scale = self.smoothing.gradient_scale / self.rest_density;
        let (gradient_scale2, relaxation) = (L::splat(gradient_scale * gradient_scale), L::splat(self.relaxation));
        let (per_rest, floor) = (L::splat(1.0 / self.rest_density), L::splat(self.fluid.constraint_floor));
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.x[own.start..]), L::load(&self.y[own.start..]));
            let mut sums = Sums { density: zero, gradient: [zero; 2], others: zero, light: zero };
            macro_rules! add {
                ($neighbours:expr, $movable:expr) => {
                    for (xj, yj, mass) in $neighbours {
                        let (dx, dy) = (xi - L::splat(xj), yi - L::splat(yj));
                        let r2 = dx * dx + dy * dy;
                        let w = (h2 - r2).max(zero);
                        let w2 = w * w;
                        sums.density = sums.density + w2 * w;
                        let g = G::weight(h, core, r2, w2);
                        let (gx, gy) = (g * dx, g * dy);
                        sums.gradient = [sums.gradient[0] + gx, sums.gradient[1] + gy];
                        if $movable {
                            let own = g * g * r2;
                            sums.others = sums.others + own;
                            if MASSES {
                                sums.light = sums.light + own * L::splat(1.0 / mass);
                            }
                        }
                    }
                };
            }
            for run in group.movable {
                let run = run.range();
                let places = self.x[run.clone()].iter().zip(&self.y[run.clone()]);
                if MASSES {
                    add!(places.zip(&self.masses[run]).map(|((x, y), mass)| (*x, *y, *mass)), true);
                } else {
                    add!(places.map(|(x, y)| (*x, *y, 1.0_f32)), true);
                }
            }
            for run in self.rock.around(group) {
                let places = self.rock.x[run.range()].iter().zip(&self.rock.y[run.range()]);
                add!(places.map(|(x, y)| (*x, *y, 1.0_f32)), false);
            }
            let mut density = sums.density * density_scale;
            let [mut gx, mut gy] = sums.gradient;
            if group.near_wall {
                self.add_walls(own.clone(), [&mut density, &mut gx, &mut gy]);
            }
            let constraint = (density * per_rest - L::splat(1.0)).max(floor);
            let all = gx * gx + gy * gy;
            let slope = (sums.others + all) * gradient_scale2;
            let per_constraint = if MASSES {
                // Each particle moves by its inverse mass (Solenthaler & Pajarola 2008, §3, for the number density); what is
                // relaxed is so by the mean of them.
                let inverse = L::splat(1.0) / L::load(&self.masses[own.start..]);
                let weighted = (sums.light + inverse * all) * gradient_scale2;
                let least = L::splat(LEAST_SLOPE);
                weighted + relaxation * ((weighted + least * inverse) / (slope + least))
            } else {
                slope + relaxation
            };
            let lambda = (zero - constraint) / per_constraint;
            let out = own.start - self.base..own.end - self.base;
            group.choose(density, || L::load(&self.density[out.clone()])).store(&mut self.density[out.clone()]);
            group.choose(lambda, || L::load(&self.lambda[out.clone()])).store(&mut self.lambda[out]);
        }
    }
}

impl<G, const MASSES: bool> ConstraintPass<'_, G, MASSES> {
    /// Adds density and gradient of the box walls, particle by particle: few are near one.
    #[inline(always)]
    fn add_walls<L: Lanes>(&self, own: std::ops::Range<usize>, sums: [&mut L; 3]) {
        let mut lanes = [[0.0_f32; MOST_LANES]; 3];
        for (lane, sum) in lanes.iter_mut().zip(&sums) {
            sum.store(&mut lane[..L::WIDTH]);
        }
        for (lane, i) in own.enumerate() {
            let (density, push) = wall_sums(self.smoothing, self.domain, Vec2::new(self.x[i], self.y[i]));
            lanes[0][lane] += density;
            lanes[1][lane] += push.x;
            lanes[2][lane] += push.y;
        }
        for (lane, sum) in lanes.iter().zip(sums) {
            *sum = L::load(lane);
        }
    }
}
