//! A pass over all of some matter, group by group.

use super::{
    matter::{LEAST_DENSITY, Matter, share_of},
    walls::Walls,
};
use crate::{
    bins::{self, Group},
    element::ElementId,
    parallel::Team,
    simd::{Lanes, Pass},
    smoothing::Smoothing,
};

/// What two that have no viscosity share of their difference, so that nothing is divided by 0: far below the share of any that have,
/// far above denormals (which cost a hundred times the time), even when the mass of a gas multiplies it.
const LEAST_SHARE: f32 = 1.0e-20;

/// What is the same in all passes of a substep.
pub(super) struct Setting<'a> {
    pub smoothing: &'a Smoothing,
    pub coefficients: &'a [f32],
    /// Walls, if anything sticks to them.
    pub walls: Option<Walls<'a>>,
    /// Largest coefficient.
    pub most: f32,
    /// Part of a tick that a pass does.
    pub part: f32,
    /// How many passes there are.
    pub passes: f32,
    pub team: Team,
}

impl Setting<'_> {
    /// Writes the velocities (d/s) after a pass to `out`.
    pub fn pass(&self, matter: Matter, groups: &[Group], once: Once, [out_x, out_y]: [&mut [f32]; 2]) {
        bins::split(groups, [out_x, out_y], self.team.threads, &|groups, base, out| {
            let pass = ViscosityPass::<false, false, false> { setting: self, matter, once, groups, base, out };
            let instructions = self.team.instructions;
            match (matter.masses.is_empty(), self.walls.is_some(), self.passes > 1.0) {
                (true, false, _) => instructions.run(pass),
                (true, true, _) => instructions.run(pass.with::<false, true, false>()),
                (false, false, false) => instructions.run(pass.with::<true, false, false>()),
                (false, true, false) => instructions.run(pass.with::<true, true, false>()),
                (false, false, true) => instructions.run(pass.with::<true, false, true>()),
                (false, true, true) => instructions.run(pass.with::<true, true, true>()),
            }
        });
    }
}

/// What takes only one of several passes, and how much of it this one does.
#[derive(Clone, Copy)]
pub(super) struct Once {
    /// Largest coefficient that one pass can do.
    pub most: f32,
    /// How many times what an equal part would do: as many as there are passes in the first, and 0 in the others.
    pub times: f32,
}

impl Once {
    /// Whether particles of a coefficient take all passes, with others that do.
    pub fn is_beyond(self, coefficient: f32) -> bool {
        // A mean is at most twice the smaller of both.
        coefficient > 0.5 * self.most
    }

    /// How many times an equal part of the passes a particle of a coefficient takes of a wall.
    pub fn times_of(self, coefficient: f32) -> f32 {
        if self.is_beyond(coefficient) { 1.0 } else { self.times }
    }
}

/// A pass over groups: where masses differ, where something sticks to walls, and where some take one of several passes.
struct ViscosityPass<'a, const MASSES: bool, const STICKS: bool, const ONCE: bool> {
    setting: &'a Setting<'a>,
    matter: Matter<'a>,
    once: Once,
    groups: &'a [Group],
    base: usize,
    /// Out: velocities, d/s.
    out: [&'a mut [f32]; 2],
}

impl<'a> ViscosityPass<'a, false, false, false> {
    /// The same for other matter.
    fn with<const MASSES: bool, const STICKS: bool, const ONCE: bool>(self) -> ViscosityPass<'a, MASSES, STICKS, ONCE> {
        let Self { setting, matter, once, groups, base, out } = self;
        ViscosityPass { setting, matter, once, groups, base, out }
    }
}

