//! The world that a run starts from: a scene, a save file, or a state in a recording.

use crate::{
    cli::{
        args::{PlayOptions, RunArguments},
        failure::Failure,
    },
    kernel::params::Preset,
    scene::{self, effects::EffectModes},
    sim::{
        checkpoint::Checkpoint,
        file::FileError,
        recording::{Recording, Segment},
    },
};
use std::{fmt::Display, fs::File, io::Read, path::Path, sync::Arc};

/// The world that a run starts from, and what is to be known of it.
pub(super) struct Start {
    /// The world.
    pub checkpoint: Checkpoint,
    /// Whether it is the start of a scene, not a saved world.
    pub is_scene: bool,
}

impl Start {
    /// Reads what `run` names, with the recorded input if it is a recording.
    pub(super) fn of_run(arguments: &RunArguments) -> Result<(Self, Option<Segment>), Failure> {
        let effects: EffectModes = arguments.effects.iter().copied().collect();
        let RunArguments { scene, settings, quality, .. } = arguments;
        let Some(mut recording) = read_recording(scene)? else {
            return Ok((Self::read(scene, settings, *quality, effects)?, None));
        };
        let unfit = [
            ("--set", !settings.is_empty()),
            ("--hold-ms", arguments.hold_ms.is_some()),
            ("--hold-error", arguments.hold_error.is_some()),
        ];
        if let Some((option, _)) = unfit.into_iter().find(|(_, is_given)| *is_given) {
            return Err(no_use(scene, "a recording", option));
        }
        let last = recording.segments.pop().ok_or_else(|| bad(Path::new(scene), &FileError::Foreign("recording")))?;
        let saved = last.start().map_err(|error| bad(Path::new(scene), &error))?;
        Ok((Self::of_saved(saved, *quality, effects), Some(last)))
    }

    /// Reads what `play` names, with the recording if it is one.
    pub(super) fn of_play(name_or_path: &str, options: &PlayOptions) -> Result<(Self, Option<Recording>), Failure> {
        let Some(recording) = read_recording(name_or_path)? else {
            return Ok((Self::read(name_or_path, &options.settings, options.quality, EffectModes::new())?, None));
        };
        let unfit = [("--set", !options.settings.is_empty()), ("--quality", options.quality.is_some())];
        if let Some((option, _)) = unfit.into_iter().find(|(_, is_given)| *is_given) {
            return Err(no_use(name_or_path, "a recording", option));
        }
        let first =
            recording.segments.first().ok_or_else(|| bad(Path::new(name_or_path), &FileError::Foreign("recording")))?;
        let saved = first.start().map_err(|error| bad(Path::new(name_or_path), &error))?;
        Ok((Self::of_saved(saved, None, EffectModes::new()), Some(recording)))
    }

    /// Reads what `soak` names.
    pub(super) fn of_soak(
        name_or_path: &str,
        settings: &[(String, String)],
        quality: Option<Preset>,
    ) -> Result<Self, Failure> {
        match Self::read(name_or_path, settings, quality, EffectModes::new())? {
            start if start.is_scene => Ok(start),
            _ => Err(no_use(name_or_path, "a save file", "soak")),
        }
    }

    /// Reads what `sweep` names.
    pub(super) fn of_sweep(name_or_path: &str, settings: &[(String, String)]) -> Result<Self, Failure> {
        Self::read(name_or_path, settings, None, EffectModes::new())
    }

    /// A saved world, with what the command line wants otherwise.
    fn of_saved(saved: Checkpoint, quality: Option<Preset>, effects: EffectModes) -> Self {
        let mut checkpoint = match quality {
            Some(preset) => saved.at_quality(preset, preset.quality()),
            None => saved,
        };
        checkpoint.modes.extend(effects);
        Self { checkpoint, is_scene: false }
    }

    fn read(
        name_or_path: &str,
        settings: &[(String, String)],
        quality: Option<Preset>,
        effects: EffectModes,
    ) -> Result<Self, Failure> {
        let Some(saved) = read_save(name_or_path)? else {
            let blueprint = scene::load(name_or_path)?.build(settings, quality, &effects)?;
            return Ok(Self { checkpoint: Checkpoint::of_scene(Arc::new(blueprint)), is_scene: true });
        };
        if !settings.is_empty() {
            return Err(no_use(name_or_path, "a save file", "--set"));
        }
        Ok(Self::of_saved(saved, quality, effects))
    }
}

fn no_use(path: &str, what: &str, option: &str) -> Failure {
    bad(Path::new(path), &format_args!("{what} has no use for {option}; allowed: a scene"))
}

/// What is wrong with an input.
pub(super) fn bad(path: &Path, what: &dyn Display) -> Failure {
    Failure::Usage(format!("{}: {what}", path.display()))
}

/// The save file at a path; `None` if the name is a scene's, or of nothing, which the scenes know best to say.
fn read_save(name_or_path: &str) -> Result<Option<Checkpoint>, Failure> {
    let Some(path) = file_beside_scenes(name_or_path) else { return Ok(None) };
    Checkpoint::decode(&read(path)?).map(Some).map_err(|error| match error {
        FileError::Foreign(_) => {
            bad(path, &format_args!("{error}; allowed: a scene, a .ron file, a save file or a recording"))
        }
        _ => bad(path, &error),
    })
}

/// The recording at a path; `None` if there is something else, or nothing.
fn read_recording(name_or_path: &str) -> Result<Option<Recording>, Failure> {
    let Some(path) = file_beside_scenes(name_or_path) else { return Ok(None) };
    let bytes = read(path)?;
    if !Recording::is_meant(&bytes) {
        return Ok(None);
    }
    Recording::decode(&bytes).map(Some).map_err(|error| bad(path, &error))
}

/// The file that a name stands for, if it is no scene.
fn file_beside_scenes(name_or_path: &str) -> Option<&Path> {
    let path = Path::new(name_or_path);
    let is_scene = path.extension().is_some_and(|extension| extension == "ron");
    (!is_scene && !scene::builtin_names().contains(&name_or_path) && path.is_file()).then_some(path)
}

/// Largest save file or recording that is read, bytes: more than the largest that is written.
const LARGEST: u64 = 1 << 30;

/// The bytes of a file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes))
        .map_err(|error| bad(path, &format_args!("can't be read: {error}")))?;
    if bytes.len() as u64 > LARGEST {
        return Err(bad(path, &format_args!("larger than {} MiB; allowed: a save file or a recording", LARGEST >> 20)));
    }
    Ok(bytes)
}
