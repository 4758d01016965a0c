//! Effects: which of them run in this tick, and why. Decided once a tick from facts that are there already; the stages
//! obey by run condition.

use crate::scene::blueprint::{Effect, EffectModes, Mode};
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
}

/// The state of every effect.
#[derive(Resource, Clone, Debug)]
pub struct Effects {
    states: [EffectState; Effect::ALL.len()],
}

impl Effects {
    /// Effects with the wanted modes; none has run yet.
    pub fn new(modes: &EffectModes) -> Self {
        let idle = EffectState { mode: Mode::Auto, running: false, why: NOT_DECIDED, active_ticks: 0 };
        let mut effects = Self { states: std::array::from_fn(|_| idle.clone()) };
        for (effect, mode) in modes {
            effects.get_mut(*effect).mode = *mode;
        }
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

    /// Wants what `other` wants.
    pub fn take_modes(&mut self, other: &Self) {
        for (state, other) in self.states.iter_mut().zip(&other.states) {
            state.mode = other.mode;
        }
    }

    /// Forgets what ran; the modes stay.
    pub fn start_over(&mut self) {
        for state in &mut self.states {
            (state.running, state.why, state.active_ticks) = (false, NOT_DECIDED, 0);
        }
    }

    /// Decides for this tick: `called_for` says whether the world calls for the effect, and why or why not.
    pub fn decide(&mut self, effect: Effect, called_for: (bool, &'static str)) {
        let state = self.get_mut(effect);
        (state.running, state.why) = match state.mode {
            Mode::Auto => called_for,
            Mode::On => (true, "switched on"),
            Mode::Off => (false, "switched off"),
        };
        state.active_ticks += u64::from(state.running);
    }
}

/// Run condition: the effect runs in this tick.
pub fn runs(effect: Effect) -> impl Fn(Res<Effects>) -> bool + Clone {
    move |effects| effects.get(effect).running
}
