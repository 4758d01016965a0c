//! The quick exam, and that its rows can fail.

use super::{Answer, CASES, ExamCase, case::share, cases::runs};
use crate::{
    kernel::params::Preset,
    lab::{
        cases::{Row, Setting, Size, Verdict, jobs, run_all, summary, table},
        jobs::finish,
    },
};

#[test]
fn the_quick_exam_is_passed_at_balanced() {
    let jobs = jobs(&CASES, |case| case.size == Size::Quick, &[Preset::Balanced]);
    assert!(jobs.len() >= 5, "the quick exam is empty");
    let rows = run_all(&jobs, 2, |_, _| {}).unwrap();
    let failed: Vec<&Row<Answer>> = rows.iter().filter(|row| row.verdict != Verdict::Pass).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert!(rows.len() > jobs.len() && rows.iter().all(|row| row.figures.milliseconds > 0.0));
}

#[test]
fn an_exam_has_the_same_rows_side_by_side_and_stopped_and_gone_on_with() {
    let jobs = jobs(&CASES, |case| ["free_fall", "pulse"].contains(&case.name), &[Preset::Draft, Preset::Fast]);
    let answers = |rows: Vec<Row<Answer>>| {
        rows.into_iter().map(|row| (row.case, row.setting, row.figures.got.to_bits())).collect::<Vec<_>>()
    };
    let alone = answers(run_all(&jobs, 1, |_, _| {}).unwrap());
    assert_eq!(alone, answers(run_all(&jobs, 3, |_, _| {}).unwrap()));
    let mut ticks = 0;
    let stopped = finish(jobs[0].run(), || {
        ticks += 1;
        ticks < 10
    });
    assert!(stopped.is_none() && ticks == 10, "it yields after each tick");
}

#[test]
fn beyond_the_tolerance_is_a_miss_at_low_qualities_and_a_failure_from_balanced_on() {
    use Verdict::{Fail, Miss, Pass};
    let jobs = jobs(&CASES, |case| case.name == "free_fall", &Preset::ALL);
    let verdicts = |got: f64| {
        let judged = jobs.iter().map(|job| share("number", "", 2.0, got, 0.1).judge(&job.setting, 1.0).0);
        judged.collect::<Vec<_>>()
    };
    assert_eq!(verdicts(2.19), [Pass; 6]);
    // What is no number is beyond every tolerance.
    for got in [2.21, f64::NAN] {
        assert_eq!(verdicts(got), [Miss, Miss, Miss, Fail, Fail, Fail]);
    }
}

#[test]
fn cases_have_names_of_their_own() {
    for (k, case) in CASES.iter().enumerate() {
        assert!(CASES[..k].iter().all(|other| other.name != case.name), "two cases are called {}", case.name);
        assert!([case.title, case.setup, case.answer, case.tolerance].iter().all(|text| !text.is_empty()));
        assert!(runs().any(|(name, _)| *name == case.name), "nothing runs {}", case.name);
    }
    assert_eq!(runs().count(), CASES.len());
}

fn row(got: f64, verdict: Verdict) -> Row<Answer> {
    let setting = Setting { name: "fast".into(), preset: Preset::Fast, binding: false };
    let (_, figures) = share("speed", "m/s", 9.81, got, 0.02).judge(&setting, 12.3);
    Row { case: "free_fall", title: "Free fall", setting: setting.name, preset: setting.preset, verdict, figures }
}

#[test]
fn the_table_is_aligned_and_names_what_is_beyond() {
    let rows = [row(9.81, Verdict::Pass), row(12.0, Verdict::Miss), row(f64::NAN, Verdict::Fail)];
    let text = table::<ExamCase>(&rows);
    let lines: Vec<&str> = text.lines().collect();
    let width = lines[0].chars().count();
    assert!(lines.iter().all(|line| line.chars().count() == width), "not aligned:\n{text}");
    assert!(lines[2].contains("| 9.81 m/s | ") && lines[2].contains("| pass |"), "{text}");
    assert!(lines[3].contains("22.32 %") && lines[3].contains("2 %") && lines[3].contains("miss"), "{text}");
    assert!(lines[4].contains("none") && lines[4].contains("FAIL"), "{text}");
    assert_eq!(summary::<ExamCase>(&rows).split(": ").count(), 2);
}
