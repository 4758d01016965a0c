//! The worlds of the cases: scenes at a quality.

pub(super) use crate::lab::cases::{CaseSimulation, Stopwatch};
use crate::{
    kernel::params::Preset,
    lab::cases::Setting,
    scene::{
        self, SceneError, SceneFile,
        blueprint::Blueprint,
        effects::{Effect, EffectModes, Mode},
    },
};

/// Acceleration of gravity of the scenes, m/s².
pub(super) const GRAVITY: f64 = 9.81;

/// A scene of the game's menu, with settings put in.
pub(super) fn builtin(name: &str, settings: &[(&str, f64)], setting: &Setting) -> Result<Blueprint, SceneError> {
    build(&scene::load(name)?, settings, setting.preset)
}

/// A scene of the exam's own (`assets/exam`), with settings put in.
pub(super) fn own(
    name: &str,
    text: &'static str,
    settings: &[(&str, f64)],
    setting: &Setting,
) -> Result<Blueprint, SceneError> {
    build(&scene::from_text(name, text)?, settings, setting.preset)
}

fn build(file: &SceneFile, settings: &[(&str, f64)], preset: Preset) -> Result<Blueprint, SceneError> {
    let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), value.to_string())).collect();
    // What rests has to come to rest, and stay there, by the method alone.
    file.build(&settings, Some(preset), &EffectModes::from([(Effect::Sleep, Mode::Off)]))
}
