//! Runs a random case and judges its world by every rule.

use super::case::Case;
use crate::{
    lab::gauntlet::{
        judged::{Found, Judged},
        rule::{Finding, Measured, Rule},
    },
    scene::{self, effects::EffectModes},
    sim::{simulation::Simulation, workers::Workers},
};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
};

/// Runs a case on one thread and judges its world after every tick.
pub fn examine(case: &Case) -> Found {
    let built =
        scene::from_text("case", case.scene.clone()).and_then(|file| file.build(&[], None, &EffectModes::new()));
    let blueprint = match built {
        Ok(blueprint) => blueprint,
        Err(error) => {
            let error = error.to_string();
            if !error.contains('\n') && error.contains("allowed") {
                return Found::Refused;
            }
            return unread(Measured::fault(0, format!("refused without a word: {error}")));
        }
    };
    // A panic is a fault like any other: the world that panics is kept, and the next one runs.
    let judged = catch_unwind(AssertUnwindSafe(|| {
        let simulation = Simulation::new(Arc::new(blueprint), Workers::single());
        let mut judged = Judged::new(simulation, case.input.clone(), case.ticks);
        (0..case.ticks).for_each(|_| judged.tick());
        judged.finish()
    }));
    judged.unwrap_or_else(|_| unread(Measured::fault(0, "the program panicked")))
}

fn unread(measured: Measured) -> Found {
    Found::Judged { findings: vec![Finding { rule: Rule::Reads, measured: Ok(measured) }], is_plain: false }
}

impl Found {
    /// The rules that are broken and should not be, with what was measured.
    pub fn broken(&self) -> impl Iterator<Item = (Rule, &Measured)> + '_ {
        let measured =
            self.findings().iter().filter_map(|Finding { rule, measured }| Some((*rule, measured.as_ref().ok()?)));
        measured.filter(|(rule, measured)| measured.is_broken() && !self.excuses(*rule))
    }

    /// What is broken, a line for each rule.
    pub fn faults(&self) -> Vec<String> {
        self.findings().iter().filter(|finding| !self.excuses(finding.rule)).filter_map(Finding::fault).collect()
    }
}
