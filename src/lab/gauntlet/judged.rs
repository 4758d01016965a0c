//! A world under hands, tick by tick before its judge: under those of the dice, and under what a player throws at it.

use super::{
    examiner::{Examiner, SHOCK, Terms},
    measure::{
        energy::Stored,
        still::{is_plain, why_not_at_rest},
    },
    rule::{Finding, ONE_TOO_MANY, Rule},
};
use crate::{
    scene::{effects::Effect, passes::Pass},
    sim::{
        effects::Effects,
        intent::Intent,
        ledger::PassLedger,
        recording::{Entry, Input},
        simulation::Simulation,
        state::Setup,
    },
};
use bevy::ecs::world::World;
use std::collections::BTreeMap;

/// Ticks in which water that has no reason to move has left the lattice that it was put on and rests: 2 s.
const SETTLED: u64 = 120;

/// What came of a world.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// Its scene was refused, as it should be: in one line that says what is allowed.
    #[cfg(not(target_arch = "wasm32"))]
    Refused,
    /// It was judged.
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
            #[cfg(not(target_arch = "wasm32"))]
            Self::Refused => &[],
            Self::Judged { findings, .. } => findings,
        }
    }

    /// Whether what breaks a rule is a known limit of the method: [`Rule::is_beyond_plain`].
    pub fn excuses(&self, rule: Rule) -> bool {
        rule.is_beyond_plain() && matches!(self, Self::Judged { is_plain: true, .. })
    }
}

/// A world, what hands do to it, and its judge.
pub(super) struct Judged {
    simulation: Simulation,
    waiting: Input,
    examiner: Examiner,
    is_plain: bool,
}

impl Judged {
    /// A world as it is, to which `input` (oldest first) is done in the next `ticks` ticks.
    pub fn new(simulation: Simulation, input: Vec<Entry>, ticks: u32) -> Self {
        let examiner = Examiner::new(simulation.world(), terms(simulation.world(), &input, ticks));
        Self { simulation, waiting: Input::new(input), examiner, is_plain: false }
    }

    /// What is done to it now, and a tick.
    pub fn tick(&mut self) {
        let Self { simulation, waiting, examiner, .. } = self;
        let before = Stored::of(simulation.world());
        if waiting.give(simulation.world_mut()) > 0 {
            simulation.apply_edits();
            examiner.edited(before, simulation.world(), true);
        }
        examiner.begin(simulation.world());
        simulation.tick();
        examiner.look(simulation.world());
        self.is_plain |= moves_plainly(simulation.world());
    }

    /// The world as it is now.
    pub fn world(&self) -> &World {
        self.simulation.world()
    }

    /// What was found.
    pub fn finish(self) -> Found {
        Found::Judged { findings: self.examiner.finish(self.simulation.world()), is_plain: self.is_plain }
    }
}

/// Whether the last tick moved matter without the pressure predictor.
fn moves_plainly(world: &World) -> bool {
    let moved = world.resource::<PassLedger>().record(Pass::Solve).last.touched > 0;
    moved && !world.resource::<Effects>().get(Effect::Predictor).running
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
