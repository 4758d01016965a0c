//! The resources that a world consists of. `control` fills them from a blueprint or a snapshot, the stages change them,
//! everyone else reads them.

use crate::{
    kernel::{
        air::{Air, AirReport},
        element::ElementTable,
        forces::{DragTable, drag_rates},
        params::{Domain, Preset, Quality},
        particles::Particles,
        pbf::Solver,
        predictor::Predictor,
        sleep::Sleep,
        solids::Solids,
        sources::{Drain, Emitter, Wind},
        units::Scale,
    },
    scene::blueprint::Blueprint,
    sim::snapshot::Snapshot,
};
use bevy::prelude::{Deref, DerefMut, Resource};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Movable particles. Written by the edit stage and the substep stages.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct ParticleStore(pub Particles);

/// Rock. Written by the edit stage only.
#[derive(Resource, Deref, DerefMut, Clone, Debug)]
pub struct Rock(pub Solids);

/// The air. Written by the edit stage (tools) and the air stage.
#[derive(Resource, Deref, DerefMut, Clone, Debug)]
pub struct AirGrid(pub Air);

/// What the scene keeps adding and taking away. Written by the source stage.
#[derive(Resource, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sources {
    /// Taps.
    pub emitters: Vec<Emitter>,
    /// Fans.
    pub winds: Vec<Wind>,
    /// Outlets.
    pub drains: Vec<Drain>,
}

/// How far the world has come.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Clock {
    /// Ticks done since the scene began.
    pub tick: u64,
    /// Edits applied since the scene began: seeds the choice of sites that pouring fills.
    pub edits: u64,
    /// The next free particle id.
    pub next_id: u32,
}

impl Clock {
    /// Ticks and edits: what a world was put through, whatever it made of it.
    pub fn seen(&self) -> (u64, u64) {
        (self.tick, self.edits)
    }
}

/// The scene that is played and the quality it is played at.
#[derive(Resource, Clone, Debug)]
pub struct Setup {
    /// The scene as it was built.
    pub blueprint: Arc<Blueprint>,
    /// The scene's box, with the gravity in force.
    pub domain: Domain,
    /// The named quality in force.
    pub preset: Preset,
    /// The numbers in force.
    pub quality: Quality,
    /// The state that `control::reset` goes back to: the scene's start, or the save file's.
    pub origin: Arc<Snapshot>,
}

impl Setup {
    /// The element table.
    pub fn elements(&self) -> &ElementTable {
        &self.blueprint.elements
    }
}

/// What the limiters did, since the scene began: whatever the program does to a world besides solving its equations is
/// counted here. In a calm scene all are zero but `substeps_max`. It is no part of the world's state: nothing reads it
/// but those who show it. The metrics' `stability` is this.
///
/// Not limiters, because they are part of a method and act on purpose: collision with rock and walls, the drains that a
/// scene has, constants that keep a division sound (`LEAST_THETA`, `LEAST_DENSITY`), and the snap of still air to rest,
/// which changes no pressure by more than a rounding.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counters {
    /// Particles removed because a coordinate or speed was not a number.
    pub non_finite: u64,
    /// Particles found outside the box or inside rock at the end of a tick.
    pub escaped: u64,
    /// Particle-substeps in which a speed was cut to the limit of the substep count.
    pub speed_clamps: u64,
    /// Ticks whose speeds called for more substeps than the limit.
    pub substeps_short: u64,
    /// Particle-substeps in which a correction was cut to the correction limit.
    pub position_clamps: u64,
    /// Particle-substeps in which a particle was at one point with another and was set apart.
    pub set_apart: u64,
    /// Particle-substeps in which an element's viscosity or vorticity confinement was cut to what a substep can take.
    pub strength_clamps: u64,
    /// Cell-substeps in which the pressure predictor cut a density error to the range of its feedback.
    pub pressure_clamps: u64,
    /// Substeps whose pressure solve stopped above its tolerance.
    pub pressure_unsolved: u64,
    /// Air cells whose speed or pressure was cut.
    pub air_clamps: u64,
    /// Substeps of the air for which sound was slowed.
    pub air_slowed: u64,
    /// Air for which new rock left no place, d² at pressure 1.
    pub air_buried: f64,
    /// Particles that were not placed because the world is full.
    pub refused: u64,
    /// Tap-ticks in which a tap could not give what was due for want of room.
    pub taps_blocked: u64,
    /// Most substeps that a tick took.
    pub substeps_max: u32,
}

