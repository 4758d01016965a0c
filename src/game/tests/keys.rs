//! The keyboard: time, tools, views.

use super::*;

#[test]
fn a_paused_world_takes_edits_and_steps_one_tick_at_a_time() {
    let mut player = Player::new();
    player.chord(&[KeyCode::KeyP]);
    let tick = player.tick();
    player.point_at(player.middle());
    player.press();
    player.frames(3);
    assert!(player.particles() > 0, "edits must happen while time stands");
    assert_eq!(player.tick(), tick);
    player.chord(&[KeyCode::Period]);
    player.frames(3);
    assert_eq!(player.tick(), tick + 1);
    player.chord(&[KeyCode::KeyP]);
    player.frames(3);
    assert!(player.tick() > tick + 1);
}

#[test]
fn sampling_takes_up_what_is_under_the_pointer() {
    let mut player = Player::new();
    player.choose("rock");
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frame();
    player.choose("water");
    player.button(MouseButton::Middle, ButtonState::Pressed);
    player.button(MouseButton::Middle, ButtonState::Released);
    player.frames(2);
    let rock = player.world().resource::<Setup>().elements().find("rock").expect("rock exists");
    assert_eq!(player.world().resource::<Toolbox>().tool, Tool::Element(rock));
}

/// Name of the chosen tool.
fn tool(player: &Player) -> String {
    let (tools, setup) = (player.world().resource::<Toolbox>(), player.world().resource::<Setup>());
    tools.tool.name(setup.elements()).to_owned()
}

#[test]
fn a_digit_at_a_tile_keeps_its_element_there_and_elsewhere_chooses_it() {
    let mut player = Player::new();
    let point_at = |player: &mut Player, element: Option<&str>| {
        player.0.world_mut().resource_mut::<HudCover>().element = element.map(str::to_owned);
    };
    let told = |player: &Player| player.world().resource::<Toasts>().last().map(str::to_owned);
    point_at(&mut player, Some("tar"));
    player.chord(&[KeyCode::Digit3]);
    assert_eq!((tool(&player).as_str(), told(&player)), ("water", Some("tar is on 3 now".to_owned())));
    player.chord(&[KeyCode::Digit3]);
    assert_eq!(tool(&player), "tar", "it is there, so it is chosen");
    point_at(&mut player, Some("wet_sand"));
    player.chord(&[KeyCode::Digit3]);
    assert_eq!(told(&player), Some("wet sand is on 3 now, tar on 7".to_owned()));
    point_at(&mut player, None);
    for (digit, element) in [(KeyCode::Digit3, "wet_sand"), (KeyCode::Digit7, "tar"), (KeyCode::Digit2, "water")] {
        player.chord(&[digit]);
        assert_eq!(tool(&player), element);
    }
}

#[test]
fn a_digit_at_a_tile_is_the_game_s_while_letters_are_typed() {
    let mut player = Player::new();
    player.0.insert_resource(HudKeys::AllButDigits);
    player.0.world_mut().resource_mut::<HudCover>().element = Some("brine".to_owned());
    player.chord(&[KeyCode::Digit4]);
    player.chord(&[KeyCode::KeyP]);
    player.chord(&[KeyCode::ShiftLeft, KeyCode::Digit2]);
    player.0.world_mut().resource_mut::<HudCover>().element = None;
    player.0.insert_resource(HudKeys::None);
    player.chord(&[KeyCode::Digit4]);
    assert_eq!(tool(&player), "brine");
    assert!(!player.world().resource::<Pace>().paused);
    assert_eq!(player.world().resource::<Shown>().0, VIEWS[0]);
}

#[test]
fn letters_in_a_text_field_are_no_keys() {
    let mut player = Player::new();
    player.0.insert_resource(HudKeys::All);
    player.chord(&[KeyCode::KeyP]);
    assert!(!player.world().resource::<Pace>().paused);
}

#[test]
fn a_slider_in_focus_has_the_arrows_and_the_game_all_other_keys() {
    let mut player = Player::new();
    player.act(Action::Zoom(3));
    player.frame();
    let seen = |player: &Player| player.world().resource::<WorldCamera>().to_world(Vec2::new(300.0, 200.0));
    let mut pan = |keys: HudKeys| {
        player.0.insert_resource(keys);
        let before = seen(&player);
        player.key(KeyCode::ArrowRight, ButtonState::Pressed);
        player.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().press(KeyCode::ArrowRight);
        player.frames(3);
        player.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().release(KeyCode::ArrowRight);
        player.key(KeyCode::ArrowRight, ButtonState::Released);
        player.frame();
        seen(&player) != before
    };
    assert!(pan(HudKeys::None) && !pan(HudKeys::Arrows));
    player.chord(&[KeyCode::KeyP]);
    assert!(player.world().resource::<Pace>().paused);
}

#[test]
fn keys_choose_views_tools_speed_and_brush() {
    let mut player = Player::new();
    player.chord(&[KeyCode::ShiftLeft, KeyCode::Digit2]);
    assert_eq!(player.world().resource::<Shown>().0, VIEWS[1]);
    player.chord(&[KeyCode::KeyV]);
    assert_eq!(player.world().resource::<Shown>().0, VIEWS[2]);
    player.chord(&[KeyCode::ShiftLeft, KeyCode::Digit6]);
    assert_eq!(player.world().resource::<Shown>().0, VIEWS[5]);
    player.chord(&[KeyCode::Digit7]);
    assert_eq!(tool(&player), "wet_sand");
    player.chord(&[KeyCode::Minus]);
    assert_eq!(player.world().resource::<Pace>().speed, 0.5);
    let radius = player.world().resource::<Toolbox>().radius();
    player.chord(&[KeyCode::BracketRight]);
    assert!(player.world().resource::<Toolbox>().radius() > radius);
    player.chord(&[KeyCode::KeyH]);
    assert!(!player.world().resource::<Panels>().visible);
}
