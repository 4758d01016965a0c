//! Gathers times and accuracy of a run, tick by tick, and makes the [`Metrics`] of it.

use crate::{
    kernel::{air::Release, units::TICKS_PER_SECOND},
    lab::{
        balance::matter,
        density::DensityError,
        drift::Drift,
        machine,
        metrics::{Accuracy, EffectCost, Metrics, ParticleCount, Sampling, Stage, TickTimes},
        run::Observer,
        stats,
        volume::volume_error,
    },
    scene::{
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{
        control,
        effects::{
            Effects,
            status::{self, EffectStatus, Sleepers},
        },
        ledger::{PassLedger, PassRecord},
        state::{
            AirGrid, Counters, DecayState, GasState, HeatState, ParticleStore, PredictorState, ReactionState, Rock,
            Setup, SleepState, SolverState,
        },
        workers::Workers,
    },
};
use bevy::{ecs::world::World, platform::time::Instant};
use std::{io, time::Duration};

/// Ticks from one accuracy sample to the next.
pub const SAMPLE_EVERY: u64 = 20;

/// Watches a run.
pub struct Sampler {
    begun: Instant,
    warmup: u64,
    ticks: u64,
    tick_ms: Vec<f64>,
    pass_ms: [Vec<f64>; Pass::ALL.len()],
    pass_totals: [Duration; Pass::ALL.len()],
    /// Active ticks of the effects at the end of the warm-up.
    active_before: [u64; Effect::ALL.len()],
    air_mass_before: f64,
    energy_before: f64,
    samples: Samples,
    drift: Drift,
    /// Time that measuring took.
    spent: Duration,
}

impl Sampler {
    /// A sampler of a run that starts with the world as it is, and leaves its first `warmup` ticks out.
    pub fn new(world: &World, warmup: u64) -> Self {
        Self {
            begun: Instant::now(),
            warmup,
            ticks: 0,
            tick_ms: Vec::new(),
            pass_ms: std::array::from_fn(|_| Vec::new()),
            pass_totals: [Duration::ZERO; Pass::ALL.len()],
            active_before: active_ticks(world),
            air_mass_before: air_mass(world),
            energy_before: matter(world).balance().energy(),
            spent: Duration::ZERO,
            samples: Samples::default(),
            drift: Drift::default(),
        }
    }

    /// The metrics of the run that ends here.
    pub fn finish(mut self, world: &World) -> Metrics {
        if self.samples.taken == 0 {
            self.sample(world);
        }
        let setup = world.resource::<Setup>();
        Metrics {
            scene: setup.blueprint.name.clone(),
            detail: setup.blueprint.scale.detail,
            quality: setup.preset.name(),
            quality_values: setup.quality,
            parameters: setup.blueprint.parameters.clone(),
            threads: world.resource::<Workers>().threads(),
            simd: world.resource::<SolverState>().instructions.name(),
            ticks: self.ticks,
            warmup: self.warmup,
            sim_seconds: self.ticks as f64 / f64::from(TICKS_PER_SECOND),
            wall_seconds: self.begun.elapsed().as_secs_f64(),
            hash: format!("{:016x}", control::hash(world)),
            particles: count(world),
            stages: self.stages(world),
            effects: self.effects(world),
            accuracy: self.accuracy(world),
            sampling: Sampling { ms_total: ms(self.spent), ms_median: stats::quantile(&mut self.samples.ms, 0.5) },
            stability: *world.resource::<Counters>(),
            memory_bytes: memory_bytes(world),
            peak_rss_bytes: machine::memory().map(|memory| memory.peak),
            ms_per_tick: TickTimes {
                max: stats::largest(&self.tick_ms),
                p95: stats::quantile(&mut self.tick_ms, 0.95),
                median: stats::quantile(&mut self.tick_ms, 0.5),
            },
        }
    }

    fn sample(&mut self, world: &World) {
        let start = Instant::now();
        self.samples.take(world);
        let took = start.elapsed();
        self.samples.ms.push(ms(took));
        self.spent += took;
    }

    fn note_times(&mut self, world: &World) {
        let ledger = world.resource::<PassLedger>();
        self.tick_ms.push(ms(ledger.last_tick()));
        for (k, pass) in Pass::ALL.into_iter().enumerate() {
            let total = ledger.record(pass).total;
            self.pass_ms[k].push(ms(total.saturating_sub(self.pass_totals[k])));
            self.pass_totals[k] = total;
        }
    }

    fn stages(&mut self, world: &World) -> Vec<(&'static str, Stage)> {
        let ledger = world.resource::<PassLedger>();
        (Pass::ALL.into_iter().zip(&mut self.pass_ms))
            .map(|(pass, times)| {
                let record = ledger.record(pass);
                let ms_median = stats::quantile(times, 0.5);
                let stage = Stage {
                    calls: record.calls,
                    ms_total: ms(record.total),
                    ms_median,
                    unit: pass.unit(),
                    touched: record.touched,
                    spared: record.spared,
                    ms_saved: record.saved(),
                };
                (pass.name(), stage)
            })
            .collect()
    }

    fn effects(&self, world: &World) -> Vec<(&'static str, EffectCost)> {
        let (ledger, effects) = (world.resource::<PassLedger>(), world.resource::<Effects>());
        let sleepers = Sleepers::in_world(world);
        let cost = |effect: Effect| {
            let EffectStatus { mode, activity, why, .. } = EffectStatus::of(effect, effects, sleepers);
            let (state, passes) = (effects.get(effect), effect.row().passes);
            let records = || passes.iter().map(|pass| ledger.record(*pass));
            let has_own = !passes.is_empty();
            let cost = EffectCost {
                mode,
                state: activity,
                active_ticks: state.active_ticks - self.active_before[effect as usize],
                differing_ticks: state.differing_ticks,
                calls: has_own.then(|| records().map(|record| record.calls).sum()),
                ms_total: has_own.then(|| records().map(|record| ms(record.total)).sum()),
                ms_saved: status::saving(effect, effects, ledger, PassRecord::saved),
                why,
            };
            (effect.name(), cost)
        };
        Effect::ALL.into_iter().map(cost).collect()
    }

    fn accuracy(&self, world: &World) -> Accuracy {
        let balance = matter(world).balance();
        let air_is_there = world.resource::<Effects>().get(Effect::Air).mode != Mode::Off;
        let mass = air_mass(world);
        let drift = (mass - self.air_mass_before) / self.air_mass_before;
        let density = || self.samples.density.iter();
        Accuracy {
            samples: self.samples.taken,
            density_error_mean: stats::mean(density().map(|error| error.mean)),
            density_error_p99: stats::mean(density().map(|error| error.p99)),
            density_error_max: stats::largest(density().map(|error| error.max)),
            density_mean: stats::mean(density().map(|error| error.density)),
            residual: residual(world),
            volume_error: stats::mean(&self.samples.volume),
            energy: balance.energy(),
            energy_start: self.energy_before,
            energy_peak: stats::largest(&self.samples.energy).unwrap_or(f64::NAN),
            momentum: balance.momentum.to_array(),
            air_mass_drift: (air_is_there && drift.is_finite()).then_some(drift),
            momentum_drift: self.drift.share(),
            air_divergence_rms: stats::mean(&self.samples.divergence).filter(|_| air_is_there),
            distance: None,
        }
    }
}

impl Observer for Sampler {
    fn after_tick(&mut self, world: &World) -> io::Result<()> {
        self.ticks += 1;
        if self.ticks > self.warmup {
            self.note_times(world);
            let start = Instant::now();
            self.drift.follow(world);
            self.spent += start.elapsed();
            if self.ticks.is_multiple_of(SAMPLE_EVERY) {
                self.sample(world);
            }
        }
        Ok(())
    }

    fn after_warmup(&mut self, world: &World) {
        self.active_before = active_ticks(world);
        self.drift = Drift::default();
        self.drift.follow(world);
    }
}

/// The samples of what costs too much for every tick.
#[derive(Default)]
struct Samples {
    taken: usize,
    density: Vec<DensityError>,
    energy: Vec<f64>,
    /// Time of each.
    ms: Vec<f64>,
    volume: Vec<f64>,
    divergence: Vec<f64>,
}

impl Samples {
    fn take(&mut self, world: &World) {
        let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
        let blueprint = &world.resource::<Setup>().blueprint;
        let (size, rest) = (blueprint.domain.size, f64::from(blueprint.fluid.rest_density));
        self.density.extend(DensityError::of_world(world));
        self.energy.push(matter(world).balance().energy());
        self.volume.extend(volume_error(particles, rock, size, rest));
        self.divergence.push(world.resource::<AirGrid>().divergence_rms());
        self.taken += 1;
    }
}

/// Mass of the air, d².
pub(super) fn air_mass(world: &World) -> f64 {
    world.resource::<AirGrid>().with_grid(world.resource::<Rock>()).mass()
}

fn active_ticks(world: &World) -> [u64; Effect::ALL.len()] {
    let effects = world.resource::<Effects>();
    let mut ticks = [0; Effect::ALL.len()];
    for effect in Effect::ALL {
        ticks[effect as usize] = effects.get(effect).active_ticks;
    }
    ticks
}

fn count(world: &World) -> ParticleCount {
    let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
    let elements = world.resource::<Setup>().elements();
    let mut numbers = vec![0; elements.len()];
    for element in particles.element.iter().copied().chain(rock.iter().map(|(_, element, _)| element)) {
        numbers[element.index()] += 1;
    }
    let by_element =
        elements.iter().zip(numbers).map(|((_, element), number)| (element.name.clone(), number)).collect();
    ParticleCount { total: particles.len() + rock.count(), by_element }
}

/// Mean constraint over the particles where it is violated, as the solver saw it in its last iteration.
pub(super) fn residual(world: &World) -> Option<f64> {
    let solver = world.resource::<SolverState>();
    (!solver.density.is_empty()).then(|| stats::mean(solver.violations().map(f64::from)).unwrap_or(0.0))
}

fn memory_bytes(world: &World) -> u64 {
    let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
    let air = world.resource::<AirGrid>();
    let solver = world.resource::<SolverState>().memory() + world.resource::<PredictorState>().memory();
    let heat = world.get_resource::<HeatState>().map_or(0, |heat| heat.memory());
    let reactions = world.get_resource::<ReactionState>().map_or(0, |reactions| reactions.memory());
    let decays = world.get_resource::<DecayState>().map_or(0, |decays| decays.memory());
    let gas = world.get_resource::<GasState>().map_or(0, |gas| gas.capacity() * size_of::<Release>());
    let sleep = world.resource::<SleepState>().memory();
    (solver + sleep + heat + reactions + decays + gas + particles.memory() + rock.memory() + air.memory_bytes()) as u64
}

pub(super) fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
    };
    use crate::{
        lab::run::{Plan, run},
        scene::{self, effects::EffectModes},
        sim::{
            intent::{Intent, IntentQueue},
            simulation::Simulation,
            workers::Workers,
        },
    };
    use std::sync::Arc;

    fn simulation(name: &str, settings: &[(&str, &str)], off: &[Effect]) -> Simulation {
        let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        let modes: EffectModes = off.iter().map(|effect| (*effect, Mode::Off)).collect();
        Simulation::new(
            Arc::new(scene::load(name).unwrap().build(&settings, None, &modes).unwrap()),
            Workers::default(),
        )
    }

    fn measure(simulation: &mut Simulation, ticks: u64) -> Metrics {
        let mut sampler = Sampler::new(simulation.world(), 0);
        run(simulation, &Plan { ticks, ..Plan::default() }, &mut [&mut sampler]).unwrap();
        sampler.finish(simulation.world())
    }

    #[test]
    fn a_drop_in_free_fall_keeps_its_momentum_but_for_gravity() {
        let still = [Effect::Air, Effect::Drag];
        // The predictor's grid solve is not exact, and neither is its way from particles to grid and back.
        for (off, limit) in [(&[still[0], still[1], Effect::Predictor][..], 1e-4), (&still, 5e-3)] {
            let mut simulation = simulation("empty", &[("columns", "100"), ("rows", "100")], off);
            let water = simulation.world().resource::<Setup>().elements().find("water").unwrap();
            let stroke = Stroke::dab(BrushShape::Disc, glam::Vec2::new(50.0, 80.0), 8.0);
            simulation.world_mut().resource_mut::<IntentQueue>().push(Intent::Stamp { element: water, stroke });
            let found = measure(&mut simulation, 25);
            let drift = found.accuracy.momentum_drift.unwrap();
            assert!(drift < limit, "the liquid pushed itself: {drift}");
            assert!(found.accuracy.momentum[1] < 0.0, "it falls");
            assert_eq!(found.accuracy.air_mass_drift, None, "the air is off");
        }
    }

    #[test]
    fn water_at_a_wall_has_no_momentum_drift_to_measure() {
        let found = measure(&mut simulation("hydrostatic", &[("columns", "12"), ("depth", "8")], &[]), 20);
        assert_eq!(found.accuracy.momentum_drift, None);
        assert!(found.accuracy.volume_error.unwrap().abs() < 0.1, "{:?}", found.accuracy);
        assert!(found.accuracy.residual.is_some());
        assert_eq!(found.stability.escaped, 0);
    }

    #[test]
    fn sealed_air_keeps_its_mass_while_it_moves() {
        let found = measure(&mut simulation("sealed_air", &[], &[]), 60);
        assert!(found.accuracy.air_mass_drift.unwrap().abs() < 1e-5, "{:?}", found.accuracy);
        assert!(found.accuracy.air_divergence_rms.unwrap() > 0.0, "the pulse travels");
    }

    #[test]
    fn memory_grows_by_the_particles() {
        let bytes = |columns| measure(&mut simulation("dam_break", &[("columns", columns)], &[]), 1).memory_bytes;
        let more = bytes("30") - bytes("10");
        assert!(
            more > (2 * 30 * 30 - 2 * 10 * 10) * crate::kernel::particles::Particles::BYTES as u64,
            "only {more} bytes more for 1,600 particles"
        );
    }

    #[test]
    #[cfg_attr(any(debug_assertions, target_arch = "wasm32"), ignore = "heavy: natively and in release only")]
    fn a_world_of_water_holds_at_most_128_bytes_a_particle_at_every_real_time_quality() {
        let presets = || Preset::ALL.into_iter().filter(|preset| *preset != Preset::Reference);
        for (columns, preset) in
            ["71", "224"].into_iter().flat_map(|columns| presets().map(move |preset| (columns, preset)))
        {
            let settings = [("columns".to_owned(), columns.to_owned())];
            let blueprint = scene::load("dam_break").unwrap().build(&settings, Some(preset), &EffectModes::new());
            let mut simulation = Simulation::new(Arc::new(blueprint.unwrap()), Workers::default());
            // What holds where it is too dense is filled when the column has come down.
            let bytes = measure(&mut simulation, 60).memory_bytes;
            let particles = simulation.world().resource::<ParticleStore>().len() as u64;
            assert!(particles > 10_000);
            assert!(bytes <= 128 * particles, "{}: {} bytes each of {particles}", preset.name(), bytes / particles);
        }
    }
}
