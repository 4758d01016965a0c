//! What is known of the world when a tick is planned. The gate gathers it once a tick; the table's verdicts are functions
//! of it and of nothing else.

use crate::{
    kernel::params::Preset,
    scene::blueprint::{Effect, Mode},
};

/// The facts of a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// What is wanted of each effect, in the order of [`Effect::ALL`].
    pub modes: [Mode; Effect::ALL.len()],
    /// The named quality in force.
    pub preset: Preset,
    /// Whether the quality has the pressure predictor.
    pub predicts: bool,
    /// Movable particles.
    pub particles: usize,
    /// How many of them sleep.
    pub asleep: usize,
    /// Whether a movable particle of an element with drag is there.
    pub feels_air: bool,
    /// Whether one of an element with viscosity is.
    pub is_viscous: bool,
    /// Whether one of an element with vorticity confinement is.
    pub keeps_eddies: bool,
    /// Whether the liquid has a tension.
    pub has_tension: bool,
    /// Whether a fan is there.
    pub has_fans: bool,
    /// Whether the air moves.
    pub air_moves: bool,
    /// Whether the fastest particle could wake air at rest.
    pub stirs_air: bool,
}

impl Facts {
    /// What is wanted of `effect`.
    pub fn mode(&self, effect: Effect) -> Mode {
        self.modes[effect as usize]
    }

    /// Whether `effect` runs in this tick, and why or why not.
    pub fn decide(&self, effect: Effect) -> (bool, &'static str) {
        match self.mode(effect) {
            Mode::Auto => (effect.row().called_for)(self),
            Mode::On => (true, "switched on"),
            Mode::Off => (false, "switched off"),
        }
    }

    /// Whether `effect` runs in this tick.
    pub fn runs(&self, effect: Effect) -> bool {
        self.decide(effect).0
    }

    /// Whether there is a liquid.
    pub fn has_liquid(&self) -> bool {
        self.particles > 0
    }
}
