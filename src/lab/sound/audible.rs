//! What of a world is listened to.

use crate::{
    kernel::{air::Air, element::ElementTable, particles::Particles, solids::Solids, units::Scale},
    sim::{
        generation::Generation,
        state::{AirGrid, Census, Clock, ParticleStore, Rock, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;

/// The parts of a world's state that sound.
#[derive(Clone, Copy, Debug)]
pub struct Audible<'a> {
    /// What moves.
    pub particles: &'a Particles,
    /// Rock.
    pub rock: &'a Solids,
    /// The air.
    pub air: &'a Air,
    /// What there is.
    pub elements: &'a ElementTable,
    /// Number of lumps of each element, rock included.
    pub census: &'a [u32],
    /// Metres of a spacing.
    pub scale: Scale,
    /// Gravity, d/s².
    pub gravity: Vec2,
    /// What the air resists with, Pa.
    pub stiffness: f32,
    /// Ticks since the scene began.
    pub tick: u64,
    /// Which world it is.
    pub generation: Generation,
}

impl<'a> Audible<'a> {
    /// Those of a world.
    pub fn of(world: &'a World) -> Self {
        let setup = world.resource::<Setup>();
        Self::of_parts(
            setup,
            world.resource::<ParticleStore>(),
            world.resource::<Rock>(),
            world.resource::<AirGrid>(),
            world.resource::<Census>(),
            world.resource::<Clock>().tick,
            Generation::of(world),
        )
    }

    /// Those of these resources.
    pub fn of_parts(
        setup: &'a Setup,
        particles: &'a Particles,
        rock: &'a Solids,
        air: &'a Air,
        census: &'a Census,
        tick: u64,
        generation: Generation,
    ) -> Self {
        let scale = setup.blueprint.scale;
        Self {
            particles,
            rock,
            air,
            elements: setup.elements(),
            census: &census.by_element,
            scale,
            gravity: setup.domain.gravity,
            stiffness: air.params().stiffness(scale),
            tick,
            generation,
        }
    }

    /// Size of the box, m.
    pub fn size(&self) -> Vec2 {
        self.scale.vec_to_metres(self.air.size())
    }
}
