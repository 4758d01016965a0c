//! Files that are dropped: each kind opens, undo goes back, and a bad one changes nothing.

use super::*;
use crate::{
    game::{drop::Hovering, playback::Playback},
    sim::{picture, recorder, recorder::Recorder},
};
use bevy::window::FileDragAndDrop;
use std::path::{Path, PathBuf};

/// A player in a world that stands, with water in it.
fn painter() -> Player {
    let mut player = Player::new();
    player.pour_and_stop();
    player
}

fn picture_of(player: &Player) -> Vec<u8> {
    picture::encode(2, 2, &[90; 12], &Checkpoint::of(player.world()).encode()).expect("so many pixels")
}

fn give(player: &mut Player, name: &str, bytes: &[u8]) {
    let order = Order::LoadBytes { name: name.to_owned(), bytes: bytes.to_vec() };
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frame();
}

fn told(player: &Player) -> &str {
    player.world().resource::<Toasts>().last().expect("a message")
}

fn dam(player: &mut Player) -> u64 {
    let order = Order::Scene { name: "dam_break".to_owned(), settings: vec![], detail: 1.0 };
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frame();
    player.hash()
}

fn hover(player: &mut Player, path: &str) {
    let path_buf = PathBuf::from(path);
    player.event(WindowEvent::FileDragAndDrop(FileDragAndDrop::HoveredFile { window: Entity::PLACEHOLDER, path_buf }));
    player.frame();
}

fn drop(player: &mut Player, path: &Path) {
    let path_buf = path.to_owned();
    player.event(WindowEvent::FileDragAndDrop(FileDragAndDrop::DroppedFile { window: Entity::PLACEHOLDER, path_buf }));
    player.frame();
}

#[test]
fn a_picture_brings_its_world_and_undo_the_one_before() {
    let mut player = painter();
    let (saved, bytes) = (player.hash(), picture_of(&player));
    let dam = dam(&mut player);
    give(&mut player, "a.png", &bytes);
    assert_eq!((player.hash(), told(&player)), (saved, "Loaded: a.png (undo goes back)"));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), dam);
}

#[test]
fn a_scene_begins_at_the_quality_in_force_and_undo_goes_back() {
    let mut player = painter();
    let before = player.hash();
    let scene = b"(title: \"Mine\", spacing: 0.1, size: (1.2, 0.8),
        contents: [(element: \"water\", shape: Rect(min: (0, 0), max: (0.4, 0.3)))])";
    give(&mut player, "Mine.RON", scene);
    assert_eq!(player.world().resource::<Setup>().blueprint.title, "Mine");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), before);
    give(&mut player, "mine.ron", b"(title: 7)");
    assert_eq!(player.hash(), before);
    assert!(told(&player).starts_with("mine.ron: ") && told(&player).lines().count() == 1, "{}", told(&player));
}

#[test]
fn a_recording_is_shown_to_its_end_even_where_time_stood() {
    let mut player = painter();
    player.world().resource::<Recorder>().keep_up(player.world());
    let end = recorder::end_now(player.world());
    let (hash, bytes) = (player.hash(), player.world().resource::<Recorder>().last_minute(end));
    let dam = dam(&mut player);
    give(&mut player, "mine.pmr", &bytes);
    assert!(player.world().contains_resource::<Playback>() && !player.world().resource::<Pace>().paused);
    player.frames(40);
    assert_eq!((player.hash(), told(&player)), (hash, "The recording ends here"));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), dam);
}

#[test]
fn what_is_no_world_is_one_line_and_changes_nothing() {
    let mut player = painter();
    let (before, good) = (player.hash(), picture_of(&player));
    for (name, bytes, says) in [
        ("half.png", &good[..good.len() / 2], "half.png: the picture is damaged: it breaks off"),
        ("letter.txt", b"Dear Sir".as_slice(), "not a save file, picture, recording or scene (.ron) of Powder Master"),
        ("nothing", b"".as_slice(), "not a save file"),
        ("old.pmr", b"{\"powder_master_replay\":1}".as_slice(), "a recording of format 1"),
    ] {
        give(&mut player, name, bytes);
        assert_eq!(player.hash(), before);
        assert!(told(&player).contains(says) && told(&player).lines().count() == 1, "{}", told(&player));
    }
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_ne!(player.hash(), before, "undo takes the water back, not a file that never opened");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_file_that_hangs_over_the_window_is_named_and_opens_when_it_is_dropped() {
    let mut player = painter();
    let (saved, bytes) = (player.hash(), picture_of(&player));
    let path = std::env::temp_dir().join(format!("powder-master-dropped-{}.png", std::process::id()));
    std::fs::write(&path, bytes).expect("the folder of temporary files can be written");
    dam(&mut player);
    let hovering = |player: &Player| player.world().resource::<Hovering>().0.clone();
    hover(&mut player, "/somewhere/a.png");
    hover(&mut player, "/somewhere/a.png");
    hover(&mut player, "/somewhere/b.png");
    assert_eq!(hovering(&player), ["a.png", "b.png"]);
    player.event(WindowEvent::FileDragAndDrop(FileDragAndDrop::HoveredFileCanceled { window: Entity::PLACEHOLDER }));
    player.frame();
    assert!(hovering(&player).is_empty(), "it was taken away again");
    hover(&mut player, "/somewhere/a.png");
    drop(&mut player, &path);
    assert!(hovering(&player).is_empty());
    assert_eq!(player.hash(), saved);
    drop(&mut player, &std::env::temp_dir());
    assert!(told(&player).contains("can't be read"), "a folder: {}", told(&player));
    std::fs::remove_file(path).expect("it is ours");
}
