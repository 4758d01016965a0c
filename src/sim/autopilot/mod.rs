//! The autopilot: holds a time budget or an error bound by changing the quality while the world runs. It reads the pass
//! ledger and the live error, decides ([`controller`]) on a rung of the [`ladder`], and gives its decision as an intent
//! like any player's: a recording holds it, and a replay needs no autopilot.

mod backoff;
pub mod controller;
pub mod ladder;
#[cfg(test)]
mod tests;
mod usual;
mod window;

use crate::{
    kernel::units::TICK_SECONDS,
    scene::{blueprint::Blueprint, effects::Pass},
    sim::{
        accuracy::{LiveError, SAMPLE_EVERY},
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        state::{Clock, ParticleStore, Setup, SleepState},
    },
};
use bevy::prelude::{App, FixedUpdate, IntoScheduleConfigs, Res, ResMut, Resource};
use controller::{Character, Controller, Verdict};
use ladder::Rung;
use std::sync::Arc;
use window::Window;

/// Times of ticks: right after a move they are still unusual, and they follow the work closely. Single ticks that take much
/// longer are no part of it.
const OF_TIME: Character = Character {
    settle: 0.04,
    aim: 0.74,
    drift: 1.15,
    short: Window { seconds: 0.12, count: 3 },
    fair: Window { seconds: 0.38, count: 5 },
    patient: Window { seconds: 0.6, count: 8 },
    calm: Window { seconds: 0.6, count: 8 },
    usual: 0.0,
    trim: 0.08,
    doubt: 0.0,
};
/// A liquid takes a while to feel another quality. A sample of 320 particles meets few of those that carry the error, so
/// that single samples are several times the mean, and are a part of it.
const OF_ERROR: Character = Character {
    settle: 0.1,
    aim: 0.7,
    drift: 1.5,
    short: Window { seconds: 0.15, count: 3 },
    fair: Window { seconds: 0.4, count: 8 },
    patient: Window { seconds: 0.8, count: 8 },
    calm: Window { seconds: 2.0, count: 8 },
    usual: 4.0,
    trim: 0.0,
    doubt: 1.0,
};

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
    flight: Option<Flight>,
}

/// What it works with, from the moment on that it takes over.
#[derive(Clone, Debug)]
struct Flight {
    controller: Controller,
    rungs: Vec<Rung>,
    blueprint: Arc<Blueprint>,
    tick: u64,
    sampled: u64,
    moves: u32,
}

impl Autopilot {
    /// Sets what is to be held; `None` leaves the quality to the player.
    pub fn hold(&mut self, goal: Option<Goal>) {
        match (goal, self.goal, &mut self.flight) {
            (Some(new), Some(old), Some(flight)) if new.same_kind(old) => flight.controller.set_bound(new.bound()),
            _ => self.flight = None,
        }
        self.goal = goal;
    }

    /// What is held.
    pub fn goal(&self) -> Option<Goal> {
        self.goal
    }

    /// How it stands with the bound.
    pub fn verdict(&self) -> Verdict {
        self.flight.as_ref().map_or(Verdict::Settling, |flight| flight.controller.verdict())
    }

    /// Changes of the quality since it took over.
    pub fn moves(&self) -> u32 {
        self.flight.as_ref().map_or(0, |flight| flight.moves)
    }
}

impl Flight {
    fn new(goal: Goal, setup: &Setup, tick: u64) -> Self {
        let rungs = ladder::ladder();
        let at = ladder::nearest(&rungs, &setup.quality);
        let last = rungs.len() - 1;
        // Positions relieve more and more: time falls down the ladder, the error up it.
        let controller = match goal {
            Goal::Time(bound) => {
                Controller::new(bound, OF_TIME, rungs.iter().rev().map(|rung| rung.work).collect(), last - at)
            }
            Goal::Error(bound) => Controller::new(bound, OF_ERROR, rungs.iter().map(Rung::error).collect(), at),
        };
        Self { controller, rungs, blueprint: setup.blueprint.clone(), tick, sampled: tick, moves: 0 }
    }

    /// Takes what the last tick measured; the rung to go to, if any.
    fn observe(&mut self, goal: Goal, tick: u64, ledger: &PassLedger, error: &LiveError) -> Option<Rung> {
        let ticks = tick - self.tick;
        self.tick = tick;
        if ticks == 0 {
            return None;
        }
        let position = match goal {
            Goal::Time(_) => {
                let time = ledger.last_tick().as_secs_f32();
                self.controller.observe(time * 1000.0, time.max(TICK_SECONDS))
            }
            Goal::Error(_) => {
                let sample = error.latest().filter(|sample| sample.tick > self.sampled)?;
                self.sampled = sample.tick;
                // Without a liquid inside there is no error to hold.
                self.controller.observe(sample.mean.unwrap_or(0.0), SAMPLE_EVERY as f32 * TICK_SECONDS)
            }
        }?;
        self.moves += 1;
        let index = match goal {
            Goal::Time(_) => self.rungs.len() - 1 - position,
            Goal::Error(_) => position,
        };
        self.rungs.get(index).copied()
    }
}

/// Adds the autopilot to a simulation.
pub fn plugin(app: &mut App) {
    app.init_resource::<Autopilot>()
        .init_resource::<LiveError>()
        .add_systems(FixedUpdate, steer.after(Pass::Measure).run_if(engaged).run_if(anyone_is_awake));
}

/// Run condition: there is something to hold.
fn engaged(autopilot: Res<Autopilot>) -> bool {
    autopilot.goal.is_some()
}

/// Run condition: not all sleeps. What a tick of sleepers costs says nothing of a quality, and a change would wake them.
fn anyone_is_awake(sleep: Option<Res<SleepState>>, particles: Option<Res<ParticleStore>>) -> bool {
    let asleep = sleep.map_or(0, |sleep| sleep.asleep());
    asleep == 0 || particles.is_none_or(|particles| asleep < particles.len())
}

/// Looks at the tick that ended and asks for another quality for the next.
pub fn steer(
    mut autopilot: ResMut<Autopilot>,
    setup: Res<Setup>,
    clock: Res<Clock>,
    ledger: Res<PassLedger>,
    error: Res<LiveError>,
    mut intents: ResMut<IntentQueue>,
) {
    let Autopilot { goal: Some(goal), flight } = &mut *autopilot else { return };
    // Another world, or an earlier state of this one: what was learned is of another situation.
    let same = |flight: &Flight| Arc::ptr_eq(&flight.blueprint, &setup.blueprint) && flight.tick <= clock.tick;
    if !flight.as_ref().is_some_and(same) {
        *flight = None;
    }
    let flight = flight.get_or_insert_with(|| Flight::new(*goal, &setup, clock.tick));
    if let Some(Rung { preset, quality, .. }) = flight.observe(*goal, clock.tick, &ledger, &error) {
        intents.push(Intent::Quality { preset, quality });
    }
}
