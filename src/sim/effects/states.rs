//! Which effects run in this tick, and why. Decided once a tick; the stages obey by run condition.

use crate::{
    scene::blueprint::{Effect, EffectModes, Mode},
    sim::effects::facts::Facts,
};
use bevy::prelude::{Res, Resource};

/// Reason until the first tick.
const NOT_DECIDED: &str = "not decided yet";

/// An effect's wish, decision and record.
#[derive(Clone, Debug)]
pub struct EffectState {
    /// What the scene or the player wants.
    pub mode: Mode,
    /// Whether it runs in this tick.
    pub running: bool,
    /// Why it runs or not.
    pub why: &'static str,
    /// Ticks in which it ran, since the scene began.
    pub active_ticks: u64,
    /// Ticks since then in which [`Mode::Auto`] may make another world than [`Mode::On`] (see
    /// [`Row::differs_from_on`](super::table::Row::differs_from_on)), whatever the mode was.
    pub differing_ticks: u64,
}

/// The state of every effect.
#[derive(Resource, Clone, Debug)]
pub struct Effects {
    states: [EffectState; Effect::ALL.len()],
}

impl Effects {
    /// Effects with the wanted modes; none has run yet.
    pub fn new(modes: &EffectModes) -> Self {
        let idle =
            EffectState { mode: Mode::Auto, running: false, why: NOT_DECIDED, active_ticks: 0, differing_ticks: 0 };
        let mut effects = Self { states: std::array::from_fn(|_| idle.clone()) };
        effects.set_modes(modes);
        effects
    }

    /// The state of `effect`.
    pub fn get(&self, effect: Effect) -> &EffectState {
        &self.states[effect as usize]
    }

    /// The state of `effect`, to change its mode.
    pub fn get_mut(&mut self, effect: Effect) -> &mut EffectState {
        &mut self.states[effect as usize]
    }

    /// The wanted modes.
    pub fn modes(&self) -> EffectModes {
        Effect::ALL.into_iter().map(|effect| (effect, self.get(effect).mode)).collect()
    }

    /// The wanted modes in the order of [`Effect::ALL`].
    pub fn wanted(&self) -> [Mode; Effect::ALL.len()] {
        self.states.each_ref().map(|state| state.mode)
    }

    /// Wants these modes; an effect that is not among them is wanted as usual.
    pub fn set_modes(&mut self, modes: &EffectModes) {
        for effect in Effect::ALL {
            self.get_mut(effect).mode = modes.get(&effect).copied().unwrap_or_default();
        }
    }

    /// Forgets what ran; the modes stay.
    pub fn start_over(&mut self) {
        for state in &mut self.states {
            (state.running, state.why) = (false, NOT_DECIDED);
            (state.active_ticks, state.differing_ticks) = (0, 0);
        }
    }

    /// Decides for this tick.
    pub fn decide(&mut self, facts: &Facts) {
        for (effect, state) in Effect::ALL.into_iter().zip(&mut self.states) {
            (state.running, state.why) = facts.decide(effect);
            state.active_ticks += u64::from(state.running);
            state.differing_ticks += u64::from((effect.row().differs_from_on)(facts));
        }
    }
}

/// Run condition: the effect runs in this tick.
pub fn runs(effect: Effect) -> impl Fn(Res<Effects>) -> bool + Clone {
    move |effects| effects.get(effect).running
}
