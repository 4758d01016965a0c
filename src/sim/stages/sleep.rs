//! Water at rest sleeps. The stages look who falls asleep and who wakes; the substeps in between know of no sleepers.

use crate::{
    kernel::{params::Preset, sleep::LOOK_TICKS},
    scene::blueprint::Effect,
    sim::{
        effects::Effects,
        ledger::{Pass, PassLedger},
        snapshot::hash_bytes,
        state::{AirGrid, Clock, ParticleStore, Rates, Rock, Setup, SleepState, SolverState},
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

/// Whether the setup calls for sleep, of which `asleep` of `count` particles make use. The plain method simmers and never
/// rests, and the reference is what sleep, too, is held against.
pub(super) fn is_called_for(setup: &Setup, asleep: usize, count: usize, air_moves: bool) -> (bool, &'static str) {
    if setup.preset == Preset::Reference {
        (false, "the reference simulates all")
    } else if count == 0 && air_moves {
        (true, "calm air sleeps by tiles")
    } else if count == 0 {
        (false, "nothing moves")
    } else if !setup.quality.predictor {
        (false, "without the predictor nothing rests")
    } else if asleep == 0 {
        (true, "nothing rests yet")
    } else if asleep < count {
        (true, "some of the water rests")
    } else {
        (true, "all of the water rests")
    }
}

/// Wakes those whom an edit, a tap or an outlet changed. Runs while paused, too, so that a state which is kept then knows.
pub(super) fn check_sleepers(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    rock: Res<Rock>,
    mut ledger: ResMut<PassLedger>,
) {
    let start = Instant::now();
    sleep.check(&mut particles, rock.version());
    ledger.note(Pass::Sleep, start.elapsed());
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
    let acting = [Effect::Sleep, Effect::Predictor, Effect::Tension, Effect::Viscosity, Effect::Vorticity];
    for (bytes, number) in bytes.chunks_exact_mut(4).zip(numbers) {
        bytes.copy_from_slice(&number.to_le_bytes());
    }
    for (byte, effect) in bytes[32..].iter_mut().zip(acting) {
        *byte = u8::from(effects.get(effect).running);
    }
    sleep.keep_under(hash_bytes(&bytes));
}

/// Wakes the bodies that the wind reaches.
pub(super) fn wake_blown(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    air: Res<AirGrid>,
    rates: Res<Rates>,
    setup: Res<Setup>,
    mut ledger: ResMut<PassLedger>,
) {
    let start = Instant::now();
    let drag = rates.drag.iter().copied().fold(0.0, f32::max);
    sleep.wake_blown(&mut particles, &air, drag, setup.domain.gravity);
    ledger.note(Pass::Sleep, start.elapsed());
}

/// Wakes the bodies that someone is about to touch.
pub(super) fn wake_touched(
    mut sleep: ResMut<SleepState>,
    mut particles: ResMut<ParticleStore>,
    mut ledger: ResMut<PassLedger>,
) {
    let start = Instant::now();
    sleep.wake_touched(&mut particles);
    ledger.note(Pass::Sleep, start.elapsed());
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
    let start = Instant::now();
    sleep.watch(&mut particles, &mut solver.density, setup.blueprint.domain.size, rock.version());
    ledger.note(Pass::Sleep, start.elapsed());
}
