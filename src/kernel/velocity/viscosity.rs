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
//! **Only where it is so viscous.** Where masses differ, a pair whose mean c is within the bound of one pass takes all of it in the first,
//! and only the others go on: beside a drop of honey a lake costs one pass. Each kind of pair is held to the same bound, and as the
//! weights of all neighbours add up to one, so is the sum of both.
//!
//! Between particles of different masses m each weight is `2 m_j/(m_i + m_j)` times as much, and of two coefficients that of a
//! pair is their harmonic mean (Morris, Fox & Zhu 1997, "Modeling low Reynolds number incompressible flows using SPH": the
//! stress is the same on both sides of a surface), so that one of a pair takes on the momentum that the other gives off. The
//! first is up to 2, and the bound half as much.
//!
//! **Surfaces.** The volumes m/ρ_j of a pair differ where the density does: at a surface, where it is 0.7, each row would drag
//! the one below more than that holds it, and a film of six rows run by a tenth too fast. What has a viscosity of its own takes the
//! smaller of both, so that one of a pair gets what the other gives, and the bound holds.
//!
//! **Walls**, of the box and of rock, hold what has a viscosity of its own: `v / (1 + c g)` with the weight g of the wall
//! ([`Grip`]), solved for the end of the pass, so that nothing is turned round by a wall however thick it is. c is that of the
//! element's viscosity alone. What only has a smoothing slips: that of water is of the particles' size and none of the liquid's,
//! whose layer at a wall would be a millimetre thick.

use crate::{
    bins::{self, Group, RockBins},
    element::{ElementId, ElementParams},
    params::Domain,
    particles::Particles,
    pbf::{Solver, wall_sums},
    simd::{Lanes, MOST_LANES, Pass},
    smoothing::Smoothing,
    units::TICK_SECONDS,
    velocity::{StrengthReport, grip::Grip},
};

/// Lowest density that a volume is taken from: a lone droplet's own kernel gives about a seventh.
const LEAST_DENSITY: f32 = 0.1;

/// Largest share of its difference to its neighbours that a particle may give up in a pass: the bound.
const MOST_SHARE: f32 = 1.0;

/// Most passes of a substep. What asks for more is as viscous as that leaves it, and counted.
const MOST_PASSES: f32 = 16.0;

