//! The recorder: keeps what happens to the world as states, input and marks. The last minute always, within a bound on
//! memory, so that any surprise can be kept; and a recording from when it is begun.
//!
//! Intents come from the edit stage. A state that is put in the place of another (undo, reset, another scene: all that
//! `control` thaws) begins a new segment.

use crate::{
    scene::passes::Pass,
    sim::{
        checkpoint::Checkpoint,
        control,
        generation::Generation,
        intent::Intent,
        mark::{Mark, Marker},
        recording::{End, Entry, Recording},
        script,
        state::{AirGrid, Clock, ParticleStore, Rock, Setup},
    },
};
use bevy::prelude::{App, FixedUpdate, IntoScheduleConfigs, Res, Resource, World, resource_exists};
use std::{
    path::PathBuf,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

/// What is always kept, ticks: a minute of the world's time.
pub const KEPT_TICKS: u64 = 3600;
/// Ticks from one state of the last minute to the next: at most so many are run again to come to any tick of it.
pub const SEGMENT_TICKS: usize = 1800;
/// Most intents before another state is taken: a player may draw for hours in a world that is paused.
const SEGMENT_ENTRIES: usize = 20_000;
/// Most memory that the last minute may take, bytes. Three states of a million particles are within it; of larger worlds
/// less is kept, at least the newest state.
pub const KEPT_BYTES: usize = 192 << 20;
/// Most memory that a recording may take, bytes. An hour of ticks takes 3 MB, a state 21 bytes a particle and more.
pub const RECORDING_BYTES: usize = 512 << 20;

/// Shared, so that what was recorded outlives the world that it is of.
#[derive(Resource, Clone, Debug, Default)]
pub struct Recorder(Arc<Mutex<Inner>>);

#[derive(Debug, Default)]
struct Inner {
    rolling: Recording,
    /// How often `rolling` began a segment.
    serial: u64,
    recording: Option<Recording>,
    /// The file that the recording shall go to, if one was named for it.
    to: Option<PathBuf>,
    marker: Marker,
    /// Generation of the world that was written last.
    generation: Generation,
}

impl Inner {
    /// The recording that takes what happens.
    fn running(&mut self) -> Option<&mut Recording> {
        self.recording.as_mut().filter(|recording| recording.end.is_none())
    }
}

/// How far a reader has come that follows the newest segment of the last minute.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cursor {
    serial: u64,
    entries: usize,
    marks: usize,
}

/// What was written since a reader looked last.
#[derive(Clone, Debug)]
pub struct News {
    /// The state that a new segment begins with, if there is one.
    pub start: Option<Checkpoint>,
    /// Intents of the newest segment.
    pub entries: Vec<Entry>,
    /// Marks of the newest segment.
    pub marks: Vec<Mark>,
}

impl Recorder {
    fn inner(&self) -> MutexGuard<'_, Inner> {
        // A panic elsewhere is what the record is for; nothing here leaves it half written.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Notes that the world takes `intent` after `tick` ticks.
    pub fn note(&self, tick: u64, intent: &Intent) {
        let mut inner = self.inner();
        let entry = Entry { tick, intent: intent.clone() };
        inner.rolling.note(entry.clone());
        if let Some(recording) = inner.running() {
            recording.note(entry);
        }
    }

    /// Takes the state of the world where a segment has to begin with it. Before every edit stage.
    pub fn keep_up(&self, world: &World) {
        let mut inner = self.inner();
        let generation = Generation::of(world);
        let jumped = std::mem::replace(&mut inner.generation, generation) != generation;
        let full = inner
            .rolling
            .segments
            .last()
            .is_none_or(|segment| segment.marks.len() >= SEGMENT_TICKS || segment.entries.len() >= SEGMENT_ENTRIES);
        let waits = inner.running().is_some_and(|recording| recording.segments.is_empty());
        if !(jumped || full || waits) {
            return;
        }
        let start = Checkpoint::of(world);
        inner.rolling.begin(start.clone(), !jumped);
        inner.serial += 1;
        inner.rolling.forget(KEPT_TICKS, KEPT_BYTES);
        if jumped || waits {
            inner.marker = Marker::default();
            if let Some(recording) = inner.running() {
                recording.begin(start, false);
            }
        }
    }

