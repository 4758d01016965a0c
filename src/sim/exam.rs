//! Where the physics exam and the game meet: the game asks for an exam and shows its rows, the lab sits it and writes
//! them. Neither knows the other.

pub use crate::sim::desk::Progress;
use crate::sim::{desk::Desk, numbers::figure};
use serde::Serialize;

/// How a row came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Within the tolerance.
    Pass,
    /// Beyond the tolerance at a quality that promises nothing: `classic`, `draft` or `fast`.
    Miss,
    /// Beyond the tolerance at `balanced` or better.
    Fail,
}

/// One quantity of one case in one setting: what is known and what came out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Name of the case.
    pub case: &'static str,
    /// Heading of the case.
    #[serde(skip)]
    pub title: &'static str,
    /// What was measured.
    pub quantity: &'static str,
    /// The quality, or the settings of the air.
    pub setting: String,
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
    /// How it came out.
    pub verdict: Verdict,
    /// Time that simulating the case took in this setting, ms; the rows of a case share it.
    pub milliseconds: f64,
}

impl Row {
    /// What was expected, what came, the error and the tolerance, in words.
    pub fn figures(&self) -> [String; 4] {
        let with_unit = |value: f64| format!("{} {}", figure(value), self.unit).trim_end().to_owned();
        let distance =
            |value: f64| if self.relative { format!("{} %", figure(100.0 * value)) } else { with_unit(value) };
        [with_unit(self.expected), with_unit(self.got), distance(self.error), distance(self.tolerance)]
    }
}

/// What the game wants of the exam, and what has come of it.
pub type ExamDesk = Desk<Row>;
