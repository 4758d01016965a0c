//! What the pointer draws and erases.

use super::*;
use crate::{
    game::{brush_mode::BrushMode, tools::TEMPERATURE},
    kernel::heat::units::ROOM,
};

#[test]
fn a_held_button_pours_each_tick_and_its_release_stops() {
    let mut player = Player::new();
    player.point_at(player.middle());
    player.press();
    player.frames(5);
    assert_eq!(player.seen().len(), 5, "one pour a tick");
    let poured = player.particles();
    assert!(poured > 0);
    player.release();
    player.frames(2);
    player.seen();
    player.frames(3);
    assert_eq!(player.seen(), [], "nothing is poured after the release");
}

#[test]
fn a_click_within_one_frame_draws() {
    let mut player = Player::new();
    player.point_at(player.middle());
    player.press();
    player.release();
    player.frames(2);
    assert!(player.particles() > 0, "the click was lost");
}

#[test]
fn a_stroke_within_one_frame_draws_its_whole_way() {
    let mut player = Player::new();
    player.choose("rock");
    let (a, b) = (player.middle(), player.middle() + Vec2::new(30.0, 0.0));
    player.point_at(a);
    player.press();
    player.point_at(a + Vec2::new(15.0, 12.0));
    player.point_at(b);
    player.release();
    player.frames(2);
    let rock = player.world().resource::<Rock>();
    for at in [a, a + Vec2::new(15.0, 12.0), b] {
        assert!(rock.is_solid(at.floor().as_ivec2()), "no rock at {at}");
    }
}

#[test]
fn pouring_does_not_depend_on_the_frame_rate() {
    let poured = |frame: Duration, frames: usize| {
        let mut player = Player::new();
        player.0.insert_resource(TimeUpdateStrategy::ManualDuration(frame));
        player.point_at(player.middle());
        player.press();
        player.frames(frames);
        let ticks = player.tick();
        (player.seen().len() as f64 / ticks as f64 * 100.0).round()
    };
    let tick = Duration::from_secs_f64(1.0 / 60.0);
    assert_eq!(poured(tick / 3, 90), 100.0);
    assert_eq!(poured(tick * 2, 15), 100.0);
}

#[test]
fn a_swing_throws_what_it_pours_and_has_a_limit() {
    let mut player = Player::new();
    player.point_at(player.middle());
    player.press();
    player.frames(2);
    let still = player.seen();
    assert!(matches!(still[..], [Intent::Pour { velocity: Vec2::ZERO, share: 1.0, .. }, ..]), "{still:?}");
    for step in 1..=12 {
        player.point_at(player.middle() + Vec2::new(-8.0 * step as f32, 0.0));
        player.frame();
    }
    let blueprint = &player.world().resource::<Setup>().blueprint;
    let fall = Reference::of(&blueprint.domain, &blueprint.air).fall;
    let mut fastest = 0.0_f32;
    for intent in player.seen() {
        let Intent::Pour { velocity, .. } = intent else { panic!("poured only, not {intent:?}") };
        assert!(velocity.x <= 0.0 && velocity.y.abs() <= 0.01 * velocity.x.abs(), "{velocity} is not along the drag");
        assert!(velocity.length() <= 1.001 * fall, "{velocity} is beyond the limit");
        fastest = fastest.max(velocity.length());
    }
    assert!(fastest > 0.2 * fall, "the swing threw with {fastest} d/s only");
}

#[test]
fn the_right_button_erases() {
    let mut player = Player::new();
    player.choose("rock");
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frames(2);
    assert!(player.rocks() > 0);
    player.button(MouseButton::Right, ButtonState::Pressed);
    player.frames(2);
    assert_eq!(player.rocks(), 0);
}

