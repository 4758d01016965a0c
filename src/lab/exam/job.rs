//! A case in one setting, and the whole exam: many of them.

use crate::{
    kernel::params::Preset,
    lab::{
        crew,
        drive::finish,
        exam::{
            case::{Case, Finding, Over, Setting, Tolerance},
            world::Clockwork,
        },
    },
    scene::SceneError,
    sim::exam::{Row, Verdict},
};

/// What comes of a job.
pub type Rows = Result<Vec<Row>, SceneError>;

/// A case in one setting.
#[derive(Clone)]
pub struct Job {
    /// The case.
    pub case: &'static Case,
    /// The setting.
    pub setting: Setting,
}

/// The cases for which `wanted` holds over these qualities, case by case.
pub fn jobs(cases: &'static [Case], wanted: impl Fn(&Case) -> bool, presets: &[Preset]) -> Vec<Job> {
    let over = |case: &'static Case| {
        let settings = match case.over {
            Over::Qualities => presets.iter().copied().map(Setting::of).collect(),
            Over::Air => Setting::airs(presets),
        };
        settings.into_iter().map(move |setting| Job { case, setting })
    };
    cases.iter().filter(|case| wanted(case)).flat_map(over).collect()
}

impl Job {
    /// What is said while it runs.
    pub fn title(&self) -> String {
        format!("{} at {}", self.case.name, self.setting.name)
    }

    /// Simulates the case and compares.
    pub async fn sit(self) -> Rows {
        let clockwork = Clockwork::default();
        let findings = (self.case.run)(self.setting.clone(), clockwork.clone()).await?;
        let milliseconds = clockwork.milliseconds();
        Ok(findings.iter().map(|finding| judge(&self, finding, milliseconds)).collect())
    }
}

fn judge(job: &Job, finding: &Finding, milliseconds: f64) -> Row {
    let Finding { quantity, unit, expected, got, tolerance } = *finding;
    let distance = (got - expected).abs();
    let (relative, error, tolerance) = match tolerance {
        Tolerance::Share(share) => (true, distance / expected.abs(), share),
        Tolerance::Within(within) => (false, distance, within),
    };
    // What is no number is beyond every tolerance.
    let verdict = match error <= tolerance {
        true => Verdict::Pass,
        false if job.setting.binding => Verdict::Fail,
        false => Verdict::Miss,
    };
    let setting = job.setting.name.clone();
    let Case { name: case, title, .. } = *job.case;
    Row { case, title, quantity, setting, unit, expected, got, relative, error, tolerance, verdict, milliseconds }
}

/// Sits all jobs, `side_by_side` at a time, and gives their rows in the order of the jobs. `says` hears how many are done
/// of how many, and which one is begun.
pub fn sit_all(jobs: &[Job], side_by_side: usize, says: impl Fn(usize, usize, &Job) + Sync) -> Rows {
    let dearness = |job: &Job| u64::from(job.setting.preset.quality().substeps);
    let results = crew::work(jobs, side_by_side, dearness, says, |job| finish(job.clone().sit(), || true));
    let mut rows = Vec::new();
    for result in results {
        rows.extend(result.unwrap_or_else(|| Ok(Vec::new()))?);
    }
    Ok(rows)
}
