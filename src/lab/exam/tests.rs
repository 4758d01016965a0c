//! The quick exam, and that its rows can fail.

use super::{
    Answer, Bound, CASES, ExamCase, KnownMiss, RowBound,
    cases::runs,
    finding::{Finding, found},
};
use crate::{
    kernel::params::Preset,
    lab::{
        cases::{Figures, Over, Row, Setting, Size, Verdict, jobs, run_all, summary, table},
        jobs::finish,
    },
};

#[test]
#[cfg_attr(any(not(debug_assertions), target_arch = "wasm32"), ignore = "tests/exam has it, and the rest")]
fn the_quick_exam_is_passed_at_balanced() {
    let jobs = jobs(&CASES, |case| case.size == Size::Quick, &[Preset::Balanced], 1.0);
    assert!(jobs.len() >= 5, "the quick exam is empty");
    let rows = run_all(&jobs, 2, |_, _| {}).unwrap();
    let failed: Vec<&Row<Answer>> = rows.iter().filter(|row| row.verdict == Verdict::Fail).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert!(rows.len() > jobs.len() && rows.iter().all(|row| row.figures.milliseconds > 0.0));
}

#[test]
fn an_exam_has_the_same_rows_side_by_side_and_stopped_and_gone_on_with() {
    let jobs = jobs(&CASES, |case| ["free_fall", "pulse"].contains(&case.name), &[Preset::Draft, Preset::Fast], 1.0);
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

/// A case of one quantity, 2 ± 10 %, that is known to miss at `fine`.
fn told(over: Over) -> ExamCase {
    let misses = vec![KnownMiss { at: Preset::Fine, why: "it is told to" }];
    let row = RowBound { quantity: "number", unit: "m", bound: Bound::Share(0.1), misses };
    ExamCase { name: "told", rows: vec![row], over, ..ExamCase::default() }
}

#[test]
fn beyond_the_tolerance_is_a_miss_at_low_qualities_and_a_failure_from_balanced_on_unless_it_is_known() {
    use Verdict::{Fail, Known, Miss, Pass};
    let verdicts = |quantity: &'static str, got: f64| {
        let settings =
            jobs(&CASES, |case| case.name == "free_fall", &Preset::ALL, 1.0).into_iter().map(|job| job.setting);
        let judge = |setting| told(Over::Qualities).judge(found(quantity, 2.0, got), &setting, 1.0);
        settings.map(|setting| judge(setting).0).collect::<Vec<_>>()
    };
    assert_eq!(verdicts("number", 2.19), [Pass; 6], "one that is cured is not called a miss");
    // What is no number is beyond every tolerance.
    for got in [2.21, f64::NAN] {
        assert_eq!(verdicts("number", got), [Miss, Miss, Miss, Fail, Known, Fail]);
    }
    assert_eq!(verdicts("another", 2.0), [Miss, Miss, Miss, Fail, Fail, Fail], "what has no bound is beyond it");
}

#[test]
fn a_known_miss_says_why_and_classic_is_only_shown_where_the_spacing_is_judged() {
    let setting = |preset: Preset| Setting { name: preset.name().to_owned(), preset, detail: 1.0, binding: true };
    let (_, answer) = told(Over::Qualities).judge(found("number", 2.0, 3.0), &setting(Preset::Fine), 1.0);
    assert_eq!(answer.known, Some("it is told to"));
    assert_eq!(answer.remark().unwrap(), "number: a known miss. it is told to");
    let (_, cured) = told(Over::Qualities).judge(found("number", 2.0, 2.0), &setting(Preset::Fine), 1.0);
    assert!(cured.remark().unwrap().contains("its line has to go"), "{cured:?}");
    let verdict = |preset| told(Over::Refinement).judge(found("number", 2.0, 3.0), &setting(preset), 1.0).0;
    assert_eq!([Preset::Classic, Preset::Balanced].map(verdict), [Verdict::Shown, Verdict::Fail]);
}

#[test]
fn errors_are_shares_or_distances_and_more_than_expected_is_not_short() {
    assert_eq!(Bound::Share(0.1).error(2.0, 1.0), 0.5);
    assert_eq!(Bound::Within(0.1).error(2.0, 1.0), 1.0);
    assert_eq!([1.0, 2.0, 3.0].map(|got| Bound::Short(1.0).error(2.0, got)), [1.0, 0.0, 0.0]);
    assert!(Bound::Short(1.0).error(2.0, f64::NAN).is_nan());
    let at_the_floor = Finding { at_the_floor: true, ..found("number", 2.0, f64::NAN) };
    let setting = Setting { name: "draft".into(), preset: Preset::Draft, detail: 1.0, binding: false };
    assert_eq!(told(Over::Qualities).judge(at_the_floor, &setting, 1.0).0, Verdict::Pass);
}

#[test]
fn cases_have_names_of_their_own() {
    for (k, case) in CASES.iter().enumerate() {
        assert!(CASES[..k].iter().all(|other| other.name != case.name), "two cases are called {}", case.name);
        assert!([case.title, case.setup, case.answer, case.tolerance].iter().all(|text| !text.is_empty()));
        assert!(runs().any(|(name, _)| *name == case.name), "nothing runs {}", case.name);
        assert!(!case.rows.is_empty(), "{} has no tolerance", case.name);
        for (k, row) in case.rows.iter().enumerate() {
            assert!(case.rows[..k].iter().all(|other| other.quantity != row.quantity), "{} twice", row.quantity);
            assert!(row.bound.value() >= 0.0 && row.misses.iter().all(|miss| !miss.why.is_empty()), "{row:?}");
        }
    }
    assert_eq!(runs().count(), CASES.len());
}

fn row(got: f64, verdict: Verdict) -> Row<Answer> {
    let setting = Setting { name: "fast".into(), preset: Preset::Fast, detail: 1.0, binding: false };
    let bound = RowBound { quantity: "speed", unit: "m/s", bound: Bound::Share(0.02), misses: Vec::new() };
    let case = ExamCase { rows: vec![bound], ..ExamCase::default() };
    let (_, figures) = case.judge(found("speed", 9.81, got), &setting, 12.3);
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
