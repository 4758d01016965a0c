//! Runs a random case and judges its world by every rule.

use super::case::Case;
use crate::{
    lab::gauntlet::{
        examiner::{Examiner, SHOCK, Terms},
        measure::{
            energy::Stored,
            still::{is_plain, why_not_at_rest},
        },
        rule::{Finding, Measured, ONE_TOO_MANY, Rule},
    },
    scene::{
        self,
        effects::{Effect, EffectModes},
        passes::Pass,
    },
    sim::{
        effects::Effects,
        intent::Intent,
        ledger::PassLedger,
        recording::{Entry, Input},
        simulation::Simulation,
        state::Setup,
        workers::Workers,
    },
};
use bevy::ecs::world::World;
use std::{
    collections::BTreeMap,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
};

/// Ticks in which water that has no reason to move has left the lattice that it was put on and rests: 2 s.
const SETTLED: u64 = 120;

/// What came of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// The scene was refused, as it should be: in one line that says what is allowed.
    Refused,
    /// Its world was judged.
    Judged {
        /// A finding for each rule, in their order.
        findings: Vec<Finding>,
        /// Whether it moved matter without the pressure predictor at any time.
        is_plain: bool,
    },
}

impl Found {
    /// What was found of each rule.
    pub fn findings(&self) -> &[Finding] {
        match self {
            Self::Refused => &[],
            Self::Judged { findings, .. } => findings,
        }
    }

    /// Whether what breaks a rule is a known limit of the method: [`Rule::is_beyond_plain`].
    pub fn excuses(&self, rule: Rule) -> bool {
        rule.is_beyond_plain() && matches!(self, Self::Judged { is_plain: true, .. })
    }

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
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::single());
        let mut examiner = Examiner::new(simulation.world(), terms(simulation.world(), &case.input, case.ticks));
        let mut waiting = Input::new(case.input.clone());
        let mut is_plain = false;
        for _ in 0..case.ticks {
            let before = Stored::of(simulation.world());
            if waiting.give(simulation.world_mut()) > 0 {
                simulation.apply_edits();
                examiner.edited(before, simulation.world(), true);
            }
            examiner.begin(simulation.world());
            simulation.tick();
            examiner.look(simulation.world());
            is_plain |= moves_plainly(simulation.world());
        }
        Found::Judged { findings: examiner.finish(simulation.world()), is_plain }
    }));
    judged.unwrap_or_else(|_| unread(Measured::fault(0, "the program panicked")))
}

/// Whether the last tick moved matter without the pressure predictor.
fn moves_plainly(world: &World) -> bool {
    let moved = world.resource::<PassLedger>().record(Pass::Solve).last.touched > 0;
    moved && !world.resource::<Effects>().get(Effect::Predictor).running
}

fn unread(measured: Measured) -> Found {
    Found::Judged { findings: vec![Finding { rule: Rule::Reads, measured: Ok(measured) }], is_plain: false }
}

/// The terms of a world at its start, which runs so many ticks under such hands.
pub(super) fn terms(world: &World, input: &[Entry], ticks: u32) -> Terms {
    let setup = world.resource::<Setup>();
    let idle = |entry: &Entry| match entry.intent {
        Intent::ClearAir => true,
        Intent::Quality { preset, quality } => quality.predictor && preset.detail() == setup.preset.detail(),
        Intent::Effect { effect, .. } => [Effect::Air, Effect::AirFeedback, Effect::Drag].contains(&effect),
        _ => false,
    };
    let restless = match why_not_at_rest(&setup.blueprint) {
        Ok(()) if !is_plain(&setup.blueprint.fluid) => Err("no plain liquid"),
        Ok(()) if !input.iter().all(idle) => Err("hands move it"),
        Ok(()) if u64::from(ticks) < SETTLED => Err("not long enough"),
        rest => rest,
    };
    Terms {
        length: u64::from(ticks),
        restless,
        shock: SHOCK,
        // What liquid gives back that was pressed to the bound of its density.
        given_back: ONE_TOO_MANY,
        bounds: BTreeMap::new(),
        waived: BTreeMap::new(),
        confines: None,
        removed: 0,
        lenient: true,
    }
}
