//! Flies the world: reads the pass ledger or the live error, and asks for the quality that the controller chose.

use super::{
    advice::{self, Advice, Now},
    controller::{Controller, Tuning, Verdict},
    ladder::{self, Level},
};
use crate::{
    kernel::units::TICK_SECONDS,
    lab::live::accuracy::{LiveError, SAMPLE_EVERY},
    scene::passes::Pass,
    sim::{
        generation::Generation,
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        state::{Clock, ParticleStore, Setup, SleepState},
    },
};
use bevy::prelude::{App, FixedUpdate, IntoScheduleConfigs, Res, ResMut, Resource};

/// Times of ticks follow the work at once. Single ticks that take much longer are no part of it. A time over the bound
/// is soon seen and soon over: no budget.
pub(super) const OF_TIME: Tuning =
    Tuning { settle: 0.05, quick: 0.6, usual: 0.6, trim: 0.08, aim: 0.7, doubt: 0.0, allowed: 1.0, first: 4.0 };
/// A liquid takes a while to feel another quality. A sample of 320 particles meets few of those that carry the error,
/// so that single samples are several times the mean, and are a part of it. It is to be over its bound for at most 2 %
/// of the time; less is allowed here, so that there is room for the first breaches.
///
/// It aims at four fifths, as the guess of what a level does errs by a fifth (`ladder::ERROR_EXPONENT`); at less, no
/// level would do for a bound that half of them hold.
pub(super) const OF_ERROR: Tuning =
    Tuning { settle: 0.1, quick: 0.8, usual: 8.0, trim: 0.0, aim: 0.8, doubt: 1.5, allowed: 0.015, first: 8.0 };

/// Ticks after a move until it advises: as many as the ledger's median is of.
const ADVISE_AFTER: u64 = 64;
/// Ticks from one look for advice to the next.
const ADVISE_EVERY: u64 = 30;

/// What is to be held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// At most so many ms a tick.
    Time(f32),
    /// At most this mean density error, a fraction.
    Error(f32),
}

impl Goal {
    fn bound(self) -> f32 {
        match self {
            Self::Time(bound) | Self::Error(bound) => bound,
        }
    }

    fn same_kind(self, other: Self) -> bool {
        matches!((self, other), (Self::Time(_), Self::Time(_)) | (Self::Error(_), Self::Error(_)))
    }
}

/// The autopilot; off without a goal.
#[derive(Resource, Clone, Debug, Default)]
pub struct Autopilot {
    goal: Option<Goal>,
    state: Option<State>,
}

/// What it works with from when it takes over.
#[derive(Clone, Debug)]
struct State {
    controller: Controller,
    ladder: Vec<Level>,
    generation: Generation,
    tick: u64,
    sampled: u64,
    moves: u32,
    /// The tick of the last move.
    moved: u64,
    /// The detail that it took over at.
    detail: f32,
    advice: Option<Advice>,
}

impl Autopilot {
    /// Sets what is to be held; `None` leaves the quality to the player.
    pub fn hold(&mut self, goal: Option<Goal>) {
        match (goal, self.goal, &mut self.state) {
            (Some(new), Some(old), Some(state)) if new.same_kind(old) => state.controller.set_bound(new.bound()),
            _ => self.state = None,
        }
        self.goal = goal;
    }

    /// What is held.
    pub fn goal(&self) -> Option<Goal> {
        self.goal
    }

    /// How it stands with the bound.
    pub fn verdict(&self) -> Verdict {
        self.state.as_ref().map_or(Verdict::Settling, |state| state.controller.verdict())
    }

    /// The detail at which it would do better, if it knows of one.
    pub fn advice(&self) -> Option<Advice> {
        self.state.as_ref().and_then(|state| state.advice)
    }

    /// Changes of the quality since it took over.
    pub fn moves(&self) -> u32 {
        self.state.as_ref().map_or(0, |state| state.moves)
    }
}

impl State {
    fn new(goal: Goal, setup: &Setup, generation: Generation, tick: u64) -> Self {
        let ladder = ladder::ladder();
        let at = ladder::nearest(&ladder, &setup.quality);
        let last = ladder.len() - 1;
        // The controller's levels relieve more and more: time falls down the ladder, the error up it.
        let controller = match goal {
            Goal::Time(bound) => {
                Controller::new(bound, OF_TIME, ladder.iter().rev().map(|level| level.work).collect(), last - at)
            }
            Goal::Error(bound) => Controller::new(bound, OF_ERROR, ladder.iter().map(Level::error).collect(), at),
        };
        let detail = setup.blueprint.scale.detail;
        Self { controller, ladder, generation, tick, sampled: tick, moves: 0, moved: tick, detail, advice: None }
    }

