//! Recordings of what is played: begun and ended by a key, or kept from the start on in a file that the command line
//! names; and the last minute, which is there at any time.

use crate::{
    game::{actions::Action, disk, files, input::bindings::Bindings, saves::SaveFolders, toasts::Toasts},
    kernel::units::TICKS_PER_SECOND,
    sim::{
        new_file::{Unwritten, write_whole},
        pace::Pace,
        recorder::{self, Recorder},
        recording::{End, RECORDING_ENDING},
        state::Setup,
    },
};
use bevy::{log::error, prelude::World};
use std::path::{Path, PathBuf};
use tr::tr;

/// The folder beside save files that recordings go to.
const FOLDER: &str = "recordings";

/// Begins a recording, or ends it and writes it.
pub fn toggle(world: &mut World) {
    if !world.contains_resource::<Setup>() {
        return;
    }
    if world.resource::<Recorder>().ticks().is_some() {
        end(world, "");
        return;
    }
    world.resource::<Recorder>().begin(world, None);
    let key = world.resource::<Bindings>().key(Action::Record);
    world.resource_mut::<Toasts>().say(tr!("Recording from here on; {} again ends it", key));
}

/// Ends a recording that takes all the memory that it may.
pub fn end_when_full(world: &mut World) {
    // What is shown of the past is not where it has come to.
    if world.resource::<Recorder>().is_full() && !world.resource::<Pace>().rewinds {
        let why = tr!(" It took all the memory that it may.");
        end(world, &why);
    }
}

fn end(world: &mut World, why: &str) {
    let seconds = world.resource::<Recorder>().ticks().unwrap_or(0) as f64 / f64::from(TICKS_PER_SECOND);
    let end = recorder::end_now(world);
    world.resource::<Recorder>().stop(end);
    match write_recording(world, end) {
        Ok(path) => {
            world.resource::<Recorder>().forget();
            let path = path.map_or(String::new(), |path| path.display().to_string());
            let told = tr!("Recorded {} s: {}", format_args!("{seconds:.1}"), path);
            world.resource_mut::<Toasts>().say(told + why);
        }
        Err(problem) => {
            let key = world.resource::<Bindings>().key(Action::Record);
            let told =
                tr!("Not written: {problem}. The recording ends here, and is kept: {key} tries again.", problem, key);
            world.resource_mut::<Toasts>().warn(told);
        }
    }
}

/// Writes the last minute into a new file and says where.
pub fn keep_last_minute(world: &mut World) {
    if !world.contains_resource::<Setup>() {
        return;
    }
    // What the last tick changed is recorded; what was put in the place of the world since then is not yet.
    world.resource::<Recorder>().keep_up(world);
    let bytes = world.resource::<Recorder>().last_minute(recorder::end_now(world));
    let written = write_new(&folders(world), world.resource::<Recorder>(), "", &bytes);
    let mut toasts = world.resource_mut::<Toasts>();
    match written {
        Ok(path) => toasts.say(tr!("The last minute: {}", path.display())),
        Err(error) => toasts.warn(tr!("The last minute is not kept: {}", error)),
    }
}

/// Writes the file that the command line named, as far as it is.
pub fn write(world: &mut World) {
    if world.resource::<Recorder>().destination().is_none() {
        return;
    }
    if let Err(problem) = write_recording(world, recorder::end_now(world)) {
        world.resource_mut::<Toasts>().warn(tr!("The recording is not written: {}", problem));
    }
}

/// Writes the recording when the game ends.
pub fn write_at_exit(world: &mut World) {
    if !world.contains_resource::<Setup>() {
        return;
    }
    if let Err(problem) = write_recording(world, recorder::end_now(world)) {
        error!("the recording is not written: {problem}");
    }
}

fn write_recording(world: &World, end: End) -> Result<Option<PathBuf>, Unwritten> {
    write_to(&folders(world), world.resource::<Recorder>(), "", end)
}

/// Writes the recording, if there is one, into the file that is named for it, or a new one.
pub fn write_to(
    folders: &[PathBuf],
    recorder: &Recorder,
    suffix: &str,
    end: End,
) -> Result<Option<PathBuf>, Unwritten> {
    let Some(bytes) = recorder.recording(end) else { return Ok(None) };
    let named = recorder.destination();
    match named {
        Some(path) => match write_whole(&path, &bytes) {
            Ok(()) => Ok(Some(path)),
            Err(error) => Err(Unwritten { path, error }),
        },
        None => write_new(folders, recorder, suffix, &bytes).map(Some),
    }
}

/// Writes a new file that is called after the scene and the tick.
pub fn write_new(folders: &[PathBuf], recorder: &Recorder, suffix: &str, bytes: &[u8]) -> Result<PathBuf, Unwritten> {
    let (scene, tick) = recorder.place().unwrap_or_else(|| ("world".to_owned(), 0));
    let scene = scene + suffix;
    if cfg!(target_arch = "wasm32") {
        let path = files::free_path(Path::new(""), &scene, tick, RECORDING_ENDING);
        return match disk::give(&path, bytes) {
            Ok(()) => Ok(path),
            Err(error) => Err(Unwritten { path, error }),
        };
    }
    files::write_new(folders, &scene, tick, RECORDING_ENDING, bytes)
}

/// The folders that recordings may go to, the first that takes them.
pub fn folders(world: &World) -> Vec<PathBuf> {
    world.resource::<SaveFolders>().0.iter().map(|folder| folder.join(FOLDER)).collect()
}
