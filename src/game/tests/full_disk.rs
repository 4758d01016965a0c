//! A disk that is full while the game writes. As in tests/cli, a limit on the size of files stands for it: one that is set
//! and lifted while the game runs. It holds for a whole process, so each test runs in one of its own.

use super::*;
use crate::{
    game::{
        crash::journal::{self, Journal},
        favourites::Favourites,
        saves::{self, SaveFolders},
    },
    sim::{
        recorder::Recorder,
        recording::{End, Recording},
    },
};
use std::{
    env,
    fs::{self, File},
    path::{Path, PathBuf},
    process::{self, Command},
    thread,
};

/// Names the test to the process that it runs in.
const INSIDE: &str = "POWDER_MASTER_FULL_DISK";
/// What a message about a full disk ends with.
const ADVICE: &str = "what was there is kept: make room, or write to another disk";

/// Runs a test of this file in a process of its own, which a file that is too large does not end. Whether this is it.
fn is_inside(test: &str) -> bool {
    if env::var(INSIDE).is_ok_and(|inside| inside == test) {
        return true;
    }
    let output = Command::new("bash")
        .args(["-c", "trap '' XFSZ && exec \"$0\" \"$@\""])
        .arg(env::current_exe().expect("a program that runs"))
        .args(["--exact", &format!("{}::{test}", module_path!().split_once("::").expect("it is in a crate").1)])
        .env(INSIDE, test)
        .output()
        .expect("bash is there");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains("1 passed"), "{test} did not run: {said}");
    false
}

/// Lets no file have more than so many bytes; nothing: as many as it likes.
fn limit_files(bytes: Option<u64>) {
    let limit = bytes.map_or("unlimited".to_owned(), |bytes| bytes.to_string());
    let set =
        Command::new("prlimit").args(["--pid", &process::id().to_string(), &format!("--fsize={limit}:")]).status();
    assert!(set.expect("prlimit is there").success());
}

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let path = env::temp_dir().join(format!("powder-master-full-{name}-{}", process::id()));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("the folder of temporary files can be written");
    path
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<_> =
        fs::read_dir(folder).into_iter().flatten().map(|entry| entry.expect("ours").path()).collect();
    files.sort();
    files
}

/// A player who has poured some water and saves into `folder`.
fn painter(folder: &Path) -> Player {
    let mut player = Player::new();
    player.0.insert_resource(SaveFolders(vec![folder.to_owned()]));
    pour(&mut player);
    player
}

fn pour(player: &mut Player) {
    player.point_at(player.middle());
    player.press();
    player.frames(3);
    player.release();
    player.frames(2);
}

fn told(player: &Player) -> String {
    player.world().resource::<Toasts>().last().expect("it is told").to_owned()
}

#[test]
#[cfg_attr(not(target_os = "linux"), ignore = "the limit is set by Linux's means")]
fn saves_and_recordings_wait_for_room_and_the_world_goes_on() {
    if !is_inside("saves_and_recordings_wait_for_room_and_the_world_goes_on") {
        return;
    }
    let folder = folder("saves");
    let (mut player, mut other) = (painter(&folder), painter(&folder));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyS]);
    player.chord(&[KeyCode::F9]);
    let saved = files(&folder);
    let old = fs::read(&saved[0]).expect("it was written");
    let begun = player.tick();

    // The smallest of them is longer.
    limit_files(Some(64));
    for (keys, says) in [
        (&[KeyCode::ControlLeft, KeyCode::KeyS][..], "Not saved: "),
        (&[KeyCode::ShiftLeft, KeyCode::F9], "The last minute is not kept: "),
        (&[KeyCode::F9], "Not written: "),
    ] {
        player.chord(keys);
        let told = told(&player);
        assert!(told.starts_with(says) && told.contains(&*folder.to_string_lossy()), "{told}");
        assert!(told.contains(": can't be written: ") && told.contains(ADVICE), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(files(&folder.join("recordings")).is_empty(), "half a recording is left");
        let now: Vec<_> = files(&folder).into_iter().filter(|path| path.is_file()).collect();
        assert_eq!((now, fs::read(&saved[0]).expect("it is there")), (saved.clone(), old.clone()));
    }
    player.frames(20);
    other.frames((player.tick() - other.tick()) as usize);
    assert_eq!(player.hash(), other.hash(), "the world went on, and the full disk changed nothing of it");

    limit_files(None);
    player.chord(&[KeyCode::F9]);
    assert!(told(&player).starts_with("Recorded "), "{}", told(&player));
    let [recording] = &files(&folder.join("recordings"))[..] else { panic!("one recording") };
    let recording = Recording::decode(&fs::read(recording).expect("it was written")).expect("it is whole");
    assert!(recording.ticks() > 0 && recording.segments[0].tick.abs_diff(begun) <= 1, "all of it");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyS]);
    assert_eq!(saves::list(std::slice::from_ref(&folder)).len(), 2, "{}", told(&player));
    fs::remove_dir_all(folder).expect("it is ours");
}

