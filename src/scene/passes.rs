//! The table of passes: what a tick consists of. `sim::stages` orders and runs them, `scene::effects` says which of them a
//! scene can switch.

use super::table::table;
use bevy::prelude::SystemSet;
use serde::Serialize;

/// What a pass works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Particles, each once a call.
    Particles,
    /// Cells of the air, each once a substep of the air.
    Cells,
    /// Edits.
    Edits,
}

impl Unit {
    /// Plural.
    pub fn name(self) -> &'static str {
        match self {
            Self::Particles => "particles",
            Self::Cells => "cells",
            Self::Edits => "edits",
        }
    }
}

/// A row of the table of passes.
#[derive(Debug)]
pub struct PassRow {
    /// Name in the metrics and on the screen.
    pub name: &'static str,
    /// What it works on.
    pub unit: Unit,
    /// Whether every substep has it, so that it is spared whatever it does not work on. The others leave nothing out.
    pub each_substep: bool,
}

table! {
    /// A pass of the tick, which is also the set of its systems. In the order in which they run first; `sim::stages` has
    /// their systems and conditions.
    #[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
    Pass: PassRow;

    /// Intents change the world.
    Edit { name: "edit", unit: Unit::Edits, each_substep: false }
    /// Emitters and drains.
    Sources { name: "sources", unit: Unit::Particles, each_substep: false }
    /// The air moves.
    Air { name: "air", unit: Unit::Cells, each_substep: true }
    /// Gravity changes velocities.
    Gravity { name: "gravity", unit: Unit::Particles, each_substep: true }
    /// Particles drag the air.
    Feedback { name: "air_feedback", unit: Unit::Particles, each_substep: true }
    /// The air drags particles.
    Drag { name: "drag", unit: Unit::Particles, each_substep: true }
    /// The pressure predictor makes velocities nearly divergence-free.
    Pressure { name: "pressure", unit: Unit::Particles, each_substep: true }
    /// Positions are predicted from velocities and swept against rock and box.
    Predict { name: "predict", unit: Unit::Particles, each_substep: true }
    /// Particles are sorted into bins.
    Bin { name: "bin", unit: Unit::Particles, each_substep: true }
    /// The density constraint moves particles.
    Solve { name: "solve", unit: Unit::Particles, each_substep: true }
    /// Velocities follow from the moves.
    Velocity { name: "velocity", unit: Unit::Particles, each_substep: true }
    /// XSPH viscosity.
    Viscosity { name: "viscosity", unit: Unit::Particles, each_substep: true }
    /// Vorticity confinement.
    Vorticity { name: "vorticity", unit: Unit::Particles, each_substep: true }
    /// Gases wander.
    Diffusion { name: "diffusion", unit: Unit::Particles, each_substep: true }
    /// Rock breaks.
    Fracture { name: "fracture", unit: Unit::Particles, each_substep: false }
    /// Heat flows, and changes matter.
    Heat { name: "heat", unit: Unit::Particles, each_substep: false }
    /// What burns and what fades.
    Decay { name: "decay", unit: Unit::Particles, each_substep: false }
    /// What touches reacts.
    React { name: "react", unit: Unit::Particles, each_substep: false }
    /// Gas that matter gave off comes into the air.
    Expand { name: "expand", unit: Unit::Particles, each_substep: false }
    /// Particles fall asleep and wake.
    Sleep { name: "sleep", unit: Unit::Particles, each_substep: false }
    /// Checks at the end of the tick.
    Measure { name: "measure", unit: Unit::Particles, each_substep: false }
}

impl Pass {
    /// What it works on.
    pub fn unit(self) -> Unit {
        self.row().unit
    }
}
