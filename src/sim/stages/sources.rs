//! Emitters and drains.

use crate::{
    kernel::{
        checks::remove_non_finite,
        spawn::{Matter, Occupancy},
        units::TICK_SECONDS,
    },
    sim::{
        stages::TickPlan,
        state::{Clock, Counters, HeatCurves, ParticleStore, Rock, Setup, Sources},
        workers::Workers,
    },
};
use bevy::platform::time::Instant;
use bevy::prelude::{Local, Res, ResMut};

/// Begins the tick: lets emitters flow and drains take, and takes away what is no longer a number.
pub(super) fn run_sources(
    setup: Res<Setup>,
    mut sources: ResMut<Sources>,
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    mut clock: ResMut<Clock>,
    (workers, curves): (Res<Workers>, Res<HeatCurves>),
    mut plan: ResMut<TickPlan>,
    mut room: Local<Occupancy>,
    mut counters: ResMut<Counters>,
) -> usize {
    plan.started = Instant::now();
    let count = particles.len();
    counters.non_finite +=
        workers.run_checks(particles.len(), |threads| remove_non_finite(&mut particles, threads)) as u64;
    let tick = clock.tick;
    let Sources { emitters, drains, .. } = &mut *sources;
    let mut matter = Matter {
        domain: &setup.domain,
        elements: setup.elements(),
        heat: &curves,
        particles: &mut particles,
        solids: &mut rock,
        next_id: &mut clock.next_id,
        limit: setup.blueprint.most_particles(),
    };
    for drain in drains.iter() {
        matter.drain(drain);
    }
    for emitter in emitters {
        let report = matter.emit(emitter, &mut room, tick, TICK_SECONDS);
        counters.refused += report.refused;
        counters.taps_blocked += u64::from(report.blocked);
    }
    count
}
