//! What came of a scene at a quality.

use super::{
    super::run::Soak,
    plan::{Job, Plan},
};
use crate::{
    kernel::simd::InstructionSet,
    sim::{checkpoint::Checkpoint, fault, state::Counters, workers::Workers},
};
use bevy::platform::time::Instant;
use serde::{Deserialize, Serialize};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A scene that was soaked at a quality.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the scene.
    pub scene: String,
    /// Name of the quality.
    pub quality: String,
    /// Hash of the world at the end; none of one that the program panicked in.
    pub hash: Option<String>,
    /// What did not hold, each in a line; nothing if all did.
    pub faults: Vec<String>,
    /// The minute, from 1, by whose end something did not hold that never did again.
    pub since: Option<u64>,
    /// What the limiters did.
    pub counters: Counters,
    /// Time that it took, s.
    pub seconds: f64,
}

impl Row {
    /// Soaks a scene from its start on one thread, and judges it as every soak.
    pub(super) fn of(plan: &Plan, job: &Job, start: &Checkpoint) -> Self {
        let begun = Instant::now();
        // A panic is a fault like any other: the next scene is played.
        let row = catch_unwind(AssertUnwindSafe(|| Self::soaked(plan, start)));
        let row = row.unwrap_or_else(|payload| {
            let fault = format!("a panic: {}", fault::describe(&*payload));
            Self { faults: vec![fault], ..Self::default() }
        });
        let (scene, quality) = (job.scene.to_owned(), job.preset.name().to_owned());
        Self { scene, quality, seconds: begun.elapsed().as_secs_f64(), ..row }
    }

    fn soaked(plan: &Plan, start: &Checkpoint) -> Self {
        let mut soak = Soak::new(start, plan.seed, plan.minutes, Workers::single(), InstructionSet::detect());
        let mut since = None;
        while !soak.is_over() {
            soak.minute();
            let report = soak.report();
            since = (!report.faults().is_empty()).then(|| since.unwrap_or(report.minutes));
        }
        let hash = Some(format!("{:016x}", soak.hash()));
        let report = soak.finish();
        Self { hash, faults: report.faults(), since, counters: report.counters, ..Self::default() }
    }

    /// Whether all held.
    pub fn is_sound(&self) -> bool {
        self.faults.is_empty()
    }

    /// How it came out, in a table.
    pub(super) fn verdict(&self) -> String {
        match (self.is_sound(), self.since) {
            (true, _) => "sound".to_owned(),
            (false, Some(minute)) => format!("NOT since minute {minute}"),
            (false, None) => "NOT sound".to_owned(),
        }
    }

    /// What did not hold, in a line.
    pub(super) fn fault(&self) -> Option<String> {
        let since = self.since.map_or_else(String::new, |minute| format!(", since minute {minute}"));
        let faults = self.faults.join("; ");
        (!self.is_sound()).then(|| format!("{} at {}{since}: {faults}", self.scene, self.quality))
    }
}
