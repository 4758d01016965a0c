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
pub(super) struct ConstraintPass<'a, G> {
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
}

impl<G: Gradient> Pass for ConstraintPass<'_, G> {
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
            let mut sums = Sums { density: zero, gradient: [zero; 2], others: zero };
            macro_rules! add {
                ($xs:expr, $ys:expr, $movable:expr) => {
                    for (&xj, &yj) in $xs.iter().zip($ys) {
                        let (dx, dy) = (xi - L::splat(xj), yi - L::splat(yj));
                        let r2 = dx * dx + dy * dy;
                        let w = (h2 - r2).max(zero);
                        let w2 = w * w;
                        sums.density = sums.density + w2 * w;
                        let g = G::weight(h, core, r2, w2);
                        let (gx, gy) = (g * dx, g * dy);
                        sums.gradient = [sums.gradient[0] + gx, sums.gradient[1] + gy];
                        if $movable {
                            sums.others = sums.others + g * g * r2;
                        }
                    }
                };
            }
            for run in group.movable {
                add!(self.x[run.range()], &self.y[run.range()], true);
            }
            for run in group.rock {
                add!(self.rock.x[run.range()], &self.rock.y[run.range()], false);
            }
            let mut density = sums.density * density_scale;
            let [mut gx, mut gy] = sums.gradient;
            if group.near_wall {
                self.add_walls(own.clone(), [&mut density, &mut gx, &mut gy]);
            }
            let constraint = (density * per_rest - L::splat(1.0)).max(floor);
            let slope = (sums.others + (gx * gx + gy * gy)) * gradient_scale2;
            let lambda = (zero - constraint) / (slope + relaxation);
            let out = own.start - self.base..own.end - self.base;
            group.choose(density, || L::load(&self.density[out.clone()])).store(&mut self.density[out.clone()]);
            group.choose(lambda, || L::load(&self.lambda[out.clone()])).store(&mut self.lambda[out]);
        }
    }
}

impl<G> ConstraintPass<'_, G> {
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