/// A limiter that acted: what the HUD shows of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acted {
    /// What it did, as words after the number.
    pub what: &'static str,
    /// What that means.
    pub meaning: &'static str,
    /// How often.
    pub count: u64,
}

impl Counters {
    /// The limiters that acted, gravest first.
    pub fn acted(&self) -> impl Iterator<Item = Acted> {
        let acted = |count, what, meaning| Acted { what, meaning, count };
        [
            acted(self.non_finite, "not a number", "particles removed because a value of theirs was no number"),
            acted(self.escaped, "escaped", "particles found outside the box or inside rock"),
            acted(self.speed_clamps, "speeds cut", "particles that were faster than the substeps can follow"),
            acted(self.substeps_short, "ticks short of substeps", "ticks whose speeds called for more substeps"),
            acted(self.position_clamps, "corrections cut", "corrections of positions that were cut to their limit"),
            acted(self.set_apart, "set apart", "particles that were at one point with another"),
            acted(self.strength_clamps, "strengths cut", "viscosity or vorticity beyond what a substep can take"),
            acted(self.pressure_clamps, "pressure cells cut", "cells too full or too thin to be put right at once"),
            acted(self.pressure_unsolved, "pressures unsolved", "substeps whose pressure was left above its tolerance"),
            acted(self.air_clamps, "air cells cut", "cells of air whose wind or pressure was cut"),
            acted(self.air_slowed, "times sound slowed", "substeps of the air that were too few for its sound"),
            acted(self.air_buried.ceil() as u64, "d² of air buried", "air for which new rock left no place"),
            acted(self.refused, "refused: world full", "particles that were not placed at the particle limit"),
            acted(self.taps_blocked, "taps blocked", "ticks in which a tap had no room for what was due"),
        ]
        .into_iter()
        .filter(|acted| acted.count > 0)
    }

    /// Adds what the air did.
    pub(super) fn add_air(&mut self, report: &AirReport) {
        self.air_clamps += report.speed_clamps + report.pressure_clamps;
        self.air_slowed += report.slowed;
        self.air_buried += report.buried;
    }
}

/// Number of particles by element, counted once a tick before the gate decides.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Rock and movable particles together.
    pub total: u32,
    /// Particles of each element, in the order of the table.
    pub by_element: Vec<u32>,
    /// Whether the last edit met the particle limit.
    pub full: bool,
    /// Rock of each element.
    pub(super) rock: Vec<u32>,
    /// Version of the rock that was counted. A world that is put in the place of another begins with a new census.
    pub(super) rock_version: Option<u64>,
}

/// The solver's buffers: positions under correction, densities, bins. Written by the substep stages.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct SolverState(pub Solver);

/// The pressure predictor's grid. Written by the pressure stage.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct PredictorState(pub Predictor);

/// Who sleeps. Written by the sleep stages.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct SleepState(pub Sleep);

/// What the elements mean to the kernel's passes, in kernel units, one entry an element.
#[derive(Resource, Clone, Debug, Default)]
pub struct Rates {
    /// k of `dv/dt = −k |v| v`, 1/d.
    pub drag: Vec<f32>,
    /// Mass of a particle, kg/m² d².
    pub mass: Vec<f32>,
    /// XSPH c.
    pub viscosity: Vec<f32>,
    /// Vorticity confinement ε, d/s.
    pub vorticity: Vec<f32>,
}

impl Rates {
    /// The rates of a scene's elements.
    pub fn new(elements: &ElementTable, scale: Scale) -> Self {
        Self {
            drag: drag_rates(elements, scale),
            mass: elements.iter().map(|(_, element)| element.density).collect(),
            viscosity: elements.iter().map(|(_, element)| element.viscosity).collect(),
            vorticity: elements.iter().map(|(_, element)| scale.to_kernel(element.vorticity)).collect(),
        }
    }

    /// What drag reads.
    pub fn drag_table(&self) -> DragTable<'_> {
        DragTable { rates: &self.drag, masses: &self.mass }
    }
}
