//! `challenge`: plays the solutions of challenges without a window, and prints the stars.

use crate::{
    cli::{args::ChallengeArguments, failure::Failure, output, progress, threads},
    kernel::{params::Preset, units::TICKS_PER_SECOND},
    lab::challenge::{Outcome, play, solution},
    scene::challenges::{Challenge, challenges, find},
    sim::{judge::Stars, numbers::trimmed, workers::Workers},
};
use std::{fmt::Write, sync::Arc};

/// Plays one challenge, or all.
pub(super) fn challenge(arguments: &ChallengeArguments) -> Result<(), Failure> {
    let json = arguments.json.as_deref();
    output::check(json.as_slice())?;
    let chosen: Vec<Arc<Challenge>> = match &arguments.name {
        Some(name) => vec![find(name)?],
        None => challenges()?.to_vec(),
    };
    threads::start(arguments.threads)?;
    let preset = arguments.quality.unwrap_or(Preset::Balanced);
    let line = progress::bar(chosen.len() as u64);
    let mut played = Vec::new();
    for challenge in &chosen {
        let found = if arguments.idle { None } else { Some(solution(&challenge.name).map_err(Failure::Outcome)?) };
        let outcome = play(challenge, found.as_ref(), preset, Workers::default()).map_err(Failure::Outcome)?;
        played.push(outcome);
        line.inc(1);
    }
    drop(line);
    let table =
        || chosen.iter().zip(&played).fold(String::new(), |text, (challenge, outcome)| text + &row(challenge, outcome));
    output::report(json, || serde_json::json!(played), table)?;
    let short = played.iter().filter(|outcome| outcome.stars != Stars::ALL).count();
    // Idle hands are to win nothing.
    let (wrong, what) = match arguments.idle {
        true => (played.iter().filter(|outcome| outcome.won).count(), "won with idle hands"),
        false => (short, "without all three stars"),
    };
    if wrong == 0 { Ok(()) } else { Err(Failure::Outcome(format!("{wrong} of {} {what}", played.len()))) }
}

fn row(challenge: &Challenge, outcome: &Outcome) -> String {
    let seconds = |ticks: u64| trimmed(ticks as f64 / f64::from(TICKS_PER_SECOND), 1);
    let Outcome { quality, ticks, particles, strokes, stars, hash, .. } = outcome;
    let mut text = format!("{}\t{quality}\t", challenge.name);
    let stars = match (outcome.won, stars.count()) {
        (false, _) => "not won".to_owned(),
        (true, 1) => "1 star".to_owned(),
        (true, count) => format!("{count} stars"),
    };
    // Writing to a text has no way to fail.
    let _ = writeln!(
        text,
        "{stars}\t{} of {} s\tparticles {particles} of {}\tstrokes {strokes} of {}\thash={hash}",
        seconds(*ticks),
        seconds(challenge.ticks),
        challenge.particles,
        challenge.strokes
    );
    text
}
