//! The stages of a tick as thin systems: each unpacks resources, calls the kernel and notes the time.

mod count;
mod edit;
mod gate;
mod measure;
mod sleep;
mod sources;
mod step;
mod substep;

use crate::{
    scene::blueprint::Effect,
    sim::{
        effects::runs,
        pace::time_moves,
        schedule::{Substep, SubstepSystems, TickSystems},
        script::{self, Script},
    },
};
use bevy::{
    ecs::schedule::{LogLevel, ScheduleBuildSettings, SingleThreadedExecutor},
    prelude::{App, FixedUpdate, IntoScheduleConfigs, Schedule, resource_exists},
};

pub use step::TickPlan;

/// Adds the stages in their order.
pub(super) fn plugin(app: &mut App) {
    // The stages are a chain: there is nothing to run side by side, and handing each to another thread takes longer than
    // some of them and allocates.
    app.edit_schedule(FixedUpdate, |schedule| {
        schedule.set_executor(SingleThreadedExecutor::new());
    });
    app.configure_sets(
        FixedUpdate,
        (
            TickSystems::Script.run_if(resource_exists::<Script>).run_if(time_moves),
            TickSystems::Edit,
            TickSystems::Sources.run_if(time_moves),
            TickSystems::Count,
            (TickSystems::Gate, TickSystems::Step, TickSystems::Measure).chain().run_if(time_moves),
        )
            .chain(),
    );
    app.add_systems(
        FixedUpdate,
        (
            script::run.in_set(TickSystems::Script),
            edit::apply_intents.in_set(TickSystems::Edit),
            sources::run_sources.in_set(TickSystems::Sources),
            (sleep::check_sleepers.run_if(sleep::anyone_sleeps), count::count_particles)
                .chain()
                .in_set(TickSystems::Count),
            (gate::plan_tick, sleep::keep_asleep).chain().in_set(TickSystems::Gate),
            step::run_substeps.in_set(TickSystems::Step),
            (sleep::watch.run_if(sleep::water_may_rest).run_if(sleep::is_time_to_look), measure::end_tick)
                .chain()
                .in_set(TickSystems::Measure),
        ),
    );
    app.add_schedule(substep_schedule());
}

fn substep_schedule() -> Schedule {
    let mut schedule = Schedule::new(Substep);
    // A chain, too.
    schedule.set_executor(SingleThreadedExecutor::new());
    schedule.set_build_settings(ScheduleBuildSettings { ambiguity_detection: LogLevel::Error, ..Default::default() });
    schedule.configure_sets(
        (
            SubstepSystems::Air,
            (
                SubstepSystems::Forces,
                SubstepSystems::Pressure,
                SubstepSystems::Predict,
                SubstepSystems::Bin,
                SubstepSystems::Solve,
                SubstepSystems::Velocity,
            )
                .chain()
                .run_if(sleep::anyone_is_awake),
        )
            .chain(),
    );
    schedule.add_systems((
        (
            substep::step_air.run_if(runs(Effect::Air)),
            sleep::wake_blown.run_if(runs(Effect::Drag)).run_if(sleep::anyone_sleeps),
        )
            .chain()
            .in_set(SubstepSystems::Air),
        (substep::apply_gravity, substep::apply_drag.run_if(runs(Effect::Drag))).chain().in_set(SubstepSystems::Forces),
        substep::predict_pressure.run_if(runs(Effect::Predictor)).in_set(SubstepSystems::Pressure),
        (substep::predict_positions, sleep::wake_touched.run_if(sleep::anyone_sleeps))
            .chain()
            .in_set(SubstepSystems::Predict),
        substep::sort_into_bins.in_set(SubstepSystems::Bin),
        substep::solve_density.in_set(SubstepSystems::Solve),
        (
            substep::update_velocities,
            substep::apply_viscosity.run_if(runs(Effect::Viscosity)),
            substep::apply_vorticity.run_if(runs(Effect::Vorticity)),
        )
            .chain()
            .in_set(SubstepSystems::Velocity),
    ));
    schedule
}
