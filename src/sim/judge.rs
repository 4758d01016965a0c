//! The judge of a challenge: counts what the player does, and sees after each tick whether the goal holds. It is no part of
//! the world: what is undone has been done, and time that is gone back over has gone by. Written by the edit stage and by the
//! end of a tick; a recording holds all that it goes by.

use crate::{
    kernel::{element::ElementId, units::Scale},
    scene::challenges::{self, Challenge, Condition},
    sim::{
        intent::Intent,
        state::{Clock, ParticleStore, Rock, Setup},
    },
};
use bevy::prelude::{Res, ResMut, Resource};
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What can be earned in a challenge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Stars {
    /// It is done.
    pub done: bool,
    /// With few particles.
    pub particles: bool,
    /// In few strokes.
    pub strokes: bool,
}

impl Stars {
    /// All of them.
    pub const ALL: Self = Self { done: true, particles: true, strokes: true };

    /// How many they are.
    pub fn count(self) -> usize {
        [self.done, self.particles, self.strokes].into_iter().filter(|star| *star).count()
    }

    /// These and others.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            done: self.done || other.done,
            particles: self.particles || other.particles,
            strokes: self.strokes || other.strokes,
        }
    }
}

/// Why a challenge is lost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Loss {
    /// Its time is up.
    Time,
    /// Something was done by what the player does not have there: what that is.
    Means(String),
}

/// How a challenge stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It goes on.
    Running,
    /// The goal is reached.
    Won(Stars),
    /// It can't be reached any more.
    Lost(Loss),
}

/// A try at a challenge.
#[derive(Clone, Debug)]
pub struct Trial {
    /// What is tried.
    pub challenge: Arc<Challenge>,
    /// How it stands.
    pub verdict: Verdict,
    /// Ticks that it took so far.
    pub ticks: u64,
    /// Strokes so far.
    pub strokes: u64,
    /// Ticks for which the goal has held without a break.
    pub held: u64,
    /// Particles poured, of the scene's own spacing: at a finer detail each is a part of one.
    poured: f64,
}

impl Trial {
    fn new(challenge: Arc<Challenge>) -> Self {
        Self { challenge, verdict: Verdict::Running, ticks: 0, strokes: 0, held: 0, poured: 0.0 }
    }

    /// Particles poured so far, of the scene's own spacing.
    pub fn poured(&self) -> u64 {
        self.poured.ceil() as u64
    }

    /// The stars that it would earn now.
    pub fn stars(&self) -> Stars {
        Stars {
            done: true,
            particles: self.poured <= f64::from(self.challenge.particles),
            strokes: self.strokes <= u64::from(self.challenge.strokes),
        }
    }

    /// Ticks that are left.
    pub fn left(&self) -> u64 {
        self.challenge.ticks.saturating_sub(self.ticks)
    }

    /// Whether it goes on.
    pub fn is_running(&self) -> bool {
        self.verdict == Verdict::Running
    }

    /// What of an intent the player does not have here, if it is not to be.
    pub fn lacks(&self, intent: &Intent, setup: &Setup) -> Option<String> {
        let name = |element: &ElementId| setup.elements().get(*element).name.clone();
        let wanted = match intent {
            Intent::Begin { .. } | Intent::Stroke | Intent::GiveUp | Intent::Quality { .. } => return None,
            Intent::Draw { element, .. }
            | Intent::Pour { element, .. }
            | Intent::Stamp { element, .. }
            | Intent::Fill { element, .. } => name(element),
            Intent::Erase { .. } => "erase".to_owned(),
            Intent::Blow { .. } => "wind".to_owned(),
            Intent::Press { .. } => "pressure".to_owned(),
            Intent::Warm { .. } => "heat".to_owned(),
            Intent::SetTemperature { .. } => "degrees".to_owned(),
            Intent::Ignite { .. } => "ignite".to_owned(),
            Intent::Replace { .. } | Intent::ReplaceAround { .. } => return Some("replacing".to_owned()),
            Intent::EraseOnly { .. } | Intent::EraseAround { .. } => return Some("erasing one element".to_owned()),
            Intent::Detail { .. } => return Some("another detail".to_owned()),
            Intent::ClearAir => return Some("clearing the air".to_owned()),
            Intent::Effect { .. } => return Some("switching effects".to_owned()),
            Intent::Gravity { .. } => return Some("another gravity".to_owned()),
            Intent::Paste { .. } => return Some("stamps".to_owned()),
            Intent::SetEmitter { .. }
            | Intent::SetDrain { .. }
            | Intent::RemoveSources { .. }
            | Intent::PasteSources { .. } => {
                return Some("springs and drains".to_owned());
            }
        };
        (!self.challenge.means.have(&wanted)).then_some(wanted)
    }
}

