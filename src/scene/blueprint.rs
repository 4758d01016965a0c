//! The world that a scene describes, ready to run: what the simulation starts from and resets to.

use crate::{
    kernel::{
        element::ElementTable,
        params::{AirParams, Domain, FluidParams, Preset, Quality},
        particles::Particles,
        solids::Solids,
        sources::{Drain, Emitter, Rect, Wind},
        units::Scale,
    },
    scene::{effects::EffectModes, knobs::PARTICLE_LIMIT},
};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, sync::Arc};

/// Air that starts at another pressure or temperature than the surroundings'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressurePatch {
    /// Where, d.
    pub area: Rect,
    /// What it pushes with; the surroundings' is 1.
    pub pressure: f32,
    /// Temperature there, K.
    pub kelvin: f32,
}

/// A validated scene with its parameters put in. Lengths in d, times in s unless said otherwise. In a save file it stands
/// without its elements and without what it starts with: the world that is saved has these.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Blueprint {
    /// Name under `assets/scenes`, or the file's stem.
    pub name: String,
    /// Title in the scene menu.
    pub title: String,
    /// One sentence for the scene menu.
    pub description: String,
    /// The values of the scene's own parameters.
    pub parameters: BTreeMap<String, f64>,
    /// Particle spacing.
    pub scale: Scale,
    /// Box and gravity.
    pub domain: Domain,
    /// All elements.
    #[serde(skip)]
    pub elements: Arc<ElementTable>,
    /// Movable particles at the start.
    #[serde(skip)]
    pub particles: Particles,
    /// Rock at the start.
    #[serde(skip)]
    pub solids: Solids,
    /// The first id that is free.
    #[serde(skip)]
    pub next_id: u32,
    /// Emitters.
    #[serde(skip)]
    pub emitters: Vec<Emitter>,
    /// Winds.
    #[serde(skip)]
    pub winds: Vec<Wind>,
    /// Drains.
    #[serde(skip)]
    pub drains: Vec<Drain>,
    /// Air at the start where it is not the surroundings'.
    #[serde(skip)]
    pub pressures: Vec<PressurePatch>,
    /// Liquid parameters.
    pub fluid: FluidParams,
    /// Air parameters.
    pub air: AirParams,
    /// Wanted effects.
    #[serde(skip)]
    pub effects: EffectModes,
    /// The named quality that `quality` came from.
    pub preset: Preset,
    /// Accuracy settings, with those that the scene or the command line set on top of the preset.
    pub quality: Quality,
    /// Most particles of the scene's own spacing (rock included) that the world may hold.
    pub particle_limit: u32,
    /// A mark of the scene file's text, or of the save file: worlds with the same one began the same, but for their
    /// parameters and what the command line set.
    #[serde(skip)]
    pub origin: u64,
    /// The element that the palette starts with.
    pub first_element: Option<String>,
}

impl Blueprint {
    /// Most particles of the run (rock included) that the world may hold.
    pub fn most_particles(&self) -> u32 {
        scaled_count(self.particle_limit, f64::from(self.scale.detail))
    }
}

/// The number of particles that stand for as much matter at a detail as `count` of the scene's own spacing, 1 … 4 000
/// 000: more no world holds.
pub(crate) fn scaled_count(count: u32, detail: f64) -> u32 {
    (f64::from(count) * detail * detail).round().clamp(PARTICLE_LIMIT.min, PARTICLE_LIMIT.max) as u32
}
