//! What effects cost, and what it saves to run only those that a scene calls for.
//!
//! Each scene is run in to a moment in which it is well under way; from there it goes on several times, each time with
//! other effects switched on, in turns. What an effect costs is a difference of two such times: alone, against a world
//! with no effect at all, and together, against the world as it is but for this effect. A world that lacks an effect soon
//! goes another way, so the runs are short.

use crate::{
    kernel::params::Preset,
    lab::stats::{largest, quantile},
    scene::{
        self, SceneError,
        blueprint::{Effect, EffectModes, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        control,
        effects::Effects,
        ledger::PassLedger,
        simulation::Simulation,
        state::{AirGrid, ParticleStore},
        workers::Workers,
    },
};
use serde::Serialize;
use std::sync::Arc;

/// Ticks before the moment from which all runs set out: 4 s.
const RUN_IN: u32 = 240;

/// Ticks of a run that are not timed, and ticks that are.
const TICKS: [u32; 2] = [6, 60];

/// What is measured.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Quality of all runs.
    pub preset: Preset,
    /// Runs of each choice of effects; the median counts.
    pub rounds: usize,
}

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

/// A choice of effects and its times.
struct Choice {
    modes: EffectModes,
    ms: Vec<f64>,
    hash: u64,
}

impl Choice {
    fn new(modes: EffectModes) -> Self {
        Self { modes, ms: Vec::new(), hash: 0 }
    }

    fn median(&self) -> f64 {
        quantile(&mut self.ms.clone(), 0.5).unwrap_or(f64::NAN)
    }

    fn spread(&self) -> f64 {
        let least = self.ms.iter().copied().fold(f64::INFINITY, f64::min);
        (largest(&self.ms).unwrap_or(f64::NAN) - least) / self.median()
    }
}

/// Measures a built-in scene.
///
/// # Errors
/// If there is no such scene.
pub fn measure(name: &'static str, plan: Plan) -> Result<SceneCost, SceneError> {
    let blueprint = scene::load(name)?.build(&[], Some(plan.preset), &EffectModes::new())?;
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
    let mut choices = vec![Choice::new(own.clone()), Choice::new(all(Mode::On)), Choice::new(all(Mode::Off))];
    for &effect in &running {
        choices.push(Choice::new(but(all(Mode::Off), effect, Mode::On)));
        choices.push(Choice::new(but(own.clone(), effect, Mode::Off)));
    }
    for _ in 0..plan.rounds {
        choices.iter_mut().for_each(|choice| time(&start, plan.preset, choice));
    }
    let ms: Vec<f64> = choices.iter().map(Choice::median).collect();
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
        spread: choices.iter().map(Choice::spread).fold(0.0, f64::max),
        same: choices[0].hash == choices[1].hash,
        effects: effects.collect(),
    })
}

/// Goes on from the start with a choice of effects and notes the median tick.
fn time(start: &Checkpoint, preset: Preset, choice: &mut Choice) {
    let start = Checkpoint { modes: choice.modes.clone(), ..start.clone().at_quality(preset, preset.quality()) };
    let mut run = Simulation::resume(&start, Workers::single());
    let [warmup, timed] = TICKS;
    (0..warmup).for_each(|_| run.tick());
    run.world_mut().resource_mut::<PassLedger>().clear();
    (0..timed).for_each(|_| run.tick());
    choice.ms.push(run.world().resource::<PassLedger>().tick().median().as_secs_f64() * 1e3);
    choice.hash = control::hash(run.world());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_without_air_saves_the_air() {
        let plan = Plan { preset: Preset::Draft, rounds: 1 };
        let cost = measure("hydrostatic", plan).unwrap();
        assert!(cost.particles > 1000 && cost.ms > 0.0);
        let named = |name: &str| cost.effects.iter().any(|effect| effect.effect == name);
        assert!(named("predictor") && !named("air"), "{:?}", cost.effects);
        assert!(measure("no such scene", plan).is_err());
    }
}
