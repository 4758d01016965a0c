//! What walls, of the box and of rock, hold of what has a viscosity of its own.

use super::{
    grip::Grip,
    matter::{LEAST_DENSITY, Matter, share_of},
};
use crate::{
    bins::{Group, RockBins},
    element::ElementId,
    params::Domain,
    pbf::wall_sums,
    simd::{Lanes, MOST_LANES},
    smoothing::Smoothing,
};
use glam::Vec2;

/// What holds what sticks.
pub(super) struct Walls<'a> {
    pub smoothing: &'a Smoothing,
    pub domain: &'a Domain,
    pub rock: &'a RockBins,
    /// c of the elements' own viscosity.
    pub strengths: &'a [f32],
    pub grip: Grip,
}

impl Walls<'_> {
    /// Whether a group has anything to do with them.
    #[inline(always)]
    pub fn hold(&self, group: &Group, elements: &[ElementId]) -> bool {
        let is_near = group.near_wall || self.rock.around(group).iter().any(|run| !run.range().is_empty());
        is_near && elements.iter().any(|element| self.strengths[element.index()] > 0.0)
    }

    /// Densities of some particles below which their neighbours' do not count, in lanes; next to none of what does not stick.
    #[inline(always)]
    pub fn densities<L: Lanes>(&self, elements: &[ElementId], density: &[f32]) -> L {
        let mut least = [LEAST_DENSITY; MOST_LANES];
        for (least, (element, density)) in least.iter_mut().zip(elements.iter().zip(density)) {
            *least = if self.strengths[element.index()] > 0.0 { least.max(*density) } else { *least };
        }
        L::load(&least)
    }

    /// What the particles of a group keep of their velocities beside them in a part of a tick, in lanes. Strengths count
    /// for `most` at most, and that of each particle `times` as much.
    #[inline(always)]
    pub fn kept<L: Lanes>(
        &self,
        matter: &Matter,
        group: &Group,
        (most, part): (f32, f32),
        times: impl Fn(ElementId) -> f32,
    ) -> L {
        let (own, smoothing) = (group.particles(), self.smoothing);
        let (xi, yi) = (L::load(&matter.x[own.start..]), L::load(&matter.y[own.start..]));
        let (zero, h2) = (L::splat(0.0), L::splat(smoothing.radius * smoothing.radius));
        let mut sum = zero;
        for run in self.rock.around(group) {
            for (&xj, &yj) in self.rock.x[run.range()].iter().zip(&self.rock.y[run.range()]) {
                let (dx, dy) = (xi - L::splat(xj), yi - L::splat(yj));
                let w = (h2 - (dx * dx + dy * dy)).max(zero);
                sum = sum + w * w * w;
            }
        }
        let mut reach = [0.0_f32; MOST_LANES];
        (sum * L::splat(smoothing.density_scale)).store(&mut reach);
        let share = share_of(self.strengths, most, &matter.element[own.clone()], part);
        let mut kept = [1.0; MOST_LANES];
        for (lane, i) in own.enumerate() {
            let at = Vec2::new(matter.x[i], matter.y[i]);
            let beyond = if group.near_wall { wall_sums(smoothing, self.domain, at).0 } else { 0.0 };
            let share = share[lane] * times(matter.element[i]);
            kept[lane] = 1.0 / (1.0 + share * self.grip.at(reach[lane] + beyond));
        }
        L::load(&kept)
    }
}
