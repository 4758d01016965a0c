//! Prediction: where the velocities alone would take the particles, without passing through rock or walls.

use crate::{
    element::{ElementId, Traits},
    forces::{drop_pushes, held},
    parallel::{WORTH_A_PIECE, spread},
    params::{Domain, Quality, WALL_GAP},
    particles::Particles,
    simd::{InstructionSet, Lanes, Pass},
    solids::Solids,
};
use glam::Vec2;
use std::sync::atomic::{AtomicU64, Ordering};

/// Longest move of a substep, in kernel radii. Collision with rock is exact at any speed; what this bounds is how deep
/// two streams can enter each other before the density constraint sees them: up to two kernel diameters each.
pub(crate) const MOVE_RADII: f32 = 4.0;
/// Substeps that a fast tick may take at the scene's own spacing, as a multiple of the quality's: in a storm, with all iterations
/// called for and the air in motion, each takes the time of up to three calm ones, and ten calm ticks are what a game has that is
/// never late. A finer run may take as many times more as it is finer, so that the speed at which matter is cut stays the same
/// in m/s.
const SUBSTEP_GROWTH: f32 = 3.0;
/// Most that a tick may take over matter that is heaped, calm ticks of counted work: what is left of ten for the air.
const MOST_WORK: f32 = 8.0;

/// Particles that are done at a time.
const BLOCK: usize = 64;

/// What the limiters of the prediction did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PredictReport {
    /// Particles whose speed was cut to the longest move.
    pub speed_clamps: u64,
}

/// Substeps of a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Substeps {
    /// How many it takes.
    pub count: u32,
    /// Whether the speeds call for more than the limit: then those that are too fast are cut.
    pub short: bool,
}

/// Substeps for a tick of `tick` s: the quality's, more if the fastest particle (d/s) would move too far in one, up to
/// three times the quality's and, beyond detail 1, so many times more as the run is finer.
///
/// **The bound.** A move is explicit, `x + v Δt`, and exact whatever its length as far as rock and walls go (`sweep`).
/// What bounds it is that two streams must not pass through each other unseen: each moves at most `MOVE_RADII` h, so with
/// the fastest speed v and gravity g a tick T takes `n ≥ (v + g T) T / (MOVE_RADII h)` substeps. Past the limit
/// the speed itself is cut to `MOVE_RADII h / Δt` and counted, so that the bound holds at any speed.
///
/// **The cost.** Where matter is heaped, each substep is as much dearer as `crowding` says (times as many neighbours). Such a tick
/// takes no more than eight calm ones ([`MOST_WORK`]) by taking fewer substeps: what is both so fast and so dense is past all
/// bounds of accuracy, and what is left of its speed is cut.
pub fn substeps(
    fastest: f32,
    domain: &Domain,
    quality: &Quality,
    (detail, tick): (f32, f32),
    crowding: impl FnOnce() -> f32,
) -> Substeps {
    let fastest = fastest + domain.gravity.length() * tick;
    let wanted = (fastest * tick / longest_move(quality)).ceil();
    let usual = quality.substeps as f32;
    if wanted.max(usual) == usual {
        return Substeps { count: quality.substeps, short: false };
    }
    let growth = SUBSTEP_GROWTH * detail.max(1.0);
    let most = (usual * growth).ceil().min((usual * growth.max(MOST_WORK) / crowding()).floor()).max(usual);
    Substeps { count: wanted.min(most) as u32, short: wanted > most }
}

/// Furthest that a particle may move in a substep, d: faster ones are cut to it.
pub fn longest_move(quality: &Quality) -> f32 {
    MOVE_RADII * quality.kernel_radius
}

/// Moves the particles to `x + v Δt`, cut to the longest move and swept against rock and box. Where that changed the
/// move, the velocity becomes that of the move that is left, and what was to push against the obstacle after the move
/// is held by it ([`held`]). A grain rubs on what stopped it: of its motion along it Coulomb's friction is lost, tan φ times what
/// was stopped.
pub fn predict(
    particles: &mut Particles,
    instructions: InstructionSet,
    (solids, domain): (&Solids, &Domain),
    quality: &Quality,
    traits: Traits,
    threads: usize,
    dt: f32,
) -> PredictReport {
    let rock = (solids.count() > 0).then_some(solids);
    let longest = longest_move(quality);
    let Particles { x, y, vx, vy, push_x, push_y, element, .. } = particles;
    let clamps = AtomicU64::new(0);
    let arrays = [&mut x[..], y, vx, vy, push_x, push_y];
    spread(arrays, WORTH_A_PIECE, threads, &|first, [x, y, vx, vy, push_x, push_y]| {
        let elements = &element[first..first + x.len()];
        let (position, velocity, push, clamps) = ([x, y], [vx, vy], [push_x, push_y], &clamps);
        instructions.run(Prediction { domain, rock, traits, elements, longest, dt, position, velocity, push, clamps });
    });
    PredictReport { speed_clamps: clamps.into_inner() }
}

