//! Which scenes are to be soaked, at which qualities.

use crate::{
    kernel::params::Preset,
    lab::cases::Shard,
    scene::{self, SceneError, blueprint::Blueprint, effects::EffectModes},
    sim::checkpoint::Checkpoint,
};
use std::{cmp::Reverse, sync::Arc};

/// Edge of a cell of the air, d: one costs about what a particle does.
const AIR_CELL: f32 = 4.0;

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Scenes of the gallery.
    pub scenes: Vec<&'static str>,
    /// Simulated time of each scene, minutes. Up to an hour nothing is judged that needs a process of its own.
    pub minutes: u64,
    /// The player's random choices.
    pub seed: u64,
    /// How many times finer than its own the spacing of each scene is.
    pub detail: f64,
    /// Qualities.
    pub presets: Vec<Preset>,
    /// The part to run, if not all.
    pub shard: Option<Shard>,
    /// Scenes at a time, each on one thread.
    pub threads: usize,
}

/// A scene at a quality.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// Name of the scene.
    pub scene: &'static str,
    /// The quality.
    pub preset: Preset,
    /// What it costs, against others.
    pub(super) cost: u64,
}

impl Plan {
    /// The jobs of this shard, the most expensive first. They are dealt out in this order, so that shards take about as long:
    /// in that of scenes and qualities one of six shards would have all of `reference`.
    ///
    /// # Errors
    /// If a scene can't be built at this detail.
    pub fn jobs(&self) -> Result<Vec<Job>, SceneError> {
        let pairs = self.scenes.iter().flat_map(|scene| self.presets.iter().map(move |preset| (*scene, *preset)));
        let job = |(scene, preset)| Ok(Job { scene, preset, cost: cost(&self.build(scene, preset)?) });
        let mut jobs: Vec<Job> = pairs.map(job).collect::<Result<_, SceneError>>()?;
        jobs.sort_by_key(|job| Reverse(job.cost));
        let own = |(k, _): &(u64, Job)| self.shard.is_none_or(|shard| shard.has(*k));
        Ok((0..).zip(jobs).filter(own).map(|(_, job)| job).collect())
    }

    /// The world that a soak starts from.
    pub(super) fn start(&self, job: &Job) -> Result<Checkpoint, SceneError> {
        Ok(Checkpoint::of_scene(Arc::new(self.build(job.scene, job.preset)?)))
    }

    fn build(&self, scene: &str, preset: Preset) -> Result<Blueprint, SceneError> {
        scene::load(scene)?.at_detail(self.detail).build(&[], Some(preset), &EffectModes::new())
    }

    /// What a journal knows the rows by: equal only where all but their times must be.
    pub fn campaign(&self, program: &str) -> String {
        let Self { minutes, seed, detail, .. } = self;
        format!("{program} scenes, {minutes} min, seed {seed}, detail {detail}")
    }
}

impl Job {
    /// What is said while it runs, and what a journal knows its row by.
    pub fn title(&self) -> String {
        format!("{} at {}", self.scene, self.preset.name())
    }
}

/// What a scene costs, against others: passes over what there is room for in the box, as emitters and the player fill it.
fn cost(blueprint: &Blueprint) -> u64 {
    let passes = u64::from(blueprint.quality.substeps * (1 + blueprint.quality.iterations));
    let cells = blueprint.domain.size.element_product() / (AIR_CELL * AIR_CELL);
    passes * (blueprint.particles.len() as u64 + cells as u64)
}
