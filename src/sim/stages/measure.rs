//! Checks at the end of a tick.

use crate::{
    kernel::checks,
    sim::{
        ledger::{Extent, PassLedger},
        pace::Pace,
        stages::TickPlan,
        state::{AirGrid, Clock, Counters, ParticleStore, Rock, Setup},
        workers::Workers,
    },
};
use bevy::prelude::{Res, ResMut};

/// Looks for particles that are where none may be.
pub(super) fn count_escaped(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    rock: Res<Rock>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
) -> usize {
    counters.escaped += workers
        .run_for(particles.len(), |threads| checks::count_escaped(&particles, &rock, &setup.blueprint.domain, threads));
    particles.len()
}

/// Counts the tick and closes its records.
pub(super) fn end_tick(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    air: Res<AirGrid>,
    plan: Res<TickPlan>,
    mut pace: ResMut<Pace>,
    mut clock: ResMut<Clock>,
    mut ledger: ResMut<PassLedger>,
) {
    clock.tick += 1;
    pace.steps_due = pace.steps_due.saturating_sub(u32::from(pace.paused));
    let air_substeps = air.substeps_at_rest(setup.quality.air_courant, plan.substep_seconds());
    let extent = Extent {
        particles: particles.len() as u64 * u64::from(plan.substeps),
        cells: (air.columns() * air.rows()) as u64 * u64::from(air_substeps * plan.substeps),
    };
    ledger.end_tick(extent, plan.started.elapsed());
}
