//! One run of a setting: its times and, if it is the first, how exact it was.

use super::{
    design::Setting,
    journal::{Found, Record},
};
use crate::{
    kernel::params::{Preset, Quality},
    lab::{
        coarse::Distance,
        density::density_error,
        metrics::Metrics,
        reference::{Follower, Reference},
        run::{Observer, Plan, run as run_plan},
        sampler::{Sampler, ms},
        stats,
    },
    scene::blueprint::{Effect, Mode},
    sim::{
        checkpoint::Checkpoint,
        control,
        effects::Effects,
        ledger::PassLedger,
        simulation::Simulation,
        state::{ParticleStore, Rock, Setup},
        workers::Workers,
    },
};
use bevy::ecs::world::World;
use std::io;

/// The run that all are compared with, on all threads: its time is not what counts.
pub(super) fn reference(start: &Checkpoint, plan: &Plan) -> io::Result<Reference> {
    Reference::record(start, plan, Workers::default(), &mut Times::default())
}

/// Runs a setting from its start on; with a reference it is sampled, too.
pub(super) fn run(
    start: &Checkpoint,
    plan: &Plan,
    setting: &Setting,
    workers: &Workers,
    reference: Option<&Reference>,
) -> io::Result<Record> {
    // What the preset is called makes no difference to the run.
    let mut simulation = begin(start, setting.preset.unwrap_or(Preset::Fast), setting.quality, workers.clone());
    let density = mean_density(simulation.world());
    let mut times = Times { warmup: plan.warmup, ..Times::default() };
    let found = if let Some(reference) = reference {
        let mut sampler = Sampler::new(simulation.world(), plan.warmup);
        let mut follower = Follower::new(reference);
        run_plan(&mut simulation, plan, &mut [&mut times, &mut sampler, &mut follower])?;
        let mut found = found(&sampler.finish(simulation.world()), follower.mean(plan.warmup));
        found.energy_gain = found.energy_gain.filter(|_| start.is_closed()).map(|ratio| {
            // What swells to its target density is lifted by as much; that is not the energy of an unstable world.
            let swelling = found.density_mean.zip(density).map_or(1.0, |(after, before)| after / before);
            ratio * swelling - 1.0
        });
        Some(found)
    } else {
        run_plan(&mut simulation, plan, &mut [&mut times])?;
        None
    };
    Ok(Record {
        ms: stats::quantile(&mut times.ms, 0.5).unwrap_or(f64::NAN),
        ms_p95: stats::quantile(&mut times.ms, 0.95).unwrap_or(f64::NAN),
        hash: format!("{:016x}", control::hash(simulation.world())),
        found,
    })
}

/// The world at its start, awake.
fn begin(start: &Checkpoint, preset: Preset, quality: Quality, workers: Workers) -> Simulation {
    let mut simulation = Simulation::resume(&start.clone().at_quality(preset, quality), workers);
    // What sleeps costs the same at every quality, and errs by the same: it says nothing of any.
    simulation.world_mut().resource_mut::<Effects>().get_mut(Effect::Sleep).mode = Mode::Off;
    simulation
}

/// Mean density of the liquid's interior, 1 at rest density.
fn mean_density(world: &World) -> Option<f64> {
    let blueprint = &world.resource::<Setup>().blueprint;
    let (size, rest) = (blueprint.domain.size, f64::from(blueprint.fluid.rest_density));
    density_error(world.resource::<ParticleStore>(), world.resource::<Rock>(), size, rest).map(|error| error.density)
}

fn found(metrics: &Metrics, distance: Distance) -> Found {
    let (accuracy, stability) = (&metrics.accuracy, &metrics.stability);
    Found {
        particles: metrics.particles.total,
        error_mean: accuracy.density_error_mean,
        error_p99: accuracy.density_error_p99,
        error_max: accuracy.density_error_max,
        density_mean: accuracy.density_mean,
        volume_error: accuracy.volume_error,
        residual: accuracy.residual,
        energy_gain: Some(accuracy.energy_peak / accuracy.energy_start).filter(|ratio| ratio.is_finite()),
        lost: stability.non_finite + stability.escaped,
        distance,
    }
}

/// Notes the time of each tick after the warm-up.
#[derive(Default)]
struct Times {
    warmup: u64,
    tick: u64,
    ms: Vec<f64>,
}

impl Observer for Times {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        self.tick += 1;
        if self.tick > self.warmup {
            self.ms.push(ms(world.resource::<PassLedger>().last_tick()));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, blueprint::EffectModes};
    use std::sync::Arc;

    /// Accuracy of the dam break of 10,082 particles as a sweep measures it.
    fn dam_break(preset: Preset) -> Found {
        let blueprint = scene::load("dam_break").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let start = Checkpoint::of_scene(Arc::new(blueprint));
        let plan = Plan { ticks: 300, warmup: 59, ..Plan::default() };
        let mut simulation = begin(&start, preset, preset.quality(), Workers::default());
        let mut sampler = Sampler::new(simulation.world(), plan.warmup);
        run_plan(&mut simulation, &plan, &mut [&mut sampler]).unwrap();
        found(&sampler.finish(simulation.world()), Distance::default())
    }

    #[test]
    fn the_dam_break_is_as_exact_as_was_asked_for() {
        // Mean and 99th percentile of the density error; what they take is in docs/accuracy.md, as it is the machine's.
        for (preset, [mean, p99]) in [(Preset::Balanced, [0.003, 0.035]), (Preset::Fine, [0.0005, 0.01])] {
            let found = dam_break(preset);
            assert_eq!((found.particles, found.lost), (10_082, 0));
            assert!(found.error_mean.unwrap() <= mean && found.error_p99.unwrap() <= p99, "{preset:?}: {found:?}");
            // A liquid that stands thin has little error.
            assert!((found.density_mean.unwrap() - 1.0).abs() <= 0.02, "{preset:?}: {found:?}");
        }
    }
}