/// Applies viscosity over `dt` s between particles, and between them and the walls of the box and rock; c is the elements'.
pub fn apply_viscosity(
    particles: &mut Particles,
    solver: &mut Solver,
    domain: &Domain,
    elements: &ElementParams,
    threads: usize,
    dt: f32,
) -> StrengthReport {
    let coefficients = &elements.viscosity[..];
    let part = dt / TICK_SECONDS;
    let most = if solver.masses.is_empty() { MOST_SHARE } else { 0.5 * MOST_SHARE } / part;
    let report = StrengthReport::of(&particles.element, coefficients, most * MOST_PASSES);
    let passes = (strongest(&particles.element, coefficients, most) / most).ceil().clamp(1.0, MOST_PASSES);
    // Volumes live in the array of λ, what particles bring to a pair in those of corrected positions: all are free between two
    // solves.
    let Solver { bins, smoothing, instructions, density, lambda, masses, x: shares, y: loads, next_x, next_y, .. } =
        solver;
    let sticks = strongest(&particles.element, &elements.stickiness, 0.0) > 0.0;
    let walls = sticks.then(|| Walls {
        smoothing,
        domain,
        rock: bins.rock(),
        strengths: &elements.stickiness,
        grip: Grip::new(smoothing),
    });
    if !sticks {
        lambda.iter_mut().zip(&*density).for_each(|(volume, density)| *volume = 1.0 / density.max(LEAST_DENSITY));
    }
    let (most_of_all, part) = (most * passes, part / passes);
    if !masses.is_empty() {
        for (k, element) in particles.element.iter().enumerate() {
            shares[k] = coefficients[element.index()].min(most_of_all) * (smoothing.density_scale * part);
            loads[k] = 4.0 * shares[k] * masses[k];
        }
    }
    for turn in 0..passes as u32 {
        let read = &*particles;
        bins::split(bins.groups(), [&mut next_x[..], &mut next_y[..]], threads, &|groups, base, out| {
            let pass = ViscosityPass::<false, false, false> {
                smoothing,
                particles: read,
                density,
                volumes: lambda,
                masses,
                shares,
                loads,
                coefficients,
                walls: walls.as_ref(),
                most: most_of_all,
                part,
                once: Once { most, times: if turn == 0 { passes } else { 0.0 } },
                groups,
                base,
                out,
            };
            match (masses.is_empty(), sticks, passes > 1.0) {
                (true, false, _) => instructions.run(pass),
                (true, true, _) => instructions.run(pass.with::<false, true, false>()),
                (false, false, false) => instructions.run(pass.with::<true, false, false>()),
                (false, true, false) => instructions.run(pass.with::<true, true, false>()),
                (false, false, true) => instructions.run(pass.with::<true, false, true>()),
                (false, true, true) => instructions.run(pass.with::<true, true, true>()),
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

/// What holds what sticks.
struct Walls<'a> {
    smoothing: &'a Smoothing,
    domain: &'a Domain,
    rock: &'a RockBins,
    /// c of the elements' own viscosity.
    strengths: &'a [f32],
    grip: Grip,
}

impl Walls<'_> {
    /// Whether a group has anything to do with them.
    #[inline(always)]
    fn hold(&self, group: &Group, elements: &[ElementId]) -> bool {
        let is_near = group.near_wall || group.rock.iter().any(|run| !run.range().is_empty());
        is_near && elements.iter().any(|element| self.strengths[element.index()] > 0.0)
    }

    /// Densities of some particles below which their neighbours' do not count, in lanes; next to none of what does not stick.
    #[inline(always)]
    fn densities<L: Lanes>(&self, elements: &[ElementId], density: &[f32]) -> L {
        let mut least = [LEAST_DENSITY; MOST_LANES];
        for (least, (element, density)) in least.iter_mut().zip(elements.iter().zip(density)) {
            *least = if self.strengths[element.index()] > 0.0 { least.max(*density) } else { *least };
        }
        L::load(&least)
    }

    /// What the particles of a group keep of their velocities beside them in a part of a tick, in lanes. Strengths count
    /// for `most` at most, and that of each particle `times` as much.
    #[inline(always)]
    fn kept<L: Lanes>(
        &self,
        particles: &Particles,
        group: &Group,
        (most, part): (f32, f32),
        times: impl Fn(ElementId) -> f32,
    ) -> L {
        let (own, smoothing) = (group.particles(), self.smoothing);
        let (xi, yi) = (L::load(&particles.x[own.start..]), L::load(&particles.y[own.start..]));
        let (zero, h2) = (L::splat(0.0), L::splat(smoothing.radius * smoothing.radius));
        let mut sum = zero;
        for run in group.rock {
            for (&xj, &yj) in self.rock.x[run.range()].iter().zip(&self.rock.y[run.range()]) {
                let (dx, dy) = (xi - L::splat(xj), yi - L::splat(yj));
                let w = (h2 - (dx * dx + dy * dy)).max(zero);
                sum = sum + w * w * w;
            }
        }
        let mut reach = [0.0_f32; MOST_LANES];
        (sum * L::splat(smoothing.density_scale)).store(&mut reach);
        let share = share_of(self.strengths, most, &particles.element[own.clone()], part);
        let mut kept = [1.0; MOST_LANES];
        for (lane, i) in own.enumerate() {
            let at = particles.position(i);
            let beyond = if group.near_wall { wall_sums(smoothing, self.domain, at).0 } else { 0.0 };
            let share = share[lane] * times(particles.element[i]);
            kept[lane] = 1.0 / (1.0 + share * self.grip.at(reach[lane] + beyond));
        }
        L::load(&kept)
    }
}

/// What takes only one of several passes, and how much of it this one does.
#[derive(Clone, Copy)]
struct Once {
    /// Largest coefficient that one pass can do.
    most: f32,
    /// How many times what an equal part would do: as many as there are passes in the first, and 0 in the others.
    times: f32,
}

impl Once {
    /// Whether particles of a coefficient take all passes, with others that do.
    fn is_beyond(self, coefficient: f32) -> bool {
        // A mean is at most twice the smaller of both.
        coefficient > 0.5 * self.most
    }

    /// How many times an equal part of the passes a particle of a coefficient takes of a wall.
    fn times_of(self, coefficient: f32) -> f32 {
        if self.is_beyond(coefficient) { 1.0 } else { self.times }
    }
}

/// A pass over groups: where masses differ, where something sticks to walls (`walls` are read), and where some take one of several
/// passes (`once` is read).
struct ViscosityPass<'a, const MASSES: bool, const STICKS: bool, const ONCE: bool> {
    smoothing: &'a Smoothing,
    particles: &'a Particles,
    density: &'a [f32],
    /// Volumes m/ρ; not read with `STICKS`, where a volume belongs to a pair.
    volumes: &'a [f32],
    /// Masses as shares of the heaviest; not read without `MASSES`.
    masses: &'a [f32],
    /// Scaled coefficients of the particles, and four times that times mass; not read without `MASSES`.
    shares: &'a [f32],
    loads: &'a [f32],
    coefficients: &'a [f32],
    /// Walls, if anything sticks to them.
    walls: Option<&'a Walls<'a>>,
    /// Largest coefficient.
    most: f32,
    /// Part of a tick that passes.
    part: f32,
    once: Once,
    groups: &'a [Group],
    base: usize,
    /// Out: velocities, d/s.
    out: [&'a mut [f32]; 2],
}

impl<'a> ViscosityPass<'a, false, false, false> {
    /// The same for other matter.
    fn with<const MASSES: bool, const STICKS: bool, const ONCE: bool>(self) -> ViscosityPass<'a, MASSES, STICKS, ONCE> {
        let Self {
            smoothing,
            particles,
            density,
            volumes,
            masses,
            shares,
            loads,
            coefficients,
            walls,
            most,
            part,
            once,
            groups,
            base,
            out,
        } = self;
        ViscosityPass {
            smoothing,
            particles,
            density,
            volumes,
            masses,
            shares,
            loads,
            coefficients,
            walls,
            most,
            part,
            once,
            groups,
            base,
            out,
        }
    }
}

impl<const MASSES: bool, const STICKS: bool, const ONCE: bool> Pass for ViscosityPass<'_, MASSES, STICKS, ONCE> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let h2 = L::splat(self.smoothing.radius * self.smoothing.radius);
        let [out_x, out_y] = self.out;
        for group in self.groups {
            let own = group.particles();
            let (xi, yi) = (L::load(&self.particles.x[own.start..]), L::load(&self.particles.y[own.start..]));
            let (vxi, vyi) = (L::load(&self.particles.vx[own.start..]), L::load(&self.particles.vy[own.start..]));
            let scale = self.smoothing.density_scale * self.part;
            let elements = &self.particles.element[own.clone()];
            let out = own.start - self.base..own.end - self.base;
            let takes_all = |element: &ElementId| self.once.is_beyond(self.coefficients[element.index()]);
            if ONCE && self.once.times == 0.0 && !elements.iter().any(takes_all) {
                out_x[out.clone()].copy_from_slice(&self.particles.vx[own.clone()]);
                out_y[out].copy_from_slice(&self.particles.vy[own]);
                continue;
            }
            let share = share_of(self.coefficients, self.most, elements, scale);
            let walls = self.walls.filter(|_| STICKS);
            let held = walls.map_or(zero, |walls| walls.densities::<L>(elements, &self.density[own.clone()]));
            let share = L::load(&share);
            let (once_most, once_times) = (L::splat(0.5 * self.once.most * scale), L::splat(self.once.times));
            let mass_i = if MASSES { L::load(&self.masses[own.start..]) } else { zero };
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
                            let sum = (share + other).max(L::splat(f32::MIN_POSITIVE));
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
            let Particles { x, y, vx, vy, .. } = self.particles;
            let sizes = if STICKS { self.density } else { self.volumes };
            for run in group.movable {
                let run = run.range();
                let places = x[run.clone()].iter().zip(&y[run.clone()]);
                let moving = places.zip(&vx[run.clone()]).zip(&vy[run.clone()]).zip(&sizes[run.clone()]);
                if MASSES {
                    let pairs = self.shares[run.clone()].iter().zip(&self.loads[run.clone()]);
                    add!(moving.zip(self.masses[run].iter().zip(pairs)));
                } else {
                    add!(moving.map(|of| (of, (&0.0, (&0.0, &0.0)))));
                }
            }
            let (mut vx, mut vy) = (vxi + share * sum_x, vyi + share * sum_y);
            if let Some(walls) = walls.filter(|walls| walls.hold(group, elements)) {
                let times = |element: ElementId| match ONCE {
                    true => self.once.times_of(self.coefficients[element.index()]),
                    false => 1.0,
                };
                let kept = walls.kept::<L>(self.particles, group, (self.most, self.part), times);
                (vx, vy) = (vx * kept, vy * kept);
            }
            vx.store(&mut out_x[out.clone()]);
            vy.store(&mut out_y[out]);
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