/// Predicts a piece of the particles.
struct Prediction<'a> {
    domain: &'a Domain,
    /// Rock, if there is any.
    rock: Option<&'a Solids>,
    traits: Traits<'a>,
    elements: &'a [ElementId],
    /// Longest move, d.
    longest: f32,
    dt: f32,
    /// In: positions, d. Out: predicted positions.
    position: [&'a mut [f32]; 2],
    /// In and out: velocities, d/s; cut where they were too fast.
    velocity: [&'a mut [f32]; 2],
    /// In and out: what is to be added to the velocities after the move besides gravity, d/s.
    push: [&'a mut [f32]; 2],
    /// Counts the particles that were too fast.
    clamps: &'a AtomicU64,
}

impl Pass for Prediction<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { domain, rock, traits, elements, longest, dt, position: [x, y], velocity: [vx, vy], .. } = self;
        let ([push_x, push_y], clamps) = (self.push, self.clamps);
        let of = |values: &[f32], k: usize| values[elements[k].index()];
        let (high, half) = (domain.highest(), 0.5 * dt * domain.gravity);
        let (mut from_x, mut from_y) = ([0.0_f32; BLOCK], [0.0_f32; BLOCK]);
        for first in (0..x.len()).step_by(BLOCK) {
            let own = first..x.len().min(first + BLOCK);
            let (vx, vy) = (&mut vx[own.clone()], &mut vy[own.clone()]);
            let (push_x, push_y) = (&mut push_x[own.clone()], &mut push_y[own.clone()]);
            let (to_x, to_y) = (&mut x[own.clone()], &mut y[own.clone()]);
            let (x, y) = (&mut from_x[..vx.len()], &mut from_y[..vx.len()]);
            x.copy_from_slice(to_x);
            y.copy_from_slice(to_y);
            if let cut @ 1.. = cut_speeds(vx, vy, longest, dt) {
                clamps.fetch_add(cut, Ordering::Relaxed);
            }
            let stopped_x = move_freely(x, vx, to_x, high.x, dt);
            let stopped_y = move_freely(y, vy, to_y, high.y, dt);
            let is_turned = rock.is_some_and(|rock| rock.sweep_all([&*x, &*y], [&mut *to_x, &mut *to_y]));
            if stopped_x | stopped_y | is_turned {
                for k in 0..x.len() {
                    if to_x[k] != x[k] + vx[k] * dt || to_y[k] != y[k] + vy[k] * dt {
                        let mut left = Vec2::new((to_x[k] - x[k]) / dt, (to_y[k] - y[k]) / dt);
                        let sine = traits.sines.map_or(0.0, |sines| of(sines, own.start + k));
                        if sine > 0.0 {
                            let from = Vec2::new(x[k], y[k]);
                            let to = from + dt * rub(left, left - Vec2::new(vx[k], vy[k]), sine);
                            let to = rock.map_or(to, |rock| rock.sweep(from, to));
                            (to_x[k], to_y[k]) = (to.x, to.y);
                            left = (to - from) / dt;
                        }
                        let half = traits.weights.map_or(half, |weights| of(weights, own.start + k) * half);
                        let kick = half + Vec2::new(push_x[k], push_y[k]);
                        let push = held(kick, left - Vec2::new(vx[k], vy[k])) - half;
                        (vx[k], vy[k], push_x[k], push_y[k]) = (left.x, left.y, push.x, push.y);
                    }
                }
            }
            drop_pushes([vx, vy], [push_x, push_y], longest / dt);
        }
    }
}

/// What friction leaves of a velocity (d/s) along a wall that changed it by `stop` (d/s). `sine`: sin φ.
fn rub(left: Vec2, stop: Vec2, sine: f32) -> Vec2 {
    let stopped = stop.length();
    if stopped == 0.0 {
        return left;
    }
    let away = stop / stopped;
    let along = left - left.dot(away) * away;
    let tangent = sine / (1.0 - sine * sine).sqrt();
    let lost = tangent * stopped / along.length().max(f32::MIN_POSITIVE);
    left - lost.min(1.0) * along
}

/// Cuts speeds to `longest` d in `dt` s; returns how many it cut.
#[inline(always)]
fn cut_speeds(vx: &mut [f32], vy: &mut [f32], longest: f32, dt: f32) -> u64 {
    let length2 = |vx: f32, vy: f32| (vx * dt) * (vx * dt) + (vy * dt) * (vy * dt);
    let is_fast = |vx: f32, vy: f32| length2(vx, vy) > longest * longest;
    if !vx.iter().zip(&*vy).fold(false, |any, (&vx, &vy)| any | is_fast(vx, vy)) {
        return 0;
    }
    let mut count = 0;
    for (vx, vy) in vx.iter_mut().zip(vy).filter(|(vx, vy)| is_fast(**vx, **vy)) {
        let share = longest / length2(*vx, *vy).sqrt();
        (*vx, *vy) = (*vx * share, *vy * share);
        count += 1;
    }
    count
}

