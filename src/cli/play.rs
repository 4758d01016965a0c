//! `play`: the game's window.

use crate::{
    cli::{args::PlayOptions, failure::Failure, threads},
    scene::{
        self,
        blueprint::{Blueprint, EffectModes},
    },
    sim::workers::Workers,
};

/// The scene without a name.
const DEFAULT_SCENE: &str = "waterfall";

/// Opens the game with a scene.
pub(super) fn play(scene: Option<&str>, options: &PlayOptions) -> Result<(), Failure> {
    let scene = scene::load(scene.unwrap_or(DEFAULT_SCENE))?;
    let blueprint = scene.build(&options.settings, options.quality, &EffectModes::new())?;
    open(blueprint, threads::workers(options.threads)?)
}

#[cfg(not(feature = "app"))]
fn open(blueprint: Blueprint, _workers: Workers) -> Result<(), Failure> {
    Err(Failure::Usage(format!(
        "this build has no window (it lacks the cargo feature `app`); `powder-master run {}` works without one",
        blueprint.name
    )))
}
