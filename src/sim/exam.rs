//! Where the physics exam and the game meet: the game asks for an exam and shows its rows, the lab sits it and writes
//! them. Neither knows the other.

use crate::kernel::params::Preset;
use bevy::prelude::Resource;
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

/// How far the exam has come.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Progress {
    /// Nobody has asked for one.
    #[default]
    Idle,
    /// It runs.
    Running {
        /// Cases done, each in one setting.
        done: usize,
        /// Cases in all.
        of: usize,
        /// What is simulated now.
        now: String,
    },
    /// All rows are there.
    Done,
    /// It was stopped before its end.
    Stopped,
    /// It can't go on: why.
    Broken(String),
}

/// What the game wants of the exam, and what has come of it. Written by the game (`wanted`) and by the lab (the rest).
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct ExamDesk {
    /// The qualities at which an exam shall be sat. Taking it back stops it; it is taken back at its end.
    pub wanted: Option<Vec<Preset>>,
    /// How far it has come.
    pub progress: Progress,
    /// The rows that are there, in the order in which they came.
    pub rows: Vec<Row>,
}
