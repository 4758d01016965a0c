//! What is found in a hard case.

use crate::{lab::cases::Figures, sim::state::Counters};
use serde::Serialize;

/// How stable a case was at a quality.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stability {
    /// What broke, each in a few words with what was allowed.
    pub broken: Vec<String>,
    /// Why that was to be expected, if it was.
    pub known: Option<&'static str>,
    /// Ticks run.
    pub ticks: u64,
    /// Movable particles at the end.
    pub particles: usize,
    /// Energy gained beyond what was put in, as the speed that all particles together would have of it, m/s.
    pub gain: f64,
    /// Most of that which is allowed.
    pub gain_allowed: Option<f64>,
    /// 99th percentile of how far the liquid is too dense: the worst after the shock. `None` without a particle inside
    /// a liquid.
    pub density_worst: Option<f64>,
    /// The same over the last tenth of the case.
    pub density_end: Option<f64>,
    /// Root of the mean square of the speeds over the last tenth, in the scene's own spacings a tick.
    pub motion: f64,
    /// The most expensive tick, as a multiple of a calm one: candidate pairs a particle, times substeps and iterations.
    pub work: f64,
    /// Most of that which is allowed.
    pub work_allowed: f64,
    /// What the limiters did.
    pub clamps: Counters,
    /// Time of a tick: median, ms.
    pub ms_median: f64,
    /// Time of a tick: the longest, ms.
    pub ms_max: f64,
    /// Time of the whole case, ms.
    pub ms_total: f64,
}

impl Figures for Stability {
    const SETTING: &'static str = "quality";

    fn broken(&self) -> &[String] {
        &self.broken
    }

    fn known(&self) -> Option<&'static str> {
        self.known
    }
}