/// Lets the game run until something is so.
fn wait(player: &mut Player, what: &str, mut until: impl FnMut(&Player) -> bool) {
    for _ in 0..2000 {
        player.frame();
        if until(player) {
            return;
        }
        thread::sleep(Duration::from_millis(5));
    }
    panic!("{what}: it takes too long");
}

#[test]
#[cfg_attr(not(target_os = "linux"), ignore = "the limit is set by Linux's means")]
fn a_journal_keeps_its_last_whole_state_and_goes_on_when_there_is_room() {
    if !is_inside("a_journal_keeps_its_last_whole_state_and_goes_on_when_there_is_room") {
        return;
    }
    let folder = folder("journal");
    let mut player = painter(&folder);
    let recorder = player.world().resource::<Recorder>().clone();
    let journal = Journal::begin(&folder, recorder).expect("the folder can be written");
    player.0.insert_resource(journal.clone());
    journal::follow(&mut player.0);
    let path = journal.path();
    let whole = || Recording::salvage(&fs::read(&path).expect("it is there")).ok();
    let poured = || whole().is_some_and(|whole| !whole.segments[0].entries.is_empty());
    wait(&mut player, "a first state", |_| poured());
    let is_warned = |player: &Player| {
        let toasts = player.world().resource::<Toasts>();
        let told = toasts.texts().filter(|told| told.starts_with("Played on, but a crash would lose it: ")).count();
        assert!(toasts.texts().all(|told| !told.contains("can't be written") || told.contains(ADVICE)));
        told == 1
    };

    limit_files(Some(0));
    pour(&mut player);
    wait(&mut player, "a warning", is_warned);
    // A new start of the world takes the place of the old one, and can't either.
    player.chord(&[KeyCode::KeyR]);
    let start = player.tick();
    for _ in 0..12 {
        player.frame();
        // The journal is told what is new every half second.
        thread::sleep(Duration::from_millis(100));
    }
    assert_eq!(player.tick(), start + 12, "the world goes on");
    assert!(poured(), "what it had is lost");
    let held = File::options().write(true).open(&path).expect("it is there").try_lock();
    assert!(held.is_err(), "another game would take it for one that was left");
    assert_eq!(files(&folder), std::slice::from_ref(&path), "a part file is left");

    limit_files(None);
    player.chord(&[KeyCode::KeyR]);
    wait(&mut player, "a state after the reset", |_| whole().is_some() && !poured());
    pour(&mut player);
    assert!(journal.close(), "it has all again");
    let end = whole().expect("it is whole");
    assert_eq!((end.end, end.segments[0].tick + end.ticks()), (Some(End::Crashed), player.tick()));
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
#[cfg_attr(not(target_os = "linux"), ignore = "the limit is set by Linux's means")]
fn a_favourite_that_can_t_be_kept_holds_and_the_old_ones_stay() {
    if !is_inside("a_favourite_that_can_t_be_kept_holds_and_the_old_ones_stay") {
        return;
    }
    let folder = folder("favourites");
    let mut player = Player::new();
    player.0.insert_resource(Favourites::of_folder(&folder));
    let mut put = |element: &str, digit| {
        player.0.world_mut().resource_mut::<HudCover>().element = Some(element.to_owned());
        player.chord(&[digit]);
        (told(&player), player.world().resource::<Favourites>().clone())
    };
    let (said, kept) = put("tar", KeyCode::Digit3);
    assert_eq!((said.as_str(), Favourites::of_folder(&folder)), ("tar is on 3 now", kept.clone()));
    limit_files(Some(4));
    let (said, now) = put("ash", KeyCode::Digit5);
    assert!(said.starts_with("ash is on 5 now, but not kept: ") && said.ends_with(ADVICE), "{said}");
    limit_files(None);
    assert_ne!(now, kept);
    assert_eq!(Favourites::of_folder(&folder), kept);
    let (_, now) = put("ash", KeyCode::Digit6);
    assert_eq!(Favourites::of_folder(&folder), now, "there is room again");
    fs::remove_dir_all(folder).expect("it is ours");
}
