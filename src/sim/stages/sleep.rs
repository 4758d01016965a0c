//! Water at rest sleeps. The stages look who falls asleep and who wakes; the substeps in between know of no sleepers.

use crate::{
    kernel::sleep::LOOK_TICKS,
    scene::blueprint::{Effect, Mode},
    sim::{
        effects::Effects,
        ledger::{Pass, PassLedger},
        snapshot::hash_bytes,
        state::{AirGrid, Clock, Elements, ParticleStore, Rock, Setup, SleepState, SolverState},
    },
};
use bevy::platform::time::Instant;
use bevy::prelude::{Res, ResMut};

/// Run condition: someone sleeps.
pub(super) fn anyone_sleeps(sleep: Res<SleepState>) -> bool {
    sleep.asleep() > 0
}

/// Run condition of the substeps: someone is awake.
pub(super) fn anyone_is_awake(particles: Res<ParticleStore>) -> bool {
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

/// Wakes those whom an edit, a tap or an outlet changed. Runs while paused, too, so that a state which is kept then knows.
pub(super) fn check_sleepers(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    rock: Res<Rock>,
    mut ledger: ResMut<PassLedger>,
) {
    let (start, asleep) = (Instant::now(), sleep.asleep() as u64);
    sleep.check(&mut particles, rock.version());
    ledger.note(Pass::Sleep, asleep, start.elapsed());
}

/// Wakes all where the conditions changed under which they fell asleep.
pub(super) fn keep_asleep(mut sleep: ResMut<SleepState>, effects: Res<Effects>, setup: Res<Setup>) {
    let mut bytes = [0; 64];
    let quality = &setup.quality;
    let gravity = setup.domain.gravity;
    let numbers = [
        gravity.x.to_bits(),
        gravity.y.to_bits(),
        quality.substeps,
        quality.iterations,
        quality.kernel_radius.to_bits(),
        quality.correction_limit.to_bits(),
        quality.gradient as u32,
        setup.blueprint.fluid.rest_density.to_bits(),
    ];
    let acting = [Effect::Predictor, Effect::Tension, Effect::Viscosity, Effect::Vorticity];
    for (bytes, number) in bytes.chunks_exact_mut(4).zip(numbers) {
        bytes.copy_from_slice(&number.to_le_bytes());
    }
    bytes[32] = u8::from(lets_water_rest(&effects, &setup));
    for (byte, effect) in bytes[33..].iter_mut().zip(acting) {
        *byte = u8::from(effects.get(effect).running);
    }
    sleep.keep_under(hash_bytes(&bytes));
}

/// Wakes the bodies that the wind reaches.
pub(super) fn wake_blown(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    air: Res<AirGrid>,
    elements: Res<Elements>,
    setup: Res<Setup>,
    mut ledger: ResMut<PassLedger>,
) {
    let start = Instant::now();
    let drag = elements.drag.iter().copied().fold(0.0, f32::max);
    sleep.wake_blown(&mut particles, &air, drag, setup.domain.gravity);
    // It looks at the air over the bodies, and at no particle.
    ledger.note(Pass::Sleep, 0, start.elapsed());
}

/// Wakes the bodies that someone is about to touch.
pub(super) fn wake_touched(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    mut ledger: ResMut<PassLedger>,
) {
    let (start, awake) = (Instant::now(), particles.len() as u64);
    sleep.wake_touched(&mut particles);
    ledger.note(Pass::Sleep, awake, start.elapsed());
}

/// Run condition: it is time to look who rests.
pub(super) fn is_time_to_look(clock: Res<Clock>) -> bool {
    clock.tick.is_multiple_of(LOOK_TICKS)
}

/// Lets the bodies sleep that have come to rest.
pub(super) fn watch(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    mut solver: ResMut<SolverState>,
    rock: Res<Rock>,
    setup: Res<Setup>,
    mut ledger: ResMut<PassLedger>,
) {
    let (start, awake) = (Instant::now(), (particles.len() - sleep.asleep()) as u64);
    sleep.watch(&mut particles, &mut solver.density, setup.blueprint.domain.size, rock.version());
    ledger.note(Pass::Sleep, awake, start.elapsed());
}
