//! What is found in a hard case.

use crate::{
    lab::{
        cases::{Figures, Text, figure_or_nan, reason},
        gauntlet::rule::{Finding, Measured, Rule},
    },
    sim::{numbers::figure, state::Counters},
};
use serde::{Deserialize, Serialize};

/// How stable a case was at a quality.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stability {
    /// What broke, each in a few words with what was allowed.
    pub broken: Vec<String>,
    /// That it took too long, if it did: what counts only where the times do ([`Figures::count_time`]).
    pub late: Option<String>,
    /// Why what broke was to be expected, if it was.
    #[serde(deserialize_with = "reason")]
    pub known: Option<Text>,
    /// Ticks run.
    pub ticks: u64,
    /// Movable particles at the end.
    pub particles: usize,
    /// What came of each rule.
    pub rules: Vec<Came>,
    /// What the limiters did.
    pub clamps: Counters,
    /// Time of a tick that nine in ten do not exceed, as a multiple of a calm tick of the same world.
    #[serde(deserialize_with = "figure_or_nan")]
    pub time: f64,
    /// Time of a tick: median, ms.
    pub ms_median: f64,
    /// Time of a tick: the longest, ms.
    pub ms_max: f64,
    /// Time of the whole case, ms.
    pub ms_total: f64,
}

/// What came of a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Came {
    /// The rule.
    pub rule: Rule,
    /// What was measured nearest to its bound.
    pub measured: Option<Measured>,
    /// Why the rule does not apply, if it does not.
    #[serde(deserialize_with = "reason")]
    pub waived: Option<Text>,
}

impl Came {
    /// What a finding says.
    pub(super) fn of(finding: Finding) -> Self {
        let Finding { rule, measured } = finding;
        let waived = measured.as_ref().err().copied();
        Self { rule, measured: measured.ok(), waived }
    }

    /// In a table: what was measured, or why nothing was.
    pub fn cell(&self) -> String {
        let measured = self.measured.as_ref().map(|measured| figure(measured.value));
        measured.or(self.waived.map(str::to_owned)).unwrap_or_default()
    }
}

impl Stability {
    /// What came of a rule, for a table.
    pub fn cell(&self, rule: Rule) -> String {
        self.rules.iter().find(|came| came.rule == rule).map_or_else(String::new, Came::cell)
    }
}

impl Figures for Stability {
    const SETTING: &'static str = "quality";

    fn broken(&self) -> &[String] {
        &self.broken
    }

    fn known(&self) -> Option<&'static str> {
        self.known
    }

    fn count_time(&mut self) -> bool {
        let late = self.late.take();
        let is_late = late.is_some();
        self.broken.extend(late);
        is_late
    }
}
