//! Heat flows, and changes matter.

use crate::{
    kernel::{heat::change, relabel::Relabelled, units::TICK_SECONDS},
    sim::{
        stages::sleep::wake_changed,
        state::{Books, Counters, HeatCurves, HeatState, ParticleStore, Rock, Setup, SleepState},
        workers::Workers,
    },
};
use bevy::prelude::{Local, Res, ResMut};

/// Gives lumps whose change is done the element that it leads to, and lets heat flow for a tick.
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
    mut relabelled: Local<Relabelled>,
) -> usize {
    let count = particles.len();
    let mut warm = setup.matter(&mut particles, &mut rock, &curves);
    change(&mut warm, &mut books, &mut relabelled);
    let report = workers.run_for(count, |threads| heat.flow(&mut warm, &mut books, threads, TICK_SECONDS));
    counters.heat_cuts += report.cuts;
    wake_changed(&mut sleep, &mut particles, &rock, &relabelled.places);
    count
}
