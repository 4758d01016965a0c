//! Gathers the facts of a tick, lets the table of effects decide by them, and plans how many substeps it takes.

use crate::{
    kernel::{predict, units::TICK_SECONDS},
    scene::effects::{Effect, Facts, Mode},
    sim::{
        effects::Effects,
        stages::TickPlan,
        state::{AirGrid, Census, Counters, Elements, ParticleStore, Setup, SleepState, Sources},
    },
};
use bevy::prelude::{Res, ResMut};

/// Plans the tick from facts that are there already.
pub(super) fn plan_tick(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    mut air: ResMut<AirGrid>,
    sources: Res<Sources>,
    census: Res<Census>,
    asleep: Res<SleepState>,
    elements: Res<Elements>,
    mut effects: ResMut<Effects>,
    mut counters: ResMut<Counters>,
    mut plan: ResMut<TickPlan>,
) {
    let fastest = predict::fastest(&particles.vx, &particles.vy);
    let modes = effects.wanted();
    // Air that is switched off stands: a wind that froze would blow for ever.
    if modes[Effect::Air as usize] == Mode::Off && !air.is_quiet() {
        air.clear();
    }
    effects.decide(&Facts {
        modes,
        preset: setup.preset,
        predicts: setup.quality.predictor,
        elements: setup.elements(),
        counts: &census.by_element,
        particles: particles.len(),
        asleep: asleep.asleep(),
        has_tension: setup.blueprint.fluid.tension_strength > 0.0,
        has_winds: !sources.winds.is_empty(),
        air_moves: !air.is_quiet(),
        stirs_air: air.may_be_roused(&elements, fastest, TICK_SECONDS / setup.quality.substeps as f32),
    });
    let wanted = predict::substeps(fastest, &setup.domain, &setup.quality, setup.blueprint.scale.detail, TICK_SECONDS);
    plan.substeps = wanted.count;
    counters.substeps_short += u64::from(wanted.short);
    counters.substeps_max = counters.substeps_max.max(plan.substeps);
}
