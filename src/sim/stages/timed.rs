//! What every pass has in common: its systems are in its set, and the ledger notes each call.

use crate::{
    scene::passes::Pass,
    sim::ledger::{Call, PassLedger},
};
use bevy::{
    ecs::{
        schedule::ScheduleConfigs,
        system::{Adapt, IntoAdapterSystem, RunSystemError, ScheduleSystem},
    },
    platform::time::Instant,
    prelude::{In, IntoScheduleConfigs, IntoSystem, ResMut, System},
};
use std::time::Duration;

/// Takes the time of a system that says what it worked on.
struct Timed;

impl<S: System<In = (), Out: Into<Call>>> Adapt<S> for Timed {
    type In = ();
    type Out = (Call, Duration);

    fn adapt(
        &mut self,
        (): (),
        run_system: impl FnOnce(()) -> Result<S::Out, RunSystemError>,
    ) -> Result<Self::Out, RunSystemError> {
        let start = Instant::now();
        let call = run_system(())?.into();
        Ok((call, start.elapsed()))
    }
}

/// A system of `pass`, which returns what it worked on.
pub(super) fn timed<C: Into<Call> + 'static, M>(
    pass: Pass,
    system: impl IntoSystem<(), C, M>,
) -> ScheduleConfigs<ScheduleSystem> {
    let note = move |In((call, time)): In<(Call, Duration)>, mut ledger: ResMut<PassLedger>| {
        ledger.note(pass, call, time);
    };
    IntoAdapterSystem::new(Timed, system).pipe(note).in_set(pass)
}
