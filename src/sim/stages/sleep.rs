//! Water at rest sleeps. These stages put particles to sleep and wake them; the passes in between see only those awake.

use crate::{
    kernel::sleep::LOOK_TICKS,
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        snapshot::hash_bytes,
        state::{AirGrid, Clock, ParticleStore, Rates, Rock, Setup, SleepState, SolverState},
    },
};
use bevy::prelude::{Res, ResMut};

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
    let acting = Effect::ALL.into_iter().filter(|effect| effect.row().wakes);
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
    rates: Res<Rates>,
    setup: Res<Setup>,
) -> usize {
    let drag = rates.drag.iter().copied().fold(0.0, f32::max);
    sleep.wake_blown(&mut particles, &air, drag, setup.domain.gravity);
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
    rock: Res<Rock>,
    setup: Res<Setup>,
) -> usize {
    let awake = particles.len() - sleep.asleep();
    sleep.watch(&mut particles, &mut solver.density, setup.blueprint.domain.size, rock.version());
    awake
}
