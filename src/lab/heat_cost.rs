//! What heat costs: a tick of liquids of which every lump exchanges heat, against one of the same liquids without any.

use crate::{
    kernel::params::Preset,
    lab::{
        experiment::{ExperimentError, interleaved, time},
        run::Plan,
        stats,
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

/// What heat costs on so many threads. Every round has the same work in the same tick and other programs only ever add to it, so the
/// shortest of the rounds counts for each tick. Times are medians of these, ms.
#[derive(Clone, Debug, Serialize)]
pub struct HeatCost {
    /// Threads.
    pub threads: usize,
    /// Movable particles.
    pub particles: usize,
    /// With heat, and without.
    pub ms: [f64; 2],
}

impl HeatCost {
    /// How many times as long a tick takes with heat.
    pub fn ratio(&self) -> f64 {
        self.ms[0] / self.ms[1]
    }
}

/// Measures it in so many rounds.
///
/// # Errors
/// If there is no world to measure.
pub fn measure(preset: Preset, workers: &Workers, rounds: usize) -> Result<HeatCost, ExperimentError> {
    let mut shortest = [(); 2].map(|()| vec![f64::INFINITY; TIMED as usize]);
    let mut particles = 0;
    for (_, k) in interleaved(2, rounds) {
        let mut world = world(preset, k == 0, workers)?;
        particles = world.get::<ParticleStore>().len();
        let run = time(&mut world, &Plan { ticks: WARMUP + TIMED, warmup: WARMUP, ..Plan::default() }, &mut [])?;
        shortest[k].iter_mut().zip(run.ms).for_each(|(shortest, ms)| *shortest = shortest.min(ms));
    }
    let ms = shortest.map(|mut ms| stats::quantile(&mut ms, 0.5).unwrap_or(f64::NAN));
    Ok(HeatCost { threads: workers.threads(), particles, ms })
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
            assert_eq!(effects.get(scene::effects::Effect::Heat).running, warm);
            assert_eq!(world.get::<SleepState>().asleep(), 0);
        }
    }
}
