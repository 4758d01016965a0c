//! Counts and checks at the end of a tick.

use crate::{
    kernel::checks,
    sim::{
        ledger::{Pass, PassLedger},
        pace::Pace,
        stages::TickPlan,
        state::{Census, Clock, Counters, ParticleStore, Rock, Setup},
        workers::Workers,
    },
};
use bevy::platform::time::Instant;
use bevy::prelude::{Res, ResMut};

/// Counts the particles of each element.
pub(super) fn count_particles(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    rock: Res<Rock>,
    mut census: ResMut<Census>,
) {
    census.by_element.clear();
    census.by_element.resize(setup.elements().len(), 0);
    checks::count_elements(&particles.element, &mut census.by_element);
    for (_, element, _) in rock.iter() {
        census.by_element[element.index()] += 1;
    }
    census.total = (particles.len() + rock.count()) as u32;
}

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
