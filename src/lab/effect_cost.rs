//! What effects cost, and what it saves to run only those that a scene calls for.
//!
//! Each scene is run in to a moment in which it is well under way; from there it goes on several times, each time with
//! other effects switched on, in turns. What an effect costs is a difference of two such times: alone, against a world
//! with no effect at all, and together, against the world as it is but for this effect. A world that lacks an effect soon
//! goes another way, so the runs are short.

use crate::{
    kernel::params::Preset,
    lab::{
        experiment::{ExperimentError, Run, Spread, interleaved, time},
        run::Plan,
    },
    scene::{
        self,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        effects::Effects,
        simulation::Simulation,
        state::{AirGrid, ParticleStore},
        workers::Workers,
    },
};
use serde::Serialize;
use std::{io, sync::Arc};

/// Ticks before the moment from which all runs set out: 4 s.
const RUN_IN: u32 = 240;

/// Ticks at the start of a run that are not timed.
const WARMUP: u64 = 6;

/// Ticks of a run that are timed.
const TIMED: u64 = 60;

/// What effects cost in a scene. Times are medians of a tick, ms.
#[derive(Clone, Debug, Serialize)]
pub struct SceneCost {
    /// Name of the scene.
    pub scene: &'static str,
    /// Movable particles at the moment.
    pub particles: usize,
    /// Cells of the air.
    pub cells: usize,
    /// With the modes that the scene has.
    pub ms: f64,
    /// With every effect on.
    pub ms_all: f64,
    /// With every effect off.
    pub ms_none: f64,
    /// The largest spread between the runs of one choice, a share of their median: what a difference must exceed.
    pub spread: f64,
    /// Whether the world with every effect on is the same, to the bit.
    pub same: bool,
    /// The effects that ran, in the order of their stages.
    pub effects: Vec<EffectCost>,
}

impl SceneCost {
    /// Share of the time that running only what is called for saves.
    pub fn saved(&self) -> f64 {
        1.0 - self.ms / self.ms_all
    }
}

/// What an effect costs a tick, ms.
#[derive(Clone, Debug, Serialize)]
pub struct EffectCost {
    /// Its name.
    pub effect: &'static str,
    /// Against no effect at all.
    pub alone: f64,
    /// Against the world without it.
    pub together: f64,
}

/// Measures a built-in scene, each choice of effects in so many rounds.
///
/// # Errors
/// If there is no such scene.
pub fn measure(name: &'static str, preset: Preset, rounds: usize) -> Result<SceneCost, ExperimentError> {
    let blueprint = scene::load(name)?.build(&[], Some(preset), &EffectModes::new())?;
    let mut world = Simulation::new(Arc::new(blueprint), Workers::single());
    (0..RUN_IN).for_each(|_| world.tick());
    let start = Checkpoint::of(world.world());
    let effects = world.world().resource::<Effects>();
    let running: Vec<Effect> = Effect::ALL.into_iter().filter(|effect| effects.get(*effect).running).collect();
    let own = effects.modes();
    let all = |mode: Mode| -> EffectModes { Effect::ALL.into_iter().map(|effect| (effect, mode)).collect() };
    let but = |mut modes: EffectModes, effect: Effect, mode: Mode| {
        modes.insert(effect, mode);
        modes
    };
    let mut choices = vec![own.clone(), all(Mode::On), all(Mode::Off)];
    for &effect in &running {
        choices.push(but(all(Mode::Off), effect, Mode::On));
        choices.push(but(own.clone(), effect, Mode::Off));
    }
    let mut runs: Vec<Vec<Run>> = vec![Vec::new(); choices.len()];
    for (_, k) in interleaved(choices.len(), rounds) {
        runs[k].push(go_on(&start, preset, &choices[k])?);
    }
    let times = runs.iter().filter_map(|runs| Spread::of(runs.iter().map(|run| run.quantile(0.5))));
    let times: Vec<Spread> = times.collect();
    let ms: Vec<f64> = times.iter().map(|ms| ms.median).collect();
    let effects = running.iter().zip(ms[3..].chunks_exact(2)).map(|(effect, pair)| EffectCost {
        effect: effect.name(),
        alone: pair[0] - ms[2],
        together: ms[0] - pair[1],
    });
    let air = world.world().resource::<AirGrid>();
    Ok(SceneCost {
        scene: name,
        particles: world.world().resource::<ParticleStore>().len(),
        cells: air.columns() * air.rows(),
        ms: ms[0],
        ms_all: ms[1],
        ms_none: ms[2],
        spread: times.iter().map(Spread::share).fold(0.0, f64::max),
        same: runs[0].iter().chain(&runs[1]).all(|run| run.hash == runs[0][0].hash),
        effects: effects.collect(),
    })
}

/// Goes on from the start with a choice of effects.
pub(super) fn go_on(start: &Checkpoint, preset: Preset, modes: &EffectModes) -> io::Result<Run> {
    let mut run = Simulation::resume(
        &start.clone().at_quality(preset, preset.quality()).map_err(io::Error::other)?,
        Workers::single(),
    );
    let mut effects = run.world_mut().resource_mut::<Effects>();
    for (effect, mode) in modes {
        effects.get_mut(*effect).mode = *mode;
    }
    time(&mut run, &Plan { ticks: WARMUP + TIMED, warmup: WARMUP, ..Plan::default() }, &mut [])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_without_air_saves_the_air() {
        let cost = measure("hydrostatic", Preset::Draft, 1).unwrap();
        assert!(cost.particles > 1000 && cost.ms > 0.0);
        let named = |name: &str| cost.effects.iter().any(|effect| effect.effect == name);
        assert!(named("predictor") && !named("air"), "{:?}", cost.effects);
        assert!(measure("no such scene", Preset::Draft, 1).is_err());
    }
}
