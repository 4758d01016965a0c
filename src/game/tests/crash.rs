//! A game that panics or is killed, and the next one.

use super::*;
use crate::{
    game::{
        crash::{
            self, Crash,
            journal::{self, Journal},
            remains::{self, Choice, Reach, Remains},
        },
        history::History,
        saves::SaveFolders,
    },
    kernel::{
        brush::{BrushShape, Stroke},
        element::ElementId,
        simd::InstructionSet,
    },
    sim::{
        checkpoint::Checkpoint,
        recorder::Recorder,
        recording::{End, Entry, Recording},
        replay::Replay,
        workers::Workers,
    },
};
use bevy::prelude::{FixedPreUpdate, Res, Update};
use std::{
    fs,
    path::{Path, PathBuf},
    sync::atomic::AtomicU64,
    thread,
};

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("powder-master-crash-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&path);
    path
}

fn pour(mut queue: ResMut<IntentQueue>, clock: Res<Clock>) {
    if clock.tick.is_multiple_of(3) {
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(20.0 + clock.tick as f32 % 40.0, 30.0), 3.0);
        queue.push(Intent::Draw { element: ElementId(1), stroke });
    }
}

/// A game whose files go to `folder`, with somebody who pours.
fn game(folder: &Path) -> App {
    let Player(mut app) = Player::new();
    app.insert_resource(SaveFolders(vec![folder.to_owned()]));
    app.add_systems(FixedPreUpdate, pour);
    app
}

fn running(folder: &Path) -> PathBuf {
    folder.join("running")
}

/// Runs until it panics.
fn until_the_end(app: App, folder: &Path) -> Crash {
    let crash = crash::run(app, Some(running(folder)), |mut app| {
        loop {
            app.update();
        }
    });
    let crash: Result<(), Crash> = crash;
    crash.expect_err("it ends with a panic")
}

/// Starts another game in `folder`, in which `choice` is made when something is offered; the game then, if it was.
fn next_start<T>(folder: &Path, choice: Option<Choice>, look: impl FnOnce(&mut Player) -> T) -> Option<T> {
    let Player(mut app) = Player::new();
    app.insert_resource(SaveFolders(vec![folder.to_owned()]));
    let outcome = crash::run(app, Some(running(folder)), |app| {
        let mut player = Player(app);
        let wait = |player: &mut Player, until: &dyn Fn(Option<&Remains>) -> bool| {
            for _ in 0..2000 {
                player.frame();
                if until(player.world().get_resource::<Remains>()) {
                    return;
                }
                thread::sleep(Duration::from_millis(5));
            }
            panic!("it takes too long");
        };
        wait(&mut player, &|remains| remains.is_none_or(|remains| remains.offer().is_some()));
        let offered = player.world().contains_resource::<Remains>();
        if let (true, Some(choice)) = (offered, choice) {
            player.0.world_mut().resource_mut::<Remains>().choice = Some(choice);
            wait(&mut player, &|remains| remains.is_none());
        }
        offered.then(|| look(&mut player))
    });
    outcome.expect("the next game ends well")
}

fn the_crash_file(folder: &Path) -> Recording {
    let files: Vec<PathBuf> = fs::read_dir(folder.join("recordings"))
        .expect("there is a folder of recordings")
        .map(|entry| entry.expect("it can be read").path())
        .collect();
    let [path] = &files[..] else { panic!("one file, not {files:?}") };
    assert!(path.to_string_lossy().contains("empty-crash-"), "{}", path.display());
    Recording::decode(&fs::read(path).expect("it was written")).unwrap_or_else(|error| panic!("{error}"))
}

/// State and tick to which a recording leads.
fn replayed(recording: &Recording) -> (u64, u64) {
    let mut replay = Replay::new(recording, Workers::default(), InstructionSet::detect()).expect("it was read");
    while replay.tick().unwrap_or_else(|difference| panic!("{difference}")) {}
    let hash = replay.finish().unwrap_or_else(|difference| panic!("{difference}"));
    (hash, replay.world().resource::<Clock>().tick)
}

fn fail_in_a_tick(clock: Res<Clock>) {
    assert!(clock.tick < 40, "the fortieth tick");
}

fn fail_on_another_thread(clock: Res<Clock>) {
    let tick = clock.tick;
    rayon::join(|| (), || assert!(tick < 40, "the fortieth tick"));
}

#[test]
fn a_panic_saves_what_was_played_and_the_next_start_restores_it() {
    type Add = fn(&mut App);
    let cases: [(&str, Add); 3] = [
        ("tick", |app| {
            app.add_systems(FixedUpdate, fail_in_a_tick.after(Pass::Sources));
        }),
        ("thread", |app| {
            app.add_systems(FixedUpdate, fail_on_another_thread.after(Pass::Sources));
        }),
        ("frame", |app| {
            app.add_systems(Update, fail_in_a_tick);
        }),
    ];
    for (name, add) in cases {
        let folder = folder(name);
        let mut app = game(&folder);
        add(&mut app);
        let Crash { what, saved } = until_the_end(app, &folder);
        assert!(what.starts_with("the fortieth tick (") && what.contains("tests/crash.rs:"), "{name}: {what}");
        assert!(saved.contains("the last minute is in") && saved.contains("the next start offers"), "{name}: {saved}");
        assert!(!format!("{what}{saved}").contains('\n'));

        let recording = the_crash_file(&folder);
        assert_eq!(recording.end, Some(End::Crashed), "{name}");
        let (hash, tick) = replayed(&recording);
        assert_eq!(tick, 40, "{name}: all ticks before it are there");
        assert!(recording.segments[0].entries.len() >= 13, "{name}: the input, too");

        // Looking at it decides nothing.
        assert!(next_start(&folder, None, |_| ()).is_some(), "{name}: nothing was offered");
        let restored = next_start(&folder, Some(Choice::Restore), |player| {
            assert!(player.world().resource::<Pace>().paused, "{name}: it goes on by itself");
            assert!(player.world().resource::<History>().reach().0, "{name}: it can't be undone");
            (player.hash(), player.tick())
        });
        assert_eq!(restored, Some((hash, tick)), "{name}");
        assert!(next_start(&folder, None, |_| ()).is_none(), "{name}: it was offered again");
        assert_eq!(fs::read_dir(running(&folder)).expect("it is there").count(), 0, "{name}: journals are left");
        fs::remove_dir_all(folder).expect("it is ours");
    }
}

