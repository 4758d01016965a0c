//! The object that `run --metrics` writes. `null` stands where a value does not apply to the run.

use crate::{
    kernel::params::Quality,
    lab::coarse::Distance,
    scene::{effects::Mode, passes::Unit},
    sim::{effects::status::Activity, state::Counters},
};
use serde::{Deserialize, Serialize, Serializer};
use std::collections::BTreeMap;

/// Everything that is measured of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Metrics {
    /// Name of the scene.
    pub scene: String,
    /// The scene's own particle spacing over the run's: what `--detail` asked for times the quality's own.
    pub detail: f32,
    /// Name of the quality.
    pub quality: &'static str,
    /// The numbers in force, which `--set` may have moved away from the name's.
    pub quality_values: Quality,
    /// The scene's own parameters.
    pub parameters: BTreeMap<String, f64>,
    /// Threads of the kernel.
    pub threads: usize,
    /// Instruction set of the kernel, as `--simd` takes it.
    pub simd: &'static str,
    /// Ticks run, the warm-up included.
    pub ticks: u64,
    /// Ticks left out of times and samples.
    pub warmup: u64,
    /// Simulated time, s.
    pub sim_seconds: f64,
    /// Time that it took, with sampling, s.
    pub wall_seconds: f64,
    /// Hash of the final state, 16 hex digits: equal hashes mean equal particles, rock and air.
    pub hash: String,
    /// Final number of particles.
    pub particles: ParticleCount,
    /// Times of whole ticks.
    pub ms_per_tick: TickTimes,
    /// Cost of each stage of the tick.
    #[serde(serialize_with = "as_map")]
    pub stages: Vec<(&'static str, Stage)>,
    /// Cost of each effect and why it ran.
    #[serde(serialize_with = "as_map")]
    pub effects: Vec<(&'static str, EffectCost)>,
    /// How true the result is.
    pub accuracy: Accuracy,
    /// What finding that out cost.
    pub sampling: Sampling,
    /// What the limiters did since the scene began.
    pub stability: Counters,
    /// What particles, solver, rock and air hold, bytes.
    pub memory_bytes: u64,
    /// Most memory that the process has had, bytes; only on Linux.
    pub peak_rss_bytes: Option<u64>,
}

/// Number of particles, rock and movable ones together.
#[derive(Clone, Debug, Serialize)]
pub struct ParticleCount {
    /// In all.
    pub total: usize,
    /// By element, in the order of the table.
    #[serde(serialize_with = "as_map")]
    pub by_element: Vec<(String, usize)>,
}

/// Times of whole ticks, ms, from the first stage to the last.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TickTimes {
    /// Median.
    pub median: Option<f64>,
    /// 95th percentile.
    pub p95: Option<f64>,
    /// Longest.
    pub max: Option<f64>,
}

/// Cost of a stage.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Stage {
    /// Calls: one a tick or one a substep.
    pub calls: u64,
    /// Time in all, ms.
    pub ms_total: f64,
    /// Median time a tick, ms.
    pub ms_median: Option<f64>,
    /// What it works on.
    pub unit: Unit,
    /// How many of them it worked on, each as often as it did.
    pub touched: u64,
    /// How many it was spared because they slept or because it was not called.
    pub spared: u64,
    /// Time that this saved, ms, estimated as docs/effects.md says; `null` if the stage never ran.
    pub ms_saved: Option<f64>,
}

/// Cost of an effect.
#[derive(Clone, Debug, Serialize)]
pub struct EffectCost {
    /// What the scene or the command line wanted.
    pub mode: Mode,
    /// Whether it works in the last tick.
    pub state: Activity,
    /// Ticks in which it ran.
    pub active_ticks: u64,
    /// Ticks since the scene began in which `on` may make another world than `auto`.
    pub differing_ticks: u64,
    /// Calls of its stage; `null` if it is a part of another's.
    pub calls: Option<u64>,
    /// Time of its stage, ms; `null` if it is a part of another's.
    pub ms_total: Option<f64>,
    /// Time that was saved because it did not run, ms, estimated; of `sleep`, because what others work on slept. `null` if
    /// its stage never ran or is another's.
    pub ms_saved: Option<f64>,
    /// Why it ran or not in the last tick, or how much of what it works on slept.
    pub why: String,
}

/// How true the result is. Means are over the samples. What may be no number is not read back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Samples taken: one every 20 ticks after the warm-up, or one at the end of a shorter run.
    pub samples: usize,
    /// Mean density error of the interior particles (see `lab::density`).
    pub density_error_mean: Option<f64>,
    /// Mean of its 99th percentile.
    pub density_error_p99: Option<f64>,
    /// Its maximum over all samples.
    pub density_error_max: Option<f64>,
    /// Mean density of the interior particles, 1 at rest density.
    pub density_mean: Option<f64>,
    /// The solver's own mean constraint C over the particles with C > 0, in its last iteration of the run.
    pub residual: Option<f64>,
    /// Mean of the share of room that the liquid takes too much (see `lab::volume`).
    pub volume_error: Option<f64>,
    /// Kinetic and potential energy of the movable particles at the end, J for each metre of depth (`--trace` has it for
    /// every tick).
    #[serde(skip_deserializing)]
    pub energy: f64,
    /// The same at the start of the run.
    #[serde(skip_deserializing)]
    pub energy_start: f64,
    /// The highest of the samples.
    #[serde(skip_deserializing)]
    pub energy_peak: f64,
    /// Their momentum at the end, kg m/s for each metre of depth.
    #[serde(skip_deserializing)]
    pub momentum: [f64; 2],
    /// Change of the air's mass since the start, as a share of it.
    pub air_mass_drift: Option<f64>,
    /// Momentum that came from nowhere as a share of Σ m |v|, over the ticks in which only gravity acted from outside:
    /// no particle near a wall or rock, no drag, none come or gone. `null` if there was no such tick.
    pub momentum_drift: Option<f64>,
    /// Mean of the root mean square divergence of the air, 1/s.
    pub air_divergence_rms: Option<f64>,
    /// Mean distance to the same start at `reference` quality (see `lab::coarse`); only with `run --reference`.
    pub distance: Option<Distance>,
}

/// What measuring cost. It is in no tick's time.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Sampling {
    /// All of it after the warm-up, ms.
    pub ms_total: f64,
    /// Median of an accuracy sample, ms.
    pub ms_median: Option<f64>,
}

/// A list of pairs as one object, in its own order.
fn as_map<K: Serialize, V: Serialize, S: Serializer>(pairs: &[(K, V)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(key, value)| (key, value)))
}
