//! Gravity and the drag of the air.

use crate::{
    air::Air,
    brush::soft_disc,
    element::ElementParams,
    parallel::{WORTH_A_PIECE, spread},
    particles::Particles,
};
use glam::Vec2;

/// Particles whose wind is looked up at a time.
const BLOCK: usize = 64;

/// Begins a substep of `dt` s: half of gravity (d/s²), whose other half comes after the move (`velocity`). `weights`: what the
/// elements feel of it, as a share, if not all feel all.
///
/// That is the leapfrog (velocity Verlet): with `x += v Δt` in between, a fall is exact at any Δt, in way and in speed.
/// Pressure and contact act at the middle of a substep, too. They are known only once the substep is solved; so that
/// the velocity that is stored is that of the substep's end, as much as they changed it by from its start to its middle
/// is added after the move (`push`), and taken back here: the pressure solve sets out from the velocity in the middle
/// of the last substep, and finds the whole change.
pub fn begin_kick(gravity: Vec2, weights: Option<&[f32]>, particles: &mut Particles, threads: usize, dt: f32) {
    let change = 0.5 * dt * gravity;
    let Particles { vx, vy, push_x, push_y, element, .. } = particles;
    for (velocity, push, change) in [(vx, push_x, change.x), (vy, push_y, change.y)] {
        spread([&mut velocity[..], push], WORTH_A_PIECE, threads, &|first, [velocity, push]| {
            if let Some(weights) = weights {
                // The rest is added below.
                for (velocity, element) in velocity.iter_mut().zip(&element[first..]) {
                    *velocity += change * (weights[element.index()] - 1.0);
                }
            }
            for (velocity, push) in velocity.iter_mut().zip(push) {
                *velocity += change - *push;
                *push = 0.0;
            }
        });
    }
}

/// What is left of a `kick` (d/s) where contact changed the velocity by `stop` (d/s): what rests on something is held
/// by it until the substep's end, too. Contact takes away no more of the kick than it took of the motion, and gives
/// nothing back.
#[inline(always)]
pub(crate) fn held(kick: Vec2, stop: Vec2) -> Vec2 {
    let against = -(kick.x * stop.x + kick.y * stop.y);
    let stop2 = stop.x * stop.x + stop.y * stop.y;
    let share = if against < stop2 { against } else { stop2 };
    // A stop whose square is too small for a number stops nothing.
    let share = if against > 0.0 && stop2 > 0.0 { share / stop2 } else { 0.0 };
    Vec2::new(kick.x + share * stop.x, kick.y + share * stop.y)
}

/// Leaves those pushes out that would take a speed past `most` d/s.
#[inline(always)]
pub(crate) fn drop_pushes([vx, vy]: [&[f32]; 2], [push_x, push_y]: [&mut [f32]; 2], most: f32) {
    for k in 0..vx.len() {
        let (x, y) = (vx[k] + push_x[k], vy[k] + push_y[k]);
        let keep = if x * x + y * y > most * most { 0.0 } else { 1.0 };
        (push_x[k], push_y[k]) = (keep * push_x[k], keep * push_y[k]);
    }
}

/// The half of the drag that comes after the move, d/s for each particle; empty where nothing drags.
#[derive(Clone, Debug, Default)]
pub struct LaterDrag {
    x: Vec<f32>,
    y: Vec<f32>,
}

impl LaterDrag {
    /// Room for what particles drag the air by, as a share of their motion in it, until this is found of that.
    pub(crate) fn shares(&mut self, count: usize) -> &mut [f32] {
        self.x.resize(count, 0.0);
        &mut self.x
    }

    /// Room for `count` particles.
    pub(crate) fn of(&mut self, count: usize) -> [&mut [f32]; 2] {
        self.x.resize(count, 0.0);
        self.y.resize(count, 0.0);
        [&mut self.x, &mut self.y]
    }

    /// Adds it to the velocities, up to the speed `most` (d/s), and is empty. The particles must be the same.
    pub fn end(&mut self, particles: &mut Particles, threads: usize, most: f32) {
        if self.x.is_empty() {
            return;
        }
        let Particles { vx, vy, push_x, push_y, .. } = particles;
        let arrays = [&mut vx[..], vy, push_x, push_y, &mut self.x, &mut self.y];
        spread(arrays, WORTH_A_PIECE, threads, &|_, [vx, vy, push_x, push_y, x, y]| {
            for k in 0..vx.len() {
                let velocity = Vec2::new(vx[k] + x[k], vy[k] + y[k]);
                let speed2 = velocity.x * velocity.x + velocity.y * velocity.y;
                let share = if speed2 > most * most { most / speed2.sqrt() } else { 1.0 };
                (vx[k], vy[k]) = (velocity.x * share, velocity.y * share);
            }
            drop_pushes([vx, vy], [push_x, push_y], most);
        });
        self.x.clear();
        self.y.clear();
    }
}