#[test]
fn a_pointer_over_the_hud_never_draws() {
    let mut player = Player::new();
    let window = player.world().resource::<WorldCamera>().window();
    player.0.world_mut().resource_mut::<HudCover>().parts = vec![Area { min: Vec2::ZERO, max: window }];
    player.point_at(player.middle());
    player.press();
    player.frames(3);
    assert_eq!(player.seen(), []);
    // A drag that began in the world draws nothing where it passes over the HUD.
    player.release();
    player.frame();
    player.0.world_mut().resource_mut::<HudCover>().parts.clear();
    player.press();
    player.frames(2);
    assert!(!player.seen().is_empty());
    player.0.world_mut().resource_mut::<HudCover>().parts = vec![Area { min: Vec2::ZERO, max: window }];
    player.point_at(player.middle() + Vec2::X);
    player.frames(3);
    assert_eq!(player.seen(), []);
}

#[test]
fn shift_draws_a_line_and_ctrl_a_rectangle_on_release() {
    let mut player = Player::new();
    let (a, b) = (player.middle(), player.middle() + Vec2::new(20.0, 10.0));
    for (key, is_rectangle) in [(KeyCode::ShiftLeft, false), (KeyCode::ControlLeft, true)] {
        player.key(key, ButtonState::Pressed);
        player.point_at(a);
        player.press();
        player.frames(2);
        player.point_at(b);
        player.frames(2);
        assert_eq!(player.seen(), [], "nothing before the release");
        player.key(key, ButtonState::Released);
        player.release();
        player.frames(2);
        let seen = player.seen();
        let [Intent::Stamp { stroke, .. }] = seen[..] else { panic!("one stamp, not {seen:?}") };
        assert!((stroke.from - a).length() < 0.1 && (stroke.to - b).length() < 0.1, "{stroke:?}");
        assert_eq!(stroke.radius == 0.0, is_rectangle);
    }
}

#[test]
fn fill_starts_where_the_pointer_is() {
    let mut player = Player::new();
    player.choose("rock");
    player.key(KeyCode::ControlLeft, ButtonState::Pressed);
    player.key(KeyCode::ShiftLeft, ButtonState::Pressed);
    player.point_at(player.middle());
    player.press();
    player.frames(2);
    assert!(matches!(player.seen()[..], [Intent::Fill { .. }]));
}

#[test]
fn the_temperature_that_was_chosen_is_set_along_a_drag_and_in_a_rectangle_and_the_right_button_sets_the_room_s() {
    let mut player = Player::new();
    player.chord(&[KeyCode::KeyC]);
    assert_eq!(player.world().resource::<Toolbox>().tool, Tool::Other(&TEMPERATURE));
    player.0.world_mut().resource_mut::<Toolbox>().set_kelvin(400.0);
    player.seen();
    let set = |player: &mut Player| {
        let kelvin = |intent| match intent {
            Intent::SetTemperature { stroke, kelvin } => (stroke.shape, kelvin),
            other => panic!("{other:?}"),
        };
        player.seen().into_iter().map(kelvin).collect::<Vec<_>>()
    };
    player.point_at(player.middle());
    player.press();
    player.frames(2);
    player.release();
    player.frames(2);
    assert_eq!(set(&mut player)[..2], [(BrushShape::Disc, 400.0); 2]);
    player.button(MouseButton::Right, ButtonState::Pressed);
    player.frame();
    player.button(MouseButton::Right, ButtonState::Released);
    player.frame();
    assert_eq!(set(&mut player)[0], (BrushShape::Disc, ROOM));
    player.frame();
    player.seen();
    player.key(KeyCode::ControlLeft, ButtonState::Pressed);
    player.press();
    player.point_at(player.middle() + Vec2::splat(10.0));
    player.release();
    player.frames(2);
    assert_eq!(set(&mut player), [(BrushShape::Rectangle, 400.0)]);
}

