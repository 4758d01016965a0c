//! What fingers do.

use super::*;
use crate::game::input::touch::Fingers;
use bevy::input::touch::{TouchInput, TouchPhase};

impl Player {
    fn touch(&mut self, id: u64, phase: TouchPhase, position: Vec2) {
        let window = Entity::PLACEHOLDER;
        self.event(WindowEvent::TouchInput(TouchInput { phase, position, window, force: None, id }));
    }

    fn camera(&self) -> WorldCamera {
        *self.world().resource::<WorldCamera>()
    }
}

#[test]
fn one_finger_pours_where_it_goes() {
    let mut player = Player::new();
    let at = player.camera().to_pixel(player.middle());
    player.touch(0, TouchPhase::Started, at);
    player.touch(0, TouchPhase::Moved, at + Vec2::new(40.0, 0.0));
    player.frames(3);
    assert!(player.particles() > 0, "nothing is poured");
    player.touch(0, TouchPhase::Ended, at + Vec2::new(40.0, 0.0));
    player.frames(2);
    player.seen();
    player.frames(3);
    assert_eq!(player.seen(), [], "nothing is poured after the finger is up");
    assert!(player.world().resource::<Fingers>().in_use);
}

#[test]
fn a_finger_held_still_pours_after_a_moment_and_a_tap_at_once() {
    let mut player = Player::new();
    let at = player.camera().to_pixel(player.middle());
    player.touch(0, TouchPhase::Started, at);
    player.frame();
    assert_eq!(player.seen(), [], "it waits for a second finger");
    player.frames(10);
    assert!(player.particles() > 0, "it never began");
    let mut player = Player::new();
    player.touch(0, TouchPhase::Started, at);
    player.touch(0, TouchPhase::Ended, at);
    player.frames(2);
    assert!(player.particles() > 0, "the tap was lost");
}

#[test]
fn two_fingers_zoom_and_move_and_draw_nothing() {
    let mut player = Player::new();
    let middle = player.camera().to_pixel(player.middle());
    let apart = |player: &mut Player, phase, at: Vec2, half: f32| {
        player.touch(0, phase, at - Vec2::new(half, 0.0));
        player.touch(1, phase, at + Vec2::new(half, 0.0));
    };
    apart(&mut player, TouchPhase::Started, middle, 50.0);
    player.frame();
    apart(&mut player, TouchPhase::Moved, middle, 150.0);
    player.frame();
    assert!((player.camera().zoom() - 3.0).abs() < 0.01, "three times as far apart: {}", player.camera().zoom());
    let under = player.camera().to_world(middle);
    assert!(under.distance(player.middle()) < 0.5, "what was between the fingers stays there: {under}");
    let way = Vec2::new(30.0, -20.0);
    apart(&mut player, TouchPhase::Moved, middle + way, 150.0);
    player.frame();
    assert!(player.camera().to_world(middle + way).distance(under) < 0.5, "the picture goes with the fingers");
    player.touch(0, TouchPhase::Ended, middle);
    player.touch(1, TouchPhase::Moved, middle + Vec2::new(90.0, 90.0));
    player.frames(10);
    player.touch(1, TouchPhase::Ended, middle);
    player.frames(3);
    assert_eq!((player.seen().len(), player.particles()), (0, 0), "the finger that is left does not draw");
}

#[test]
fn a_second_finger_ends_the_stroke() {
    let mut player = Player::new();
    let at = player.camera().to_pixel(player.middle());
    player.touch(0, TouchPhase::Started, at);
    player.frames(10);
    player.touch(1, TouchPhase::Started, at + Vec2::new(100.0, 0.0));
    player.frames(2);
    player.seen();
    player.touch(0, TouchPhase::Moved, at - Vec2::new(100.0, 0.0));
    player.frames(3);
    assert_eq!(player.seen(), [], "it goes on drawing");
    assert!(player.camera().zoom() > 1.5);
}

#[test]
fn a_finger_on_the_hud_draws_nothing() {
    let mut player = Player::new();
    let window = player.camera().window();
    player.0.world_mut().resource_mut::<HudCover>().parts = vec![Area { min: Vec2::ZERO, max: window }];
    player.touch(0, TouchPhase::Started, window / 2.0);
    player.touch(0, TouchPhase::Moved, window / 2.0 + Vec2::new(60.0, 0.0));
    player.frames(10);
    assert_eq!((player.seen().len(), player.particles()), (0, 0));
}

#[test]
fn a_finger_drags_a_frame_and_a_tap_pastes_where_it_is_lifted() {
    let mut player = Player::at_a_pool();
    let drag = |player: &mut Player, from: Vec2, to: Vec2| {
        let [from, to] = [from, to].map(|at| player.camera().to_pixel(player.middle() + at));
        player.touch(0, TouchPhase::Started, from);
        player.frames(8);
        player.touch(0, TouchPhase::Moved, to);
        player.frame();
        player.touch(0, TouchPhase::Ended, to);
        player.frames(2);
    };
    let (particles, rocks) = (player.particles(), player.rocks());
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyC]);
    drag(&mut player, Vec2::new(-31.0, -11.0), Vec2::new(-9.0, 6.0));
    drag(&mut player, Vec2::new(-12.0, 0.0), Vec2::new(15.0, 0.0));
    assert_eq!((player.particles(), player.rocks()), (2 * particles, 2 * rocks));
    // A second finger moves the picture: nothing is pasted.
    let at = player.camera().to_pixel(player.middle() + Vec2::new(20.0, 25.0));
    player.touch(0, TouchPhase::Started, at);
    player.frames(8);
    player.touch(1, TouchPhase::Started, at + Vec2::new(30.0, 0.0));
    player.frame();
    player.touch(0, TouchPhase::Ended, at);
    player.touch(1, TouchPhase::Ended, at + Vec2::new(30.0, 0.0));
    player.frames(3);
    assert_eq!(player.particles(), 2 * particles);
}
