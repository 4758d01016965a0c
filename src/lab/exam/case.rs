//! What a case of the exam is: a question with a known answer.

pub(super) use crate::lab::cases::{Over, Setting, Size};
use crate::{
    lab::cases::{Figures, Stopwatch, Verdict},
    scene::SceneError,
    sim::numbers::figure,
};
use serde::Serialize;
use std::pin::Pin;

/// A question with a known answer.
#[derive(Debug)]
pub struct ExamCase {
    /// Name on the command line.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// The setup and what is measured, in Markdown.
    pub setup: &'static str,
    /// The known answer and where it comes from, in Markdown.
    pub answer: &'static str,
    /// Why the tolerances are what they are, in Markdown.
    pub tolerance: &'static str,
    /// What it depends on.
    pub over: Over,
    /// How long it takes.
    pub size: Size,
    /// Simulates it.
    pub(super) run: fn(Setting, Stopwatch) -> Run,
}

/// A case at work.
pub(super) type Run = Pin<Box<dyn Future<Output = Result<Vec<Finding>, SceneError>> + Send>>;

/// How far from the known answer still passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tolerance {
    /// A share of the answer.
    Share(f64),
    /// In the unit of the answer.
    Within(f64),
}

/// What a case found out about one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Finding {
    pub quantity: &'static str,
    pub unit: &'static str,
    pub expected: f64,
    pub got: f64,
    pub tolerance: Tolerance,
}

impl Finding {
    /// How it comes out in a setting.
    pub fn judge(self, setting: &Setting, milliseconds: f64) -> (Verdict, Answer) {
        let Self { quantity, unit, expected, got, tolerance } = self;
        let distance = (got - expected).abs();
        let (relative, error, tolerance) = match tolerance {
            Tolerance::Share(share) => (true, distance / expected.abs(), share),
            Tolerance::Within(within) => (false, distance, within),
        };
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
