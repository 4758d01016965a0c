//! The stages of a tick as thin systems: each unpacks resources, calls the kernel and returns what it worked on. This is the
//! table of contents of a tick: what runs, in which order, and under which condition.

mod count;
mod decay;
mod edit;
mod expand;
mod fracture;
mod gate;
mod heat;
mod measure;
mod react;
mod rock;
mod sleep;
mod sources;
mod step;
mod substep;
mod timed;

use crate::{
    scene::{effects::Effect, passes::Pass},
    sim::{
        effects::runs,
        judge,
        pace::time_moves,
        script::{self, Script},
    },
};
use bevy::{
    ecs::schedule::{LogLevel, ScheduleBuildSettings, SingleThreadedExecutor},
    prelude::{App, FixedUpdate, IntoScheduleConfigs, Schedule, resource_exists},
};
use timed::timed;

pub use step::{Substep, TickPlan};

/// Adds the stages of a tick in their order.
pub(super) fn plugin(app: &mut App) {
    // The stages are a chain: there is nothing to run side by side, and handing each to another thread takes longer than
    // some of them and allocates.
    app.edit_schedule(FixedUpdate, |schedule| {
        schedule.set_executor(SingleThreadedExecutor::new());
    });
    app.add_systems(
        FixedUpdate,
        (
            script::run.run_if(resource_exists::<Script>).run_if(time_moves),
            timed(Pass::Edit, edit::apply_intents).run_if(edit::has_intents),
            timed(Pass::Sources, sources::run_sources).run_if(time_moves),
            timed(Pass::Sleep, sleep::check_sleepers).run_if(sleep::any_asleep),
            count::count_particles,
            (
                gate::plan_tick,
                gate::plan_substeps,
                timed(Pass::Expand, expand::crowd).run_if(runs(Effect::Expansion)),
                sleep::keep_asleep,
                step::run_substeps,
                timed(Pass::Fracture, fracture::fracture).run_if(runs(Effect::Fracture)).run_if(fracture::is_pressed),
                // Each before those that may give it its first work: what the gate left out has nothing to do in the tick.
                timed(Pass::Heat, heat::flow).run_if(runs(Effect::Heat)),
                timed(Pass::Decay, decay::decay).run_if(runs(Effect::Decay)),
                timed(Pass::React, react::react).run_if(runs(Effect::Reactions)),
                rock::show_to_air,
                timed(Pass::Expand, expand::expand).run_if(expand::has_gas),
                timed(Pass::Sleep, sleep::watch).run_if(sleep::water_may_rest).run_if(sleep::is_time_to_look),
                timed(Pass::Measure, measure::count_escaped),
                measure::end_tick.in_set(Pass::Measure),
                judge::judge.run_if(judge::is_running),
            )
                .chain()
                .run_if(time_moves),
        )
            .chain(),
    );
    app.add_schedule(substep());
}

/// The stages of a substep in their order.
fn substep() -> Schedule {
    let mut schedule = Schedule::new(Substep);
    // A chain, too.
    schedule.set_executor(SingleThreadedExecutor::new());
    schedule.set_build_settings(ScheduleBuildSettings { ambiguity_detection: LogLevel::Error, ..Default::default() });
    schedule.add_systems(
        (
            timed(Pass::Air, substep::step_air).run_if(runs(Effect::Air)),
            timed(Pass::Expand, expand::push).run_if(runs(Effect::Expansion)).run_if(expand::air_moves),
            timed(Pass::Sleep, sleep::wake_blown).run_if(runs(Effect::Drag)).run_if(sleep::any_asleep),
            (
                timed(Pass::Gravity, substep::begin_kick),
                timed(Pass::Feedback, substep::drag_air).run_if(runs(Effect::AirFeedback)),
                timed(Pass::Drag, substep::apply_drag).run_if(runs(Effect::Drag)),
                timed(Pass::Pressure, substep::predict_pressure).run_if(runs(Effect::Predictor)),
                timed(Pass::Predict, substep::predict_positions),
                timed(Pass::Sleep, sleep::wake_touched).run_if(sleep::any_asleep),
                timed(Pass::Bin, substep::sort_into_bins),
                timed(Pass::Solve, substep::solve_density),
                timed(Pass::Velocity, substep::update_velocities),
                timed(Pass::Viscosity, substep::apply_viscosity).run_if(runs(Effect::Viscosity)),
                timed(Pass::Vorticity, substep::apply_vorticity).run_if(runs(Effect::Vorticity)),
                timed(Pass::Diffusion, substep::spread_gases).run_if(runs(Effect::Diffusion)),
            )
                .chain()
                .run_if(sleep::any_awake),
        )
            .chain(),
    );
    schedule
}
