//! `replay`: a recording once more, tick by tick, until something is not what it was.

use crate::{
    cli::{
        args::ReplayArguments,
        failure::Failure,
        output, progress,
        start::{bad, read},
        threads,
    },
    sim::{
        fault,
        recording::{End, Recording},
        replay::{Difference, Replay},
        workers::Workers,
    },
};
use serde::Serialize;
use std::panic::{self, AssertUnwindSafe};

/// What came out.
#[derive(Serialize)]
struct Outcome {
    /// Whether every tick is what it was, and the end.
    same: bool,
    /// Ticks that were run.
    ticks: u64,
    /// Ticks in the recording.
    recorded: u64,
    /// Segments in the recording: one more than the jumps in it.
    #[serde(rename = "stretches")]
    segments: usize,
    /// Hash of the world at the end.
    hash: Option<String>,
    /// The first tick that differs.
    difference: Option<Difference>,
    /// What a panic said that ended it.
    panic: Option<String>,
    /// Whether the recording was ended by a crash.
    crashed: bool,
}

/// Why a replay did not come to its end.
enum Stop {
    Different(Difference),
    Panic(String),
}

/// Runs a recording again and compares.
pub(super) fn replay(arguments: &ReplayArguments) -> Result<(), Failure> {
    let json = arguments.json.as_deref();
    output::check(json.as_slice())?;
    let path = &arguments.file;
    let recording = Recording::decode(&read(path)?).map_err(|error| bad(path, &error))?;
    threads::start(arguments.machine.threads)?;
    let mut replay =
        Replay::new(&recording, Workers::default(), arguments.machine.simd).map_err(|error| bad(path, &error))?;
    // A panic is an outcome here, and gets one line.
    fault::watch(false);
    let crashed = recording.end == Some(End::Crashed);
    let outcome = run(&mut replay, &recording);
    let done = replay.done();
    if let Some(json) = json {
        let (hash, difference, panic) = match &outcome {
            Ok(hash) => (Some(format!("{hash:016x}")), None, None),
            Err(Stop::Different(difference)) => (None, Some(*difference), None),
            Err(Stop::Panic(text)) => (None, None, Some(text.clone())),
        };
        let (recorded, segments) = (recording.ticks(), recording.segments.len());
        let same = outcome.is_ok();
        output::write_json(json, &Outcome { same, ticks: done, recorded, segments, hash, difference, panic, crashed })?;
    }
    match outcome {
        Ok(_) if output::is_stdout(json) => Ok(()),
        Ok(hash) if crashed => output::print(&format!(
            "same: {done} ticks, hash {hash:016x}; recorded by a crash that does not come again\n"
        )),
        Ok(hash) => output::print(&format!("same: {done} ticks, hash {hash:016x}\n")),
        Err(Stop::Different(difference)) => Err(Failure::Outcome(format!("{}: {difference}", path.display()))),
        Err(Stop::Panic(text)) => {
            let file = path.display();
            Err(Failure::Outcome(format!("{file}: after {done} of {} ticks, a panic: {text}", recording.ticks())))
        }
    }
}

/// Runs to the end, and on through the tick of a crash; the hash of the world there.
fn run(replay: &mut Replay, recording: &Recording) -> Result<u64, Stop> {
    let line = progress::bar(recording.ticks());
    while guard(|| replay.tick())? {
        line.set_position(replay.done());
    }
    let hash = guard(|| replay.finish())?;
    if recording.end == Some(End::Crashed) {
        guard(|| {
            replay.go_beyond();
            Ok(())
        })?;
    }
    Ok(hash)
}

fn guard<T>(work: impl FnOnce() -> Result<T, Difference>) -> Result<T, Stop> {
    // Nothing is looked at after a panic but how many ticks were done before it.
    match panic::catch_unwind(AssertUnwindSafe(work)) {
        Ok(outcome) => outcome.map_err(Stop::Different),
        Err(payload) => Err(Stop::Panic(fault::describe(&*payload))),
    }
}
