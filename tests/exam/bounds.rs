//! A bound of the gauntlet is loosened only together with its derivation: all are held against their history.

use powder_master::lab::gauntlet::{Bound, bounds};
use serde::Deserialize;

/// A change: what is bounded, the most that is allowed, derivation, date, commit or version.
#[derive(Clone, Debug, Deserialize)]
struct Change(String, f64, String, String, String);

fn history() -> Vec<Change> {
    ron::from_str(include_str!("bounds.ron")).unwrap_or_else(|error| panic!("tests/exam/bounds.ron: {error}"))
}

/// What is wrong with these bounds, by their history.
fn faults(bounds: &[Bound], history: &[Change]) -> Vec<String> {
    let mut faults = Vec::new();
    for Bound { name, most, why } in bounds {
        let own: Vec<&Change> = history.iter().filter(|change| change.0 == *name).collect();
        match own.last() {
            None => faults.push(format!("{name}: its bound {most} has no line in the history")),
            Some(last) if last.1 != *most => {
                faults.push(format!("{name}: is {most}, but {} in the last line of its history", last.1));
            }
            Some(last) if last.2 != *why => {
                faults.push(format!("{name}: follows from \"{why}\", but from \"{}\" in its history", last.2));
            }
            Some(_) => {}
        }
        for pair in own.windows(2) {
            if pair[1].1 > pair[0].1 && pair[1].2 == pair[0].2 {
                faults.push(format!("{name}: {} after {}, from the same derivation", pair[1].1, pair[0].1));
            }
        }
        if !own.is_sorted_by(|a, b| a.3 <= b.3) {
            faults.push(format!("{name}: its lines are not in the order of their dates"));
        }
    }
    for Change(name, most, _, date, version) in history {
        let lacks = most.is_nan() || *most < 0.0 || version.is_empty();
        if lacks || !date.split('-').map(str::len).eq([4, 2, 2]) {
            faults
                .push(format!("{name}: a line needs a bound, none below 0, a derivation, a date, a commit or version"));
        }
    }
    faults
}

#[test]
fn no_bound_is_looser_than_it_was_unless_it_follows_from_something_else() {
    let faults = faults(&bounds(), &history());
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_bound_that_is_loosened_for_no_reason_is_found() {
    let bound = |most, why: &str| vec![Bound { name: "rest".into(), most, why: why.into() }];
    let line = |most, why: &str| Change("rest".into(), most, why.into(), "2026-11-22".into(), "0.1.0".into());
    let known = [line(0.02, "a pixel")];
    assert_eq!(faults(&bound(0.02, "a pixel"), &known), [""; 0]);
    assert!(!faults(&bound(0.03, "a pixel"), &known).is_empty(), "looser, and not written down");
    assert!(!faults(&bound(0.01, "a pixel"), &known).is_empty(), "tighter, and not written down");
    assert!(!faults(&bound(0.02, "two pixels"), &known).is_empty(), "another derivation, and not written down");
    assert!(!faults(&bound(0.02, "a pixel"), &[]).is_empty(), "no line");
    let after = |most, why: &str| [known[0].clone(), line(most, why)];
    let looser = faults(&bound(0.03, "a pixel"), &after(0.03, "a pixel"));
    assert!(looser.iter().any(|fault| fault.contains("from the same derivation")), "{looser:?}");
    assert_eq!(faults(&bound(0.03, "half a pixel"), &after(0.03, "half a pixel")), [""; 0]);
    assert_eq!(faults(&bound(0.01, "a pixel"), &after(0.01, "a pixel")), [""; 0], "tighter is welcome");
    assert!(!faults(&bound(f64::NAN, "a pixel"), &[line(f64::NAN, "a pixel")]).is_empty(), "no number");
    // Lines of what is no longer bounded stay.
    assert_eq!(faults(&[], &known), [""; 0]);
}
