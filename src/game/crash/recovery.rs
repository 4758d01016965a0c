//! Recovery at the next start: looks for the journal of an earlier game that did not end well, offers its world and
//! restores it.

use crate::{
    game::{actions::Action, crash::journal::PREFIX, disk, history, input::bindings::Bindings, toasts::Toasts},
    kernel::simd::InstructionSet,
    sim::{
        checkpoint::Checkpoint,
        pace::Pace,
        recording::{End, RECORDING_ENDING, Recording, Segment},
        replay::Replay,
        state::SolverState,
        workers::Workers,
    },
};
use bevy::prelude::{App, IntoScheduleConfigs, Resource, RunFixedMainLoop, RunFixedMainLoopSystems, World};
use std::{
    fs::{self, File, OpenOptions},
    io::Read,
    panic::{self, AssertUnwindSafe},
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    thread::{self, JoinHandle},
};
use tr::tr;

/// A game that did not end well. As long as this is there, its file is locked: no other game offers it.
#[derive(Debug)]
pub struct Found {
    path: PathBuf,
    _lock: File,
    recording: Arc<Recording>,
    /// Title of the scene.
    pub title: String,
    /// Ticks that the world had done at the end.
    pub tick: u64,
}

impl Found {
    fn last(&self) -> Option<&Segment> {
        self.recording.segments.last()
    }

    /// Ticks that lie between the state that was kept and the end.
    pub fn ticks(&self) -> u64 {
        self.last().map_or(0, |segment| segment.marks.len() as u64)
    }
}

/// What shall become of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Go on with the world just before the end.
    Restore,
    /// Go on with the state that was kept last.
    Earlier,
    /// Delete it.
    Forget,
}

/// How far a world came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// To the end.
    Whole,
    /// Without the last edits: the world does not survive them.
    LastTick,
    /// To the state that was kept last: the world does not survive what came after it.
    LastState,
}

#[derive(Debug, Default)]
enum Stage {
    #[default]
    Nothing,
    Searching(JoinHandle<Option<Found>>),
    Offered(Found),
    Restoring(Found, JoinHandle<Option<(Checkpoint, Reach)>>),
}

/// The recovery of an earlier game.
#[derive(Resource, Debug, Default)]
pub struct Recovery {
    stage: Stage,
    done: Arc<AtomicU64>,
    /// What the player chose.
    pub choice: Option<Choice>,
}

impl Recovery {
    /// What is offered; and how much of it has run again, 0 … 1, if that has begun.
    pub fn offer(&self) -> Option<(&Found, Option<f32>)> {
        match &self.stage {
            Stage::Offered(found) => Some((found, None)),
            Stage::Restoring(found, _) => {
                let done = self.done.load(Ordering::Relaxed) as f32;
                Some((found, Some((done / found.ticks().max(1) as f32).min(1.0))))
            }
            Stage::Nothing | Stage::Searching(_) => None,
        }
    }

    /// Whether a thread looks for something, or runs it again.
    pub fn is_busy(&self) -> bool {
        matches!(self.stage, Stage::Searching(_) | Stage::Restoring(..))
    }

    /// Decides nothing: the file stays, and the next start offers it again.
    pub fn put_off(&mut self) {
        self.stage = Stage::Nothing;
    }
}

/// Looks for what is left in a folder, beside the game that begins.
pub fn search(app: &mut App, folder: PathBuf) {
    let stage = thread::Builder::new().name("recovery".to_owned()).spawn(move || find(&folder));
    app.insert_resource(Recovery { stage: stage.map_or(Stage::Nothing, Stage::Searching), ..Recovery::default() });
    app.add_systems(RunFixedMainLoop, update.in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop));
}

/// The newest journal in a folder whose game has ended, if something would be lost without it. Journals that hold nothing
/// of use are deleted.
fn find(folder: &Path) -> Option<Found> {
    let is_journal = |path: &Path| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with(PREFIX) && path.extension().is_some_and(|ending| ending == RECORDING_ENDING)
    };
    let mut journals = disk::list(folder);
    journals.retain(|(path, _)| is_journal(path));
    journals.sort_by(|(a, written_a), (b, written_b)| (written_b, b).cmp(&(written_a, a)));
    journals.into_iter().find_map(|(path, _)| {
        let mut file = OpenOptions::new().read(true).write(true).open(&path).ok()?;
        // It is of a game that runs, or that has offered it.
        file.try_lock().ok()?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).ok()?;
        let found = read(&bytes);
        if found.is_none() {
            // Nothing can be done about it if it stays.
            let _ = fs::remove_file(&path);
        }
        let (recording, title, tick) = found?;
        Some(Found { path, _lock: file, recording: Arc::new(recording), title, tick })
    })
}

