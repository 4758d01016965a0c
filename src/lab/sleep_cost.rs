//! What it saves to let water sleep: ticks of a world that came to rest, asleep and awake.

use crate::{
    kernel::params::Preset,
    lab::{
        effect_cost::go_on,
        experiment::{ExperimentError, Run, Spread, interleaved},
    },
    scene::{
        self,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        simulation::Simulation,
        state::{ParticleStore, SleepState},
        workers::Workers,
    },
};
use serde::Serialize;
use std::sync::Arc;

/// Ticks within which a world must fall asleep: five minutes.
const LONGEST: u32 = 18_000;

/// What sleep saves in a world at rest. Times are medians of a tick, ms.
#[derive(Clone, Debug, Serialize)]
pub struct SleepCost {
    /// Name of the scene.
    pub scene: &'static str,
    /// Movable particles.
    pub particles: usize,
    /// Those of them that sleep.
    pub asleep: usize,
    /// Ticks until all of them did, or [`LONGEST`].
    pub ticks: u32,
    /// With `sleep` off.
    pub ms_awake: f64,
    /// With it on.
    pub ms_asleep: f64,
}

/// Lets a built-in scene fall asleep on one thread and measures how it goes on, asleep and awake, in so many rounds.
///
/// # Errors
/// If there is no such scene.
pub fn measure(
    name: &'static str,
    settings: &[(String, String)],
    preset: Preset,
    rounds: usize,
) -> Result<SleepCost, ExperimentError> {
    let blueprint = scene::load(name)?.build(settings, Some(preset), &EffectModes::new())?;
    let mut world = Simulation::new(Arc::new(blueprint), Workers::single());
    let mut ticks = 0;
    while ticks < LONGEST && world.get::<SleepState>().asleep() < world.get::<ParticleStore>().len() {
        world.tick();
        ticks += 1;
    }
    let start = Checkpoint::of(world.world());
    let choices = [Mode::Off, Mode::On].map(|mode| EffectModes::from([(Effect::Sleep, mode)]));
    let mut runs: [Vec<Run>; 2] = Default::default();
    for (_, k) in interleaved(choices.len(), rounds) {
        runs[k].push(go_on(&start, preset, &choices[k])?);
    }
    let median = |runs: Vec<Run>| Spread::of(runs.iter().map(|run| run.quantile(0.5))).map_or(f64::NAN, |ms| ms.median);
    let [ms_awake, ms_asleep] = runs.map(median);
    let (particles, asleep) = (world.get::<ParticleStore>().len(), world.get::<SleepState>().asleep());
    Ok(SleepCost { scene: name, particles, asleep, ticks, ms_awake, ms_asleep })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tank_at_rest_costs_next_to_nothing() {
        let settings = [("columns", "40"), ("depth", "20")].map(|(key, value)| (key.to_owned(), value.to_owned()));
        let cost = measure("hydrostatic", &settings, Preset::Draft, 1).unwrap();
        assert_eq!((cost.particles, cost.asleep), (800, 800));
        assert!((1..LONGEST).contains(&cost.ticks) && cost.ms_asleep > 0.0, "{cost:?}");
        assert!(cost.ms_awake > 2.0 * cost.ms_asleep, "{cost:?}");
        assert!(measure("no such scene", &[], Preset::Draft, 1).is_err());
    }
}
