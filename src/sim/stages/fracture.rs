//! Rock breaks under the pressure of the air.

use crate::{
    kernel::{fracture, relabel::Relabelled},
    sim::{
        stages::{TickPlan, sleep::wake_changed},
        state::{AirGrid, Books, HeatCurves, ParticleStore, Recipes, Rock, Setup, SleepState},
    },
};
use bevy::prelude::{Local, Res, ResMut};

/// Run condition: at the start of the tick the air pressed harder than a layer of the weakest of the rock bears. So it is the same
/// whether the effect is `on` or `auto`.
pub(super) fn is_pressed(plan: Res<TickPlan>) -> bool {
    plan.presses
}

/// Breaks what the air presses on harder than it bears, once it has spread as far as it does in the tick.
pub(super) fn fracture(
    (setup, curves, recipes): (Res<Setup>, Res<HeatCurves>, Res<Recipes>),
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    air: Res<AirGrid>,
    mut books: ResMut<Books>,
    mut sleep: ResMut<SleepState>,
    mut relabelled: Local<Relabelled>,
) -> usize {
    let count = rock.count();
    let mut warm = setup.matter(&mut particles, &mut rock, &curves);
    fracture::fracture(&mut warm, &recipes.fractures, &air, &mut books, &mut relabelled);
    wake_changed(&mut sleep, &mut particles, &rock, &relabelled.places);
    count
}
