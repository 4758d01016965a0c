//! Gathers the facts of a tick and lets the table of effects decide by them, and plans how many substeps it takes.

use crate::{
    kernel::{checks, crowding::Crowding, fracture, predict, units::TICK_SECONDS},
    scene::effects::{Effect, Facts, Mode},
    sim::{
        effects::Effects,
        stages::TickPlan,
        state::{
            AirGrid, Apart, Census, Counters, Elements, MassShares, ParticleStore, Recipes, Rock, Setup, SleepState,
            Sources,
        },
        workers::Workers,
    },
};
use bevy::prelude::{Local, Res, ResMut};

/// Plans the tick from facts that are there already.
pub(super) fn plan_tick(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    mut air: ResMut<AirGrid>,
    sources: Res<Sources>,
    census: Res<Census>,
    (asleep, rock, workers): (Res<SleepState>, Res<Rock>, Res<Workers>),
    (elements, recipes): (Res<Elements>, Res<Recipes>),
    (mut effects, mut plan): (ResMut<Effects>, ResMut<TickPlan>),
    mut shares: ResMut<MassShares>,
    mut apart: ResMut<Apart>,
) {
    plan.fastest =
        workers.run_checks(particles.len(), |threads| checks::fastest([&particles.vx, &particles.vy], threads));
    let modes = effects.wanted();
    // Air that is switched off stands: a wind that froze would blow for ever.
    if modes[Effect::Air as usize] == Mode::Off && !air.is_quiet() {
        air.clear();
    }
    let has_heat = particles.has_heat() || !rock.heats().is_empty();
    plan.presses = fracture::presses(&air, &recipes.fractures, &census.by_element, setup.blueprint.scale);
    let facts = Facts {
        modes: &modes,
        preset: setup.preset,
        predicts: setup.quality.predictor,
        elements: setup.elements(),
        air_density: setup.blueprint.air.density,
        counts: &census.by_element,
        particles: particles.len(),
        asleep: asleep.asleep(),
        has_heat,
        air_is_warm: air.is_warm(),
        presses: plan.presses,
        can_react: recipes.touches.is_called_for(&census.by_element),
        may_decay: recipes.decays.is_called_for(&census.by_element, has_heat),
        has_tension: setup.blueprint.fluid.tension_strength > 0.0,
        has_winds: !sources.winds.is_empty(),
        air_moves: !air.is_quiet(),
        stirs_air: {
            let substep = TICK_SECONDS / setup.quality.substeps as f32;
            air.may_be_roused(&elements, &census.by_element, plan.fastest, substep)
        },
    };
    effects.decide(&facts);
    shares.clear();
    // Where all is as heavy there is nothing to it, even if it is `on`.
    if let Some([_, heaviest]) = facts.densities().filter(|_| effects.get(Effect::Masses).running) {
        shares.extend(elements.mass.iter().map(|mass| mass / heaviest));
    }
    *apart = Apart {
        grains: facts.has_grains() && effects.acts(Effect::Friction),
        gases: facts.has_gases() && effects.acts(Effect::Buoyancy),
        viscous: facts.has_viscous() && effects.acts(Effect::Viscosity),
    };
}

/// Plans how many substeps the tick takes.
pub(super) fn plan_substeps(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    mut counters: ResMut<Counters>,
    mut plan: ResMut<TickPlan>,
    mut crowding: Local<Crowding>,
) {
    // The substeps of a preset make up for the detail of its own.
    let finer = f64::from(setup.blueprint.scale.detail) / setup.preset.detail();
    let length = (finer as f32, TICK_SECONDS);
    let crowding = || crowding.of(&particles, setup.domain.size);
    let wanted = predict::substeps(plan.fastest, &setup.domain, &setup.quality, length, crowding);
    plan.substeps = wanted.count;
    counters.substeps_short += u64::from(wanted.short);
    counters.substeps_max = counters.substeps_max.max(plan.substeps);
}
