//! Intents change the world.

use crate::{
    kernel::{
        decay::ignite_under,
        element::ElementTable,
        forces,
        heat::{set_under, warm_under},
        params::Preset,
        piece::lowest_cell,
        predictor::Kept,
        sleep::{Sleep, SleepRecord},
        spawn::{EditReport, Matter, Pouring},
        units::TICK_SECONDS,
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{
        control::change_quality,
        effects::Effects,
        intent::{Intent, IntentQueue},
        judge::Judge,
        recorder::Recorder,
        snapshot::Snapshot,
        stamp::fitted,
        state::{
            AirGrid, Books, Census, Clock, Counters, Elements, HeatCurves, ParticleStore, PredictorState, Recipes,
            Rock, Setup, SleepState, SolverState, Sources,
        },
    },
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Res, ResMut},
};
use glam::Vec2;

/// Run condition: something is to be done.
pub(super) fn has_intents(queue: Res<IntentQueue>) -> bool {
    !queue.is_empty()
}

/// What else changes with the detail.
#[derive(SystemParam)]
pub(super) struct Derived<'w> {
    elements: ResMut<'w, Elements>,
    sources: ResMut<'w, Sources>,
    predictor: ResMut<'w, PredictorState>,
    sleep: ResMut<'w, SleepState>,
    solver: ResMut<'w, SolverState>,
    curves: Res<'w, HeatCurves>,
    recipes: ResMut<'w, Recipes>,
    books: ResMut<'w, Books>,
    judge: ResMut<'w, Judge>,
}

/// Applies all waiting intents in order.
pub(super) fn apply_intents(
    (mut queue, recorder): (ResMut<IntentQueue>, Option<Res<Recorder>>),
    (mut setup, mut effects): (ResMut<Setup>, ResMut<Effects>),
    mut particles: ResMut<ParticleStore>,
    mut rock: ResMut<Rock>,
    mut air: ResMut<AirGrid>,
    mut derived: Derived,
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
            recorder.note(clock.tick, &intent);
        }
        derived.judge.see(&intent, &setup, &clock);
        clock.edits += 1;
        let wanted = match intent {
            Intent::Detail { detail } => Some((detail, setup.preset)),
            Intent::Quality { preset, .. } if preset.detail() != setup.preset.detail() => {
                Some((setup.asked_detail(), preset))
            }
            _ => None,
        };
        if let Some((detail, preset)) = wanted {
            let mut world = Parts {
                setup: &mut setup,
                particles: &mut particles,
                rock: &mut rock,
                air: &mut air,
                clock: &mut clock,
                derived: &mut derived,
            };
            if !world.change_detail(detail, preset) {
                continue;
            }
            *census = Census::default();
        }
        let air_stands = effects.get(Effect::Air).mode == Mode::Off;
        if !air_stands && moves_air(&intent, setup.elements(), &rock) {
            air.build(&rock);
        }
        let mut matter = Matter {
            domain: &setup.domain,
            elements: setup.elements(),
            heat: &derived.curves,
            particles: &mut particles,
            solids: &mut rock,
            next_id: &mut clock.next_id,
            limit: setup.blueprint.most_particles(),
        };
        let mut report = EditReport::default();
        match intent {
            Intent::Draw { .. }
            | Intent::Pour { .. }
            | Intent::Stamp { .. }
            | Intent::Fill { .. }
            | Intent::Erase { .. }
            | Intent::Replace { .. }
            | Intent::ReplaceAround { .. }
            | Intent::EraseOnly { .. }
            | Intent::EraseAround { .. }
            | Intent::Paste { .. } => {
                let mut places = Vec::new();
                report = edit_matter(&mut matter, &intent, seed, (&setup.blueprint, &mut places));
                derived.sleep.disturb(&places);
            }
            Intent::Blow { .. } | Intent::Press { .. } if air_stands => {}
            Intent::Blow { stroke, velocity } => {
                let wind = air.blow(stroke.to, stroke.radius, velocity);
                // A tool that moves no air pushes nothing, either.
                if !air.is_quiet() && air_may_yield(&setup, &effects) {
                    let radius = stroke.radius.max(air.cell());
                    forces::drag_in_disc(stroke.to, radius, wind, &derived.elements, &mut particles, TICK_SECONDS);
                }
            }
            Intent::Press { stroke, amount } => air.press(stroke.to, stroke.radius, amount),
            Intent::ClearAir => air.clear(),
            Intent::Quality { preset, quality } => change_quality(&mut setup, &mut air, &rock, preset, quality),
            Intent::Effect { effect, mode } => effects.get_mut(effect).mode = mode,
            Intent::Gravity { gravity } => setup.domain.gravity = gravity,
            Intent::Detail { .. } | Intent::Begin { .. } | Intent::Stroke | Intent::GiveUp => {}
            Intent::Warm { stroke, degrees } => {
                let mut warm = setup.matter(&mut particles, &mut rock, &derived.curves);
                warm_under(&mut warm, &stroke, degrees, &mut derived.books);
            }
            Intent::SetTemperature { stroke, kelvin } => {
                let mut warm = setup.matter(&mut particles, &mut rock, &derived.curves);
                set_under(&mut warm, &stroke, kelvin, &mut derived.books);
            }
            Intent::SetEmitter { element, stroke } => {
                derived.sources.add_emitter(element, &stroke, &setup.blueprint);
            }
            Intent::SetDrain { stroke } => derived.sources.add_drain(&stroke, &setup.blueprint),
            Intent::RemoveSources { stroke } => derived.sources.remove_under(&stroke),
            Intent::PasteSources { springs } => derived.sources.add_springs(&springs, &setup.blueprint),
            Intent::Ignite { stroke } => {
                let mut warm = setup.matter(&mut particles, &mut rock, &derived.curves);
                ignite_under(&mut warm, &derived.recipes.decays, &stroke, &mut derived.books);
            }
        }
        // After each one, so that it makes no difference which of them came in the same tick.
        air.set_solids(&rock);
        refused += report.refused;
        placed += report.placed;
        derived.judge.count(report.placed, &setup);
    }
    counters.refused += refused;
    counters.add_air(&air.take_report());
    if refused > 0 || placed > 0 {
        census.full = refused > 0;
    }
    (clock.edits - before) as usize
}