/// Where velocities take coordinates, kept inside the box; returns whether a wall stopped any.
#[inline(always)]
fn move_freely(from: &[f32], velocity: &[f32], to: &mut [f32], high: f32, dt: f32) -> bool {
    let mut stopped = false;
    for ((to, from), velocity) in to.iter_mut().zip(from).zip(velocity) {
        let free = from + velocity * dt;
        let at = if free > WALL_GAP { free } else { WALL_GAP };
        *to = if at < high { at } else { high };
        stopped |= *to != free;
    }
    stopped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{checks, params::Preset, units::TICK_SECONDS};

    #[test]
    fn speeds_are_followed_up_to_the_bound_and_cut_to_it_past_it() {
        let quality = Preset::Balanced.quality();
        let usual = quality.substeps * SUBSTEP_GROWTH as u32;
        let bound = longest_move(&quality) * usual as f32 / TICK_SECONDS;
        let domain = Domain { size: Vec2::splat(1000.0), gravity: Vec2::ZERO };
        let solids = Solids::new(1000, 1000);
        // The same speed in m/s is twice as many d/s at detail 2.
        for (detail, part, short) in [(1.0, 0.99, false), (1.0, 10.0, true), (2.0, 0.99, false), (0.5, 10.0, true)] {
            let finer = f32::max(detail, 1.0);
            let (bound, most) = (bound * finer, usual * finer as u32);
            let speed = part * bound;
            let mut particles = Particles::default();
            particles.push(0, ElementId(0), Vec2::splat(500.0), Vec2::new(0.6, -0.8) * speed);
            let speed = checks::fastest([&particles.vx, &particles.vy], 1);
            let wanted = substeps(speed, &domain, &quality, (detail, TICK_SECONDS), || 1.0);
            assert_eq!(wanted, Substeps { count: most, short });
            let dt = TICK_SECONDS / wanted.count as f32;
            let report = predict(
                &mut particles,
                InstructionSet::Baseline,
                (&solids, &domain),
                &quality,
                Traits::default(),
                1,
                dt,
            );
            assert_eq!(report.speed_clamps, u64::from(short));
            let (left, moved) = (particles.velocity(0), particles.position(0).distance(Vec2::splat(500.0)));
            let expected = speed.min(bound);
            assert!((left.length() / expected - 1.0).abs() < 1e-4, "{left} at a speed of {speed}");
            assert!((left.normalize() - Vec2::new(0.6, -0.8)).length() < 1e-4, "the way has changed: {left}");
            assert!(moved <= longest_move(&quality) * 1.0001, "moved {moved} d");
        }
    }

    #[test]
    fn a_grain_slides_on_the_floor_as_far_as_coulomb_has_it_and_a_drop_without_end() {
        let (dt, gravity, speed) = (TICK_SECONDS, 98.1, 60.0);
        let domain = Domain { size: Vec2::new(400.0, 10.0), gravity: Vec2::new(0.0, -gravity) };
        let (solids, quality, sine) = (Solids::new(400, 10), Preset::Balanced.quality(), 0.5_f32);
        let mut particles = Particles::default();
        for element in [0, 1] {
            particles.push(element.into(), ElementId(element), Vec2::new(10.0, WALL_GAP), Vec2::new(speed, 0.0));
        }
        for _ in 0..120 {
            particles.vy.iter_mut().for_each(|vy| *vy -= gravity * dt);
            let (around, traits) =
                ((&solids, &domain), Traits { sines: Some(&[0.0, sine]), weights: None, drawn: None });
            predict(&mut particles, InstructionSet::Baseline, around, &quality, traits, 1, dt);
        }
        assert!((particles.vx[0] - speed).abs() < 1e-4 && particles.vx[1] == 0.0, "{:?} d/s", particles.vx);
        // v²/(2 μ g), less half of the first step: it is slower from the first step's start on.
        let friction = sine / (1.0 - sine * sine).sqrt();
        let expected = speed * speed / (2.0 * friction * gravity) - 0.5 * speed * dt;
        let way = particles.x[1] - 10.0;
        assert!((way - expected).abs() < 0.02 * expected, "{way} d, {expected} expected");
    }

    #[test]
    fn crowded_matter_takes_fewer_substeps() {
        let quality = Preset::Balanced.quality();
        let domain = Domain { size: Vec2::splat(1000.0), gravity: Vec2::ZERO };
        let count = |crowding: f32| substeps(1e6, &domain, &quality, (1.0, TICK_SECONDS), || crowding);
        let usual = quality.substeps;
        for (crowding, most) in [(1.0, 3 * usual), (2.6, 3 * usual), (4.0, 2 * usual), (8.0, usual), (100.0, usual)] {
            assert_eq!(count(crowding), Substeps { count: most, short: true }, "{crowding} times as crowded");
        }
        let calm = substeps(0.0, &domain, &quality, (1.0, TICK_SECONDS), || panic!("calm matter is not looked at"));
        assert_eq!(calm, Substeps { count: usual, short: false });
        assert_eq!(substeps(f32::NAN, &domain, &quality, (1.0, TICK_SECONDS), || 1.0).count, usual);
        // A finer run takes as many more as it is finer, where nothing is crowded.
        let finer = substeps(1e6, &domain, &quality, (4.0, TICK_SECONDS), || 1.0);
        assert_eq!(finer.count, 12 * usual);
    }
}
