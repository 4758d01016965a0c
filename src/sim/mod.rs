//! The Bevy side of the kernel: its data as resources, its passes as ordered systems, and what may be done to it from
//! outside (`intent`, `control`).

pub mod checkpoint;
pub mod control;
pub mod effects;
pub mod fault;
pub mod file;
pub mod generation;
pub mod intent;
pub mod judge;
pub mod ledger;
pub mod mark;
pub mod new_file;
pub mod numbers;
pub mod pace;
pub mod picture;
pub mod recorder;
pub mod recording;
pub mod reel;
pub mod replay;
mod resample;
pub mod script;
pub mod simulation;
pub mod snapshot;
pub mod springs;
pub mod stages;
pub mod stamp;
pub mod state;
mod trial;
pub mod workers;
pub mod world_text;

use bevy::prelude::{App, Plugin};

/// The simulation: resources, stages and their order. Runs headless as well as in a window.
pub struct SimulationPlugin;

impl Plugin for SimulationPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<pace::Pace>()
            .init_resource::<generation::Generation>()
            .init_resource::<intent::IntentQueue>()
            .init_resource::<judge::Judge>()
            .init_resource::<stages::TickPlan>()
            .init_resource::<state::SolverState>()
            .init_resource::<state::PredictorState>()
            .init_resource::<state::DragState>()
            .init_resource::<state::MassShares>()
            .init_resource::<state::Apart>()
            .init_resource::<state::StartEnergy>()
            .init_resource::<state::SleepState>()
            .init_resource::<state::HeatState>()
            .init_resource::<state::HeatCurves>()
            .init_resource::<state::ReactionState>()
            .init_resource::<state::DecayState>()
            .init_resource::<state::GasState>()
            .init_resource::<state::Recipes>()
            .init_resource::<state::Books>()
            .init_resource::<workers::Workers>()
            .add_plugins(stages::plugin);
    }
}
