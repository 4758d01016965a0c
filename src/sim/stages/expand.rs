//! Gas that matter gave off in the tick comes into the air.

use crate::{
    kernel::{heat::GAS_PARTS, predict::longest_move},
    scene::effects::Effect,
    sim::{
        effects::Effects,
        stages::{TickPlan, sleep::wake_changed},
        state::{AirGrid, Books, Counters, Elements, GasState, ParticleStore, Rock, Setup, SleepState},
    },
};
use bevy::prelude::{Res, ResMut};
use glam::Vec2;

/// Part of gravity that matter at rest does not feel. Changing this affects when it wakes.
const FELT: f32 = 0.02;

/// Run condition: the air moves, or is to move.
pub(super) fn air_moves(air: Res<AirGrid>) -> bool {
    !air.is_quiet()
}

/// Finds where matter stands in the way of the air in this tick, and wakes what is pushed by more than it would feel.
pub(super) fn crowd(
    mut air: ResMut<AirGrid>,
    mut particles: ResMut<ParticleStore>,
    mut sleep: ResMut<SleepState>,
    (elements, rock, setup): (Res<Elements>, Res<Rock>, Res<Setup>),
) -> usize {
    air.crowd(&elements, &particles);
    air.press_matter();
    let places: Vec<Vec2> = air.pushed(FELT * setup.domain.gravity.length()).collect();
    wake_changed(&mut sleep, &mut particles, &rock, &places);
    particles.len()
}

/// The air pushes what stands in its way.
pub(super) fn push(
    mut air: ResMut<AirGrid>,
    mut particles: ResMut<ParticleStore>,
    mut counters: ResMut<Counters>,
    (elements, setup, plan): (Res<Elements>, Res<Setup>, Res<TickPlan>),
) -> usize {
    let dt = plan.substep_seconds();
    let most = longest_move(&setup.quality) / dt;
    air.press_matter();
    counters.speed_clamps += air.push_matter(&elements, &mut particles, most, dt);
    particles.len()
}

/// Run condition: matter gave off gas, or took some.
pub(super) fn has_gas(gas: Res<GasState>) -> bool {
    !gas.is_empty()
}

/// Lets it into the air.
pub(super) fn expand(
    mut gas: ResMut<GasState>,
    mut air: ResMut<AirGrid>,
    (mut books, mut counters): (ResMut<Books>, ResMut<Counters>),
    (rock, effects): (Res<Rock>, Res<Effects>),
) -> usize {
    let got = air.expand(&gas, effects.acts(Effect::Convection), &rock);
    counters.add_air(&air.take_report());
    books.gas += (got * GAS_PARTS).round() as i64;
    let count = gas.len();
    gas.clear();
    count
}
