//! The keyboard: time, tools, views, and keys that the player has chosen.

use super::*;
use crate::game::{
    actions::PanelId,
    input::{
        bindings::{Bindings, Slot},
        chord::{Chord, NONE},
        keymap::Keymap,
        layouts::Layout,
        rebind::{KeyEditor, KeyOrder},
    },
    lens::Lens,
    rewind::Rewind,
};

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

/// The panel in which keys are chosen.
const HELP: PanelId = PanelId("help");

impl Player {
    /// Asks for a key of an action, as a press on it in the help does, and presses some.
    fn put_on(&mut self, action: Action, keys: &[KeyCode]) -> String {
        if !self.world().resource::<Panels>().shows(HELP) {
            self.act(Action::Panel(HELP));
        }
        self.0.world_mut().resource_mut::<KeyEditor>().ask(Slot { action, place: 0 });
        self.chord(keys);
        self.world().resource::<KeyEditor>().told().map_or_else(String::new, |told| told.text.clone())
    }

    fn key_of(&self, action: Action) -> String {
        self.world().resource::<Bindings>().key(action)
    }

    fn is_paused(&self) -> bool {
        self.world().resource::<Pace>().paused
    }

    fn hold(&mut self, key: KeyCode, frames: usize) {
        self.key(key, ButtonState::Pressed);
        self.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().press(key);
        self.frames(frames);
    }

    fn let_go(&mut self, key: KeyCode) {
        self.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().release(key);
        self.key(key, ButtonState::Released);
        self.frame();
    }
}

#[test]
fn a_key_that_is_chosen_does_its_action_and_the_old_one_does_not() {
    let mut player = Player::new();
    assert_eq!(player.put_on(Action::Pause, &[KeyCode::KeyN]), "N is for “pause” now");
    assert!(!player.is_paused(), "it was pressed to be chosen");
    player.chord(&[KeyCode::Space]);
    assert!(!player.is_paused());
    player.chord(&[KeyCode::KeyN]);
    assert!(player.is_paused());
    // One that a browser leaves to its page.
    player.put_on(Action::Pause, &[KeyCode::ControlLeft, KeyCode::ShiftLeft, KeyCode::KeyY]);
    player.chord(&[KeyCode::KeyN]);
    assert!(player.is_paused());
    player.chord(&[KeyCode::ShiftLeft, KeyCode::ControlLeft, KeyCode::KeyY]);
    assert!(!player.is_paused());
    assert_eq!(player.key_of(Action::Pause), "Ctrl+Shift+Y");
}

#[test]
fn a_key_in_use_changes_places_and_this_is_said() {
    let mut player = Player::new();
    let told = player.put_on(Action::Pause, &[KeyCode::KeyV]);
    assert_eq!(told, "V is for “pause” now; “next view”, which had it, is on Space");
    player.chord(&[KeyCode::Space]);
    assert_eq!((player.is_paused(), player.world().resource::<Shown>().0), (false, VIEWS[1]));
    player.chord(&[KeyCode::KeyV]);
    assert_eq!((player.is_paused(), player.world().resource::<Shown>().0), (true, VIEWS[1]));
    player.0.world_mut().resource_mut::<Orders>().push(Order::Keys(KeyOrder::Reset));
    player.frame();
    player.chord(&[KeyCode::Space]);
    assert!(!player.is_paused(), "all is as it was");
}

#[test]
fn escape_leaves_a_key_as_it_is_and_what_the_system_has_is_refused() {
    let mut player = Player::new();
    assert_eq!(player.put_on(Action::Pause, &[KeyCode::Escape]), "");
    assert!(player.world().resource::<Panels>().shows(HELP), "it leaves the choice, not the panel");
    assert_eq!(player.key_of(Action::Pause), "Space");
    let told = player.put_on(Action::Pause, &[KeyCode::CapsLock]);
    assert!(told.contains("CapsLock") && told.contains("the system has"), "{told}");
    assert!(player.world().resource::<KeyEditor>().asked().is_some(), "it may be another");
    player.chord(&[KeyCode::KeyN]);
    assert_eq!(player.key_of(Action::Pause), "N");
    player.chord(&[KeyCode::Escape]);
    assert!(!player.world().resource::<Panels>().shows(HELP));
    player.frames(2);
    player.0.world_mut().resource_mut::<KeyEditor>().ask(Slot { action: Action::Pause, place: 0 });
    player.frames(2);
    player.chord(&[KeyCode::KeyN]);
    assert!(player.is_paused(), "with the help closed nothing is asked for");
}

