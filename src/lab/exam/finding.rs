//! What a run of a case found out, and the verdict on it.

use crate::{
    kernel::params::Preset,
    lab::{
        cases::{Figures, Over, Setting, Text, Verdict, figure_or_nan, line, reason},
        exam::{Bound, ExamCase, set_up::SetUp},
    },
    scene::SceneError,
    sim::numbers::figure,
};
use serde::{Deserialize, Serialize};
use std::pin::Pin;

/// What a case found out.
pub(super) type Findings = Result<Vec<Finding>, SceneError>;

/// What runs a case.
pub(super) type Run = fn(SetUp) -> Pin<Box<dyn Future<Output = Findings> + Send>>;

/// What a case found out about one of its quantities.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Finding {
    pub quantity: &'static str,
    pub expected: f64,
    pub got: f64,
    /// What it was made of, in words; empty where there is nothing to say.
    pub note: String,
    /// The finding can't be told from the truth: nothing is claimed, and nothing can be beyond.
    pub at_the_floor: bool,
}

/// What was expected of a quantity and what came.
pub(super) fn found(quantity: &'static str, expected: f64, got: f64) -> Finding {
    Finding { quantity, expected, got, note: String::new(), at_the_floor: false }
}

impl ExamCase {
    /// How what was found in a setting comes out.
    pub(super) fn judge(&self, finding: Finding, setting: &Setting, milliseconds: f64) -> (Verdict, Answer) {
        let Finding { quantity, expected, got, mut note, at_the_floor } = finding;
        let row = self.row(quantity);
        // What has no bound is beyond it.
        let bound = row.map_or(Bound::Within(f64::NAN), |row| row.bound);
        let error = if at_the_floor { 0.0 } else { bound.error(expected, got) };
        let known = row.and_then(|row| row.misses.iter().find(|miss| self.over.same(miss.at, setting.preset)));
        // What is no number is beyond every tolerance.
        let verdict = match (error <= bound.value(), known) {
            _ if self.over == Over::Refinement && setting.preset == Preset::Classic => Verdict::Shown,
            (true, _) => Verdict::Pass,
            (false, Some(_)) => Verdict::Known,
            (false, None) if setting.binding => Verdict::Fail,
            (false, None) => Verdict::Miss,
        };
        if let (Verdict::Pass, Some(_)) = (verdict, known) {
            note =
                format!("{note} It is listed as a known miss, but holds: its line has to go.").trim_start().to_owned();
        }
        let answer = Answer {
            quantity,
            unit: row.map_or("", |row| row.unit),
            expected,
            got,
            relative: matches!(bound, Bound::Share(_)),
            error,
            tolerance: bound.value(),
            note,
            known: known.filter(|_| verdict == Verdict::Known).map(|miss| miss.why),
            milliseconds,
        };
        (verdict, answer)
    }
}

/// One quantity of a case: what is known and what came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// What was measured.
    #[serde(deserialize_with = "line")]
    pub quantity: Text,
    /// Unit of `expected` and `got`; empty for a ratio.
    #[serde(deserialize_with = "line")]
    pub unit: Text,
    /// The known answer.
    #[serde(deserialize_with = "figure_or_nan")]
    pub expected: f64,
    /// What the program gave.
    #[serde(deserialize_with = "figure_or_nan")]
    pub got: f64,
    /// Whether `error` and `tolerance` are shares of `expected`, or else in its unit.
    pub relative: bool,
    /// |got − expected|, or how far `got` is short of it; 0 where nothing can be told from the truth.
    #[serde(deserialize_with = "figure_or_nan")]
    pub error: f64,
    /// Largest error that passes.
    #[serde(deserialize_with = "figure_or_nan")]
    pub tolerance: f64,
    /// What it was made of, in words; empty where there is nothing to say.
    pub note: String,
    /// Why it is beyond, where that is a known miss.
    #[serde(deserialize_with = "reason")]
    pub known: Option<Text>,
    /// Time that simulating the case took in this setting, ms; the rows of a case share it.
    pub milliseconds: f64,
}

impl Answer {
    /// A value with its unit.
    pub(super) fn with_unit(&self, value: f64) -> String {
        format!("{} {}", figure(value), self.unit).trim_end().to_owned()
    }

    /// A distance from the known answer.
    pub(super) fn distance(&self, value: f64) -> String {
        if self.relative { format!("{} %", figure(100.0 * value)) } else { self.with_unit(value) }
    }

    /// What was expected, what came, the error and the tolerance, in words.
    pub fn words(&self) -> [String; 4] {
        let Self { expected, got, error, tolerance, .. } = *self;
        [self.with_unit(expected), self.with_unit(got), self.distance(error), self.distance(tolerance)]
    }
}

impl Figures for Answer {
    const SETTING: &'static str = "setting";

    fn remark(&self) -> Option<String> {
        let quantity = self.quantity;
        match (self.note.as_str(), self.known) {
            ("", None) => None,
            ("", Some(why)) => Some(format!("{quantity}: a known miss. {why}")),
            (note, None) => Some(format!("{quantity}: {note}")),
            (note, Some(why)) => Some(format!("{quantity}: {note} A known miss. {why}")),
        }
    }
}
