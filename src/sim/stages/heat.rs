//! Heat flows, and changes matter.

use crate::{
    kernel::{heat::change, parallel::Team, relabel::Relabelled, units::TICK_SECONDS},
    scene::effects::Effect,
    sim::{
        effects::Effects,
        stages::sleep::wake_changed,
        state::{
            AirGrid, Books, Counters, GasState, HeatCurves, HeatState, ParticleStore, Rock, Setup, SleepState,
            SolverState,
        },
        workers::Workers,
    },
};
use bevy::prelude::{Local, Res, ResMut};

/// Gives lumps whose change is done the element that it leads to, lets heat flow for a tick, and warms the air by what is warm.
pub(super) fn flow(
    (setup, curves, solver): (Res<Setup>, Res<HeatCurves>, Res<SolverState>),
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    mut heat: ResMut<HeatState>,
    mut sleep: ResMut<SleepState>,
    (mut books, mut counters): (ResMut<Books>, ResMut<Counters>),
    mut air: ResMut<AirGrid>,
    mut gas: ResMut<GasState>,
    (effects, workers): (Res<Effects>, Res<Workers>),
    mut relabelled: Local<Relabelled>,
) -> usize {
    let count = particles.len();
    let mut warm = setup.matter(&mut particles, &mut rock, &curves);
    relabelled.air = effects.reaches_air(Effect::Expansion).then_some(setup.blueprint.air.density);
    change(&mut warm, &mut books, &mut relabelled);
    let instructions = solver.instructions;
    let report = workers.run_awake(count, || {
        workers.run_for(count, |threads| heat.flow(&mut warm, &mut books, Team { instructions, threads }, TICK_SECONDS))
    });
    counters.heat_cuts += report.cuts;
    if effects.reaches_air(Effect::Convection) {
        air.warm_up(heat.contacts(), &rock);
    }
    gas.extend_from_slice(&relabelled.releases);
    wake_changed(&mut sleep, &mut particles, &rock, &relabelled.places);
    count
}
