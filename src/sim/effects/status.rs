//! What F3 and the metrics show of an effect, from what the gate and the ledger have noted. No tick reads it.

use crate::{
    scene::{
        effects::{Effect, Mode},
        passes::{Pass, Unit},
    },
    sim::{
        effects::Effects,
        ledger::{PassLedger, PassRecord},
        numbers::grouped,
        state::{AirGrid, ParticleStore, SleepState},
    },
};
use bevy::ecs::world::World;
use serde::Serialize;

/// Whether an effect works.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Activity {
    /// On all that there is.
    Runs,
    /// It would, but some of what there is sleeps, or all.
    Asleep,
    /// Not at all.
    Off,
}

impl Activity {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Runs => "runs",
            Self::Asleep => "asleep",
            Self::Off => "off",
        }
    }
}

/// How much of the world sleeps: how many, of how many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sleepers {
    /// Movable particles.
    pub particles: (usize, usize),
    /// Tiles of the air; none without a grid.
    pub tiles: (usize, usize),
}

impl Sleepers {
    /// Of the parts of a world.
    pub fn of(sleep: &SleepState, particles: &ParticleStore, air: &AirGrid) -> Self {
        Self { particles: (sleep.asleep(), particles.len()), tiles: air.sleeping_tiles() }
    }

    /// Of a world.
    pub fn in_world(world: &World) -> Self {
        Self::of(world.resource(), world.resource(), world.resource())
    }

    /// Of what `effect` works on.
    fn of_effect(self, effect: Effect) -> (usize, usize, &'static str) {
        match effect.row().passes {
            // What sleeps is its work.
            [Pass::Sleep] => (0, 0, ""),
            [pass] if pass.unit() == Unit::Cells => (self.tiles.0, self.tiles.1, "tiles"),
            _ => (self.particles.0, self.particles.1, "particles"),
        }
    }
}

/// What is shown of an effect.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectStatus {
    /// What the scene or the player wants.
    pub mode: Mode,
    /// Whether it works.
    pub activity: Activity,
    /// Whether any of it works.
    pub works: bool,
    /// Why it does or does not, or how much of what it works on sleeps.
    pub why: String,
    /// How much of what it works on sleeps, of how much, and what that is, if any of it does.
    pub asleep: Option<(usize, usize, &'static str)>,
}

impl EffectStatus {
    /// Of `effect` in a world of which so much sleeps.
    pub fn of(effect: Effect, effects: &Effects, sleepers: Sleepers) -> Self {
        let state = effects.get(effect);
        let (asleep, all, unit) = sleepers.of_effect(effect);
        let (activity, why) = if !state.running {
            (Activity::Off, state.why.to_owned())
        } else if asleep == 0 {
            (Activity::Runs, state.why.to_owned())
        } else if asleep < all {
            (Activity::Asleep, format!("{} of {} {unit}", grouped(asleep as u64), grouped(all as u64)))
        } else {
            (Activity::Asleep, format!("all {} {unit}", grouped(all as u64)))
        };
        let works = state.running && (asleep == 0 || asleep < all);
        let asleep = (activity == Activity::Asleep).then_some((asleep, all, unit));
        Self { mode: state.mode, activity, works, why, asleep }
    }

    /// It as one text: `off: nothing is viscous`, `asleep: 62 of 64 tiles`.
    pub fn text(&self) -> String {
        format!("{}: {}", self.activity.name(), self.why)
    }
}

/// What it saves that `effect` does not run, or, of [`Effect::Sleep`], that what the effects that run would have worked on
/// sleeps, ms: a sum over passes of `saved`, each of which counts for one effect. `None` where one of them never ran, or
/// where the effect is a part of another's pass.
pub fn saving(
    effect: Effect,
    effects: &Effects,
    ledger: &PassLedger,
    saved: fn(&PassRecord) -> Option<f64>,
) -> Option<f64> {
    let is_left_out = |pass: Pass| Effect::of(pass).filter(|owner| !effects.get(*owner).running);
    let sum = |wanted: &dyn Fn(Pass) -> bool| {
        Pass::ALL.into_iter().filter(|pass| wanted(*pass)).map(|pass| saved(ledger.record(pass))).sum::<Option<f64>>()
    };
    match effect {
        Effect::Sleep => sum(&|pass| is_left_out(pass).is_none()),
        _ if effects.get(effect).running => Some(0.0),
        _ if effect.row().passes.is_empty() => None,
        _ => sum(&|pass| is_left_out(pass) == Some(effect)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::effects::EffectModes;

    fn status(effect: Effect, mode: Mode, sleepers: Sleepers) -> String {
        let mut effects = Effects::new(&EffectModes::from([(effect, mode)]));
        let state = effects.get_mut(effect);
        (state.running, state.why) = (mode == Mode::On, "because");
        EffectStatus::of(effect, &effects, sleepers).text()
    }

    #[test]
    fn what_sleeps_is_told_of_what_an_effect_works_on() {
        let sleepers = Sleepers { particles: (1600, 1600), tiles: (62, 64) };
        assert_eq!(status(Effect::Air, Mode::On, sleepers), "asleep: 62 of 64 tiles");
        assert_eq!(status(Effect::Air, Mode::Off, sleepers), "off: because");
        assert_eq!(status(Effect::Viscosity, Mode::On, sleepers), "asleep: all 1,600 particles");
        assert_eq!(status(Effect::Sleep, Mode::On, sleepers), "runs: because");
        assert_eq!(status(Effect::Viscosity, Mode::On, Sleepers::default()), "runs: because");
    }
}