#[test]
fn held_keys_are_those_that_were_chosen() {
    let mut player = Player::new();
    player.frames(10);
    player.put_on(Action::Rewind, &[KeyCode::KeyN]);
    player.hold(KeyCode::Backspace, 2);
    assert!(!player.world().resource::<Pace>().rewinds);
    player.let_go(KeyCode::Backspace);
    let tick = player.tick();
    player.hold(KeyCode::KeyN, 4);
    assert!(player.world().resource::<Pace>().rewinds && player.tick() < tick);
    player.let_go(KeyCode::KeyN);
    assert!(player.world().resource::<Rewind>().bytes() == 0 && !player.world().resource::<Pace>().rewinds);
    player.put_on(Action::Lens, &[KeyCode::KeyN]);
    player.hold(KeyCode::KeyN, 40);
    assert!(player.world().resource::<Lens>().is_on());
    player.let_go(KeyCode::KeyN);
    player.frames(2);
    assert!(!player.world().resource::<Lens>().is_on());
    player.act(Action::Zoom(3));
    player.put_on(Action::Pan(1, 0), &[KeyCode::KeyJ]);
    let seen = |player: &Player| player.world().resource::<WorldCamera>().to_world(Vec2::new(300.0, 200.0));
    for (key, moves) in [(KeyCode::ArrowRight, false), (KeyCode::KeyJ, true)] {
        let before = seen(&player);
        player.hold(key, 3);
        assert_eq!(seen(&player) != before, moves, "{key:?}");
        player.let_go(key);
    }
}

#[test]
fn favourites_follow_their_keys() {
    let mut player = Player::new();
    player.0.world_mut().resource_mut::<Orders>().push(Order::Keys(KeyOrder::Layout(Layout::PowderToy)));
    player.frame();
    player.chord(&[KeyCode::Digit2]);
    assert_eq!((tool(&player).as_str(), player.world().resource::<Shown>().0), ("water", VIEWS[1]));
    player.0.world_mut().resource_mut::<HudCover>().element = Some("tar".to_owned());
    player.0.insert_resource(HudKeys::AllButDigits);
    player.chord(&[KeyCode::ShiftLeft, KeyCode::Digit3]);
    assert_eq!(player.world().resource::<Toasts>().last(), Some("tar is on Shift+3 now"));
    player.0.world_mut().resource_mut::<HudCover>().element = None;
    player.0.insert_resource(HudKeys::None);
    player.chord(&[KeyCode::ShiftLeft, KeyCode::Digit3]);
    assert_eq!(tool(&player), "tar");
    player.put_on(Action::Element('3'), &[KeyCode::KeyN]);
    player.0.insert_resource(HudKeys::AllButDigits);
    player.0.world_mut().resource_mut::<HudCover>().element = Some("brine".to_owned());
    player.chord(&[KeyCode::KeyN]);
    player.0.insert_resource(HudKeys::None);
    player.0.world_mut().resource_mut::<HudCover>().element = None;
    player.choose("water");
    player.chord(&[KeyCode::KeyN]);
    assert_eq!(tool(&player), "tar", "a letter that was typed in the search puts nothing on a place");
}

#[test]
fn what_is_chosen_is_in_force_in_the_next_session() {
    if cfg!(target_arch = "wasm32") {
        return;
    }
    let folder = std::env::temp_dir().join(format!("powder-next-keys-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    let session = || {
        Player::with(|app| {
            app.insert_resource(Keymap::of_folder(&folder));
        })
    };
    let mut player = session();
    player.put_on(Action::Pause, &[KeyCode::KeyW]);
    let wind = player.world().resource::<Bindings>().slot(Chord::new(KeyCode::Space, NONE)).expect("it changed places");
    assert!(matches!(wind.action, Action::Tool(_)));
    let mut player = session();
    assert_eq!((player.key_of(Action::Pause), player.key_of(wind.action)), ("W".to_owned(), "Space".to_owned()));
    player.chord(&[KeyCode::KeyW]);
    assert!(player.is_paused());
    std::fs::remove_dir_all(folder).expect("it is ours");
}
