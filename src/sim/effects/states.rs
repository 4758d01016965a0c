//! Which effects run in this tick, and why. Decided once a tick; the stages have run conditions on it.

use crate::scene::effects::{Effect, EffectModes, Facts, Mode};
use bevy::prelude::{Res, Resource};

/// What is wanted of an effect, what was decided, and how often it ran.
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
    /// [`EffectRow::differs_from_on`](crate::scene::effects::EffectRow::differs_from_on)), whatever the mode was.
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
        let idle = EffectState {
            mode: Mode::Auto,
            running: false,
            why: "not decided yet",
            active_ticks: 0,
            differing_ticks: 0,
        };
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

    /// Whether the passes of `effect` have something to do in this tick: it runs, and so do those that it needs.
    pub fn acts(&self, effect: Effect) -> bool {
        self.get(effect).running && effect.row().needs.iter().all(|needed| self.get(*needed).running)
    }

    /// Whether what `effect` gives to the air comes to any: it acts, and the air may move.
    pub fn reaches_air(&self, effect: Effect) -> bool {
        self.acts(effect) && self.get(Effect::Air).mode != Mode::Off
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
        *self = Self::new(&self.modes());
    }

    /// Decides for this tick.
    pub fn decide(&mut self, facts: &Facts<'_>) {
        for (effect, state) in Effect::ALL.into_iter().zip(&mut self.states) {
            (state.running, state.why) = effect.decide(facts);
            state.active_ticks += u64::from(state.running);
            state.differing_ticks += u64::from((effect.row().differs_from_on)(facts));
        }
    }
}

/// Run condition of the passes of an effect.
pub fn runs(effect: Effect) -> impl Fn(Res<Effects>) -> bool + Clone {
    move |effects| effects.acts(effect)
}
