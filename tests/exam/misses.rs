//! Every case at `balanced` and the quick ones at every quality: what misses is listed, and what is listed misses.

use powder_master::{
    kernel::params::Preset,
    lab::{
        cases::{Row, Size, Verdict, jobs, run_all, table},
        exam::{Answer, CASES, ExamCase, KnownMiss},
    },
};
use std::{collections::BTreeSet, thread::available_parallelism};

/// Whether these rows are beyond their tolerances without being listed, or listed without being beyond.
fn unlisted(cases: &[ExamCase], rows: &[Row<Answer>]) -> Vec<String> {
    let mut faults = Vec::new();
    for row in rows {
        let Some(case) = cases.iter().find(|case| case.name == row.case) else { continue };
        let Some(bound) = case.row(row.figures.quantity) else {
            faults.push(format!("{}, {}: has no tolerance", row.case, row.figures.quantity));
            continue;
        };
        let listed = bound.misses.iter().any(|miss| case.over.same(miss.at, row.preset));
        let [expected, got, error, tolerance] = row.figures.words();
        let what = format!(
            "{}, {} at {}: {got} for {expected}, {error} off, {tolerance} are allowed",
            row.case, row.figures.quantity, row.setting
        );
        match (row.verdict, listed) {
            (Verdict::Fail | Verdict::Miss, _) => faults.push(format!("a new miss. {what}")),
            (Verdict::Pass, true) => faults.push(format!("cured, but still listed as a miss. {what}")),
            (Verdict::Known, false) => faults.push(format!("known, but not listed. {what}")),
            _ => {}
        }
    }
    faults
}

#[test]
fn a_new_miss_and_a_cured_one_are_found() {
    let jobs = jobs(&CASES, |case| case.name == "free_fall", &[Preset::Draft], 1.0);
    let rows = run_all(&jobs, 1, |_, _| {}).expect("the scene can be built");
    let mut case = ExamCase { name: "free_fall", ..ExamCase::default() };
    case.rows = jobs[0].case.rows.clone();
    assert_eq!(unlisted(std::slice::from_ref(&case), &rows), [""; 0]);
    let with = |verdict: Verdict| vec![Row { verdict, ..rows[0].clone() }];
    for verdict in [Verdict::Miss, Verdict::Fail] {
        assert!(unlisted(std::slice::from_ref(&case), &with(verdict))[0].starts_with("a new miss. free_fall, speed"));
    }
    case.rows[0].misses = vec![KnownMiss { at: Preset::Draft, why: "it is told to" }];
    assert!(unlisted(std::slice::from_ref(&case), &rows)[0].starts_with("cured"));
    assert_eq!(unlisted(&[case], &with(Verdict::Known)), [""; 0]);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "heavy: in release only")]
fn what_misses_is_listed_and_what_is_listed_misses() {
    let mut jobs: Vec<_> = jobs(&CASES, |case| case.size == Size::Quick, &Preset::ALL, 1.0);
    jobs.extend(self::jobs(&CASES, |case| case.size != Size::Quick, &[Preset::Balanced], 1.0));
    let threads = available_parallelism().map_or(1, usize::from);
    let rows = run_all(&jobs, threads, |_, _| {}).expect("every scene can be built");
    for case in CASES.iter() {
        let found: BTreeSet<&str> =
            rows.iter().filter(|row| row.case == case.name).map(|row| row.figures.quantity).collect();
        let asked: BTreeSet<&str> = case.rows.iter().map(|row| row.quantity).collect();
        assert_eq!(found, asked, "{}: what is measured is what has a tolerance", case.name);
    }
    let faults = unlisted(&CASES, &rows);
    assert!(
        faults.is_empty(),
        "{}\nA miss is mended, or listed with its reason in `misses` in assets/exam/cases.ron; one that is cured is taken \
         off that list; no tolerance is loosened.\n{}",
        faults.join("\n"),
        table::<ExamCase>(&rows)
    );
}