#[test]
fn what_is_forgotten_or_taken_from_earlier_is_not_offered_again() {
    let folder = folder("choices");
    for choice in [Choice::Forget, Choice::Earlier] {
        let mut app = game(&folder);
        app.add_systems(FixedUpdate, fail_in_a_tick);
        until_the_end(app, &folder);
        let tick = next_start(&folder, Some(choice), |player| player.tick()).expect("it was offered");
        if choice == Choice::Earlier {
            assert!(tick <= 1, "the state that was kept is of the start, not of tick {tick}");
        }
        assert!(next_start(&folder, None, |_| ()).is_none(), "{choice:?}: it was offered again");
    }
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
fn a_game_that_was_killed_leaves_its_journal_and_one_that_ended_well_nothing() {
    let folder = folder("killed");
    let running = running(&folder);
    let mut app = game(&folder);
    let recorder = app.world().resource::<Recorder>().clone();
    let journal = Journal::begin(&running, recorder).expect("the folder can be written");
    app.insert_resource(journal.clone());
    journal::follow(&mut app);
    for _ in 0..14 {
        app.update();
        thread::sleep(Duration::from_millis(100));
    }
    // As long as the game lives, its journal is its own.
    assert!(next_start(&folder, None, |_| ()).is_none(), "the journal of a game that lives was offered");
    // What a killed game leaves: the file, without a lock, perhaps broken off.
    let bytes = fs::read(journal.path()).expect("it is written while the game runs");
    let recording = Recording::salvage(&bytes).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(recording.end, None);
    assert!(recording.ticks() >= 4, "{} ticks in 1.4 s", recording.ticks());
    let (hash, tick) = replayed(&recording);
    journal.forget();
    assert!(!journal.path().exists());
    let left = running.join("running-7.pmr");
    fs::write(&left, &bytes).expect("the folder can be written");
    let restored = next_start(&folder, Some(Choice::Restore), |player| (player.hash(), player.tick()));
    assert_eq!(restored, Some((hash, tick)));
    fs::write(&left, &bytes[..bytes.len() - 3]).expect("the folder can be written");
    let earlier = next_start(&folder, Some(Choice::Restore), |player| player.tick()).expect("what is whole is offered");
    assert!(earlier <= tick);
    // Rubbish, and a game in which nobody did anything, are not worth a question.
    fs::write(&left, b"PowderMaster recording\n").expect("the folder can be written");
    assert!(next_start(&folder, None, |_| ()).is_none());
    assert!(!left.exists(), "rubbish stays");
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
fn what_panics_again_is_restored_as_far_as_it_goes() {
    let mut app = game(&folder("again"));
    (0..20).for_each(|_| app.update());
    let bytes = app.world().resource::<Recorder>().last_minute(End::Crashed);
    let good = Recording::decode(&bytes).unwrap_or_else(|error| panic!("{error}"));
    let set = InstructionSet::detect();
    let tick = |recording: &Recording| {
        let restored = remains::restore(recording, set, &AtomicU64::new(0)).expect("there is always something");
        (restored.0.state.clock.tick, restored.1)
    };
    let start = good.segments[0].tick;
    let end = start + good.ticks();
    assert_eq!(tick(&good), (end, Reach::Whole));
    // No file can hold this: it stands for an edit that the program does not survive.
    let fatal = |tick| Entry { tick, intent: Intent::Fill { element: ElementId(200), at: Vec2::splat(10.0) } };
    let mut bad = good.clone();
    bad.segments[0].entries.push(fatal(end));
    assert_eq!(tick(&bad), (end, Reach::LastTick));
    let mut worse = good.clone();
    worse.segments[0].entries.insert(0, fatal(start));
    assert_eq!(tick(&worse), (start, Reach::LastState));
}

#[test]
fn a_file_of_the_last_minute_takes_the_state_that_is_shown() {
    let mut app = game(&folder("jump"));
    (0..20).for_each(|_| app.update());
    let saved = Checkpoint::decode(&Checkpoint::of(app.world()).encode()).expect("its own file");
    (0..5).for_each(|_| app.update());
    saved.restore(app.world_mut());
    app.world_mut().resource_mut::<Pace>().paused = true;
    let recorder = app.world().resource::<Recorder>();
    recorder.keep_up(app.world());
    let bytes = recorder.last_minute(crate::sim::recorder::end_now(app.world()));
    let recording = Recording::decode(&bytes).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(replayed(&recording).0, control::hash(app.world()));
}
