//! All bounds that worlds are judged by, each with its derivation: what the history of bounds is held to (`tests/exam`).

use super::{
    CASES,
    case::GauntletCase,
    rule::{AIR_ROUNDINGS, MOST_WORK, ONE_TOO_MANY, OVERLAP_SPEED, Rule, STILL, STILL_DENSITY, SWOLLEN},
};

/// A bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// What it bounds; of a case's own, the case first.
    pub name: String,
    /// The most that is allowed; infinite where a rule is waived.
    pub most: f64,
    /// Where it follows from.
    pub why: String,
}

impl Bound {
    fn new(name: impl Into<String>, most: f64, why: impl Into<String>) -> Self {
        Self { name: name.into(), most, why: why.into() }
    }
}

/// Those that hold everywhere, and then those of each case.
pub fn bounds() -> Vec<Bound> {
    let everywhere = [
        ("air: roundings", AIR_ROUNDINGS, Rule::Air),
        ("energy: speed of what parts, d/s", OVERLAP_SPEED, Rule::Energy),
        ("energy: share of what water holds by standing too high", SWOLLEN, Rule::Energy),
        ("density: share too dense", ONE_TOO_MANY, Rule::Density),
        ("density: share too dense, still water", STILL_DENSITY, Rule::Density),
        ("rest: d a tick", STILL, Rule::Rest),
        ("cost: calm ticks", MOST_WORK, Rule::Cost),
    ];
    let everywhere = everywhere.map(|(name, most, rule)| Bound::new(name, most, rule.why()));
    everywhere.into_iter().chain(CASES.iter().flat_map(own)).collect()
}

/// What a case is allowed beyond them.
fn own(case: &GauntletCase) -> Vec<Bound> {
    let name = |what: &str| format!("{}: {what}", case.name);
    let mut own: Vec<Bound> =
        case.bounds.iter().map(|(rule, bound)| Bound::new(name(rule.name()), bound.most, bound.why)).collect();
    own.extend(case.fastest.map(|bound| Bound::new(name("speed, m/s"), bound.most, bound.why)));
    own.extend((case.shock > 0).then(|| Bound::new(name("shock, ticks"), case.shock as f64, "the shock of its start")));
    own.extend(case.moves.map(|why| Bound::new(name("rest"), f64::INFINITY, why)));
    own.extend(case.waived.iter().map(|(rule, why)| Bound::new(name(rule.name()), f64::INFINITY, *why)));
    let known = case.known.iter().map(|(rule, known)| (rule.name(), known));
    own.extend(
        known
            .chain(case.known_own.iter().map(|known| ("its own", known)))
            .map(|(what, known)| Bound::new(name(&format!("{what} at classic")), f64::INFINITY, format!("{known:?}"))),
    );
    own
}
