//! What may be done to a world as a whole, between ticks: reset, freeze, thaw, change the quality. Every state that is put
//! in the place of another goes through [`thaw`], which counts it.

use crate::{
    kernel::{
        params::{Preset, Quality},
        predictor::Predictor,
        sleep::Sleep,
    },
    sim::{
        effects::Effects,
        generation::Generation,
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        pace::Pace,
        resample::count_at,
        snapshot::{Snapshot, hash_state},
        state::{
            AirGrid, Books, Census, Clock, Counters, ParticleStore, PredictorState, Rock, Setup, SleepState,
            SolverState, Sources,
        },
    },
};
use bevy::{
    app::FixedUpdate,
    prelude::{Mut, World},
};

/// Goes back to the start of the scene (or to the state of the save file that was loaded), and to its gravity.
pub fn reset(world: &mut World) {
    let mut setup = world.resource_mut::<Setup>();
    setup.domain = setup.blueprint.domain;
    let origin = setup.start();
    thaw(world, &origin);
    world.insert_resource(Counters::default());
    world.insert_resource(PassLedger::default());
    world.resource_mut::<Effects>().start_over();
}

/// Copies the state out.
pub fn freeze(world: &World) -> Snapshot {
    Snapshot {
        particles: world.resource::<ParticleStore>().0.clone(),
        solids: world.resource::<Rock>().0.clone(),
        air: world.resource::<AirGrid>().0.clone(),
        kept: world.get_resource::<PredictorState>().map_or_else(Default::default, |state| state.kept()),
        sleep: world.get_resource::<SleepState>().map_or_else(Default::default, |sleep| sleep.record().clone()),
        sources: world.resource::<Sources>().clone(),
        clock: *world.resource::<Clock>(),
        books: world.get_resource::<Books>().cloned().unwrap_or_default(),
    }
}

/// Puts a state of the same scene back (undo, redo). Waiting intents are forgotten.
pub fn thaw(world: &mut World, snapshot: &Snapshot) {
    Generation::count_state(world);
    show(world, snapshot);
}

/// The same of a state that is only looked at, and of the same history: what is derived from the world stays as it is where
/// nothing of it differs. Before the world goes on, [`thaw`] has to follow.
pub fn show(world: &mut World, snapshot: &Snapshot) {
    let air_cell = world.resource::<Setup>().quality.air_cell;
    let mut air = if snapshot.air.cell() == air_cell { snapshot.air.clone() } else { snapshot.air.resized(air_cell) };
    air.set_solids(&snapshot.solids);
    world.insert_resource(ParticleStore(snapshot.particles.clone()));
    world.insert_resource(Rock(snapshot.solids.clone()));
    world.insert_resource(AirGrid(air));
    world.insert_resource(snapshot.sources.clone());
    world.insert_resource(snapshot.clock);
    world.insert_resource(snapshot.books.clone());
    world.insert_resource(Census::default());
    // What is derived from the rock follows its version, which only tells apart the states of one history.
    world.insert_resource(PredictorState(Predictor::resume(snapshot.kept.clone())));
    let size = world.resource::<Setup>().blueprint.domain.size;
    world.insert_resource(SleepState(Sleep::resume(
        snapshot.sleep.clone(),
        &snapshot.particles,
        size,
        snapshot.solids.version(),
    )));
    world.get_resource_or_init::<SolverState>().bins.forget_rock();
    world.get_resource_or_init::<IntentQueue>().clear();
}

/// Whether the world can go on at a detail that is asked for, at a preset that may have its own.
///
/// # Errors
/// If not: one line that says why, and what is allowed.
pub fn check_detail(world: &World, detail: f64, preset: Preset) -> Result<(), String> {
    let setup = world.resource::<Setup>();
    let to = setup.at_detail(detail, preset)?;
    let count = world.resource::<ParticleStore>().len() + world.resource::<Rock>().count();
    count_at(count, &setup.blueprint, &to.blueprint).map(drop)
}

/// Goes on at another quality of the same detail. The air is carried over to its new cells.
pub fn set_quality(world: &mut World, preset: Preset, quality: Quality) {
    world.resource_scope(|world, mut air: Mut<AirGrid>| {
        world.resource_scope(|world, mut setup: Mut<Setup>| {
            change_quality(&mut setup, &mut air, world.resource::<Rock>(), preset, quality);
        });
    });
}

/// [`set_quality`] of the parts.
pub(super) fn change_quality(setup: &mut Setup, air: &mut AirGrid, rock: &Rock, preset: Preset, quality: Quality) {
    (setup.preset, setup.quality) = (preset, quality);
    if air.cell() != quality.air_cell {
        air.0 = air.resized(quality.air_cell);
        air.set_solids(rock);
    }
}

/// Carries out the intents that wait, without a tick.
pub fn apply_edits(world: &mut World) {
    let paused = Pace { paused: true, steps_due: 0, ..Pace::default() };
    let pace = std::mem::replace(&mut *world.resource_mut::<Pace>(), paused);
    world.run_schedule(FixedUpdate);
    *world.resource_mut::<Pace>() = pace;
}

/// Has an edit done at once.
pub fn edit(world: &mut World, intent: Intent) {
    world.resource_mut::<IntentQueue>().push(intent);
    apply_edits(world);
}

/// Hash of the state as it is (see [`Snapshot::hash`]).
pub fn hash(world: &World) -> u64 {
    hash_state(world.resource::<ParticleStore>(), world.resource::<Rock>(), world.resource::<AirGrid>())
}
