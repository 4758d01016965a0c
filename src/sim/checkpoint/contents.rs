//! What a save file holds.

use crate::{
    kernel::{
        air::Air,
        element::{Element, ElementId},
        params::{Domain, Preset, Quality},
        particles::Particles,
        predictor::Kept,
        sleep::SleepRecord,
    },
    scene::{blueprint::Blueprint, effects::EffectModes},
    sim::state::{Books, Clock, Sources},
};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// What the file holds.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Contents<'a> {
    pub scene: Cow<'a, Blueprint>,
    /// In the place of the scene's own, as are those that follow.
    pub domain: Domain,
    pub effects: EffectModes,
    pub preset: Preset,
    pub quality: Quality,
    pub elements: Vec<Element>,
    pub particles: Particles,
    pub rock: Vec<RockCell>,
    pub air: Air,
    pub kept: Kept,
    pub sleep: SleepRecord,
    pub sources: Sources,
    pub clock: Clock,
    pub books: Books,
}

/// A cell of rock.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct RockCell {
    pub column: u32,
    pub row: u32,
    pub element: ElementId,
    pub id: u32,
    /// Quanta.
    pub heat: i32,
}
