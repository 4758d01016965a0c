//! What is recorded is the same world again.

use super::*;
use crate::{
    game::recording::{self, Recording},
    kernel::params::Preset,
    lab::{
        headless::Headless,
        run::{Plan, run},
    },
    sim::{replay::Replay, workers::Workers},
};
use std::{fs, path::PathBuf};

fn file(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("powder-master-{name}-{}.jsonl", std::process::id()))
}

/// A player who is recorded from the first tick.
fn recorded(path: &std::path::Path) -> Player {
    let mut player = Player::new();
    control::reset(player.0.world_mut());
    recording::begin(player.0.world_mut(), path.to_owned());
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

/// The hash at the end of a recording, played again.
fn again(path: &std::path::Path) -> u64 {
    let scene = scene::load("empty").expect("the scene comes with the game");
    let text = fs::read_to_string(path).expect("it was written");
    let built = scene.build(&[], None, &EffectModes::new()).expect("its defaults are valid");
    let replay = Replay::read(&text, &built.elements).expect("it is a replay");
    let blueprint = Arc::new(replay.header.restore(built, true));
    let mut headless = Headless::new(blueprint, Workers::default());
    let intents = replay.entries.iter().map(|entry| (entry.tick, entry.intent)).collect();
    let plan = Plan { ticks: replay.header.ticks, warmup: 0, intents, complete: true };
    run(&mut headless, &plan, &mut []).expect("nobody watches");
    control::hash(headless.world())
}

#[test]
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
    assert!(player.world().contains_resource::<Recording>(), "the recording has ended");
    assert_eq!(again(&path), hash);
    fs::remove_file(path).expect("it is ours");
}

#[test]
fn a_recording_ends_where_it_would_stop_being_true() {
    let orders = [
        Order::Scene { name: "dam_break".into(), settings: vec![] },
        Order::Act(crate::game::input::bindings::Action::Reset),
    ];
    for (number, order) in orders.into_iter().enumerate() {
        let path = file(&format!("ends-{number}"));
        let mut player = recorded(&path);
        scribble(&mut player, "water", Vec2::ZERO);
        player.chord(&[KeyCode::Space]);
        let hash = player.hash();
        player.0.world_mut().resource_mut::<Orders>().push(order.clone());
        player.frame();
        assert!(!player.world().contains_resource::<Recording>(), "{order:?}");
        scribble(&mut player, "rock", Vec2::ZERO);
        assert_eq!(again(&path), hash, "{order:?}");
        fs::remove_file(path).expect("it is ours");
    }
}
