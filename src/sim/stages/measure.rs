//! Checks at the end of a tick.

use crate::{
    kernel::checks,
    sim::{
        ledger::{Pass, PassLedger},
        pace::Pace,
        stages::TickPlan,
        state::{Clock, Counters, ParticleStore, Rock, Setup},
        workers::Workers,
    },
};
use bevy::platform::time::Instant;
use bevy::prelude::{Res, ResMut};

/// Looks for particles that are where none may be, and closes the tick's books.
pub(super) fn end_tick(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    rock: Res<Rock>,
    plan: Res<TickPlan>,
    workers: Res<Workers>,
    mut pace: ResMut<Pace>,
    mut clock: ResMut<Clock>,
    mut counters: ResMut<Counters>,
    mut ledger: ResMut<PassLedger>,
) {
    let start = Instant::now();
    counters.escaped += workers
        .run_for(particles.len(), |threads| checks::count_escaped(&particles, &rock, &setup.blueprint.domain, threads));
    clock.tick += 1;
    pace.steps_due = pace.steps_due.saturating_sub(u32::from(pace.paused));
    ledger.note(Pass::Measure, start.elapsed());
    ledger.end_tick(plan.started.elapsed());
}
