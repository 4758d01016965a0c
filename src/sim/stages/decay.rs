//! What is hot enough burns, and what fades goes.

use crate::{
    kernel::relabel::Relabelled,
    sim::{
        snapshot::Clock,
        stages::sleep::wake_changed,
        state::{Books, DecayState, HeatCurves, ParticleStore, Recipes, Rock, Setup, SleepState},
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
    mut relabelled: Local<Relabelled>,
) -> usize {
    let count = particles.len();
    let mut warm = setup.matter(&mut particles, &mut rock, &curves);
    decays.run(&mut warm, &recipes.decays, &mut books, &mut relabelled, clock.tick);
    wake_changed(&mut sleep, &mut particles, &rock, &relabelled.places);
    count
}