    /// Takes what the last tick measured; the level to go to, if any.
    fn observe(&mut self, goal: Goal, tick: u64, ledger: &PassLedger, error: &LiveError) -> Option<Level> {
        let ticks = tick - self.tick;
        self.tick = tick;
        if ticks == 0 {
            return None;
        }
        let chosen = match goal {
            Goal::Time(_) => {
                let time = ledger.last_tick().as_secs_f32();
                self.controller.observe(time * 1000.0, time.max(TICK_SECONDS))
            }
            Goal::Error(_) => {
                let sample = error.latest().filter(|sample| sample.tick > self.sampled)?;
                self.sampled = sample.tick;
                // Without a liquid inside there is no error to hold.
                let value = error.mean().and(sample.mean).unwrap_or(0.0);
                self.controller.observe(value, SAMPLE_EVERY as f32 * TICK_SECONDS)
            }
        }?;
        self.moves += 1;
        self.moved = tick;
        let index = match goal {
            Goal::Time(_) => self.ladder.len() - 1 - chosen,
            Goal::Error(_) => chosen,
        };
        self.ladder.get(index).copied()
    }

    /// Looks for a better detail once the median of the ticks is of this quality alone.
    fn advise(&mut self, goal: Goal, setup: &Setup, ledger: &PassLedger) {
        let Goal::Time(bound) = goal else { return };
        if self.tick < self.moved + ADVISE_AFTER || !self.tick.is_multiple_of(ADVISE_EVERY) {
            self.advice = self.advice.filter(|_| self.tick > self.moved);
            return;
        }
        let now = Now {
            milliseconds: ledger.tick().median().as_secs_f32() * 1000.0,
            quality: setup.quality,
            detail: setup.asked_detail(),
        };
        // What sleeps takes no time now, and would be awake then.
        let all_awake = ledger.record(Pass::Solve).last.spared == 0;
        self.advice = match self.controller.verdict() {
            Verdict::Beyond => advice::coarser(now),
            Verdict::Holds if all_awake => advice::finer(now, OF_TIME.aim * bound),
            _ => None,
        };
    }
}

/// Adds the autopilot to a simulation.
pub fn plugin(app: &mut App) {
    app.init_resource::<Autopilot>()
        .init_resource::<LiveError>()
        .add_systems(FixedUpdate, steer.after(Pass::Measure).run_if(engaged).run_if(any_awake));
}

/// Run condition: there is something to hold.
fn engaged(autopilot: Res<Autopilot>) -> bool {
    autopilot.goal.is_some()
}

/// Run condition: not all particles sleep. The time of a tick in which nothing moves says nothing of a quality, and a
/// change would wake them.
fn any_awake(sleep: Option<Res<SleepState>>, particles: Option<Res<ParticleStore>>) -> bool {
    let asleep = sleep.map_or(0, |sleep| sleep.asleep());
    asleep == 0 || particles.is_none_or(|particles| asleep < particles.len())
}

/// Looks at the tick that ended and asks for another quality for the next.
pub fn steer(
    mut autopilot: ResMut<Autopilot>,
    (setup, generation): (Res<Setup>, Res<Generation>),
    clock: Res<Clock>,
    ledger: Res<PassLedger>,
    error: Res<LiveError>,
    mut intents: ResMut<IntentQueue>,
) {
    let Autopilot { goal: Some(goal), state } = &mut *autopilot else { return };
    // Another world, an earlier state of this one, or another detail: what was learned is of another situation.
    let detail = setup.blueprint.scale.detail;
    if state.as_ref().is_some_and(|state| state.generation != *generation || state.detail != detail) {
        *state = None;
    }
    let state = state.get_or_insert_with(|| State::new(*goal, &setup, *generation, clock.tick));
    if let Some(Level { preset, quality, .. }) = state.observe(*goal, clock.tick, &ledger, &error) {
        intents.push(Intent::Quality { preset, quality });
    }
    state.advise(*goal, &setup, &ledger);
}
