//! The game without a window: events of the devices go in, the world changes.

use crate::{
    game::{
        GamePlugin,
        camera::{Area, WorldCamera},
        hud::{HudState, toast::Toasts},
        input::{keys::Typing, pointer::HudCover},
        orders::{Order, Orders, Shown},
        tools::{Tool, Toolbox},
    },
    scene::{self, blueprint::EffectModes},
    sim::{
        SimulationPlugin, control,
        intent::{Intent, IntentQueue},
        pace::Pace,
        state::{Clock, ParticleStore, Rock, Setup},
        view::{Reference, View},
    },
};
use bevy::{
    MinimalPlugins,
    app::App,
    input::{
        ButtonState,
        keyboard::{Key, KeyboardInput},
        mouse::MouseButtonInput,
    },
    prelude::{ButtonInput, Entity, FixedUpdate, IntoScheduleConfigs, KeyCode, MouseButton, ResMut, Resource, World},
    time::TimeUpdateStrategy,
    window::{CursorMoved, WindowEvent},
};
use glam::Vec2;
use std::{sync::Arc, time::Duration};

/// The intents that the ticks saw.
#[derive(Resource, Default)]
struct Seen(Vec<Intent>);

fn spy(mut queue: ResMut<IntentQueue>, mut seen: ResMut<Seen>) {
    let intents: Vec<Intent> = queue.drain().collect();
    for &intent in &intents {
        queue.push(intent);
    }
    seen.0.extend(intents);
}

/// A player at an empty box, one tick a frame.
struct Player(App);

impl Player {
    fn new() -> Self {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, SimulationPlugin, GamePlugin))
            .init_resource::<ButtonInput<KeyCode>>()
            .init_resource::<Seen>()
            .insert_resource(TimeUpdateStrategy::FixedTimesteps(1))
            .add_systems(FixedUpdate, spy.before(crate::sim::schedule::TickSystems::Edit));
        let scene = scene::load("empty").expect("the scene comes with the game");
        let blueprint = scene.build(&[], None, &EffectModes::new()).expect("its defaults are valid");
        control::load(app.world_mut(), Arc::new(blueprint));
        app.finish();
        app.cleanup();
        let mut player = Self(app);
        player.frame();
        player.choose("water");
        player
    }

    fn world(&self) -> &World {
        self.0.world()
    }

    fn frame(&mut self) {
        self.0.update();
    }

    fn frames(&mut self, count: usize) {
        (0..count).for_each(|_| self.frame());
    }

    fn event(&mut self, event: WindowEvent) {
        self.0.world_mut().write_message(event);
    }

    fn key(&mut self, key_code: KeyCode, state: ButtonState) {
        self.event(WindowEvent::KeyboardInput(KeyboardInput {
            key_code,
            logical_key: Key::Escape,
            state,
            text: None,
            repeat: false,
            window: Entity::PLACEHOLDER,
        }));
    }

    /// Presses keys one after the other and lets them go in the reverse order, all in one frame.
    fn chord(&mut self, keys: &[KeyCode]) {
        keys.iter().for_each(|key| self.key(*key, ButtonState::Pressed));
        keys.iter().rev().for_each(|key| self.key(*key, ButtonState::Released));
        self.frame();
    }

    fn button(&mut self, button: MouseButton, state: ButtonState) {
        self.event(WindowEvent::MouseButtonInput(MouseButtonInput { button, state, window: Entity::PLACEHOLDER }));
    }

    fn press(&mut self) {
        self.button(MouseButton::Left, ButtonState::Pressed);
    }

    fn release(&mut self) {
        self.button(MouseButton::Left, ButtonState::Released);
    }

    /// Moves the pointer to a place in the world, d.
    fn point_at(&mut self, at: Vec2) {
        let position = self.world().resource::<WorldCamera>().to_pixel(at);
        self.event(WindowEvent::CursorMoved(CursorMoved { window: Entity::PLACEHOLDER, position, delta: None }));
    }

    fn middle(&self) -> Vec2 {
        self.world().resource::<WorldCamera>().world() / 2.0
    }

    fn choose(&mut self, element: &str) {
        let element = self.world().resource::<Setup>().elements().find(element).expect("the element exists");
        self.0.world_mut().resource_mut::<Toolbox>().tool = Tool::Element(element);
    }

    fn seen(&mut self) -> Vec<Intent> {
        std::mem::take(&mut self.0.world_mut().resource_mut::<Seen>().0)
    }

    fn particles(&self) -> usize {
        self.world().resource::<ParticleStore>().len()
    }

    fn rocks(&self) -> usize {
        self.world().resource::<Rock>().count()
    }

    fn tick(&self) -> u64 {
        self.world().resource::<Clock>().tick
    }

    fn hash(&self) -> u64 {
        control::hash(self.world())
    }
}

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
fn undo_and_redo_restore_the_exact_state() {
    let mut player = Player::new();
    player.chord(&[KeyCode::Space]);
    let empty = player.hash();
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frames(2);
    let drawn = player.hash();
    assert_ne!(drawn, empty);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), empty, "undo");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    assert_eq!(player.hash(), drawn, "redo");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    assert_eq!(player.world().resource::<Toasts>().last(), Some("Nothing to make again"));
}

