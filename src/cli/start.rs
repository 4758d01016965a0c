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
        picture,
        recording::{Recording, Segment},
    },
};
use std::{fmt::Display, fs::File, io::Read, path::Path, sync::Arc};

/// What the command line wants of the world that it names.
#[derive(Clone, Debug, Default)]
pub(super) struct Wanted<'a> {
    /// Parameters of the scene, and knobs.
    pub settings: &'a [(String, String)],
    /// The quality, if not the scene's own.
    pub quality: Option<Preset>,
    /// The detail, if not the scene's own.
    pub detail: Option<f64>,
    /// Modes of effects that are not the scene's.
    pub effects: EffectModes,
}

/// The world that a run starts from, and what is to be known of it.
pub(super) struct Start {
    /// The world.
    pub checkpoint: Checkpoint,
    /// Whether it is the start of a scene, not a saved world.
    pub is_scene: bool,
}

impl Start {
    /// Reads what `run` names, with the recorded input and the quality that it begins at if it is a recording.
    pub(super) fn of_run(arguments: &RunArguments) -> Result<(Self, Option<(Segment, Preset)>), Failure> {
        let effects: EffectModes = arguments.effects.iter().copied().collect();
        let RunArguments { scene, settings, quality, detail, .. } = arguments;
        let unfit = [
            ("--set", !settings.is_empty()),
            ("--detail", detail.is_some()),
            ("--hold-ms", arguments.hold_ms.is_some()),
            ("--hold-error", arguments.hold_error.is_some()),
        ];
        let Some(mut recording) = read_recording(scene, &unfit)? else {
            let wanted = Wanted { settings, quality: *quality, detail: *detail, effects };
            return Ok((Self::read(scene, wanted)?, None));
        };
        let Some(last) = recording.segments.pop() else {
            return Err(bad(Path::new(scene), &FileError::Foreign("recording")));
        };
        let saved = last.start().map_err(|error| bad(Path::new(scene), &error))?;
        let preset = saved.setup.preset;
        let start = Self::of_saved(Path::new(scene), saved, *quality, None, effects)?;
        Ok((start, Some((last, preset))))
    }

    /// Reads what `play` names, with the recording if it is one.
    pub(super) fn of_play(scene: &str, options: &PlayOptions) -> Result<(Self, Option<Recording>), Failure> {
        let PlayOptions { settings, quality, detail, .. } = options;
        let unfit = [("--set", !settings.is_empty()), ("--quality", quality.is_some()), ("--detail", detail.is_some())];
        let Some(recording) = read_recording(scene, &unfit)? else {
            let wanted = Wanted { settings, quality: *quality, detail: *detail, ..Wanted::default() };
            return Ok((Self::read(scene, wanted)?, None));
        };
        let start = Self::of_segment(scene, recording.segments.first())?;
        Ok((start, Some(recording)))
    }

    /// Reads what `soak` names.
    pub(super) fn of_soak(name_or_path: &str, wanted: Wanted<'_>) -> Result<Self, Failure> {
        match Self::read(name_or_path, wanted)? {
            start if start.is_scene => Ok(start),
            _ => Err(no_use(name_or_path, "a save file", "soak")),
        }
    }

    /// The state that a segment of a recording begins with.
    fn of_segment(path: &str, segment: Option<&Segment>) -> Result<Self, Failure> {
        let path = Path::new(path);
        let segment = segment.ok_or_else(|| bad(path, &FileError::Foreign("recording")))?;
        let saved = segment.start().map_err(|error| bad(path, &error))?;
        Self::of_saved(path, saved, None, None, EffectModes::new())
    }

    /// A saved world, with what the command line wants otherwise.
    fn of_saved(
        path: &Path,
        saved: Checkpoint,
        quality: Option<Preset>,
        detail: Option<f64>,
        effects: EffectModes,
    ) -> Result<Self, Failure> {
        let (own, asked) = (&saved.setup, saved.setup.asked_detail());
        let (preset, numbers) = quality.map_or((own.preset, own.quality), |preset| (preset, preset.quality()));
        let mut checkpoint = saved.at(preset, numbers, detail.unwrap_or(asked)).map_err(|what| bad(path, &what))?;
        checkpoint.modes.extend(effects);
        Ok(Self { checkpoint, is_scene: false })
    }

    /// Reads a scene or a save file.
    pub(super) fn read(name_or_path: &str, wanted: Wanted<'_>) -> Result<Self, Failure> {
        let Wanted { settings, quality, detail, effects } = wanted;
        let Some(saved) = read_save(name_or_path)? else {
            let scene = scene::load(name_or_path)?.at_detail(detail.unwrap_or(1.0));
            let blueprint = scene.build(settings, quality, &effects)?;
            return Ok(Self { checkpoint: Checkpoint::of_scene(Arc::new(blueprint)), is_scene: true });
        };
        if !settings.is_empty() {
            return Err(no_use(name_or_path, "a save file", "--set"));
        }
        Self::of_saved(Path::new(name_or_path), saved, quality, detail, effects)
    }
}

fn no_use(path: &str, what: &str, option: &str) -> Failure {
    bad(Path::new(path), &format_args!("{what} has no use for {option}; allowed: a scene"))
}

/// What is wrong with an input.
pub(super) fn bad(path: &Path, what: &dyn Display) -> Failure {
    Failure::Usage(format!("{}: {what}", path.display()))
}

/// The world in the save file or picture at a path; `None` if the name is a scene's, or of nothing, which the scenes know best to say.
fn read_save(name_or_path: &str) -> Result<Option<Checkpoint>, Failure> {
    let Some(path) = file_beside_scenes(name_or_path) else { return Ok(None) };
    picture::read_world(&read(path)?).map(Some).map_err(|error| match error {
        FileError::Foreign(_) => bad(
            path,
            &format_args!(
                "{error}; allowed: a scene, a .ron file, a save file, a picture with its world or a recording"
            ),
        ),
        _ => bad(path, &error),
    })
}

/// The recording at a path; `None` if there is something else, or nothing. Of the options in `unfit` none may be given
/// with it.
fn read_recording(name_or_path: &str, unfit: &[(&str, bool)]) -> Result<Option<Recording>, Failure> {
    let Some(path) = file_beside_scenes(name_or_path) else { return Ok(None) };
    let bytes = read(path)?;
    if !Recording::is_meant(&bytes) {
        return Ok(None);
    }
    let recording = Recording::decode(&bytes).map_err(|error| bad(path, &error))?;
    match unfit.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => Err(no_use(name_or_path, "a recording", option)),
        None => Ok(Some(recording)),
    }
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
        return Err(bad(
            path,
            &format_args!("larger than {} MiB; allowed: a save file, a picture or a recording", LARGEST >> 20),
        ));
    }
    Ok(bytes)
}
