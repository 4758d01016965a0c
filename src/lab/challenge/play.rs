//! Plays a challenge without a window, by its solution or with idle hands.

use super::solution::Solution;
use crate::{
    kernel::params::Preset,
    scene::{challenges::Challenge, effects::EffectModes},
    sim::{
        intent::Intent,
        judge::{Judge, Loss, Stars, Trial, Verdict},
        recording::Input,
        simulation::Simulation,
        state::Setup,
        workers::Workers,
    },
};
use serde::Serialize;
use std::sync::Arc;

/// What came out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// Name of the challenge.
    pub challenge: String,
    /// Name of the quality.
    pub quality: String,
    /// Whether it was won.
    pub won: bool,
    /// The stars that were earned.
    pub stars: Stars,
    /// Ticks that it took.
    pub ticks: u64,
    /// Strokes.
    pub strokes: u64,
    /// Particles poured, of the scene's own spacing.
    pub particles: u64,
    /// Hash of the world at the end.
    pub hash: String,
}

impl Outcome {
    fn of(simulation: &Simulation, trial: &Trial, preset: Preset) -> Self {
        let stars = if let Verdict::Won(stars) = trial.verdict { stars } else { Stars::default() };
        Self {
            challenge: trial.challenge.name.clone(),
            quality: preset.name().to_owned(),
            won: stars.done,
            stars,
            ticks: trial.ticks,
            strokes: trial.strokes,
            particles: trial.poured(),
            hash: format!("{:016x}", simulation.hash()),
        }
    }
}

/// Plays a challenge at a quality, by a solution or with idle hands, until it is won or lost.
///
/// # Errors
/// If its scene can't be built, or the solution does not fit it, or uses what the player does not have there: one line.
pub fn play(
    challenge: &Challenge,
    solution: Option<&Solution>,
    preset: Preset,
    workers: Workers,
) -> Result<Outcome, String> {
    let named = |what: String| format!("{}: {what}", challenge.name);
    let blueprint = challenge.scene.build(&[], Some(preset), &EffectModes::new()).map_err(|error| error.to_string())?;
    let mut simulation = Simulation::new(Arc::new(blueprint), workers);
    let entries = match solution {
        Some(solution) => solution.entries(simulation.get::<Setup>()).map_err(named)?,
        None => Vec::new(),
    };
    let mut input = Input::new(entries);
    simulation.push(Intent::Begin { challenge: challenge.name.clone() });
    loop {
        input.give(simulation.world_mut());
        simulation.tick();
        let Some(trial) = simulation.get::<Judge>().trial() else {
            return Err(named("it did not begin".to_owned()));
        };
        match &trial.verdict {
            Verdict::Running => {}
            Verdict::Lost(Loss::Means(means)) => return Err(named(format!("the solution uses {means}"))),
            Verdict::Won(_) | Verdict::Lost(Loss::Time) => return Ok(Outcome::of(&simulation, trial, preset)),
        }
    }
}
