//! That every scene of the gallery is sound, and that one that is not is seen.

use super::{Job, Plan, Row, Tally, run};
use crate::{
    kernel::params::Preset,
    lab::{
        cases::Shard,
        experiment::journal::{Journal, JournalFile},
    },
    scene,
    sim::{checkpoint::Checkpoint, snapshot::Snapshot},
};
use std::{
    fs,
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
};

/// A minute, in which the player does everything once.
fn plan(scenes: Vec<&'static str>, presets: &[Preset], detail: f64) -> Plan {
    Plan { scenes, minutes: 1, seed: 1, detail, presets: presets.to_vec(), shard: None, threads: 2 }
}

fn played(plan: &Plan, journal: Option<Journal<Row>>) -> (Tally, usize) {
    let played = AtomicUsize::new(0);
    let count = |_, _: &Job| _ = played.fetch_add(1, Ordering::Relaxed);
    let (tally, kept) = run(plan, &plan.jobs().unwrap(), journal, count).unwrap();
    kept.unwrap();
    (tally, played.into_inner())
}

/// Each scene at one quality, in turn, with a sixteenth of its particles: a minute of a core. A debug build has time for one in
/// five, and the command for ten minutes of all at every quality; `reference` takes as long as the five others together.
#[test]
fn every_scene_is_sound() {
    const IN_TURN: [Preset; 5] = [Preset::Classic, Preset::Draft, Preset::Fast, Preset::Balanced, Preset::Fine];
    // Its emitters of smoke are as wide as a particle of its own.
    let (narrow, others): (Vec<_>, Vec<_>) =
        scene::builtin_names().into_iter().partition(|name| *name == "wind_tunnel");
    let in_turn = |turn: usize| others.iter().copied().skip(turn).step_by(IN_TURN.len()).collect();
    let mut plans = vec![plan(in_turn(1), &[Preset::Draft], 0.25)];
    if cfg!(not(debug_assertions)) {
        let others = (0..IN_TURN.len()).filter(|turn| *turn != 1);
        plans.extend(others.map(|turn| plan(in_turn(turn), &[IN_TURN[turn]], 0.25)));
        plans.push(plan(narrow, &[Preset::Draft], 0.75));
    }
    for plan in plans {
        let (tally, _) = played(&plan, None);
        assert_eq!(tally.failure(), None, "{}", tally.failed().join("\n"));
    }
}

/// Three small scenes.
fn small() -> Plan {
    plan(vec!["layers", "sealed_air", "u_tube"], &[Preset::Draft], 0.25)
}

/// Without what it took.
fn timeless((mut tally, played): (Tally, usize)) -> (Tally, usize) {
    tally.rows.iter_mut().for_each(|row| row.seconds = 0.0);
    (tally, played)
}

#[test]
fn shards_are_the_whole_and_a_journal_plays_nothing_twice() {
    let path = std::env::temp_dir().join(format!("powder-master-scenes-{}", std::process::id()));
    let _ = fs::remove_file(&path);
    let kept = |plan: &Plan| {
        let journal = Journal::read(JournalFile::open(&path).unwrap(), plan.campaign("this")).unwrap();
        timeless(played(plan, Some(journal)))
    };
    let (whole, count) = timeless(played(&small(), None));
    assert_eq!((whole.rows.len(), count), (3, 3));
    let shard = |text: &str| kept(&Plan { shard: Some(Shard::read(text).unwrap()), ..small() });
    let parts = ["2/2", "1/2"].map(|text| shard(text).0);
    assert_eq!(Tally::merge(parts.to_vec()), Ok(whole.clone()));
    assert_eq!(kept(&small()), (whole.clone(), 0), "all of it was kept");
    let (other, count) = kept(&Plan { seed: 2, ..small() });
    assert!(count == 3 && other != whole, "other play is another run");
    assert!(Tally::merge(vec![parts[0].clone()]).is_err_and(|what| what.contains("1/2 is missing")));
    let other = Tally { detail: 1.0, ..parts[1].clone() };
    assert!(Tally::merge(vec![parts[0].clone(), other]).is_err_and(|what| what.contains("shards of one run")));
    fs::remove_file(&path).unwrap();
}

/// The faults of a scene whose start is changed, and a table with them.
fn with(change: fn(&mut Snapshot)) -> (Row, Tally) {
    let plan = small();
    let jobs = plan.jobs().unwrap();
    let job = jobs.iter().find(|job| job.scene == "u_tube").unwrap();
    let mut start: Checkpoint = plan.start(job).unwrap();
    let mut state = (*start.state).clone();
    change(&mut state);
    start.state = Arc::new(state);
    let row = Row::of(&plan, job, &start);
    (row.clone(), Tally::new(&plan, vec![row]))
}

#[test]
fn a_scene_that_is_not_sound_is_named() {
    let (row, tally) = with(|state| state.particles.x[0] = f32::NAN);
    assert_eq!((row.faults.len(), row.since), (1, Some(1)), "{row:?}");
    let named = "u_tube at draft, since minute 1: 1 particles stopped being numbers";
    assert_eq!(tally.failed(), [named]);
    assert_eq!(tally.failure().unwrap(), format!("1 of 1 soaks are not sound, the first is {named}"));
    assert!(tally.table().contains("NOT since minute 1, "), "{}", tally.table());
    assert!(tally.document("a command", "a processor").contains(named));
    // What no scene is.
    let (row, tally) = with(|state| _ = state.particles.x.pop());
    assert!(row.faults[0].starts_with("a panic: ") && row.hash.is_none(), "{row:?}");
    assert!(tally.table().contains("NOT sound"));
}
