//! Throwing hard cases at the world that is played.

use super::*;
use crate::{
    game::{hud::panels::throws::PANEL, throws::Thrown},
    lab::gauntlet::throws::{Progress, StressTest, Throw},
    sim::{recording::Input, simulation::Simulation, workers::Workers},
};
use bevy::platform::time::Instant;

fn throw(player: &mut Player, name: &'static str) {
    player.0.world_mut().resource_mut::<Orders>().push(Order::Throw(name));
    player.frame();
}

/// A player at the communicating vessels.
fn at_vessels() -> Player {
    let mut player = Player::new();
    let scene = Order::Scene { name: "communicating_vessels".to_owned(), settings: vec![], detail: 0.5 };
    player.0.world_mut().resource_mut::<Orders>().push(scene);
    player.frames(10);
    player
}

fn gravity(player: &Player) -> f32 {
    player.world().resource::<Setup>().domain.gravity.y
}

/// Waits for the verdict.
fn verdict(player: &mut Player) -> Progress {
    let begun = Instant::now();
    while player.world().resource::<StressTest>().is_running() {
        assert!(begun.elapsed() < Duration::from_secs(300), "no verdict");
        // A module has no thread beside its own to wait for.
        if cfg!(not(target_arch = "wasm32")) {
            std::thread::sleep(Duration::from_millis(20));
        }
        player.frame();
    }
    player.world().resource::<StressTest>().progress().clone()
}

#[test]
fn the_copy_that_is_judged_is_the_world_that_is_played() {
    let mut player = at_vessels();
    let start = Checkpoint::of(player.world());
    let input = Throw::find("tumble").unwrap().input(player.world().resource::<Setup>(), player.tick());
    throw(&mut player, "tumble");
    player.frames(150);
    let mut copy = Simulation::resume(&start, Workers::single());
    let mut waiting = Input::new(input);
    while copy.get::<Clock>().tick < player.tick() {
        waiting.give(copy.world_mut());
        copy.tick();
    }
    assert_eq!(copy.hash(), control::hash(player.world()));
    let verdict = verdict(&mut player);
    assert!(matches!(verdict, Progress::Held { .. }), "{verdict:?}");
}

#[test]
fn undo_brings_the_world_back_and_nothing_more_comes() {
    let mut player = at_vessels();
    let own = gravity(&player);
    throw(&mut player, "weight");
    player.frames(20);
    assert!(gravity(&player) < 50.0 * own, "it weighs a hundred times as much");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(gravity(&player), own);
    player.frames(200);
    assert_eq!(gravity(&player), own);
    assert!(!player.world().contains_resource::<Thrown>());
}

#[test]
fn time_that_goes_back_into_the_midst_of_it_lets_things_fall_as_before() {
    let mut player = Player::new();
    let own = gravity(&player);
    throw(&mut player, "weight");
    player.frames(20);
    let midst = Checkpoint::of(player.world());
    player.frames(200);
    assert_eq!(gravity(&player), own, "it ends by itself");
    midst.restore(player.0.world_mut());
    player.frames(3);
    assert_eq!(gravity(&player), own);
}

#[test]
fn one_comes_after_the_other() {
    let mut player = Player::new();
    throw(&mut player, "tumble");
    throw(&mut player, "storm");
    assert_eq!(player.world().resource::<StressTest>().throw().map(|throw| throw.name), Some("tumble"));
    player.frames(140);
    throw(&mut player, "storm");
    assert_eq!(player.world().resource::<StressTest>().throw().map(|throw| throw.name), Some("storm"));
    throw(&mut player, "no such throw");
    assert_eq!(player.world().resource::<StressTest>().throw().map(|throw| throw.name), Some("storm"));
}

#[test]
fn keys_open_the_panel_and_it_stays_beside_the_world() {
    let mut player = Player::new();
    player.chord(&[KeyCode::ShiftLeft, KeyCode::F7]);
    assert!(player.world().resource::<Panels>().shows(PANEL.id));
    player.chord(&[KeyCode::Escape]);
    assert!(player.world().resource::<Panels>().shows(PANEL.id), "it stays while one plays");
}