#[test]
fn a_match_lights_oil_and_undo_puts_it_out() {
    let mut player = Player::new();
    player.choose("oil");
    player.point_at(player.middle());
    player.press();
    player.frames(20);
    player.release();
    player.frames(2);
    player.chord(&[KeyCode::KeyP]);
    let before = player.hash();
    player.chord(&[KeyCode::KeyI]);
    player.press();
    player.frames(2);
    player.release();
    player.frames(2);
    assert_ne!(player.hash(), before, "the oil is as cold as before");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    player.frames(2);
    assert_eq!(player.hash(), before);
}

/// Draws a block of an element at a place beside the middle, in one tick.
fn block(player: &mut Player, element: &str, at: Vec2) {
    player.choose(element);
    player.key(KeyCode::ControlLeft, ButtonState::Pressed);
    player.point_at(player.middle() + at);
    player.press();
    player.point_at(player.middle() + at + Vec2::new(12.0, 8.0));
    player.frame();
    player.release();
    player.key(KeyCode::ControlLeft, ButtonState::Released);
    player.frames(2);
}

/// Particles and rock of an element.
fn count(player: &Player, element: &str) -> usize {
    let element = player.world().resource::<Setup>().elements().find(element).expect("the element exists");
    let moving = player.world().resource::<ParticleStore>().element.iter().filter(|other| **other == element).count();
    moving + player.world().resource::<Rock>().iter().filter(|(_, other, _)| *other == element).count()
}

#[test]
fn replacing_draws_over_what_is_there_by_brush_line_rectangle_and_fill_and_is_undone() {
    for (keys, all) in [
        (&[][..], false),
        (&[KeyCode::ShiftLeft], false),
        (&[KeyCode::ControlLeft], false),
        (&[KeyCode::ControlLeft, KeyCode::ShiftLeft], true),
    ] {
        let mut player = Player::new();
        player.chord(&[KeyCode::KeyP]);
        block(&mut player, "wood", Vec2::new(-20.0, 0.0));
        block(&mut player, "water", Vec2::new(5.0, 0.0));
        let (wood, water, before) = (count(&player, "wood"), count(&player, "water"), player.hash());
        assert!(wood > 50 && water > 50);
        player.choose("oil");
        player.chord(&[KeyCode::Insert]);
        keys.iter().for_each(|key| player.key(*key, ButtonState::Pressed));
        player.point_at(player.middle() + Vec2::new(8.0, 2.0));
        player.press();
        player.frame();
        player.point_at(player.middle() + Vec2::new(15.0, 6.0));
        player.frames(2);
        player.release();
        keys.iter().for_each(|key| player.key(*key, ButtonState::Released));
        player.frames(2);
        let oil = count(&player, "oil");
        assert_eq!((count(&player, "wood"), count(&player, "water") + oil), (wood, water), "{keys:?}");
        assert!(if all { oil == water } else { oil > 10 && oil < water }, "{keys:?}: {oil} of {water}");
        player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
        player.frames(2);
        assert_eq!(player.hash(), before, "{keys:?}");
    }
}

#[test]
fn erasing_only_one_element_leaves_what_it_lies_in() {
    let mut player = Player::new();
    player.chord(&[KeyCode::KeyP]);
    block(&mut player, "wood", Vec2::new(-6.0, 0.0));
    block(&mut player, "oil", Vec2::new(6.0, 0.0));
    let oil = count(&player, "oil");
    player.choose("wood");
    player.chord(&[KeyCode::Delete]);
    for button in [MouseButton::Left, MouseButton::Right] {
        let before = count(&player, "wood");
        player.point_at(player.middle() + Vec2::new(if button == MouseButton::Left { 6.0 } else { -4.0 }, 4.0));
        player.button(button, ButtonState::Pressed);
        player.frames(2);
        player.button(button, ButtonState::Released);
        player.frames(2);
        assert!(count(&player, "wood") < before, "{button:?}");
    }
    assert_eq!(count(&player, "oil"), oil);
    player.chord(&[KeyCode::Delete]);
    assert_eq!(player.world().resource::<Toolbox>().mode(), BrushMode::Draw, "the key again draws");
}
