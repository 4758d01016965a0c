//! What heat costs: a tick of liquids of which every lump exchanges heat, against one of the same liquids without any.

use crate::{
    kernel::params::Preset,
    lab::{
        experiment::{ExperimentError, Run, Spread, interleaved, time},
        run::Plan,
    },
    scene::{self, effects::EffectModes},
    sim::{simulation::Simulation, state::ParticleStore, workers::Workers},
};
use serde::Serialize;
use std::sync::Arc;

/// The scene.
const SCENE: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/bench/heat.ron"));

/// Its parameters that are temperatures.
const TEMPERATURES: [&str; 3] = ["floor", "water", "oil"];

/// Ticks that are not timed, and that are.
const WARMUP: u64 = 60;
const TIMED: u64 = 240;

/// What heat costs on so many threads. Times are medians of a tick, ms.
#[derive(Clone, Debug, Serialize)]
pub struct HeatCost {
    /// Threads.
    pub threads: usize,
    /// Movable particles.
    pub particles: usize,
    /// With heat, and without.
    pub ms: [f64; 2],
    /// How many times as long a tick takes with it: the median of the rounds'.
    pub ratio: f64,
    /// The least and the greatest of the rounds' ratios.
    pub range: [f64; 2],
}

/// Measures it in so many rounds.
///
/// # Errors
/// If there is no world to measure.
pub fn measure(preset: Preset, workers: &Workers, rounds: usize) -> Result<HeatCost, ExperimentError> {
    let mut runs: [Vec<Run>; 2] = Default::default();
    let mut particles = 0;
    for (_, k) in interleaved(2, rounds) {
        let mut world = world(preset, k == 0, workers)?;
        particles = world.get::<ParticleStore>().len();
        runs[k].push(time(&mut world, &Plan { ticks: WARMUP + TIMED, warmup: WARMUP, ..Plan::default() }, &mut [])?);
    }
    let of = |runs: &[Run]| runs.iter().map(|run| run.quantile(0.5)).collect::<Vec<f64>>();
    let [with, without] = runs.map(|runs| of(&runs));
    let spread = |values: &mut dyn Iterator<Item = f64>| {
        Spread::of(values).unwrap_or(Spread { median: f64::NAN, range: [f64::NAN; 2] })
    };
    let ratios = spread(&mut with.iter().zip(&without).map(|(with, without)| with / without));
    Ok(HeatCost {
        threads: workers.threads(),
        particles,
        ms: [with, without].map(|ms| spread(&mut ms.into_iter()).median),
        ratio: ratios.median,
        range: ratios.range,
    })
}

/// The liquids, warm or as warm as the room.
fn world(preset: Preset, warm: bool, workers: &Workers) -> Result<Simulation, ExperimentError> {
    let settings = TEMPERATURES.map(|name| (name.to_owned(), "293".to_owned()));
    let settings = if warm { &[][..] } else { &settings };
    let blueprint = scene::from_text("heat", SCENE)?.build(settings, Some(preset), &EffectModes::new())?;
    Ok(Simulation::new(Arc::new(blueprint), workers.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::heat::units::ROOM,
        sim::{
            effects::Effects,
            state::{HeatCurves, SleepState},
        },
    };

    #[test]
    fn one_world_is_all_warm_and_the_other_has_no_heat_and_both_are_awake() {
        for warm in [true, false] {
            let mut world = world(Preset::Balanced, warm, &Workers::single()).expect("a world");
            world.run(WARMUP as u32 / 4);
            let particles = world.get::<ParticleStore>();
            assert_eq!(particles.len(), 10_000);
            let curves = world.get::<HeatCurves>();
            let kelvin = |i| curves.curve(particles.element[i]).temperature(particles.heat_of(i));
            let unlike = (0..particles.len()).filter(|i| (kelvin(*i) - ROOM).abs() > 1.0).count();
            assert_eq!(unlike, if warm { 10_000 } else { 0 });
            let effects = world.get::<Effects>();
            assert_eq!(effects.get(crate::scene::effects::Effect::Heat).running, warm);
            assert_eq!(world.get::<SleepState>().asleep(), 0);
        }
    }
}
