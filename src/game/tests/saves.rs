//! Saving and loading by keys and by the list.

use super::*;
use crate::game::saves::{self, SaveFolders, Summary};
use std::{fs, path::PathBuf};

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("powder-master-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("the folder of temporary files can be written");
    path
}

/// A player in a paused world with some water, who saves into `folder`.
fn painter(folder: &std::path::Path) -> Player {
    let mut player = Player::new();
    player.0.insert_resource(SaveFolders(vec![folder.to_owned()]));
    player.pour_and_stop();
    player
}

fn load(player: &mut Player, path: &std::path::Path) {
    player.0.world_mut().resource_mut::<Orders>().push(Order::Load(path.to_owned()));
    player.frame();
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_saved_world_comes_back_and_loading_can_be_undone() {
    let folder = folder("saves");
    let mut player = painter(&folder);
    let (saved, tick, particles) = (player.hash(), player.tick(), player.particles());
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyS]);
    let files = saves::list(std::slice::from_ref(&folder));
    let [(path, _)] = &files[..] else { panic!("one save file, not {files:?}") };
    let summary = Summary::read(path).expect("the file is sound");
    assert_eq!((summary.tick, summary.particles), (tick, particles));

    let name = "dam_break".to_owned();
    player.0.world_mut().resource_mut::<Orders>().push(Order::Scene { name, settings: vec![], detail: 1.0 });
    player.frame();
    let dam = player.hash();
    load(&mut player, path);
    assert_eq!(player.hash(), saved, "the world of the file");
    assert_eq!(player.world().resource::<Setup>().blueprint.name, "empty");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), dam, "loading was undone");
    assert_eq!(player.world().resource::<Setup>().blueprint.name, "dam_break");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    assert_eq!(player.hash(), saved, "and made again");
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn a_broken_file_changes_nothing_and_says_why() {
    let folder = folder("broken");
    let mut player = painter(&folder);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyS]);
    let (path, _) = saves::list(std::slice::from_ref(&folder)).remove(0);
    let bytes = fs::read(&path).expect("it was written");
    let before = player.hash();
    for (bytes, says) in [(&bytes[..bytes.len() / 2], "damaged"), (b"a letter", "not a save file")] {
        fs::write(&path, bytes).expect("it can be written again");
        load(&mut player, &path);
        assert_eq!(player.hash(), before);
        let told = player.world().resource::<Toasts>().last().expect("a message");
        assert!(told.contains(says) && told.lines().count() == 1, "{told}");
    }
    load(&mut player, &folder.join("nothing.pms"));
    assert!(player.world().resource::<Toasts>().last().is_some_and(|told| told.contains("can't be read")));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_ne!(player.hash(), before, "undo takes the water back, not a load that never was");
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
fn where_nothing_can_be_written_the_player_is_told() {
    let mut player = Player::new();
    player.0.insert_resource(SaveFolders(vec![PathBuf::from("/dev/null/nowhere")]));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyS]);
    assert!(player.world().resource::<Toasts>().last().is_some_and(|told| told.starts_with("Not saved")));
}
