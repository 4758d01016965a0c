//! Gravity and the drag of the air.

use crate::kernel::{air::Air, element::ElementTable, particles::Particles, units::Scale};
use glam::Vec2;

/// Adds gravity (d/s²) over `dt` s.
pub fn apply_gravity(gravity: Vec2, particles: &mut Particles, dt: f32) {
    let change = gravity * dt;
    for vx in &mut particles.vx {
        *vx += change.x;
    }
    for vy in &mut particles.vy {
        *vy += change.y;
    }
}

/// Drag of each element as `k` of `dv/dt = −k |v| v`, 1/d: `C / (ρ d²)` per metre, times d.
pub fn drag_rates(elements: &ElementTable, scale: Scale) -> Vec<f32> {
    elements.iter().map(|(_, element)| element.drag / (element.density * scale.spacing)).collect()
}

/// Drags every particle towards the air at its place with `F = C v²`, v being its velocity relative to the air.
///
/// `dv/dt = −k |v| v` has the exact solution `v / (1 + k |v| Δt)`, which neither overshoots nor reverses at any C.
pub fn apply_drag(air: &Air, rates: &[f32], particles: &mut Particles, dt: f32) {
    let quiet = air.is_quiet();
    for i in 0..particles.len() {
        let rate = rates[particles.element[i].index()];
        let wind = if quiet { Vec2::ZERO } else { air.sample_velocity(particles.position(i)) };
        let velocity = dragged(particles.velocity(i), wind, rate, dt);
        (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
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
        for product in [0.1, 1.0, 10.0, 100.0, 1000.0] {
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