/// The try that is judged, if there is one. It stays after its end, until another begins or it is left.
#[derive(Resource, Clone, Debug, Default)]
pub struct Judge(Option<Trial>);

impl Judge {
    /// The try.
    pub fn trial(&self) -> Option<&Trial> {
        self.0.as_ref()
    }

    /// The try that goes on.
    pub fn running(&self) -> Option<&Trial> {
        self.0.as_ref().filter(|trial| trial.is_running())
    }

    /// Leaves it.
    pub fn leave(&mut self) {
        self.0 = None;
    }

    /// Takes note of an intent, before it is carried out.
    pub fn see(&mut self, intent: &Intent, setup: &Setup, clock: &Clock) {
        match intent {
            Intent::Begin { challenge } => self.begin(challenge, setup, clock),
            Intent::GiveUp => self.leave(),
            _ => {
                let Some(trial) = self.0.as_mut().filter(|trial| trial.is_running()) else { return };
                if let Some(lacking) = trial.lacks(intent, setup) {
                    trial.verdict = Verdict::Lost(Loss::Means(lacking));
                }
                trial.strokes += u64::from(*intent == Intent::Stroke);
            }
        }
    }

    /// Begins where the scene of the challenge does, and nowhere else.
    fn begin(&mut self, name: &str, setup: &Setup, clock: &Clock) {
        let found = challenges::find(name).ok();
        let fits = |challenge: &Arc<Challenge>| challenge.scene.name() == setup.blueprint.name;
        let at_start = (clock.tick, clock.edits) == (0, 0);
        self.0 = found.filter(|challenge| at_start && fits(challenge)).map(Trial::new);
    }

    /// Counts particles that were placed by an intent.
    pub fn count(&mut self, placed: u64, setup: &Setup) {
        if let Some(trial) = self.0.as_mut().filter(|trial| trial.is_running()) {
            trial.poured += placed as f64 / f64::from(setup.blueprint.scale.particles_per_own());
        }
    }
}

/// Run condition: a challenge goes on.
pub(super) fn is_running(judge: Res<Judge>) -> bool {
    judge.running().is_some()
}

/// Judges the world as it is after a tick.
pub(super) fn judge(mut judge: ResMut<Judge>, setup: Res<Setup>, particles: Res<ParticleStore>, rock: Res<Rock>) {
    let Some(trial) = &mut judge.0 else { return };
    if trial.challenge.scene.name() != setup.blueprint.name {
        // Another world was put in the place of its own: by undo, beyond its beginning.
        return judge.leave();
    }
    trial.ticks += 1;
    let holds = trial.challenge.goal.iter().all(|condition| holds(condition, &setup, &particles, &rock));
    trial.held = if holds { trial.held + 1 } else { 0 };
    if trial.held >= trial.challenge.hold {
        trial.verdict = Verdict::Won(trial.stars());
    } else if trial.ticks >= trial.challenge.ticks {
        trial.verdict = Verdict::Lost(Loss::Time);
    }
}

/// How many there are of what a condition counts, of the scene's own spacing.
pub fn count(condition: &Condition, setup: &Setup, particles: &ParticleStore, rock: &Rock) -> f64 {
    let elements = setup.elements();
    let wanted: Vec<ElementId> = condition.of.iter().filter_map(|name| elements.find(name)).collect();
    let scale = setup.blueprint.scale;
    let (inside, outside) =
        (condition.inside.map(|area| lengths(area, scale)), condition.outside.map(|area| lengths(area, scale)));
    let counts = |element: ElementId, at: Vec2| {
        wanted.contains(&element)
            && inside.is_none_or(|area| contains(area, at))
            && !outside.is_some_and(|area| contains(area, at))
    };
    let moving = (0..particles.len())
        .filter(|&k| counts(particles.element[k], Vec2::new(particles.x[k], particles.y[k])))
        .count();
    let fixed = rock.iter().filter(|(cell, element, _)| counts(*element, cell.as_vec2() + 0.5)).count();
    (moving + fixed) as f64 / f64::from(scale.particles_per_own())
}

fn holds(condition: &Condition, setup: &Setup, particles: &ParticleStore, rock: &Rock) -> bool {
    let count = count(condition, setup, particles, rock);
    condition.at_least.is_none_or(|least| count >= f64::from(least))
        && condition.at_most.is_none_or(|most| count <= f64::from(most))
}

/// A rectangle in m, in d.
fn lengths((min, max): (DVec2, DVec2), scale: Scale) -> (Vec2, Vec2) {
    let of = |corner: DVec2| (corner / f64::from(scale.spacing)).as_vec2();
    (of(min), of(max))
}

fn contains((min, max): (Vec2, Vec2), at: Vec2) -> bool {
    at.cmpge(min).all() && at.cmplt(max).all()
}
