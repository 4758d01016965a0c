//! What is recorded is the same world again.

use super::*;
use crate::{
    game::{actions::Action, playback, saves::SaveFolders},
    kernel::{params::Preset, simd::InstructionSet},
    scene::effects::{Effect, Mode},
    sim::{
        checkpoint::Checkpoint,
        effects::Effects,
        recorder::Recorder,
        recording::{RECORDING_ENDING, Recording},
        replay::Replay,
        workers::Workers,
    },
};
use std::{
    fs,
    path::{Path, PathBuf},
};

fn file(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("powder-master-{name}-{}.{RECORDING_ENDING}", std::process::id()))
}

/// A player who is recorded from the first tick.
fn recorded(path: &Path) -> Player {
    let mut player = Player::new();
    control::reset(player.0.world_mut());
    player.world().resource::<Recorder>().begin(player.world(), Some(path.to_owned()));
    player
}

fn scribble(player: &mut Player, element: &str, at: Vec2) {
    player.choose(element);
    player.point_at(player.middle() + at);
    player.press();
    player.frames(4);
    player.point_at(player.middle() + at + Vec2::new(9.0, 4.0));
    player.frames(3);
    player.release();
    player.frames(2);
}

fn order(player: &mut Player, order: Order) {
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frame();
}

fn read(path: &Path) -> Recording {
    let bytes = fs::read(path).expect("it was written");
    Recording::decode(&bytes).unwrap_or_else(|error| panic!("{error}"))
}

/// The hash at the end of a recording, played again.
fn again(path: &Path) -> u64 {
    let recording = read(path);
    let mut replay = Replay::new(&recording, Workers::default(), InstructionSet::detect()).expect("it was read");
    while replay.tick().unwrap_or_else(|difference| panic!("{difference}")) {}
    replay.finish().unwrap_or_else(|difference| panic!("{difference}"))
}

