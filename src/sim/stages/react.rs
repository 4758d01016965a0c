//! What touches reacts.

use crate::{
    kernel::relabel::Relabelled,
    scene::effects::Effect,
    sim::{
        effects::Effects,
        snapshot::Clock,
        stages::sleep::wake_changed,
        state::{Books, Census, GasState, HeatCurves, ParticleStore, ReactionState, Recipes, Rock, Setup, SleepState},
        workers::Workers,
    },
};
use bevy::prelude::{Local, Res, ResMut};

/// Lets what touches react.
pub(super) fn react(
    (setup, curves, recipes): (Res<Setup>, Res<HeatCurves>, Res<Recipes>),
    (census, clock): (Res<Census>, Res<Clock>),
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    mut reactions: ResMut<ReactionState>,
    mut books: ResMut<Books>,
    mut sleep: ResMut<SleepState>,
    mut gas: ResMut<GasState>,
    (effects, workers): (Res<Effects>, Res<Workers>),
    mut relabelled: Local<Relabelled>,
) -> usize {
    // What is not there reacts with nobody, even if it is `on`.
    if !recipes.touches.is_called_for(&census.by_element) {
        return 0;
    }
    let count = particles.len();
    let mut warm = setup.matter(&mut particles, &mut rock, &curves);
    relabelled.air = effects.reaches_air(Effect::Expansion).then_some(setup.blueprint.air.density);
    workers.run_for(count, |threads| {
        let what = (&recipes.touches, &census.by_element[..]);
        reactions.react(&mut warm, what, &mut books, &mut relabelled, clock.tick, threads);
    });
    gas.extend_from_slice(&relabelled.releases);
    wake_changed(&mut sleep, &mut particles, &rock, &relabelled.places);
    count
}