#[test]
fn a_reset_can_be_undone() {
    let mut player = Player::new();
    player.chord(&[KeyCode::Space]);
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frames(2);
    let drawn = player.hash();
    player.chord(&[KeyCode::KeyR]);
    assert_eq!(player.particles(), 0);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), drawn);
}

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
fn the_wind_blows_along_the_drag_and_has_a_limit() {
    let mut player = Player::new();
    player.chord(&[KeyCode::KeyW]);
    player.point_at(player.middle());
    player.press();
    player.frame();
    for step in 1..=6 {
        player.point_at(player.middle() + Vec2::new(-12.0 * step as f32, 0.0));
        player.frame();
    }
    let seen = player.seen();
    let winds: Vec<Vec2> = seen
        .iter()
        .map(|intent| match intent {
            Intent::Blow { velocity, .. } => *velocity,
            other => panic!("wind only, not {other:?}"),
        })
        .collect();
    let blueprint = &player.world().resource::<Setup>().blueprint;
    let reference = Reference::of(&blueprint.domain, &blueprint.air);
    assert!(!winds.is_empty());
    for wind in winds {
        assert!(wind.x < 0.0 && wind.y.abs() < 0.01 * wind.x.abs(), "{wind} must point along the drag");
        assert!(wind.length() <= 2.001 * reference.wind, "{wind} is beyond the limit");
    }
}

#[test]
fn the_pressure_tool_adds_with_the_left_button_and_sucks_with_the_right() {
    for (button, sign) in [(MouseButton::Left, 1.0), (MouseButton::Right, -1.0)] {
        let mut player = Player::new();
        player.chord(&[KeyCode::KeyQ]);
        player.point_at(player.middle());
        player.button(button, ButtonState::Pressed);
        player.frames(2);
        let seen = player.seen();
        assert!(!seen.is_empty());
        for intent in seen {
            let Intent::Press { amount, .. } = intent else { panic!("pressure only, not {intent:?}") };
            assert_eq!(amount.signum(), sign);
        }
    }
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

#[test]
fn letters_in_a_text_field_are_no_keys() {
    let mut player = Player::new();
    player.0.insert_resource(Typing(true));
    player.chord(&[KeyCode::KeyP]);
    assert!(!player.world().resource::<Pace>().paused);
}

#[test]
fn keys_choose_views_tools_speed_and_brush() {
    let mut player = Player::new();
    player.chord(&[KeyCode::ShiftLeft, KeyCode::Digit2]);
    assert_eq!(player.world().resource::<Shown>().0, View::Speed);
    player.chord(&[KeyCode::KeyV]);
    assert_eq!(player.world().resource::<Shown>().0, View::Density);
    player.chord(&[KeyCode::Digit1]);
    let first = player.world().resource::<Setup>().elements().iter().find(|(_, e)| e.key == '1').map(|(id, _)| id);
    assert_eq!(player.world().resource::<Toolbox>().element(), first);
    player.chord(&[KeyCode::Minus]);
    assert_eq!(player.world().resource::<Pace>().speed, 0.5);
    let radius = player.world().resource::<Toolbox>().radius();
    player.chord(&[KeyCode::BracketRight]);
    assert!(player.world().resource::<Toolbox>().radius() > radius);
    player.chord(&[KeyCode::KeyH]);
    assert!(!player.world().resource::<HudState>().visible);
}

#[test]
fn another_scene_forgets_the_past_and_shows_its_own_box() {
    let mut player = Player::new();
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frame();
    let settings = vec![("columns".to_owned(), "12".to_owned())];
    player.0.world_mut().resource_mut::<Orders>().push(Order::Scene { name: "dam_break".into(), settings });
    player.frames(2);
    let setup = player.world().resource::<Setup>();
    assert_eq!(setup.blueprint.name, "dam_break");
    assert_eq!(player.world().resource::<WorldCamera>().world(), setup.blueprint.domain.size);
    assert_eq!(player.particles(), 2 * 12 * 12);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.world().resource::<Toasts>().last(), Some("Nothing to undo"));
    player.0.world_mut().resource_mut::<Orders>().push(Order::Scene { name: "nowhere".into(), settings: vec![] });
    player.frames(2);
    assert!(player.world().resource::<Toasts>().last().is_some_and(|text| text.contains("nowhere")));
    assert_eq!(
        player.world().resource::<Setup>().blueprint.name,
        "dam_break",
        "a scene that isn't there changes nothing"
    );
}
