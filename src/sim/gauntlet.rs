//! Where the stability gauntlet and the game meet: the lab lays the cases here and says how they came out, the game shows
//! them and plays the one that is to be watched.

use crate::{
    kernel::params::Preset,
    scene::{SceneError, blueprint::Blueprint},
    sim::{checkpoint::Checkpoint, desk::Desk, script::Script, state::Counters},
};
use bevy::prelude::{Resource, World};
use serde::Serialize;
use std::sync::Arc;

/// How a case came out at a quality.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Nothing broke.
    Pass,
    /// Something broke where the plain method, `classic`, is known to.
    Known,
    /// Something broke.
    Fail,
}

/// A case at a quality.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Name of the case.
    pub case: &'static str,
    /// Heading of the case.
    #[serde(skip)]
    pub title: &'static str,
    /// Name of the quality.
    pub quality: &'static str,
    /// How it came out.
    pub verdict: Verdict,
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
    /// 99th percentile of the density error: the worst after the shock. `None` without a particle inside a liquid.
    pub density_worst: Option<f64>,
    /// The same over the last tenth of the case.
    pub density_end: Option<f64>,
    /// Root of the mean square of the speeds over the last tenth, d a tick.
    pub motion: f64,
    /// Dearest tick, as a multiple of a calm one: candidate pairs a particle, times substeps and iterations.
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

/// Makes the world of a case at a quality.
pub type Start = Arc<dyn Fn(Preset) -> Result<Blueprint, SceneError> + Send + Sync>;

/// A case as the game knows it.
#[derive(Clone)]
pub struct Entry {
    /// Name.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What happens in it.
    pub what: &'static str,
    /// Its world at a quality.
    pub start: Start,
    /// What is done to it before each tick.
    pub act: Option<fn(&mut World, u64)>,
}

/// The cases that can be watched, in the order in which they are shown. Written by the lab at the start.
#[derive(Resource, Clone, Default)]
pub struct Cases(pub Vec<Entry>);

impl Cases {
    /// The case called `name`.
    pub fn find(&self, name: &str) -> Option<&Entry> {
        self.0.iter().find(|entry| entry.name == name)
    }
}

impl Entry {
    /// Makes `world` the case's, which `start` built, and lets what is done to it begin.
    pub fn play(&self, world: &mut World, blueprint: Blueprint) {
        match self.act {
            Some(act) => world.insert_resource(Script { scene: blueprint.name.clone(), act }),
            None => drop(world.remove_resource::<Script>()),
        }
        Checkpoint::of_scene(Arc::new(blueprint)).restore(world);
    }
}

/// What the game wants of the gauntlet, and what has come of it.
pub type GauntletDesk = Desk<Row>;