impl<const MASSES: bool, const STICKS: bool, const ONCE: bool> Pass for ViscosityPass<'_, MASSES, STICKS, ONCE> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { setting, matter, once, groups, base, out: [out_x, out_y] } = self;
        let Setting { smoothing, coefficients, ref walls, most, part, .. } = *setting;
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let h2 = L::splat(smoothing.radius * smoothing.radius);
        for group in groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&matter.x[own.start..]), L::load(&matter.y[own.start..]));
            let (vxi, vyi) = (L::load(&matter.vx[own.start..]), L::load(&matter.vy[own.start..]));
            let scale = smoothing.density_scale * part;
            let elements = &matter.element[own.clone()];
            let out = own.start - base..own.end - base;
            let takes_all = |element: &ElementId| once.is_beyond(coefficients[element.index()]);
            if ONCE && once.times == 0.0 && !elements.iter().any(takes_all) {
                out_x[out.clone()].copy_from_slice(&matter.vx[own.clone()]);
                out_y[out].copy_from_slice(&matter.vy[own]);
                continue;
            }
            let share = share_of(coefficients, most, elements, scale);
            let walls = walls.as_ref().filter(|_| STICKS);
            let held = walls.map_or(zero, |walls| walls.densities::<L>(elements, &matter.density[own.clone()]));
            let share = L::load(&share);
            let (once_most, once_times) = (L::splat(0.5 * once.most * scale), L::splat(once.times));
            let mass_i = if MASSES { L::load(&matter.masses[own.start..]) } else { zero };
            let (mut sum_x, mut sum_y) = (zero, zero);
            macro_rules! add {
                ($neighbours:expr) => {
                    for (((((xj, yj), vxj), vyj), size), (mass, (other, load))) in $neighbours {
                        let (dx, dy) = (xi - L::splat(*xj), yi - L::splat(*yj));
                        let w = (h2 - (dx * dx + dy * dy)).max(zero);
                        let mut weight = w * w * w;
                        // The volume of a pair is one over this density; that of a particle is known.
                        let density = if STICKS { L::splat(size.max(LEAST_DENSITY)).max(held) } else { zero };
                        if MASSES {
                            // Of a pair, each takes on what the other gives off.
                            let (mass, other): (&f32, &f32) = (mass, other);
                            let other = L::splat(*other);
                            let sum = (share + other).max(L::splat(LEAST_SHARE));
                            let both = sum * (mass_i + L::splat(*mass));
                            let per = L::splat(*load) / if STICKS { both * density } else { both };
                            weight = weight * if STICKS { per } else { per * L::splat(*size) };
                            if ONCE {
                                // Both of a pair find the same, for neither comes first in these.
                                let (mean, most) = (share * other, once_most * sum);
                                weight = weight * most.if_less(mean, one, once_times);
                            }
                        } else {
                            weight = if STICKS { weight / density } else { weight * L::splat(*size) };
                        }
                        sum_x = sum_x + weight * (L::splat(*vxj) - vxi);
                        sum_y = sum_y + weight * (L::splat(*vyj) - vyi);
                    }
                };
            }
            let Matter { x, y, vx, vy, .. } = matter;
            let sizes = if STICKS { matter.density } else { matter.volumes };
            for run in group.movable {
                let run = run.range();
                let places = x[run.clone()].iter().zip(&y[run.clone()]);
                let moving = places.zip(&vx[run.clone()]).zip(&vy[run.clone()]).zip(&sizes[run.clone()]);
                if MASSES {
                    let pairs = matter.shares[run.clone()].iter().zip(&matter.loads[run.clone()]);
                    add!(moving.zip(matter.masses[run].iter().zip(pairs)));
                } else {
                    add!(moving.map(|of| (of, (&0.0, (&0.0, &0.0)))));
                }
            }
            let (mut vx, mut vy) = (vxi + share * sum_x, vyi + share * sum_y);
            if let Some(walls) = walls.filter(|walls| walls.hold(group, elements)) {
                let times = |element: ElementId| match ONCE {
                    true => once.times_of(coefficients[element.index()]),
                    false => 1.0,
                };
                let kept = walls.kept::<L>(&matter, group, (most, part), times);
                (vx, vy) = (vx * kept, vy * kept);
            }
            vx.store(&mut out_x[out.clone()]);
            vy.store(&mut out_y[out]);
        }
    }
}
