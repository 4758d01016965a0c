//! Intents change the world.

use crate::{
    kernel::{
        element::ElementTable,
        forces,
        params::Preset,
        spawn::{EditReport, Matter},
        units::TICK_SECONDS,
    },
    scene::effects::{Effect, Mode},
    sim::{
        control::change_quality,
        effects::Effects,
        intent::{Intent, IntentQueue},
        recorder::Recorder,
        state::{AirGrid, Census, Clock, Counters, Elements, ParticleStore, Rock, Setup},
    },
};
use bevy::prelude::{Res, ResMut};

/// Run condition: something is to be done.
pub(super) fn has_intents(queue: Res<IntentQueue>) -> bool {
    !queue.is_empty()
}

/// Applies all waiting intents in order.
pub(super) fn apply_intents(
    (mut queue, recorder): (ResMut<IntentQueue>, Option<Res<Recorder>>),
    (mut setup, mut effects): (ResMut<Setup>, ResMut<Effects>),
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    mut air: ResMut<AirGrid>,
    elements: Res<Elements>,
    mut clock: ResMut<Clock>,
    mut counters: ResMut<Counters>,
    mut census: ResMut<Census>,
) -> usize {
    let mut refused = 0;
    let mut placed = 0;
    let before = clock.edits;
    for intent in queue.drain() {
        let seed = clock.edits;
        if let Some(recorder) = &recorder {
            recorder.note(clock.tick, intent);
        }
        clock.edits += 1;
        let air_stands = effects.get(Effect::Air).mode == Mode::Off;
        if !air_stands && moves_air(&intent, setup.elements(), &rock) {
            air.build(&rock);
        }
        let mut matter = Matter {
            domain: &setup.domain,
            elements: setup.elements(),
            particles: &mut particles,
            solids: &mut rock,
            next_id: &mut clock.next_id,
            limit: setup.blueprint.particle_limit,
        };
        let mut report = EditReport::default();
        match intent {
            Intent::Draw { element, stroke } => report = matter.pour(element, &stroke, seed),
            Intent::Stamp { element, stroke } => report = matter.stamp(element, &stroke),
            Intent::Fill { element, at } => report = matter.fill(element, at),
            Intent::Erase { stroke } => report = matter.erase(&stroke),
            Intent::Blow { .. } | Intent::Press { .. } if air_stands => {}
            Intent::Blow { stroke, velocity } => {
                let wind = air.blow(stroke.to, stroke.radius, velocity);
                if air_may_yield(&setup, &effects) {
                    let radius = stroke.radius.max(air.cell());
                    forces::drag_in_disc(stroke.to, radius, wind, &elements, &mut particles, TICK_SECONDS);
                }
            }
            Intent::Press { stroke, amount } => air.press(stroke.to, stroke.radius, amount),
            Intent::ClearAir => air.clear(),
            Intent::Quality { preset, quality } => change_quality(&mut setup, &mut air, &rock, preset, quality),
            Intent::Effect { effect, mode } => effects.get_mut(effect).mode = mode,
            Intent::Gravity { gravity } => setup.domain.gravity = gravity,
        }
        // After each one, so that it makes no difference which of them came in the same tick.
        air.set_solids(&rock);
        refused += report.refused;
        placed += report.placed;
    }
    counters.refused += refused;
    counters.add_air(&air.take_report());
    if refused > 0 || placed > 0 {
        census.full = refused > 0;
    }
    (clock.edits - before) as usize
}

/// Whether the air that the wind tool blows would stop at the first water that it meets. The tool goes on pushing, so
/// what is under it gets the wind of the tick at once, and the tool gives the momentum for it.
fn air_may_yield(setup: &Setup, effects: &Effects) -> bool {
    let runs = |effect: Effect| effects.get(effect).mode != Mode::Off;
    let yields = effects.get(Effect::AirFeedback).mode == Mode::On || setup.preset != Preset::Classic;
    runs(Effect::Drag) && runs(Effect::AirFeedback) && yields
}

/// Whether an intent may move air that has been at rest since the scene began. Rock that comes or goes does.
fn moves_air(intent: &Intent, elements: &ElementTable, rock: &Rock) -> bool {
    match intent {
        Intent::Blow { .. } | Intent::Press { .. } => true,
        Intent::Draw { element, .. } | Intent::Stamp { element, .. } | Intent::Fill { element, .. } => {
            elements.get(*element).fixed
        }
        Intent::Erase { .. } => rock.count() > 0,
        Intent::ClearAir | Intent::Quality { .. } | Intent::Effect { .. } | Intent::Gravity { .. } => false,
    }
}
