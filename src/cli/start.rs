//! The world that a run starts from: a scene, a scene as a replay found it, or a save file.

use crate::{
    cli::{
        args::{PlayOptions, RunArguments},
        failure::Failure,
    },
    kernel::{params::Preset, simd::InstructionSet},
    scene::{
        self,
        blueprint::{Blueprint, EffectModes},
    },
    sim::{
        control,
        effects::Effects,
        replay::Replay,
        save::{self, SaveError, Saved},
        state::SolverState,
    },
};
use bevy::ecs::world::World;
use std::{fmt::Display, fs, path::Path, sync::Arc};

/// Everything that was read and is ready to run.
pub(super) enum Start {
    /// The start of a scene.
    Scene(Box<Blueprint>),
    /// A saved world, with what the command line wants otherwise.
    Saved(Box<Saved>, Wishes),
}

/// What the command line changes in a saved world.
pub(super) struct Wishes {
    quality: Option<Preset>,
    effects: EffectModes,
}

impl Start {
    /// Reads what `run` names, with the recorded input if there is some.
    pub(super) fn of_run(arguments: &RunArguments) -> Result<(Self, Option<Replay>), Failure> {
        let effects: EffectModes = arguments.effects.iter().copied().collect();
        let Some(path) = arguments.replay.as_deref() else {
            let start = Self::read(&arguments.scene, &arguments.settings, arguments.quality, effects)?;
            return Ok((start, None));
        };
        if read_save(&arguments.scene)?.is_some() {
            return Err(only_a_scene(&arguments.scene, "--replay"));
        }
        let file = scene::load(&arguments.scene)?;
        let replay = read_replay(path)?;
        let header = &replay.header;
        if header.scene != file.name() {
            let (recorded, asked) = (&header.scene, file.name());
            let what = format!("was recorded in the scene {recorded}, not in {asked}; allowed: run {recorded}");
            return Err(bad(path, &what));
        }
        let modes = header.effects.iter().chain(&effects).map(|(effect, mode)| (*effect, *mode)).collect();
        let built = file.build(&header.settings(), Some(arguments.quality.unwrap_or(header.preset)), &modes)?;
        let blueprint = header.restore(built, arguments.quality.is_none());
        Ok((Self::Scene(Box::new(blueprint)), Some(replay)))
    }

    /// Reads what `play` names.
    pub(super) fn of_play(name_or_path: &str, options: &PlayOptions) -> Result<Self, Failure> {
        let start = Self::read(name_or_path, &options.settings, options.quality, EffectModes::new())?;
        match start {
            Self::Saved(..) if options.record.is_some() => Err(only_a_scene(name_or_path, "--record")),
            start => Ok(start),
        }
    }

    /// Reads what `soak` names.
    pub(super) fn of_soak(
        name_or_path: &str,
        settings: &[(String, String)],
        quality: Option<Preset>,
    ) -> Result<Self, Failure> {
        match Self::read(name_or_path, settings, quality, EffectModes::new())? {
            Self::Saved(..) => Err(only_a_scene(name_or_path, "soak")),
            start => Ok(start),
        }
    }

    /// Reads what `sweep` names.
    pub(super) fn of_sweep(name_or_path: &str, settings: &[(String, String)]) -> Result<Self, Failure> {
        Self::read(name_or_path, settings, None, EffectModes::new())
    }

    /// Name of the scene.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Scene(blueprint) => &blueprint.name,
            Self::Saved(saved, _) => saved.name(),
        }
    }

    /// Whether it is the start of a scene.
    pub(super) fn is_scene(&self) -> bool {
        matches!(self, Self::Scene(_))
    }

    fn read(
        name_or_path: &str,
        settings: &[(String, String)],
        quality: Option<Preset>,
        effects: EffectModes,
    ) -> Result<Self, Failure> {
        let Some(saved) = read_save(name_or_path)? else {
            let blueprint = scene::load(name_or_path)?.build(settings, quality, &effects)?;
            return Ok(Self::Scene(Box::new(blueprint)));
        };
        if !settings.is_empty() {
            return Err(only_a_scene(name_or_path, "--set"));
        }
        Ok(Self::Saved(Box::new(saved), Wishes { quality, effects }))
    }

    /// Makes `world` the start, to be simulated on the lanes of `instructions`.
    pub(super) fn load(self, world: &mut World, instructions: InstructionSet) {
        match self {
            Self::Scene(blueprint) => control::load(world, Arc::new(*blueprint)),
            Self::Saved(saved, wishes) => {
                save::load(world, *saved);
                if let Some(preset) = wishes.quality {
                    control::set_quality(world, preset, preset.quality());
                }
                let mut effects = world.resource_mut::<Effects>();
                for (effect, mode) in wishes.effects {
                    effects.get_mut(effect).mode = mode;
                }
            }
        }
        world.resource_mut::<SolverState>().instructions = instructions;
    }
}

fn only_a_scene(path: &str, option: &str) -> Failure {
    bad(Path::new(path), &format_args!("a save file has no use for {option}; allowed: a scene"))
}

fn bad(path: &Path, what: &dyn Display) -> Failure {
    Failure::Usage(format!("{}: {what}", path.display()))
}

/// The save file at a path; `None` if the name is a scene's, or of nothing, which the scenes know best to say.
fn read_save(name_or_path: &str) -> Result<Option<Saved>, Failure> {
    let path = Path::new(name_or_path);
    let is_scene = path.extension().is_some_and(|extension| extension == "ron");
    if is_scene || scene::builtin_names().contains(&name_or_path) || !path.is_file() {
        return Ok(None);
    }
    let bytes = fs::read(path).map_err(|error| bad(path, &format_args!("can't be read: {error}")))?;
    save::decode(&bytes).map(Some).map_err(|error| match error {
        SaveError::Foreign => bad(path, &format_args!("{error}; allowed: a scene, a .ron file or a save file")),
        _ => bad(path, &error),
    })
}

fn read_replay(path: &Path) -> Result<Replay, Failure> {
    let text = fs::read_to_string(path).map_err(|error| bad(path, &format_args!("can't be read: {error}")))?;
    Replay::read(&text, &*scene::elements()?).map_err(|error| bad(path, &error))
}
