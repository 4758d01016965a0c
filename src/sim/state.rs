//! The resources that a world consists of. `control` fills them from a blueprint or a snapshot, the stages change them,
//! everyone else reads them.

use crate::{
    kernel::{
        air::{Air, AirReport, Release},
        decay::{Decays, table::DecayTable},
        element::{ElementParams, ElementTable, Traits},
        forces::LaterDrag,
        fracture::table::FractureTable,
        heat::{Heat, Warm, table::HeatTable},
        params::{Domain, Preset, Quality},
        particles::Particles,
        pbf::Solver,
        predictor::Predictor,
        reactions::{Reactions, table::ReactionTable},
        sleep::Sleep,
        solids::Solids,
    },
    scene::{Tuning, blueprint::Blueprint},
    sim::snapshot::Snapshot,
};
use bevy::prelude::{Deref, DerefMut, Resource};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

pub use crate::sim::snapshot::{Books, Clock, Sources};

/// Movable particles. Written by the edit stage and the substep stages.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct ParticleStore(pub Particles);

/// Rock. Written by the edit stage only.
#[derive(Resource, Deref, DerefMut, Clone, Debug)]
pub struct Rock(pub Solids);

/// The air. Written by the edit stage (tools) and the air stage.
#[derive(Resource, Deref, DerefMut, Clone, Debug)]
pub struct AirGrid(pub Air);

/// The scene that is played and the quality it is played at.
#[derive(Resource, Clone, Debug)]
pub struct Setup {
    /// The scene at the detail in force. At another than it was opened at it has nothing to start with.
    pub blueprint: Arc<Blueprint>,
    /// The scene as it was opened.
    pub opened: Arc<Blueprint>,
    /// The scene's box, with the gravity in force.
    pub domain: Domain,
    /// The named quality in force.
    pub preset: Preset,
    /// The numbers in force.
    pub quality: Quality,
    /// The state that `control::reset` goes back to: the scene's start, or the save file's, at the detail it was opened
    /// at.
    pub origin: Arc<Snapshot>,
}

impl Setup {
    /// What the knobs stand at.
    pub fn tuning(&self) -> Tuning {
        let Blueprint { fluid, particle_limit, .. } = *self.blueprint;
        Tuning { fluid, quality: self.quality, particle_limit }
    }

    /// The element table.
    pub fn elements(&self) -> &ElementTable {
        &self.blueprint.elements
    }

    /// The matter of a world, with what its heat, its changes and its reactions go by.
    pub fn matter<'a>(
        &'a self,
        particles: &'a mut Particles,
        solids: &'a mut Solids,
        table: &'a HeatTable,
    ) -> Warm<'a> {
        let scale = self.blueprint.scale;
        Warm { particles, solids, elements: self.elements(), table, domain: &self.domain, scale }
    }
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

