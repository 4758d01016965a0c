//! What a case of the exam is: a question with a known answer.

use crate::{
    kernel::params::Preset,
    lab::cases::{Over, Size, line, read},
};
use serde::Deserialize;
use std::sync::LazyLock;

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
    /// How far each of its quantities may be off, in the order in which they are shown.
    pub rows: Vec<RowBound>,
    /// What it depends on.
    pub over: Over,
    /// How long it takes.
    pub size: Size,
}

/// How far a quantity of a case may be off.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RowBound {
    /// What is measured; a name of its own in the case.
    pub quantity: &'static str,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    /// The tolerance. tests/exam/tolerances.ron has its history; it only ever gets tighter.
    pub bound: Bound,
    /// Where it is known to be beyond.
    #[serde(default)]
    pub misses: Vec<KnownMiss>,
}

/// A tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub enum Bound {
    /// A share of what is expected.
    Share(f64),
    /// So much, in the quantity's unit.
    Within(f64),
    /// So much below what is expected, in the quantity's unit; more is as good.
    Short(f64),
}

impl Bound {
    /// The number of it.
    pub fn value(self) -> f64 {
        let (Self::Share(value) | Self::Within(value) | Self::Short(value)) = self;
        value
    }

    /// How far off a value is, in the unit of the tolerance.
    pub(super) fn error(self, expected: f64, got: f64) -> f64 {
        match self {
            Self::Share(_) => ((got - expected) / expected).abs(),
            Self::Within(_) => (got - expected).abs(),
            // `max` would make 0 of what is no number.
            Self::Short(_) if got >= expected => 0.0,
            Self::Short(_) => expected - got,
        }
    }
}

/// A miss that is known. It is shown as such; when it is cured, its line has to go.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownMiss {
    /// The quality, or the first of those that are the same setting of the case.
    pub at: Preset,
    /// Why it misses, as far as that is known.
    #[serde(deserialize_with = "line")]
    pub why: &'static str,
}

impl ExamCase {
    /// The row of a quantity.
    pub fn row(&self, quantity: &str) -> Option<&RowBound> {
        self.rows.iter().find(|row| row.quantity == quantity)
    }
}
