//! The order of a tick. `FixedUpdate` holds the tick; the stages that are repeated for each substep stand in a schedule
//! of their own, which the step stage runs.

use bevy::{ecs::schedule::ScheduleLabel, prelude::SystemSet};

/// The stages of a tick, in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TickSystems {
    /// The scene's script acts, if it has one.
    Script,
    /// Intents change the world; runs while paused, too.
    Edit,
    /// Taps and outlets.
    Sources,
    /// Counts the particles: nothing places or takes any after it. Runs while paused, too.
    Count,
    /// Decides which effects run and how many substeps it takes.
    Gate,
    /// Runs [`Substep`] as often as it takes.
    Step,
    /// Checks, and closes the books of the tick.
    Measure,
}

/// The schedule of one substep.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Substep;

/// The stages of a substep, in order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SubstepSystems {
    /// The air moves, in substeps of its own.
    Air,
    /// Gravity and drag change velocities.
    Forces,
    /// The pressure predictor makes velocities nearly divergence-free.
    Pressure,
    /// Velocities predict positions, swept against rock and box.
    Predict,
    /// Particles are sorted into bins; candidate ranges are built.
    Bin,
    /// The density constraint corrects the positions.
    Solve,
    /// Velocities follow from the moves; viscosity and vorticity change them.
    Velocity,
}
