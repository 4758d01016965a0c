//! What is hot enough burns, and what fades goes.

use crate::{
    kernel::relabel::Relabelled,
    scene::effects::Effect,
    sim::{
        effects::Effects,
        snapshot::Clock,
        stages::sleep::wake_changed,
        state::{Books, DecayState, GasState, HeatCurves, ParticleStore, Recipes, Rock, Setup, SleepState},
    },
};
use bevy::prelude::{Local, Res, ResMut};

/// Lets matter become what it becomes in time.
pub(super) fn decay(
    (setup, curves, recipes, clock): (Res<Setup>, Res<HeatCurves>, Res<Recipes>, Res<Clock>),
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    mut decays: ResMut<DecayState>,
    mut books: ResMut<Books>,
    mut sleep: ResMut<SleepState>,
    mut gas: ResMut<GasState>,
    effects: Res<Effects>,
    mut relabelled: Local<Relabelled>,
) -> usize {
    let count = particles.len();
    let mut warm = setup.matter(&mut particles, &mut rock, &curves);
    relabelled.air = effects.reaches_air(Effect::Expansion).then_some(setup.blueprint.air.density);
    decays.run(&mut warm, &recipes.decays, &mut books, &mut relabelled, clock.tick);
    gas.extend_from_slice(&relabelled.releases);
    wake_changed(&mut sleep, &mut particles, &rock, &relabelled.places);
    count
}
