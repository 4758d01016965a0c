//! What a save file holds.

use crate::{
    kernel::{
        air::Air,
        element::{Element, ElementId},
        params::{AirParams, Domain, FluidParams, Quality},
        particles::Particles,
        sleep::SleepRecord,
        units::Scale,
    },
    scene::effects::Mode,
    sim::state::{Clock, Sources},
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What the file holds. Effects and the preset go by name, so that new ones don't shift the old.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Contents {
    pub name: String,
    pub title: String,
    pub description: String,
    pub parameters: BTreeMap<String, f64>,
    pub scale: Scale,
    pub domain: Domain,
    pub elements: Vec<Element>,
    pub fluid: FluidParams,
    pub air_params: AirParams,
    pub effects: Vec<(String, Mode)>,
    pub preset: String,
    pub quality: Quality,
    pub particle_limit: u32,
    pub first_element: Option<String>,
    pub particles: Particles,
    pub rock: Vec<RockCell>,
    pub air: Air,
    pub pressure: Vec<f32>,
    pub sleep: SleepRecord,
    pub sources: Sources,
    pub clock: Clock,
}

/// A cell of rock.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct RockCell {
    pub column: u32,
    pub row: u32,
    pub element: ElementId,
    pub id: u32,
}
