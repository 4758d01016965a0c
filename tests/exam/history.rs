//! Tolerances only ever get tighter: those of the code are held against their history.

use powder_master::lab::exam::{Bound, CASES, ExamCase};
use serde::Deserialize;

/// A change: case, quantity, tolerance, date, commit or version, reason.
#[derive(Clone, Debug, Deserialize)]
struct Change(String, String, Bound, String, String, String);

fn history() -> Vec<Change> {
    ron::from_str(include_str!("tolerances.ron")).unwrap_or_else(|error| panic!("tests/exam/tolerances.ron: {error}"))
}

/// What is wrong with the tolerances of these cases, by their history.
fn faults(cases: &[ExamCase], history: &[Change]) -> Vec<String> {
    let mut faults = Vec::new();
    let kind = |bound: &Bound| std::mem::discriminant(bound);
    for case in cases {
        for row in &case.rows {
            let name = format!("{}, {}", case.name, row.quantity);
            let own: Vec<&Change> =
                history.iter().filter(|change| change.0 == case.name && change.1 == row.quantity).collect();
            let Some(last) = own.last() else {
                faults.push(format!("{name}: its tolerance {:?} has no line in the history", row.bound));
                continue;
            };
            let tightest = own.iter().map(|change| change.2.value()).fold(f64::INFINITY, f64::min);
            if row.bound.value() > tightest {
                faults.push(format!("{name}: {:?} is looser than the {tightest} that was", row.bound));
            }
            if last.2.value() > tightest {
                faults.push(format!("{name}: its last line, {:?}, is looser than the {tightest} that was", last.2));
            }
            if last.2 != row.bound {
                faults.push(format!("{name}: is {:?}, but {:?} in the last line of its history", row.bound, last.2));
            }
            if own.iter().any(|change| kind(&change.2) != kind(&row.bound)) {
                faults.push(format!("{name}: a tolerance of another kind is another quantity, with a name of its own"));
            }
            if !own.is_sorted_by(|a, b| a.3 <= b.3) {
                faults.push(format!("{name}: its lines are not in the order of their dates"));
            }
        }
    }
    for Change(case, quantity, bound, date, version, reason) in history {
        if !cases.iter().any(|known| known.name == case && known.row(quantity).is_some()) {
            faults.push(format!("{case}, {quantity}: in the history, but not in the exam"));
        }
        let numbers = date.split('-').map(|part| part.len()).eq([4, 2, 2]);
        if !numbers || version.is_empty() || reason.is_empty() || !(0.0..10.0).contains(&bound.value()) {
            faults.push(format!("{case}, {quantity}: a line needs a tolerance, a date, a commit or version, a reason"));
        }
    }
    faults
}

#[test]
fn no_tolerance_is_looser_than_it_ever_was() {
    let faults = faults(&CASES, &history());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The exam's cases with one of `collision` loosened.
fn change(to: Bound) -> Vec<ExamCase> {
    let mut case = ExamCase { name: "collision", rows: Vec::new(), ..ExamCase::default() };
    let rows = CASES.iter().filter(|case| case.name == "collision").flat_map(|case| case.rows.clone());
    case.rows.extend(rows);
    case.rows[0].bound = to;
    vec![case]
}

#[test]
fn what_is_looser_or_not_written_down_is_found() {
    let known: Vec<Change> = history().into_iter().filter(|change| change.0 == "collision").collect();
    let row = &change(Bound::Share(0.02))[0].rows[0];
    assert_eq!(faults(&change(Bound::Share(0.02)), &known), [""; 0]);
    let looser = faults(&change(Bound::Share(0.03)), &known);
    assert!(looser.iter().any(|fault| fault.contains("looser than the 0.02")), "{looser:?}");
    let line = |bound| {
        let mut lines = known.clone();
        lines.push(Change(
            "collision".into(),
            row.quantity.into(),
            bound,
            "2026-11-22".into(),
            "1".into(),
            "why".into(),
        ));
        lines
    };
    let edited = faults(&change(Bound::Share(0.03)), &line(Bound::Share(0.03)));
    assert!(edited.iter().any(|fault| fault.contains("its last line, Share(0.03), is looser")), "{edited:?}");
    assert_eq!(faults(&change(Bound::Share(0.01)), &line(Bound::Share(0.01))), [""; 0], "tighter is welcome");
    assert!(!faults(&change(Bound::Share(0.01)), &known).is_empty(), "but has to be written down");
    assert!(!faults(&change(Bound::Within(0.02)), &known).is_empty(), "another kind");
    assert!(!faults(&change(Bound::Share(0.02)), &known[..1]).is_empty(), "a row without a line");
    assert!(!faults(&[], &known).is_empty(), "lines of no row");
}
