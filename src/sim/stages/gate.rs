//! Decides which effects run in a tick, and how many substeps it takes.

use crate::{
    kernel::{element::Element, forces::DragTable, params::Preset, predict, units::TICK_SECONDS},
    scene::blueprint::{Effect, Mode},
    sim::{
        effects::Effects,
        stages::{TickPlan, sleep},
        state::{AirGrid, Census, Counters, ParticleStore, Rates, Setup, SleepState, Sources},
    },
};
use bevy::prelude::{Res, ResMut};

/// Plans the tick from facts that are there already.
pub(super) fn plan_tick(
    setup: Res<Setup>,
    particles: Res<ParticleStore>,
    air: Res<AirGrid>,
    sources: Res<Sources>,
    census: Res<Census>,
    asleep: Res<SleepState>,
    rates: Res<Rates>,
    mut effects: ResMut<Effects>,
    mut counters: ResMut<Counters>,
    mut plan: ResMut<TickPlan>,
) {
    let present = |wanted: &dyn Fn(&Element) -> bool| {
        let mut counted = setup.elements().iter().zip(&census.by_element);
        counted.any(|((_, element), &count)| count > 0 && !element.fixed && wanted(element))
    };
    let called = |called: bool, yes: &'static str, no: &'static str| (called, if called { yes } else { no });
    let feels_air = present(&|element| element.drag > 0.0);
    let drag_runs = match effects.get(Effect::Drag).mode {
        Mode::Auto => feels_air,
        mode => mode == Mode::On,
    };
    let air_is_off = effects.get(Effect::Air).mode == Mode::Off;
    let fastest = predict::fastest(&particles.vx, &particles.vy);
    let drag = DragTable { rates: &rates.drag, masses: &rates.mass };
    let stirs = air.may_be_roused(drag, fastest, TICK_SECONDS / setup.quality.substeps as f32);
    effects.decide(
        Effect::AirFeedback,
        if air_is_off {
            (false, "the air is switched off")
        } else if !drag_runs || !feels_air {
            (false, "no particle feels the air")
        } else if setup.preset == Preset::Classic {
            (false, "not in this quality")
        } else {
            called(stirs || !air.is_quiet(), "particles meet moving air", "particles and air are still")
        },
    );
    let fed = effects.get(Effect::AirFeedback).running;
    effects.decide(
        Effect::Air,
        if !sources.winds.is_empty() {
            (true, "a fan drives the air")
        } else if fed && air.is_quiet() {
            (true, "particles drag it along")
        } else {
            called(!air.is_quiet(), "the air moves", "the air is still")
        },
    );
    effects.decide(Effect::Drag, called(feels_air, "particles feel the air", "no particle feels the air"));
    effects.decide(
        Effect::Predictor,
        if setup.quality.predictor {
            called(!particles.is_empty(), "a liquid is there", "no liquid")
        } else {
            (false, "not in this quality")
        },
    );
    effects.decide(
        Effect::Tension,
        called(
            !particles.is_empty() && setup.blueprint.fluid.tension_strength > 0.0,
            "a liquid is there",
            "no liquid, or its tension is 0",
        ),
    );
    effects.decide(
        Effect::Viscosity,
        called(present(&|element| element.viscosity > 0.0), "a viscous liquid is there", "nothing is viscous"),
    );
    effects.decide(
        Effect::Vorticity,
        called(present(&|element| element.vorticity > 0.0), "a liquid keeps its eddies", "nothing keeps its eddies"),
    );
    let wanted = predict::substeps(fastest, &setup.domain, &setup.quality, TICK_SECONDS);
    plan.substeps = wanted.count;
    counters.substeps_short += u64::from(wanted.short);
    effects.decide(Effect::Sleep, sleep::is_called_for(&setup, asleep.asleep(), particles.len(), !air.is_quiet()));
    counters.substeps_max = counters.substeps_max.max(plan.substeps);
}