/// The recordings in a folder for saved worlds.
fn recordings(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.join("recordings")).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("it can be read").path()).collect();
    paths.sort();
    paths
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_recording_repeats_pauses_undo_wind_and_the_last_edits() {
    let path = file("everything");
    let mut player = recorded(&path);
    scribble(&mut player, "water", Vec2::new(0.0, 10.0));
    scribble(&mut player, "rock", Vec2::new(-20.0, -5.0));
    player.chord(&[KeyCode::Space]);
    scribble(&mut player, "rock", Vec2::new(5.0, -8.0));
    scribble(&mut player, "water", Vec2::new(9.0, 0.0));
    player.button(MouseButton::Right, ButtonState::Pressed);
    player.frames(3);
    player.button(MouseButton::Right, ButtonState::Released);
    player.frames(2);
    player.chord(&[KeyCode::Period]);
    player.chord(&[KeyCode::Space]);
    player.frames(10);
    scribble(&mut player, "rock", Vec2::new(0.0, 14.0));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    player.chord(&[KeyCode::KeyQ]);
    player.press();
    player.frames(5);
    player.release();
    player.frames(20);
    player.chord(&[KeyCode::KeyP]);
    scribble(&mut player, "water", Vec2::new(-9.0, 12.0));
    let hash = player.hash();
    player.0.world_mut().write_message(bevy::app::AppExit::Success);
    player.frame();
    assert_eq!(again(&path), hash);
    fs::remove_file(path).expect("it is ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_recording_goes_on_at_another_quality_and_back_with_undo() {
    let path = file("qualities");
    let mut player = recorded(&path);
    let choose = |player: &mut Player, preset| {
        player.0.world_mut().resource_mut::<Orders>().push(Order::Quality(preset));
        player.frames(6);
        assert_eq!(player.world().resource::<Setup>().quality, preset.quality());
    };
    scribble(&mut player, "water", Vec2::new(0.0, 10.0));
    choose(&mut player, Preset::Fine);
    scribble(&mut player, "rock", Vec2::new(-20.0, -5.0));
    choose(&mut player, Preset::Draft);
    scribble(&mut player, "water", Vec2::new(9.0, 0.0));
    choose(&mut player, Preset::Reference);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.world().resource::<Setup>().preset, Preset::Draft, "a state goes on at its own quality");
    player.frames(10);
    player.chord(&[KeyCode::KeyP]);
    let hash = player.hash();
    player.0.world_mut().write_message(bevy::app::AppExit::Success);
    player.frame();
    assert!(player.world().resource::<Recorder>().ticks().is_some(), "the recording has ended");
    assert_eq!(again(&path), hash);
    fs::remove_file(path).expect("it is ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_recording_goes_on_through_everything_that_puts_another_world_in_place() {
    let path = file("jumps");
    let mut player = recorded(&path);
    scribble(&mut player, "water", Vec2::ZERO);
    order(&mut player, Order::Effect(Effect::Viscosity, Mode::On));
    player.frames(3);
    assert_eq!(player.world().resource::<Effects>().get(Effect::Viscosity).mode, Mode::On);
    let saved = Checkpoint::of(player.world()).encode();
    let save = file("jumps-save").with_extension("pms");
    fs::write(&save, saved).expect("the folder of temporary files can be written");
    order(
        &mut player,
        Order::Scene { name: "dam_break".into(), settings: vec![("columns".into(), "9".into())], detail: 1.0 },
    );
    player.frames(5);
    order(&mut player, Order::Load(save.clone()));
    player.frames(5);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    player.frames(5);
    order(&mut player, Order::Act(Action::Reset));
    scribble(&mut player, "rock", Vec2::ZERO);
    player.chord(&[KeyCode::Space]);
    let hash = player.hash();
    player.0.world_mut().write_message(bevy::app::AppExit::Success);
    player.frame();
    assert_eq!(read(&path).segments.len(), 5, "start, scene, save file, undo, reset");
    assert_eq!(again(&path), hash);
    fs::remove_file(path).and_then(|()| fs::remove_file(save)).expect("they are ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_key_begins_a_recording_and_ends_it_and_another_keeps_the_last_minute() {
    let folder = file("keys").with_extension("d");
    let mut player = Player::new();
    player.0.insert_resource(SaveFolders(vec![folder.clone()]));
    scribble(&mut player, "water", Vec2::new(0.0, 10.0));
    player.chord(&[KeyCode::F9]);
    assert!(player.world().resource::<Recorder>().ticks().is_some());
    let begun = player.tick();
    scribble(&mut player, "rock", Vec2::new(-20.0, -5.0));
    player.chord(&[KeyCode::Space]);
    scribble(&mut player, "water", Vec2::new(5.0, 9.0));
    let (hash, tick) = (player.hash(), player.tick());
    player.chord(&[KeyCode::F9]);
    assert_eq!(player.world().resource::<Recorder>().ticks(), None);
    let [path] = &recordings(&folder)[..] else { panic!("one file, not {:?}", recordings(&folder)) };
    let told = player.world().resource::<Toasts>().last().expect("it is told").to_owned();
    assert!(told.starts_with("Recorded 0.") && told.ends_with(&path.display().to_string()), "{told}");
    let recording = read(path);
    assert!(recording.segments[0].tick.abs_diff(begun) <= 1, "{} is not {begun}", recording.segments[0].tick);
    assert_eq!(recording.segments[0].tick + recording.ticks(), tick);
    assert_eq!(again(path), hash);

    player.chord(&[KeyCode::ShiftLeft, KeyCode::F9]);
    let minute = recordings(&folder).into_iter().find(|other| other != path).expect("a second file");
    let told = player.world().resource::<Toasts>().last().expect("it is told").to_owned();
    assert!(told.starts_with("The last minute: ") && told.ends_with(&minute.display().to_string()), "{told}");
    assert_eq!(read(&minute).ticks(), tick, "all that was played, and the recording did not end it");
    assert_eq!(again(&minute), hash);
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_recording_that_can_not_be_written_ends_and_is_kept_until_it_can() {
    let folder = file("full-disk").with_extension("d");
    fs::write(&folder, "no folder").expect("the folder of temporary files can be written");
    let mut player = Player::new();
    player.0.insert_resource(SaveFolders(vec![folder.clone()]));
    player.chord(&[KeyCode::F9]);
    scribble(&mut player, "water", Vec2::new(0.0, 10.0));
    player.chord(&[KeyCode::Space]);
    let (hash, tick) = (player.hash(), player.tick());
    player.chord(&[KeyCode::F9]);
    let told = player.world().resource::<Toasts>().last().expect("it is told").to_owned();
    assert!(told.contains("can't be written") && told.ends_with("F9 tries again."), "{told}");
    player.chord(&[KeyCode::Space]);
    scribble(&mut player, "rock", Vec2::new(-20.0, -5.0));
    fs::remove_file(&folder).expect("it is ours");
    player.chord(&[KeyCode::F9]);
    assert_eq!(player.world().resource::<Recorder>().ticks(), None);
    let [path] = &recordings(&folder)[..] else { panic!("one file, not {:?}", recordings(&folder)) };
    let recording = read(path);
    assert_eq!(recording.segments[0].tick + recording.ticks(), tick, "it went on");
    assert_eq!(again(path), hash);
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_recording_can_be_watched_and_comes_to_the_same_end() {
    let path = file("watched");
    let mut player = recorded(&path);
    scribble(&mut player, "water", Vec2::ZERO);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    scribble(&mut player, "rock", Vec2::new(3.0, -9.0));
    player.chord(&[KeyCode::Space]);
    let (hash, tick) = (player.hash(), player.tick());
    player.0.world_mut().write_message(bevy::app::AppExit::Success);
    player.frame();
    let recording = read(&path);
    let mut watcher = Player::new();
    let watch = |watcher: &mut Player| {
        recording.segments[0].start().expect("it was read").restore(watcher.0.world_mut());
        playback::begin(watcher.0.world_mut(), recording.clone());
    };
    watch(&mut watcher);
    watcher.frames(recording.ticks() as usize + 10);
    assert!(watcher.world().resource::<Pace>().paused, "it stands at the end");
    assert_eq!((watcher.tick(), watcher.hash()), (tick, hash));
    watcher.chord(&[KeyCode::Space]);
    watch(&mut watcher);
    watcher.frames(4);
    order(&mut watcher, Order::Act(Action::Reset));
    watcher.frames(30);
    assert_eq!(watcher.particles(), 0, "a reset leaves the recording");
    assert!(!watcher.world().resource::<Pace>().paused);
    watch(&mut watcher);
    watcher.frames(4);
    scribble(&mut watcher, "rock", Vec2::new(20.0, 9.0));
    assert_eq!(watcher.world().resource::<Toasts>().last(), Some("The recording is left here"));
    watcher.frames(recording.ticks() as usize + 10);
    assert!(!watcher.world().resource::<Pace>().paused, "a stroke leaves the recording, and its end stops no one");
    fs::remove_file(path).expect("it is ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_recording_repeats_what_is_replaced_cut_and_pasted_at_another_detail_too() {
    let path = file("stamps");
    let mut player = Player::at_a_pool();
    player.set_springs();
    player.world().resource::<Recorder>().begin(player.world(), Some(path.clone()));
    player.chord(&[KeyCode::KeyP]);
    player.take(KeyCode::KeyC);
    player.chord(&[KeyCode::ShiftLeft, KeyCode::KeyR]);
    player.click(Vec2::new(5.0, 10.0));
    player.frames(10);
    player.click(Vec2::new(30.0, 10.0));
    player.take(KeyCode::KeyX);
    player.chord(&[KeyCode::ShiftLeft, KeyCode::KeyH]);
    player.click(Vec2::new(-20.0, 12.0));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    order(&mut player, Order::Detail(0.5));
    player.click(Vec2::new(-10.0, 4.0));
    player.chord(&[KeyCode::Escape]);
    for key in [KeyCode::Insert, KeyCode::Delete] {
        player.chord(&[key]);
        scribble(&mut player, "oil", Vec2::new(-15.0, -2.0));
    }
    player.chord(&[KeyCode::KeyP]);
    let hash = player.hash();
    player.0.world_mut().write_message(bevy::app::AppExit::Success);
    player.frame();
    assert_eq!(again(&path), hash);
    let segments = read(&path).segments;
    let count = |of: fn(&Intent) -> bool| -> usize {
        segments.iter().map(|segment| segment.entries.iter().filter(|entry| of(&entry.intent)).count()).sum()
    };
    assert_eq!(count(|intent| matches!(intent, Intent::Paste { .. })), 4);
    assert_eq!(count(|intent| matches!(intent, Intent::PasteSources { .. })), 4);
    fs::remove_file(path).expect("it is ours");
}
