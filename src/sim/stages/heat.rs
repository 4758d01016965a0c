//! Heat flows, and changes matter.

use crate::{
    kernel::{
        heat::{Changed, Warm},
        units::TICK_SECONDS,
    },
    sim::{
        state::{Books, Counters, HeatCurves, HeatState, ParticleStore, Rock, Setup, SleepState},
        workers::Workers,
    },
};
use bevy::prelude::{Local, Res, ResMut};

/// Lets heat flow for a tick, and gives lumps whose change is done the element that it leads to.
pub(super) fn flow(
    setup: Res<Setup>,
    curves: Res<HeatCurves>,
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    mut heat: ResMut<HeatState>,
    mut books: ResMut<Books>,
    mut sleep: ResMut<SleepState>,
    workers: Res<Workers>,
    mut counters: ResMut<Counters>,
    mut changed: Local<Changed>,
) -> usize {
    let count = particles.len();
    let mut warm = Warm {
        particles: &mut particles,
        solids: &mut rock,
        elements: setup.elements(),
        table: &curves,
        domain: &setup.domain,
        scale: setup.blueprint.scale,
    };
    let report = workers.run_for(count, |threads| heat.flow(&mut warm, &mut books, threads, TICK_SECONDS));
    counters.heat_cuts += report.cuts;
    heat.change(&mut warm, &mut books, &mut changed);
    sleep.disturb(&changed.places);
    count
}
