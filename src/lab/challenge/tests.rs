use super::*;
use crate::{
    kernel::params::Preset,
    lab::jobs::pool,
    scene::challenges::{Challenge, challenges},
    sim::{judge::Stars, workers::Workers},
};
use std::sync::Arc;

fn all() -> &'static [Arc<Challenge>] {
    challenges().expect("they come with the game")
}

/// What comes of all challenges at some qualities, each alone on a thread.
fn outcomes(presets: &[Preset], solved: bool) -> Vec<(Arc<Challenge>, Outcome)> {
    let jobs: Vec<_> =
        all().iter().flat_map(|challenge| presets.iter().map(move |preset| (challenge, *preset))).collect();
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let cost = |(_, preset): &(_, Preset)| (1000.0 * preset.detail()) as u64 + u64::from(preset.quality().substeps);
    pool::run(
        &jobs,
        threads,
        cost,
        |_, _| {},
        |&(challenge, preset)| {
            let found = solved.then(|| solution(&challenge.name).expect("each has one"));
            let outcome = play(challenge, found.as_ref(), preset, Workers::single()).expect("it can be played");
            (challenge.clone(), outcome)
        },
    )
}

fn assert_solved(presets: &[Preset]) {
    let outcomes = outcomes(presets, true);
    let short: Vec<_> = outcomes.iter().filter(|(_, outcome)| outcome.stars != Stars::ALL).collect();
    assert!(short.is_empty(), "{:#?}", short.iter().map(|(_, outcome)| outcome).collect::<Vec<_>>());
    assert_eq!(outcomes.len(), 12 * presets.len());
}

#[test]
fn their_solutions_win_all_stars() {
    // Natively the next test does it at every quality.
    assert_solved(if cfg!(target_arch = "wasm32") { &[Preset::Balanced] } else { &[Preset::Draft] });
}

#[test]
#[cfg_attr(any(debug_assertions, target_arch = "wasm32"), ignore = "heavy: natively and in release only")]
fn their_solutions_win_all_stars_at_every_quality() {
    assert_solved(&Preset::ALL);
}

#[test]
#[cfg_attr(any(debug_assertions, target_arch = "wasm32"), ignore = "heavy: natively and in release only")]
fn idle_hands_win_nothing() {
    let outcomes = outcomes(&[Preset::Classic, Preset::Draft, Preset::Balanced, Preset::Fine], false);
    for (challenge, outcome) in outcomes {
        assert_eq!((outcome.won, outcome.ticks), (false, challenge.ticks), "{outcome:?}");
        assert_eq!((outcome.strokes, outcome.particles), (0, 0));
    }
}

#[test]
fn their_worlds_are_small_and_their_words_short() {
    for (k, challenge) in all().iter().enumerate() {
        let name = &challenge.name;
        assert_eq!(challenge.number as usize, k + 1, "{name}: the numbers go from 1 up");
        let world = challenge.scene.build(&[], None, &Default::default()).expect("its defaults are valid");
        let count = world.particles.len() + world.solids.count();
        assert!(count <= 2500, "{name}: {count} particles");
        assert!(challenge.title().len() <= 22 && challenge.task.len() <= 100, "{name}: no room for its words");
        assert!(challenge.task.ends_with('.'), "{name}");
    }
}
