//! The quick exam, and that its rows can fail.

use super::{
    CASES, Case, Job,
    case::{Finding, Over, Run, Setting, Tolerance},
    finish, jobs, sit_all,
    world::Clockwork,
};
use crate::{
    kernel::params::Preset,
    sim::exam::{Row, Verdict},
};

#[test]
fn the_quick_exam_is_passed_at_balanced() {
    let jobs = jobs(CASES, |case| case.quick, &[Preset::Balanced]);
    assert!(jobs.len() >= 5, "the quick exam is empty");
    let rows = sit_all(&jobs, 2, |_, _, _| {}).unwrap();
    let failed: Vec<&Row> = rows.iter().filter(|row| row.verdict != Verdict::Pass).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert!(rows.len() > jobs.len() && rows.iter().all(|row| row.milliseconds > 0.0));
}

#[test]
fn an_exam_has_the_same_rows_side_by_side_and_stopped_and_gone_on_with() {
    let jobs = jobs(CASES, |case| ["free_fall", "pulse"].contains(&case.name), &[Preset::Draft, Preset::Fast]);
    let answers =
        |rows: Vec<Row>| rows.into_iter().map(|row| (row.case, row.setting, row.got.to_bits())).collect::<Vec<_>>();
    let alone = answers(sit_all(&jobs, 1, |_, _, _| {}).unwrap());
    assert_eq!(alone, answers(sit_all(&jobs, 3, |_, _, _| {}).unwrap()));
    let mut ticks = 0;
    let stopped = finish(jobs[0].clone().sit(), || {
        ticks += 1;
        ticks < 10
    });
    assert!(stopped.is_none() && ticks == 10, "it yields after each tick");
}

/// Cases that answer where 2 ± 10 % is known: just within, just beyond, and nothing.
static TOLD: [Case; 3] = [told(|_, _| answer(2.19)), told(|_, _| answer(2.21)), told(|_, _| answer(f64::NAN))];

const fn told(run: fn(Setting, Clockwork) -> Run) -> Case {
    Case { name: "told", title: "", setup: "", answer: "", tolerance: "", over: Over::Qualities, quick: false, run }
}

fn answer(got: f64) -> Run {
    let finding = Finding { quantity: "number", unit: "", expected: 2.0, got, tolerance: Tolerance::Share(0.1) };
    Box::pin(async move { Ok(vec![finding]) })
}

#[test]
fn beyond_the_tolerance_is_a_miss_at_low_qualities_and_a_failure_from_balanced_on() {
    use Verdict::{Fail, Miss, Pass};
    let rows = sit_all(&jobs(&TOLD, |_| true, &Preset::ALL), 1, |_, _, _| {}).unwrap();
    let verdicts: Vec<Verdict> = rows.iter().map(|row| row.verdict).collect();
    let beyond = [Miss, Miss, Miss, Fail, Fail, Fail];
    // What is no number is beyond every tolerance.
    assert_eq!(verdicts, [[Pass; 6], beyond, beyond].concat());
}

#[test]
fn air_is_examined_once_for_each_of_its_settings() {
    let settings = |presets: &[Preset]| {
        let jobs: Vec<Job> = jobs(CASES, |case| case.name == "pulse", presets);
        jobs.into_iter().map(|job| (job.setting.name, job.setting.binding)).collect::<Vec<_>>()
    };
    assert_eq!(settings(&[Preset::Fast, Preset::Fast]).len(), 1);
    assert_eq!(settings(&[Preset::Fast, Preset::Balanced]).len(), 2, "another air is another setting");
    let same_cells = [Preset::Classic, Preset::Balanced];
    assert!(same_cells.iter().all(|preset| preset.quality().air_cell == 4.0));
    assert_eq!(settings(&same_cells).len(), 2, "another advection is another setting");
    assert_eq!(settings(&same_cells).iter().filter(|setting| setting.1).count(), 1, "classic promises nothing");
}

#[test]
fn cases_have_names_of_their_own() {
    for (k, case) in CASES.iter().enumerate() {
        assert!(CASES[..k].iter().all(|other| other.name != case.name), "two cases are called {}", case.name);
        assert!([case.title, case.setup, case.answer, case.tolerance].iter().all(|text| !text.is_empty()));
    }
}
