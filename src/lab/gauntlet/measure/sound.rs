//! Whether every value is a number.

use crate::{
    kernel::particles::Particles,
    sim::state::{AirGrid, ParticleStore},
};
use bevy::ecs::world::World;

/// What is no number or a pressure below 0, if anything is.
pub(in crate::lab::gauntlet) fn unsound(world: &World) -> Option<&'static str> {
    let Particles { x, y, vx, vy, .. } = &world.resource::<ParticleStore>().0;
    let air = world.resource::<AirGrid>();
    let sound = |values: &[f32]| values.iter().fold(true, |all, value| all & value.is_finite());
    if ![x, y, vx, vy].into_iter().all(|values| sound(values)) {
        Some("a particle is not finite")
    } else if (0..air.rows()).any(|row| !sound(air.velocity_x_row(row)) || !sound(air.velocity_y_row(row))) {
        Some("a wind is not finite")
    } else if (0..air.rows()).any(|row| !air.pressure_row(row).iter().all(|p| p.is_finite() && *p >= 0.0)) {
        Some("a pressure is not finite or below 0")
    } else {
        None
    }
}
