//! Particles in known places, for the tests of what measures them.

use crate::kernel::{element::ElementId, particles::Particles};
use glam::{IVec2, Vec2};

/// Particles at rest at these points, d.
pub(super) fn world(points: impl IntoIterator<Item = Vec2>) -> Particles {
    let mut particles = Particles::default();
    for (id, p) in points.into_iter().enumerate() {
        particles.push(id as u32, ElementId(0), p, Vec2::ZERO);
    }
    particles
}

/// The sites of a lattice from the corner of the box on, d.
pub(super) fn lattice(columns: i32, rows: i32, spacing: f32) -> Vec<Vec2> {
    (0..columns * rows).map(|k| (IVec2::new(k % columns, k / columns).as_vec2() + Vec2::splat(0.5)) * spacing).collect()
}
