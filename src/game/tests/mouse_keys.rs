//! The pointer by keys alone.

use super::*;
use crate::game::input::{mouse_keys::MouseKeys, pointer::Pointer, strokes::DragState};
use bevy::window::CursorMoved;

impl Player {
    /// Holds keys down for some frames, as the devices report it, and lets them go.
    fn hold_keys(&mut self, held: &[KeyCode], frames: usize) {
        for key in held {
            self.key(*key, ButtonState::Pressed);
            self.keyboard(|keys| keys.press(*key));
        }
        for _ in 0..frames {
            self.frame();
            self.keyboard(ButtonInput::clear);
        }
        for key in held.iter().rev() {
            self.key(*key, ButtonState::Released);
            self.keyboard(|keys| keys.release(*key));
        }
        self.frame();
        self.keyboard(ButtonInput::clear);
    }

    fn keyboard(&mut self, change: impl FnOnce(&mut ButtonInput<KeyCode>)) {
        change(&mut self.0.world_mut().resource_mut());
    }

    fn pointer(&self) -> Option<Vec2> {
        self.world().resource::<Pointer>().at
    }
}

/// One with mouse keys on.
fn player() -> Player {
    let mut player = Player::new();
    player.chord(&[KeyCode::F8]);
    assert!(player.world().resource::<MouseKeys>().0 && player.was_told("the arrows move the pointer"));
    player
}

#[test]
fn arrows_move_the_pointer_and_the_longer_the_faster() {
    let mut player = player();
    assert_eq!(player.pointer(), None);
    player.hold_keys(&[KeyCode::ArrowRight], 1);
    let begun = player.pointer().expect("it comes in the middle of the window");
    let middle = player.world().resource::<WorldCamera>().window() / 2.0;
    assert!(begun.y == middle.y && (2.0..8.0).contains(&(begun.x - middle.x)), "{begun}, {middle}");
    player.hold_keys(&[KeyCode::ArrowRight, KeyCode::ArrowUp], 30);
    let first = player.pointer().unwrap() - begun;
    assert!(first.x > 60.0 && first.y < -60.0, "{first}");
    player.hold_keys(&[KeyCode::ArrowLeft], 400);
    assert_eq!(player.pointer().unwrap().x, 0.0, "it stays in the window");
}

#[test]
fn keys_are_its_buttons_with_all_that_modifiers_make_of_them() {
    let mut player = player();
    player.point_at(player.middle());
    player.hold_keys(&[KeyCode::Enter], 3);
    assert!(player.particles() > 0, "Enter pours");
    player.hold_keys(&[KeyCode::Backslash], 3);
    assert_eq!(player.particles(), 0, "the right button erases");
    player.choose("rock");
    player.hold_keys(&[KeyCode::ShiftLeft, KeyCode::Enter, KeyCode::ArrowRight], 40);
    player.frames(2);
    let walls = player.rocks();
    player.hold_keys(&[KeyCode::Enter], 1);
    assert!(walls > 3 * (player.rocks() - walls).max(1), "Shift draws a line");
}

#[test]
fn a_short_press_is_a_click_and_one_that_is_held_ends_with_it() {
    let mut player = player();
    player.point_at(player.middle());
    player.keyboard(|keys| {
        keys.press(KeyCode::Enter);
        keys.release(KeyCode::Enter);
    });
    player.frame();
    player.keyboard(ButtonInput::clear);
    player.frames(2);
    assert!(player.particles() > 0);
    player.keyboard(|keys| keys.press(KeyCode::Enter));
    player.frames(2);
    assert!(player.world().resource::<DragState>().current().is_some());
    player.chord(&[KeyCode::F8]);
    player.frame();
    assert!(player.world().resource::<DragState>().current().is_none(), "the button does not stay down");
}

#[test]
fn without_them_and_while_one_types_keys_are_what_they_were() {
    let mut player = Player::new();
    player.point_at(player.middle());
    player.frame();
    let before = player.pointer();
    player.hold_keys(&[KeyCode::ArrowRight, KeyCode::Enter], 5);
    assert_eq!((player.pointer(), player.particles()), (before, 0));
    let mut player = self::player();
    player.0.insert_resource(HudKeys::All);
    player.hold_keys(&[KeyCode::ArrowRight, KeyCode::Enter], 5);
    assert_eq!((player.pointer(), player.particles()), (None, 0));
}

#[test]
fn at_the_edge_of_the_window_it_pushes_the_picture() {
    let mut player = player();
    player.event(WindowEvent::CursorMoved(CursorMoved {
        window: Entity::PLACEHOLDER,
        position: Vec2::new(1.0, 100.0),
        delta: None,
    }));
    player.frame();
    player.0.world_mut().resource_mut::<WorldCamera>().zoom_at(Vec2::new(400.0, 300.0), 4.0);
    let left = |player: &Player| player.world().resource::<WorldCamera>().to_world(Vec2::ZERO).x;
    let before = left(&player);
    player.hold_keys(&[KeyCode::ArrowLeft], 10);
    assert!(left(&player) < before - 1.0, "{before} → {}", left(&player));
}
