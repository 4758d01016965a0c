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
        recording::{End, Entry, KEY_TICKS, Recording, Spot, Stretch},
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
/// What can be gone back to, ticks: half a minute of the world's time.
pub const REWIND_TICKS: u64 = 1800;
/// Most memory that going back may take, bytes: the states that are kept for it, one in [`KEY_TICKS`] ticks, and those that
/// are made while it is done. Of a world of 100,000 particles that are some six seconds; of 40,000, all of it.
pub const REWIND_BYTES: usize = if cfg!(target_arch = "wasm32") { 96 << 20 } else { 192 << 20 };
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
    /// Whether states are kept to go back to.
    keeps_keys: bool,
    /// Bytes of the state that was taken last.
    state_bytes: usize,
    /// Whether the past is looked at: then nothing is taken.
    held: bool,
}

impl Inner {
    /// The recording that takes what happens.
    fn running(&mut self) -> Option<&mut Recording> {
        self.recording.as_mut().filter(|recording| recording.end.is_none())
    }

    /// Keeps the state of the world to go back to, if it is time for that.
    fn keep_key(&mut self, world: &World) {
        let spacing = key_spacing(self.state_bytes);
        if self.keeps_keys && self.rolling.ticks_since_key() >= spacing {
            let state = Checkpoint::of(world);
            self.state_bytes = state.bytes();
            // Beside them there are the states of two stretches while they are looked at, and the world before.
            let beside = (2 * spacing + 2) * self.state_bytes;
            self.rolling.note_key(state);
            self.rolling.thin(REWIND_TICKS, REWIND_BYTES.saturating_sub(beside));
        }
    }
}

/// Ticks from one state to go back to, of so many bytes, to the next: half of the memory is for them, a quarter for each of
/// the two stretches between them that are looked at.
fn key_spacing(bytes: usize) -> usize {
    (REWIND_BYTES / bytes.max(1) / 4).clamp(1, KEY_TICKS)
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
        if inner.held {
            return;
        }
        let entry = Entry { tick, intent: intent.clone() };
        inner.rolling.note(entry.clone());
        if let Some(recording) = inner.running() {
            recording.note(entry);
        }
    }

    /// Takes the state of the world where a segment has to begin with it. Before every edit stage.
    pub fn keep_up(&self, world: &World) {
        let mut inner = self.inner();
        if inner.held {
            return;
        }
        let generation = Generation::of(world);
        let jumped = std::mem::replace(&mut inner.generation, generation) != generation;
        let full = inner
            .rolling
            .segments
            .last()
            .is_none_or(|segment| segment.marks.len() >= SEGMENT_TICKS || segment.entries.len() >= SEGMENT_ENTRIES);
        let waits = inner.running().is_some_and(|recording| recording.segments.is_empty());
        if !(jumped || full || waits) {
            inner.keep_key(world);
            return;
        }
        let start = Checkpoint::of(world);
        inner.state_bytes = start.bytes();
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
        if inner.held || inner.rolling.segments.last().is_none_or(|segment| segment.now() + 1 != clock.tick) {
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

    /// Bytes that the states take that are kept to go back to, to a good approximation.
    pub fn key_bytes(&self) -> usize {
        self.inner().rolling.key_bytes()
    }

    /// Keeps states to go back to, from here on.
    pub fn keep_keys(&self) {
        self.inner().keeps_keys = true;
    }

    /// Takes nothing from here on: the past is looked at. Where the present is; nothing if nothing is recorded.
    pub(in crate::sim) fn hold(&self) -> Option<Spot> {
        let mut inner = self.inner();
        let now = inner.rolling.end_spot();
        inner.held = now.is_some();
        now
    }

    /// What lies before a place of the last minute.
    pub(in crate::sim) fn stretch_before(&self, spot: Spot) -> Option<Stretch> {
        self.inner().rolling.stretch_before(spot)
    }

    /// Goes on as before it was held.
    pub(in crate::sim) fn release(&self) {
        self.inner().held = false;
    }

    /// Goes on from a place of the last minute, at which `world` is. What came after it is forgotten there; a recording
    /// that runs has the way back as a jump, like an undo.
    pub(in crate::sim) fn go_on_from(&self, world: &World, spot: Spot) {
        let mut inner = self.inner();
        let start = Checkpoint::of(world);
        inner.rolling.cut(spot);
        inner.rolling.begin(start.clone(), true);
        inner.serial += 1;
        (inner.marker, inner.generation) = (Marker::default(), Generation::of(world));
        inner.held = false;
        if let Some(recording) = inner.running() {
            recording.begin(start, false);
        }
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
