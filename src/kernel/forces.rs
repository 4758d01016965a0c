//! Gravity and the drag of the air.

use crate::{
    air::Air,
    brush::soft_disc,
    element::ElementParams,
    parallel::{WORTH_A_PIECE, spread},
    particles::Particles,
};
use glam::Vec2;

/// Fewer particles than this a piece do not pay for another thread: gravity is one addition.
const WORTH_GRAVITY: usize = 65_536;
/// Particles whose wind is looked up at a time.
const BLOCK: usize = 64;

/// Adds gravity (d/s²) over `dt` s.
pub fn apply_gravity(gravity: Vec2, particles: &mut Particles, threads: usize, dt: f32) {
    let change = gravity * dt;
    spread([&mut particles.vx[..], &mut particles.vy[..]], WORTH_GRAVITY, threads, &|_, [vx, vy]| {
        vx.iter_mut().for_each(|vx| *vx += change.x);
        vy.iter_mut().for_each(|vy| *vy += change.y);
    });
}

/// Drags every particle towards the air at its place with `F = C v²`, v being its velocity relative to the air.
///
/// `dv/dt = −k |v| v` has the exact solution `v / (1 + k |v| Δt)`, which neither overshoots nor reverses at any C. The
/// explicit step `v (1 − k |v| Δt)` would turn the particle round past **`k |v| Δt = 1`** and speed it up past 2; the
/// solution has no such bound, so there is nothing to limit.
pub fn apply_drag(air: &Air, elements: &ElementParams, particles: &mut Particles, threads: usize, dt: f32) {
    let quiet = air.is_quiet();
    let Particles { x, y, vx, vy, element, .. } = particles;
    spread([&mut vx[..], &mut vy[..]], WORTH_A_PIECE, threads, &|base, [vx, vy]| {
        for (index, (vx, vy)) in vx.chunks_mut(BLOCK).zip(vy.chunks_mut(BLOCK)).enumerate() {
            let own = base + index * BLOCK..base + index * BLOCK + vx.len();
            let (mut wind_x, mut wind_y) = ([0.0; BLOCK], [0.0; BLOCK]);
            if !quiet {
                let (wind_x, wind_y) = (&mut wind_x[..vx.len()], &mut wind_y[..vx.len()]);
                air.sample_velocities(&x[own.clone()], &y[own.clone()], wind_x, wind_y);
            }
            for (k, element) in element[own].iter().enumerate() {
                let wind = Vec2::new(wind_x[k], wind_y[k]);
                let velocity = dragged(Vec2::new(vx[k], vy[k]), wind, elements.drag[element.index()], dt);
                (vx[k], vy[k]) = (velocity.x, velocity.y);
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
