//! A case in one setting, and many of them.

use crate::{
    kernel::params::Preset,
    lab::{
        cases::{case::Case, row::Row, setting::Setting, simulation::Stopwatch},
        jobs::{finish, pool},
    },
    scene::SceneError,
};

/// A case in one setting.
pub struct Job<C: 'static> {
    /// The case.
    pub case: &'static C,
    /// The setting.
    pub setting: Setting,
}

/// The cases for which `wanted` holds at these qualities and this detail, case by case.
pub fn jobs<C: Case>(cases: &'static [C], wanted: impl Fn(&C) -> bool, presets: &[Preset], detail: f64) -> Vec<Job<C>> {
    let of = |case: &'static C| {
        case.about().over.settings(presets, detail).into_iter().map(move |setting| Job { case, setting })
    };
    cases.iter().filter(|case| wanted(case)).flat_map(of).collect()
}

impl<C: Case> Job<C> {
    /// What is said while it runs.
    pub fn title(&self) -> String {
        format!("{} at {}", self.case.about().name, self.setting.name)
    }

    /// Simulates the case and judges. Yields after each tick.
    pub async fn run(&self) -> Result<Vec<Row<C::Figures>>, SceneError> {
        let about = self.case.about();
        let found = self.case.run(&self.setting, &Stopwatch::default()).await?;
        let row = |(verdict, figures)| Row {
            case: about.name,
            title: about.title,
            setting: self.setting.name.clone(),
            preset: self.setting.preset,
            verdict,
            figures,
        };
        Ok(found.into_iter().map(row).collect())
    }

    /// What it costs, against others.
    fn cost(&self) -> u64 {
        let quality = self.setting.preset.quality();
        let passes = u64::from(quality.substeps * quality.iterations);
        (1000 * self.case.about().size as u64 + passes) * self.case.length()
    }
}

/// Runs all jobs, `threads` at a time, and gives their rows in the order of the jobs. `report` is called with how
/// many are done, and with the one that begins.
pub fn run_all<C: Case>(
    jobs: &[Job<C>],
    threads: usize,
    report: impl Fn(usize, &Job<C>) + Sync,
) -> Result<Vec<Row<C::Figures>>, SceneError> {
    let results = pool::run(jobs, threads, Job::cost, report, |job| finish(job.run(), || true));
    let mut rows = Vec::new();
    // None is stopped: each has its rows.
    for result in results.into_iter().flatten() {
        rows.extend(result?);
    }
    Ok(rows)
}
