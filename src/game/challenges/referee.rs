//! What a press may do while a challenge runs, and that it counts as a stroke. Everything that a hand does to the world goes
//! through here.

use crate::{
    game::{language::spoken, toasts::Toasts, tools::spaced},
    sim::{
        generation::Generation,
        intent::Intent,
        judge::{Judge, Trial},
        state::Setup,
    },
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Res, ResMut},
};
use tr::tr;

/// Sees all that a hand does.
#[derive(SystemParam)]
pub struct Referee<'w> {
    judge: Res<'w, Judge>,
    setup: Option<Res<'w, Setup>>,
    generation: Res<'w, Generation>,
    toasts: ResMut<'w, Toasts>,
}

impl Referee<'_> {
    /// What is left of what a press does in a tick. `counted` is the world in which the press was counted as a stroke, if it
    /// was: where undo has put another in its place, it goes on as a stroke of its own.
    pub fn admit(&mut self, mut intents: Vec<Intent>, counted: &mut Option<Generation>) -> Vec<Intent> {
        let (Some(trial), Some(setup)) = (self.judge.running(), &self.setup) else { return intents };
        let mut lacking = None;
        intents.retain(|intent| {
            let lacks = trial.lacks(intent, setup);
            let is_good = lacks.is_none();
            lacking = lacks.or(lacking.take());
            is_good
        });
        if let Some(lacking) = lacking {
            self.toasts.say(refusal(trial, &lacking));
        }
        if !intents.is_empty() && counted.replace(*self.generation) != Some(*self.generation) {
            intents.insert(0, Intent::Stroke);
        }
        intents
    }
}

/// What is said to a player who wants something that a challenge does not give.
pub fn refusal(trial: &Trial, lacking: &str) -> String {
    let means: Vec<String> = trial.challenge.means.iter().map(|name| spoken(&spaced(name))).collect();
    let (lacking, means) = (spoken(&spaced(lacking)), means.join(&tr!(" and ")));
    tr!("No {lacking} in this challenge: you have {means}", lacking, means)
}