/// Drags every particle towards the air at its place with `F = C v²`, v being its velocity relative to the air.
///
/// `dv/dt = −k |v| v` has the exact solution `v / (1 + k |v| Δt)`, which neither overshoots nor reverses at any C. The
/// explicit step `v (1 − k |v| Δt)` would turn the particle round past **`k |v| Δt = 1`** and speed it up past 2; the
/// solution has no such bound, so there is nothing to limit.
///
/// The velocity gets half of the change, `later` the other half (d/s): it comes after the move.
pub fn apply_drag(
    air: &Air,
    elements: &ElementParams,
    particles: &mut Particles,
    later: &mut LaterDrag,
    threads: usize,
    dt: f32,
) {
    let (quiet, rates) = (air.is_quiet(), &elements.drag[..]);
    let Particles { x, y, vx, vy, element, .. } = particles;
    let [later_x, later_y] = later.of(x.len());
    spread([&mut vx[..], vy, later_x, later_y], WORTH_A_PIECE, threads, &|base, [vx, vy, later_x, later_y]| {
        for (index, (vx, vy)) in vx.chunks_mut(BLOCK).zip(vy.chunks_mut(BLOCK)).enumerate() {
            let first = index * BLOCK;
            let own = base + first..base + first + vx.len();
            let (mut wind_x, mut wind_y) = ([0.0; BLOCK], [0.0; BLOCK]);
            if !quiet {
                let (wind_x, wind_y) = (&mut wind_x[..vx.len()], &mut wind_y[..vx.len()]);
                air.sample_velocities(&x[own.clone()], &y[own.clone()], wind_x, wind_y);
            }
            for (k, element) in element[own].iter().enumerate() {
                let wind = Vec2::new(wind_x[k], wind_y[k]);
                let before = Vec2::new(vx[k], vy[k]);
                let half = 0.5 * (dragged(before, wind, rates[element.index()], dt) - before);
                (vx[k], vy[k]) = (before.x + half.x, before.y + half.y);
                (later_x[first + k], later_y[first + k]) = (half.x, half.y);
            }
        }
    });
}

/// Drags the particles in a soft disc as [`apply_drag`] would in air that has `wind` (d/s) for `dt` s and does
/// not yield: all of it at `centre` (d), nothing from `radius` (d) on ([`soft_disc`]).
pub fn drag_in_disc(
    centre: Vec2,
    radius: f32,
    wind: Vec2,
    elements: &ElementParams,
    particles: &mut Particles,
    dt: f32,
) {
    if !(centre.is_finite() && radius.is_finite() && wind.is_finite()) {
        return;
    }
    let Particles { x, y, vx, vy, element, .. } = particles;
    for (i, (x, y)) in x.iter().zip(y).enumerate() {
        let weight = soft_disc(Vec2::new(*x, *y), centre, radius);
        if weight > 0.0 {
            let before = Vec2::new(vx[i], vy[i]);
            let after = before + (dragged(before, wind, elements.drag[element[i].index()], dt) - before) * weight;
            (vx[i], vy[i]) = (after.x, after.y);
        }
    }
}

/// Velocity after `dt` s of drag at `rate` 1/d in a wind.
fn dragged(velocity: Vec2, wind: Vec2, rate: f32, dt: f32) -> Vec2 {
    let relative = velocity - wind;
    let speed = (relative.x * relative.x + relative.y * relative.y).sqrt();
    wind + relative / (1.0 + rate * speed * dt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_substep_begins_with_half_of_gravity_and_without_the_push_of_the_last() {
        let mut particles = Particles::default();
        particles.push(0, crate::element::ElementId(0), Vec2::ONE, Vec2::new(3.0, 5.0));
        (particles.push_x[0], particles.push_y[0]) = (1.0, -2.0);
        begin_kick(Vec2::new(0.0, -8.0), None, &mut particles, 1, 0.25);
        assert_eq!(particles.velocity(0), Vec2::new(2.0, 6.0));
        assert_eq!((particles.push_x[0], particles.push_y[0]), (0.0, 0.0));
    }

    #[test]
    fn what_is_next_to_nothing_stops_nothing() {
        let kick = Vec2::new(0.0, -1e-2);
        assert_eq!(held(kick, Vec2::new(0.0, 1e-25)), kick, "its square is 0");
        assert_eq!(held(kick, Vec2::new(0.0, 1.0)), Vec2::ZERO);
        assert_eq!(held(kick, Vec2::new(0.0, -1.0)), kick, "it acts the same way");
    }

    #[test]
    fn drag_never_reverses_and_follows_its_solution() {
        // 1 is the bound of an explicit step.
        for product in [0.1, 0.99, 1.0, 9.9, 10.0, 100.0, 1000.0] {
            let velocity = dragged(Vec2::new(30.0, -40.0), Vec2::ZERO, product / 50.0, 1.0);
            let expected = Vec2::new(30.0, -40.0) / (1.0 + product);
            assert!((velocity - expected).length() < 1e-4 * expected.length(), "{velocity} instead of {expected}");
            assert!(velocity.x > 0.0 && velocity.y < 0.0, "drag turned the particle round");
        }
    }

    #[test]
    fn two_half_steps_of_drag_are_one_step() {
        let (velocity, wind) = (Vec2::new(5.0, 2.0), Vec2::new(-3.0, 1.0));
        let whole = dragged(velocity, wind, 0.02, 0.5);
        let halves = dragged(dragged(velocity, wind, 0.02, 0.25), wind, 0.02, 0.25);
        assert!((whole - halves).length() < 1e-5);
    }
}