/// The recording in a journal, with title and last tick, if something would be lost with it: after a crash in any case, else
/// if the world was edited.
fn read(bytes: &[u8]) -> Option<(Recording, String, u64)> {
    let recording = Recording::salvage(bytes).ok()?;
    let last = recording.segments.last()?;
    let start = last.start().ok()?;
    let edited = start.state.clock.edits > 0 || !last.entries.is_empty();
    let tick = last.tick + last.marks.len() as u64;
    let title = start.setup.blueprint.title.clone();
    (edited || recording.end == Some(End::Crashed)).then_some((recording, title, tick))
}

/// Goes on with what was begun and does what was chosen.
pub fn update(world: &mut World) {
    let Some(mut recovery) = world.remove_resource::<Recovery>() else { return };
    let choice = recovery.choice.take();
    recovery.stage = match recovery.stage {
        Stage::Searching(job) if job.is_finished() => job.join().ok().flatten().map_or(Stage::Nothing, Stage::Offered),
        Stage::Offered(found) => decide(world, found, choice, &recovery.done),
        Stage::Restoring(found, _) if matches!(choice, Some(Choice::Earlier | Choice::Forget)) => {
            // The thread ends by itself, and its result is dropped.
            decide(world, found, choice, &recovery.done)
        }
        Stage::Restoring(found, job) if job.is_finished() => {
            match job.join().ok().flatten() {
                Some((saved, reach)) => go_on(world, saved, reach),
                None => world.resource_mut::<Toasts>().warn(tr!("The world can't be restored")),
            }
            remove(world, &found);
            Stage::Nothing
        }
        stage => stage,
    };
    if !matches!(recovery.stage, Stage::Nothing) {
        world.insert_resource(recovery);
    }
}

fn decide(world: &mut World, found: Found, choice: Option<Choice>, done: &Arc<AtomicU64>) -> Stage {
    match choice {
        None => return Stage::Offered(found),
        Some(Choice::Restore) => {
            let (recording, done) = (found.recording.clone(), done.clone());
            let instructions = world.resource::<SolverState>().instructions;
            let work = move || restore(&recording, instructions, &done);
            return match thread::Builder::new().name("restore".to_owned()).spawn(work) {
                Ok(job) => Stage::Restoring(found, job),
                Err(error) => {
                    world.resource_mut::<Toasts>().warn(tr!("The world can't be restored: {}", error));
                    Stage::Offered(found)
                }
            };
        }
        Some(Choice::Earlier) => match found.last().map(Segment::start) {
            Some(Ok(saved)) => go_on(world, saved, Reach::LastState),
            _ => world.resource_mut::<Toasts>().warn(tr!("The world can't be restored")),
        },
        Some(Choice::Forget) => {}
    }
    remove(world, &found);
    Stage::Nothing
}

fn remove(world: &mut World, found: &Found) {
    if let Err(error) = fs::remove_file(&found.path) {
        world.resource_mut::<Toasts>().warn(tr!("{}: can't be removed: {}", found.path.display(), error));
    }
}

/// Runs what was recorded again, as far as the world survives it.
pub fn restore(recording: &Recording, instructions: InstructionSet, done: &AtomicU64) -> Option<(Checkpoint, Reach)> {
    let run = |reach| {
        let run = || {
            // The game beside it shall not wait for its threads.
            let workers = Workers::new(1).ok()?;
            let mut replay = Replay::of_last(recording, workers, instructions).ok()?;
            // A tick that differs is no reason to give the rest up.
            while !matches!(replay.tick(), Ok(false)) {
                done.store(replay.done(), Ordering::Relaxed);
            }
            if reach == Reach::Whole {
                let _ = replay.finish();
            }
            Checkpoint::decode(&Checkpoint::of(replay.world()).encode()).ok()
        };
        // A world that a panic went through is not looked at again.
        panic::catch_unwind(AssertUnwindSafe(run)).ok().flatten().map(|saved| (saved, reach))
    };
    let last_state = || Some((recording.segments.last()?.start().ok()?, Reach::LastState));
    run(Reach::Whole).or_else(|| run(Reach::LastTick)).or_else(last_state)
}

/// Goes on with a world that was restored: paused, until the player lets time go on.
fn go_on(world: &mut World, saved: Checkpoint, reach: Reach) {
    history::checkpoint(world);
    saved.restore(world);
    *world.resource_mut::<Pace>() = Pace { paused: true, steps_due: 0, ..*world.resource::<Pace>() };
    let key = world.resource::<Bindings>().key(Action::Pause);
    let told = match reach {
        Reach::Whole => tr!("Restored: {} lets time go on", key),
        Reach::LastTick => tr!("Restored without the last edits, which it does not survive: {} lets time go on", key),
        Reach::LastState => tr!("Restored as it was kept last: {} lets time go on", key),
    };
    world.resource_mut::<Toasts>().say(told);
}
