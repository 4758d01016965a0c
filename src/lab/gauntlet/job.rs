//! A case at a quality, and the whole gauntlet: many of them.

use crate::{
    kernel::params::Preset,
    lab::{
        crew,
        drive::finish,
        gauntlet::{
            case::Case,
            judge::{Books, Judge},
        },
        stage::{Clockwork, Stage},
    },
    scene::SceneError,
    sim::gauntlet::Row,
};

/// A case at a quality.
#[derive(Clone)]
pub struct Job {
    /// The case.
    pub case: &'static Case,
    /// The quality.
    pub preset: Preset,
}

/// The cases for which `wanted` holds at these qualities, case by case.
pub fn jobs(cases: &'static [Case], wanted: impl Fn(&Case) -> bool, presets: &[Preset]) -> Vec<Job> {
    let at = |case: &'static Case| presets.iter().map(move |preset| Job { case, preset: *preset });
    cases.iter().filter(|case| wanted(case)).flat_map(at).collect()
}

impl Job {
    /// What is said while it runs.
    pub fn title(&self) -> String {
        format!("{} at {}", self.case.name, self.preset.name())
    }

    /// Simulates the case and judges it. Yields after each tick.
    pub async fn judge(self) -> Result<Row, SceneError> {
        let Self { case, preset } = self;
        let clockwork = Clockwork::default();
        let mut stage = Stage::new(case.blueprint(preset)?, &clockwork);
        let mut judge = Judge::new(case, stage.world());
        for tick in 0..u64::from(case.ticks) {
            if let Some(act) = case.act {
                // What the script and its intents put in is told from what the tick does with it.
                let before = Books::of(stage.world());
                act(stage.world_mut(), tick);
                stage.edit();
                judge.edited(before, Books::of(stage.world()));
            }
            let before = Books::of(stage.world());
            let ticks = match case.frames {
                Some(frames) => stage.frame(frames(tick)).await,
                None => {
                    stage.tick().await;
                    1
                }
            };
            judge.look(before, ticks, stage.world());
        }
        Ok(judge.row(case, preset, stage.world(), clockwork.milliseconds()))
    }
}

/// Runs all jobs, `side_by_side` at a time, and gives their rows in the order of the jobs. `says` hears how many are done
/// of how many, and which one is begun.
pub fn run_all(
    jobs: &[Job],
    side_by_side: usize,
    says: impl Fn(usize, usize, &Job) + Sync,
) -> Result<Vec<Row>, SceneError> {
    let dearness = |job: &Job| {
        let quality = job.preset.quality();
        let long = job.case.size as u64;
        (long * 1000 + u64::from(quality.substeps * quality.iterations)) * u64::from(job.case.ticks)
    };
    let results = crew::work(jobs, side_by_side, dearness, says, |job| finish(job.clone().judge(), || true));
    // Nobody stops them: each has its row.
    results.into_iter().flatten().collect()
}
