//! Rewinding by key: what is seen, what ends it, and what is left of it.

use super::*;
use crate::{
    game::{actions::Action, rewind::Rewind},
    sim::recorder::{REWIND_TICKS, Recorder},
};

/// A player who holds the key from now on.
fn hold(player: &mut Player) {
    player.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().press(KeyCode::Backspace);
    player.key(KeyCode::Backspace, ButtonState::Pressed);
}

fn let_go(player: &mut Player) {
    player.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().release(KeyCode::Backspace);
    player.key(KeyCode::Backspace, ButtonState::Released);
    player.frame();
}

/// Pours for a while; the hashes after each frame.
fn pour(player: &mut Player, frames: usize) -> Vec<u64> {
    player.point_at(player.middle());
    player.press();
    let hashes = (0..frames)
        .map(|_| {
            player.frame();
            player.hash()
        })
        .collect();
    player.release();
    hashes
}

fn back(player: &Player) -> Option<u64> {
    player.world().resource::<Rewind>().progress().map(|(ticks, _)| ticks)
}

/// Runs frames until it is `ticks` back: each goes one back, unless the machine has too much else to do.
fn run_back(player: &mut Player, ticks: u64) {
    while back(player).is_none_or(|back| back < ticks) {
        let before = back(player).unwrap_or(0);
        player.frame();
        assert!(back(player).is_some_and(|now| now <= before + 1), "a frame goes back by more than a tick");
    }
}

#[test]
fn held_it_runs_back_a_tick_a_frame_and_let_go_it_goes_on_from_there() {
    let mut player = Player::new();
    let hashes = pour(&mut player, 50);
    player.frame();
    let (last, before) = (player.tick(), player.hash());
    hold(&mut player);
    for k in 1..=30 {
        run_back(&mut player, k);
        assert_eq!(player.tick(), last - k);
        assert_eq!(player.hash(), hashes[50 - k as usize], "{k} ticks back");
    }
    let_go(&mut player);
    // It has run a tick since.
    assert_eq!((player.tick(), back(&player)), (last - 29, None));
    assert!(!player.world().resource::<Pace>().paused && player.world().resource::<Pace>().ticks());
    player.chord(&[KeyCode::Space]);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!((player.tick(), player.hash()), (last, before), "undo goes forward again");
}

#[test]
fn it_works_while_time_stands_and_leaves_it_standing() {
    let mut player = Player::new();
    let hashes = pour(&mut player, 30);
    player.frame();
    player.chord(&[KeyCode::Space]);
    let last = player.tick();
    hold(&mut player);
    run_back(&mut player, 12);
    let_go(&mut player);
    player.frames(5);
    assert!(player.world().resource::<Pace>().paused);
    assert_eq!((player.tick(), player.hash()), (last - 12, hashes[30 - 12]));
}

#[test]
fn a_stroke_ends_it_and_draws_on_what_is_seen() {
    let mut player = Player::new();
    pour(&mut player, 40);
    player.frame();
    let last = player.tick();
    hold(&mut player);
    run_back(&mut player, 20);
    player.press();
    player.frame();
    player.release();
    player.frames(2);
    assert_eq!((player.tick(), back(&player)), (last - 20 + 3, None), "held on, but it has ended");
    let told: Vec<&str> = player.world().resource::<Toasts>().texts().collect();
    assert!(told.contains(&"Back by 0.3 s (undo goes forward again)"), "{told:?}");
}

#[test]
fn it_ends_at_the_beginning_and_says_so() {
    let mut player = Player::new();
    pour(&mut player, 10);
    player.frame();
    hold(&mut player);
    player.frames(40);
    let progress = player.world().resource::<Rewind>().progress();
    assert_eq!(progress.and_then(|(_, end)| end), Some("this is where it began"));
    assert_eq!((player.tick(), player.particles()), (0, 0));
    let_go(&mut player);
    assert_eq!(player.tick(), 1);
}

#[test]
fn a_button_that_is_pressed_for_a_frame_goes_back_by_one() {
    let mut player = Player::new();
    player.frames(9);
    let last = player.tick();
    player.chord(&[KeyCode::Space]);
    player.0.world_mut().resource_mut::<Orders>().push(Order::Act(Action::Rewind));
    player.frame();
    assert_eq!(player.tick(), last - 1);
    player.frame();
    assert_eq!((player.tick(), back(&player)), (last - 1, None));
}

#[test]
fn half_a_minute_is_kept_and_what_was_before_it_is_not() {
    let mut player = Player::new();
    pour(&mut player, 4);
    player.frames(2 * REWIND_TICKS as usize);
    let bytes = player.world().resource::<Recorder>().key_bytes();
    player.frames(200);
    assert!(player.world().resource::<Recorder>().key_bytes() <= bytes + bytes / 50, "it grows");
    player.chord(&[KeyCode::Space]);
    let last = player.tick();
    hold(&mut player);
    player.frames(REWIND_TICKS as usize + 20);
    let progress = player.world().resource::<Rewind>().progress();
    assert_eq!(progress, Some((REWIND_TICKS, Some("as far back as it is kept"))));
    assert_eq!(player.tick(), last - REWIND_TICKS);
}
