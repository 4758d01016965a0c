//! A world that is drawn, how it is looked at, and where its picture ends.

use crate::{
    game::{
        camera::WorldCamera,
        lens::Ring,
        render::{level::Level, tracers::Tracers},
        views::{fire::Burning, strain::Limited, table::View},
    },
    kernel::heat::Exposure,
    lab::difference::Half,
    sim::{
        generation::Generation,
        state::{AirGrid, Clock, HeatCurves, ParticleStore, Recipes, Rock, Setup, SolverState},
    },
};
use bevy::{prelude::World, window::Window};
use glam::UVec2;

/// Where and how everything is seen.
#[derive(Clone, Copy)]
pub(super) struct Sight<'a> {
    pub(super) window: &'a Window,
    pub(super) camera: &'a WorldCamera,
    pub(super) view: &'static View,
    /// The moment that is drawn, s before the last tick.
    pub(super) back: f32,
    /// Time of the world, s; from 0 again every hour.
    pub(super) time: f32,
    /// How much of the picture is drawn.
    pub(super) level: Level,
}

impl Sight<'_> {
    /// Pixels of the picture to a logical one of the window, along each side.
    pub(super) fn scale(self) -> f32 {
        self.window.resolution.scale_factor() * self.level.resolution()
    }

    /// Size of the picture, pixels.
    pub(super) fn size(self) -> UVec2 {
        (self.window.resolution.physical_size().as_vec2() * self.level.resolution()).ceil().as_uvec2().max(UVec2::ONE)
    }
}

/// Where a picture ends.
#[derive(Clone, Copy)]
pub(super) enum Within {
    /// At the edge of the window.
    Window,
    /// At that of its area.
    Area,
    /// At the ring of the lens.
    Ring(Ring),
}

/// A world, and what is drawn into it.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub(super) generation: Generation,
    pub(super) setup: &'a Setup,
    pub(super) particles: &'a ParticleStore,
    pub(super) rock: &'a Rock,
    pub(super) air: &'a AirGrid,
    pub(super) solver: Option<&'a SolverState>,
    pub(super) curves: &'a HeatCurves,
    pub(super) recipes: &'a Recipes,
    /// What the limiters work on.
    pub(super) limited: Limited<'a>,
    pub(super) tracers: Option<&'a Tracers>,
    /// Ticks since the scene began.
    pub(super) tick: u64,
}

impl<'a> Scene<'a> {
    /// What its matter is to a fire, of what was gathered of its particles.
    pub(super) fn burning(self, exposure: &'a Exposure) -> Burning<'a> {
        let Self { setup, particles, rock, curves, recipes, .. } = self;
        Burning {
            particles,
            rock,
            elements: setup.elements(),
            curves,
            decays: &recipes.decays,
            lights: recipes.decays.lowest_ignition(),
            exposure,
        }
    }

    /// What is compared with another world.
    pub(super) fn half(self) -> Half<'a> {
        Half { particles: self.particles, air: self.air, scale: self.setup.blueprint.scale }
    }

    /// What there is of a world, if it has been loaded.
    pub(super) fn of(world: &'a World) -> Option<Self> {
        Some(Self {
            generation: *world.get_resource()?,
            setup: world.get_resource()?,
            particles: world.get_resource()?,
            rock: world.get_resource()?,
            air: world.get_resource()?,
            solver: world.get_resource(),
            curves: world.get_resource()?,
            recipes: world.get_resource()?,
            limited: Limited::of(world)?,
            tracers: world.get_resource(),
            tick: world.get_resource::<Clock>()?.tick,
        })
    }
}
