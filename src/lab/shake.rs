//! Equally good starts: in a chaotic flow particles go their own ways after the smallest difference, so that one run says
//! little of what is usual.

use crate::{
    kernel::{random::Random, units::TICKS_PER_SECOND},
    sim::state::ParticleStore,
};
use bevy::ecs::world::World;

/// Speed that is calm to the eye, d a tick.
pub const UNSEEN: f32 = 0.02;

/// Speed that is lost in the rounding of places, d a tick: places of more than 64 d are known to 2⁻¹⁷ d.
pub const ROUNDING: f32 = 7.6e-6;

/// Changes every velocity of the movable particles by up to `most` (d a tick) along each axis, by chance; equal seeds, equal
/// changes.
pub fn shake(world: &mut World, most: f32, seed: u64) {
    let mut random = Random::new(seed);
    let particles = &mut world.resource_mut::<ParticleStore>().into_inner().0;
    for velocity in particles.vx.iter_mut().chain(&mut particles.vy) {
        *velocity += most * TICKS_PER_SECOND as f32 * random.offset();
    }
}