/// Places matter, changes it or takes it away, where that is what an intent wants. `places` gets where what moves became
/// something else, d.
fn edit_matter(
    matter: &mut Matter,
    intent: &Intent,
    seed: u64,
    (scene, places): (&Blueprint, &mut Vec<Vec2>),
) -> EditReport {
    match *intent {
        Intent::Draw { element, stroke } => matter.drip(element, &stroke, seed),
        Intent::Pour { element, stroke, velocity, share } => {
            matter.pour(element, &stroke, Pouring { velocity, share }, seed)
        }
        Intent::Stamp { element, stroke } => matter.stamp(element, &stroke),
        Intent::Fill { element, at } => matter.fill(element, at),
        Intent::Erase { stroke } => matter.erase(&stroke),
        Intent::Replace { element, stroke } => matter.replace(element, &stroke, places),
        Intent::ReplaceAround { element, at } => matter.replace_around(element, at, places),
        Intent::EraseOnly { element, stroke } => matter.erase_only(element, &stroke),
        Intent::EraseAround { element, at } => matter.erase_around(element, at),
        Intent::Paste { ref piece, at, turn } => match fitted(piece, scene) {
            Ok(piece) => matter.paste(&piece, lowest_cell(at, turn.size(piece.size)), turn),
            Err(_) => EditReport { refused: piece.count() as u64, ..EditReport::default() },
        },
        _ => EditReport::default(),
    }
}

/// The parts of a world that change with its detail.
struct Parts<'a, 'w> {
    setup: &'a mut Setup,
    particles: &'a mut ParticleStore,
    rock: &'a mut Rock,
    air: &'a mut AirGrid,
    clock: &'a mut Clock,
    derived: &'a mut Derived<'w>,
}

impl Parts<'_, '_> {
    /// Goes on at a detail that is asked for, at a preset that may have its own; `false` if the world does not fit it,
    /// and stays what it is. A player was told before (`control::check_detail`).
    fn change_detail(&mut self, detail: f64, preset: Preset) -> bool {
        let Ok(setup) = self.setup.at_detail(detail, preset) else { return false };
        let Derived { elements, recipes, sources, predictor, sleep, solver, .. } = &mut *self.derived;
        let before = Snapshot {
            particles: self.particles.0.clone(),
            solids: self.rock.0.clone(),
            air: self.air.0.clone(),
            kept: Kept::default(),
            sleep: SleepRecord::default(),
            sources: sources.clone(),
            clock: *self.clock,
            books: Books::default(),
        };
        let Ok(after) = before.resampled(&self.setup.blueprint, &setup.blueprint, setup.quality.air_cell) else {
            return false;
        };
        (**elements, **recipes) = (Elements::of(&setup.blueprint), Recipes::of(&setup.blueprint));
        **predictor = PredictorState::default();
        let (size, version) = (setup.domain.size, after.solids.version());
        **sleep = SleepState(Sleep::resume(after.sleep, &after.particles, size, version));
        solver.bins.forget_rock();
        (self.particles.0, self.rock.0, self.air.0) = (after.particles, after.solids, after.air);
        (**sources, *self.clock, *self.setup) = (after.sources, after.clock, setup);
        true
    }
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
        Intent::Draw { element, .. }
        | Intent::Pour { element, .. }
        | Intent::Stamp { element, .. }
        | Intent::Fill { element, .. } => elements.get(*element).fixed,
        Intent::Replace { element, .. } | Intent::ReplaceAround { element, .. } => {
            elements.get(*element).fixed || rock.count() > 0
        }
        Intent::Paste { piece, .. } => !piece.rock.is_empty(),
        Intent::Erase { .. } | Intent::EraseOnly { .. } | Intent::EraseAround { .. } => rock.count() > 0,
        Intent::ClearAir
        | Intent::Quality { .. }
        | Intent::Effect { .. }
        | Intent::Gravity { .. }
        | Intent::Detail { .. }
        | Intent::Warm { .. }
        | Intent::SetTemperature { .. }
        | Intent::Ignite { .. }
        | Intent::Begin { .. }
        | Intent::Stroke
        | Intent::GiveUp
        | Intent::SetEmitter { .. }
        | Intent::SetDrain { .. }
        | Intent::RemoveSources { .. }
        | Intent::PasteSources { .. } => false,
    }
}
