//! What a case of the exam is: a question with a known answer.

use crate::{
    lab::{
        cases::{Figures, Over, Setting, Size, Verdict, line, read},
        exam::set_up::SetUp,
    },
    scene::SceneError,
    sim::numbers::figure,
};
use serde::{Deserialize, Serialize};
use std::{pin::Pin, sync::LazyLock};

/// All cases, in the order in which they are shown.
pub static CASES: LazyLock<Vec<ExamCase>> =
    LazyLock::new(|| read("assets/exam/cases.ron", include_str!("../../../assets/exam/cases.ron")));

/// A question with a known answer, as `assets/exam/cases.ron` has it.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ExamCase {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// The setup and what is measured, in Markdown.
    #[serde(deserialize_with = "line")]
    pub setup: &'static str,
    /// The known answer and where it comes from, in Markdown.
    #[serde(deserialize_with = "line")]
    pub answer: &'static str,
    /// Why the tolerances are what they are, in Markdown.
    #[serde(deserialize_with = "line")]
    pub tolerance: &'static str,
    /// What it depends on.
    pub over: Over,
    /// How long it takes.
    pub size: Size,
}

/// What a case found out.
pub(super) type Findings = Result<Vec<Finding>, SceneError>;

/// What runs a case.
pub(super) type Run = fn(SetUp) -> Pin<Box<dyn Future<Output = Findings> + Send>>;

/// What a case found out about one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Finding {
    pub quantity: &'static str,
    pub unit: &'static str,
    pub expected: f64,
    pub got: f64,
    /// Whether `tolerance` is a share of what is expected, or else in its unit.
    pub relative: bool,
    pub tolerance: f64,
}

/// A finding that may be off by a share of what is expected.
pub(super) fn share(quantity: &'static str, unit: &'static str, expected: f64, got: f64, share: f64) -> Finding {
    Finding { quantity, unit, expected, got, relative: true, tolerance: share }
}

/// A finding that may be off by so much, in its unit.
pub(super) fn within(quantity: &'static str, unit: &'static str, expected: f64, got: f64, most: f64) -> Finding {
    Finding { quantity, unit, expected, got, relative: false, tolerance: most }
}

impl Finding {
    /// How it comes out in a setting.
    pub fn judge(self, setting: &Setting, milliseconds: f64) -> (Verdict, Answer) {
        let Self { quantity, unit, expected, got, relative, tolerance } = self;
        let distance = (got - expected).abs();
        let error = if relative { distance / expected.abs() } else { distance };
        // What is no number is beyond every tolerance.
        let verdict = match error <= tolerance {
            true => Verdict::Pass,
            false if setting.binding => Verdict::Fail,
            false => Verdict::Miss,
        };
        (verdict, Answer { quantity, unit, expected, got, relative, error, tolerance, milliseconds })
    }
}

/// One quantity of a case: what is known and what came out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// What was measured.
    pub quantity: &'static str,
    /// Unit of `expected` and `got`; empty for a ratio.
    pub unit: &'static str,
    /// The known answer.
    pub expected: f64,
    /// What the program gave.
    pub got: f64,
    /// Whether `error` and `tolerance` are shares of `expected`, or else in its unit.
    pub relative: bool,
    /// |got − expected|.
    pub error: f64,
    /// Largest error that passes.
    pub tolerance: f64,
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
}
