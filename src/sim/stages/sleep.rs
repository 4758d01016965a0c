//! Water at rest sleeps. These stages put particles to sleep and wake them; the passes in between see only those awake.

use crate::{
    kernel::{particles::Particles, predictor::Buoyancy, sleep::LOOK_TICKS},
    scene::{
        KNOBS, Part,
        effects::{Effect, Mode},
    },
    sim::{
        effects::Effects,
        snapshot::hash_bytes,
        state::{
            AirGrid, Clock, Elements, MassShares, ParticleStore, PredictorState, Rock, Setup, SleepState, SolverState,
        },
    },
};
use bevy::prelude::{Res, ResMut};
use glam::Vec2;

/// Run condition: some particles sleep.
pub(super) fn any_asleep(sleep: Res<SleepState>) -> bool {
    sleep.asleep() > 0
}

/// Run condition of the substeps: some particles are awake.
pub(super) fn any_awake(particles: Res<ParticleStore>) -> bool {
    !particles.is_empty()
}

/// Run condition: the effect runs, and not for the air alone.
pub(super) fn water_may_rest(effects: Res<Effects>, setup: Res<Setup>) -> bool {
    lets_water_rest(&effects, &setup)
}

/// Without the predictor, water sleeps only where that is asked for.
fn lets_water_rest(effects: &Effects, setup: &Setup) -> bool {
    let sleep = effects.get(Effect::Sleep);
    sleep.running && (setup.quality.predictor || sleep.mode == Mode::On)
}

/// Wakes the particles that an edit, an emitter or a drain changed. Runs while paused, too: a state that is kept then has it.
pub(super) fn check_sleepers(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    rock: Res<Rock>,
) -> usize {
    let asleep = sleep.asleep();
    sleep.check(&mut particles, rock.version());
    asleep
}

/// Wakes what lies where something became another element or went: before anyone counts the sleepers, of whom some may be gone.
pub(super) fn wake_changed(sleep: &mut SleepState, particles: &mut Particles, rock: &Rock, places: &[Vec2]) {
    if !places.is_empty() {
        sleep.disturb(places);
        sleep.check(particles, rock.version());
    }
}

/// Wakes all where the conditions changed under which they fell asleep: gravity, what the solver goes by, and the effects.
pub(super) fn keep_asleep(mut sleep: ResMut<SleepState>, effects: Res<Effects>, setup: Res<Setup>) {
    let gravity = setup.domain.gravity.to_array().map(f64::from);
    let knobs = KNOBS.iter().filter(|knob| [Part::Solver, Part::Liquid].contains(&knob.part));
    let acting = Effect::ALL.into_iter().filter(|effect| effect.row().wakes).map(|effect| match effect {
        // A drop of another density that comes or goes is nothing to a body of one, nor is a grain, or a gas.
        Effect::Buoyancy | Effect::Masses | Effect::Friction => effects.get(effect).mode != Mode::Off,
        _ => effects.get(effect).running,
    });
    let conditions = (gravity.into_iter())
        .chain(knobs.map(|knob| knob.get(&setup.tuning())))
        .chain([f64::from(lets_water_rest(&effects, &setup))])
        .chain(acting.map(f64::from));
    let hash = conditions
        .fold(0, |hash: u64, condition| hash_bytes([hash.to_le_bytes(), condition.to_le_bytes()].as_flattened()));
    sleep.keep_under(hash);
}

/// Wakes the bodies that the wind reaches.
pub(super) fn wake_blown(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    air: Res<AirGrid>,
    elements: Res<Elements>,
    setup: Res<Setup>,
) -> usize {
    sleep.wake_blown(&mut particles, &air, &elements.drag, setup.domain.gravity);
    // It looks at the air over the bodies, and at no particle.
    0
}

/// Wakes the bodies that an awake particle is about to touch.
pub(super) fn wake_touched(mut sleep: ResMut<SleepState>, mut particles: ResMut<ParticleStore>) -> usize {
    let awake = particles.len();
    sleep.wake_touched(&mut particles);
    awake
}

/// Run condition: it is time to look what has come to rest.
pub(super) fn is_time_to_look(clock: Res<Clock>) -> bool {
    clock.tick.is_multiple_of(LOOK_TICKS)
}

/// Lets the bodies sleep that have come to rest.
pub(super) fn watch(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    mut solver: ResMut<SolverState>,
    predictor: Res<PredictorState>,
    shares: Res<MassShares>,
    effects: Res<Effects>,
    rock: Res<Rock>,
    setup: Res<Setup>,
) -> usize {
    let awake = particles.len() - sleep.asleep();
    let (predicts, gravity) = (effects.get(Effect::Predictor).running, setup.domain.gravity);
    let buoyancy = predictor.buoyancy().filter(|_| predicts).zip(shares.get());
    let rising = |particles: &Particles, i: usize| {
        let speed = |(buoyancy, masses): (Buoyancy, &[f32])| {
            buoyancy.speed(particles.position(i), masses[particles.element[i].index()], gravity)
        };
        buoyancy.map_or(0.0, speed)
    };
    let place = (setup.blueprint.domain.size, rock.version());
    sleep.watch(&mut particles, &mut solver.density, place, rising);
    awake
}