    /// Takes the mark of the tick that was done, if one was.
    fn mark(&self, particles: &ParticleStore, rock: &Rock, air: &AirGrid, clock: &Clock) {
        let mut inner = self.inner();
        if inner.rolling.segments.last().is_none_or(|segment| segment.now() + 1 != clock.tick) {
            return;
        }
        let mark = inner.marker.mark(particles, rock, air, clock);
        inner.rolling.mark(mark);
        if let Some(recording) = inner.running() {
            recording.mark(mark);
        }
    }

    /// The last minute as a recording.
    pub fn last_minute(&self, end: End) -> Vec<u8> {
        self.inner().rolling.encode(end)
    }

    /// Name of the scene that is played, and how many ticks of it are done.
    pub fn place(&self) -> Option<(String, u64)> {
        let inner = self.inner();
        let segment = inner.rolling.segments.last()?;
        Some((segment.start().ok()?.setup.blueprint.name.clone(), segment.now()))
    }

    /// Begins a recording at the state of the world; `to` is the file that it shall go to, if one is named for it.
    pub fn begin(&self, world: &World, to: Option<PathBuf>) {
        let mut inner = self.inner();
        (inner.recording, inner.to) = (Some(Recording::default()), to);
        drop(inner);
        self.keep_up(world);
    }

    /// The file that is named for the recording.
    pub fn destination(&self) -> Option<PathBuf> {
        self.inner().to.clone()
    }

    /// Whether there is a recording, and how many ticks it holds.
    pub fn ticks(&self) -> Option<u64> {
        self.inner().recording.as_ref().map(Recording::ticks)
    }

    /// Whether a recording that runs takes all the memory that it may.
    pub fn is_full(&self) -> bool {
        self.inner().running().is_some_and(|recording| recording.bytes() > RECORDING_BYTES)
    }

    /// The recording so far, which ends with `end` if it still runs.
    pub fn recording(&self, end: End) -> Option<Vec<u8>> {
        let inner = self.inner();
        inner.recording.as_ref().map(|recording| recording.encode(end))
    }

    /// Ends the recording, but keeps it until it is written: it takes no more from here on.
    pub fn stop(&self, end: End) {
        if let Some(recording) = &mut self.inner().recording {
            recording.end.get_or_insert(end);
        }
    }

    /// Forgets the recording: it is written.
    pub fn forget(&self) {
        let mut inner = self.inner();
        (inner.recording, inner.to) = (None, None);
    }

    /// What was written since `cursor`, if it is anything.
    pub fn news(&self, cursor: &mut Cursor) -> Option<News> {
        let inner = self.inner();
        let segment = inner.rolling.segments.last()?;
        let start = if cursor.serial == inner.serial { None } else { segment.start().ok() };
        if start.is_some() {
            *cursor = Cursor { serial: inner.serial, entries: 0, marks: 0 };
        }
        let (entries, marks) = (segment.entries[cursor.entries..].to_vec(), segment.marks[cursor.marks..].to_vec());
        cursor.entries += entries.len();
        cursor.marks += marks.len();
        (start.is_some() || !entries.is_empty() || !marks.is_empty()).then_some(News { start, entries, marks })
    }

    /// Bytes that the last minute takes, to a good approximation.
    pub fn bytes(&self) -> usize {
        self.inner().rolling.bytes()
    }
}

/// How a recording ends that is written now.
pub fn end_now(world: &World) -> End {
    End::Stopped { hash: control::hash(world) }
}

/// Adds the recorder to a simulation.
pub fn plugin(app: &mut App) {
    app.init_resource::<Recorder>().add_systems(
        FixedUpdate,
        (
            keep_up.after(script::run).before(Pass::Edit).run_if(resource_exists::<Setup>),
            mark.after(Pass::Measure).run_if(resource_exists::<Setup>),
        ),
    );
}

/// See [`Recorder::keep_up`].
pub fn keep_up(world: &World) {
    world.resource::<Recorder>().keep_up(world);
}

fn mark(recorder: Res<Recorder>, particles: Res<ParticleStore>, rock: Res<Rock>, air: Res<AirGrid>, clock: Res<Clock>) {
    recorder.mark(&particles, &rock, &air, &clock);
}