macro_rules! counters {
    ($(#[$about:meta])* $Counters:ident; $($(#[$doc:meta])* $name:ident: $Type:ty, $what:literal, $meaning:literal;)+) => {
        $(#[$about])*
        #[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct $Counters {
            $($(#[$doc])* pub $name: $Type,)+
            /// Most substeps that a tick took.
            pub substeps_max: u32,
        }

        impl $Counters {
            /// The limiters that acted, gravest first.
            pub fn acted(&self) -> impl Iterator<Item = Acted> {
                [$(Acted { what: $what, meaning: $meaning, count: (self.$name as f64).ceil() as u64 }),+]
                    .into_iter()
                    .filter(|acted| acted.count > 0)
            }
        }
    };
}

counters! {
    /// What the limiters did, since the scene began: whatever the program does to a world besides solving its equations is
    /// counted here. In a calm scene all are zero but `substeps_max`. It is no part of the world's state: nothing reads it
    /// but those who show it. The metrics' `stability` is this.
    ///
    /// Not limiters, because they are part of a method and act on purpose: collision with rock and walls, the drains that a
    /// scene has, constants that keep a division sound (`LEAST_THETA`, `LEAST_DENSITY`), and the snap of still air to rest,
    /// which changes no pressure by more than a rounding.
    Counters;

    /// Particles removed because a coordinate or speed was not a number.
    non_finite: u64, "not a number", "particles removed because a value of theirs was no number";
    /// Particles found outside the box or inside rock at the end of a tick.
    escaped: u64, "escaped", "particles found outside the box or inside rock";
    /// Particle-substeps in which a speed was cut to the limit of the substep count.
    speed_clamps: u64, "speeds cut", "particles that were faster than the substeps can follow";
    /// Ticks whose speeds called for more substeps than the limit.
    substeps_short: u64, "ticks short of substeps", "ticks whose speeds called for more substeps";
    /// Particle-substeps in which a correction was cut to the correction limit.
    position_clamps: u64, "corrections cut", "corrections of positions that were cut to their limit";
    /// Particle-substeps in which a particle was at one point with another and was set apart.
    set_apart: u64, "set apart", "particles that were at one point with another";
    /// Particle-substeps in which an element's viscosity or vorticity confinement was cut to what a substep can take.
    strength_clamps: u64, "strengths cut", "viscosity or vorticity beyond what a substep can take";
    /// Cell-substeps in which the pressure predictor cut a density error to the range of its feedback.
    pressure_clamps: u64, "pressure cells cut", "cells too full or too thin to be put right at once";
    /// Substeps whose pressure solve stopped above its tolerance.
    pressure_unsolved: u64, "pressures unsolved", "substeps whose pressure was left above its tolerance";
    /// Lump-ticks in which an exchange of heat was cut to what evens out.
    heat_cuts: u64, "flows of heat cut", "lumps that would have given or taken more heat than evens them out";
    /// Air cells whose speed or pressure was cut.
    air_clamps: u64, "air cells cut", "cells of air whose wind or pressure was cut";
    /// Substeps of the air for which sound was slowed.
    air_slowed: u64, "times sound slowed", "substeps of the air that were too few for its sound";
    /// Air for which new rock left no place, d² at pressure 1.
    air_buried: f64, "d² of air buried", "air for which new rock left no place";
    /// Particles that were not placed because the world is full.
    refused: u64, "refused: world full", "particles that were not placed at the particle limit";
    /// Emitter-ticks in which an emitter could not give what was due for want of room.
    taps_blocked: u64, "emitters blocked", "ticks in which an emitter had no room for what was due";
}

impl Counters {
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

/// The half of the drag that comes after the move. Written by the drag stage, taken by the prediction.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct DragState(pub LaterDrag);

/// Energy of the particles at the start of the substep (`kernel::velocity::energy`), where vorticity confinement runs: it
/// may give back what the substep loses of it. Written before the first stage that moves particles.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct StartEnergy(pub f64);

/// Masses of the elements as shares of the heaviest that is there, where the effect `masses` runs; else empty. Written by
/// the gate.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct MassShares(pub Vec<f32>);

impl MassShares {
    /// They, if the effect runs.
    pub fn get(&self) -> Option<&[f32]> {
        (!self.0.is_empty()).then_some(&self.0[..])
    }
}

/// What sets elements apart in the passes over all particles. Written by the gate.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct Apart {
    /// Whether grains are there, and the effect `friction` runs.
    pub grains: bool,
    /// Whether gases are there, and the effect `buoyancy` runs.
    pub gases: bool,
    /// Whether viscous liquids are there, and the effect `viscosity` runs.
    pub viscous: bool,
}

impl Apart {
    /// It, for the passes.
    pub fn of(self, elements: &ElementParams) -> Traits<'_> {
        let Self { grains, gases, viscous } = self;
        Traits {
            sines: grains.then_some(&elements.friction[..]),
            weights: gases.then_some(&elements.weight[..]),
            drawn: viscous.then_some(&elements.drawn[..]),
        }
    }
}

/// The buffers of the exchange of heat. Written by the heat stage.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct HeatState(pub Heat);

/// How warm the elements are by their heat. Made when a scene opens.
#[derive(Resource, Deref, Clone, Debug, Default)]
pub struct HeatCurves(pub HeatTable);

/// The buffers of the reactions. Written by the stage of the reactions.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct ReactionState(pub Reactions);

/// The buffers of the decays. Written by the stage of the decays.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct DecayState(pub Decays);

/// Gas that matter gave off in this tick. Written by the stages of heat, decay and reactions, taken by the last of the tick.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct GasState(pub Vec<Release>);

/// What becomes of which elements. Made when a scene opens, and anew at another detail: smaller lumps burn and react sooner.
#[derive(Resource, Clone, Debug, Default)]
pub struct Recipes {
    /// Where they touch.
    pub touches: ReactionTable,
    /// In time.
    pub decays: DecayTable,
    /// Under the pressure of the air.
    pub fractures: FractureTable,
}

impl Recipes {
    /// Those of a scene at its detail.
    pub fn of(scene: &Blueprint) -> Self {
        let (elements, detail) = (&scene.elements, scene.scale.detail);
        Self {
            touches: ReactionTable::new(elements, detail),
            decays: DecayTable::new(elements, detail),
            fractures: FractureTable::new(elements),
        }
    }
}

/// Who sleeps. Written by the sleep stages.
#[derive(Resource, Deref, DerefMut, Clone, Debug, Default)]
pub struct SleepState(pub Sleep);

/// What the kernel's passes read of the elements. Made when a scene opens, and anew at another detail.
#[derive(Resource, Deref, Clone, Debug, Default)]
pub struct Elements(pub ElementParams);

impl Elements {
    /// Those of a scene at its scale.
    pub fn of(scene: &Blueprint) -> Self {
        Self(ElementParams::new(&scene.elements, scene.scale, scene.air.density))
    }
}
