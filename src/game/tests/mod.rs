//! The game without a window: events of the devices go in, the world changes.

use crate::{
    game::{
        GamePlugin,
        actions::Action,
        camera::{Area, WorldCamera},
        input::{keys::HudKeys, pointer::HudCover},
        orders::{Order, Orders},
        panels::Panels,
        toasts::Toasts,
        toolbox::Toolbox,
        tools::Tool,
        views::table::{Shown, VIEWS},
    },
    kernel::brush::BrushShape,
    lab::colours::Reference,
    scene::{self, effects::EffectModes, passes::Pass},
    sim::{
        SimulationPlugin,
        checkpoint::Checkpoint,
        control,
        intent::{Intent, IntentQueue},
        pace::Pace,
        state::{Clock, ParticleStore, Rock, Setup},
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

mod accuracy;
mod air;
mod challenges;
#[cfg(not(target_arch = "wasm32"))]
mod crash;
mod detail;
mod draw;
#[cfg(not(target_arch = "wasm32"))]
mod full_disk;
mod gauges;
mod gauntlet;
#[cfg(not(target_arch = "wasm32"))]
mod hints;
mod keys;
#[cfg(not(target_arch = "wasm32"))]
mod language;
mod lens;
mod mixer;
mod mouse_keys;
mod museum;
mod opening;
mod past;
mod recording;
mod rewind;
mod saves;
mod springs;
mod stamps;
mod throws;
mod touch;

/// The intents that the ticks saw.
#[derive(Resource, Default)]
struct Seen(Vec<Intent>);

fn spy(mut queue: ResMut<IntentQueue>, mut seen: ResMut<Seen>) {
    let intents: Vec<Intent> = queue.drain().collect();
    for intent in &intents {
        queue.push(intent.clone());
    }
    seen.0.extend(intents);
}

/// A player at an empty box, one tick a frame.
struct Player(App);

impl Player {
    fn new() -> Self {
        Self::with(|_| {})
    }

    /// One whose game has something more.
    fn with(furnish: impl FnOnce(&mut App)) -> Self {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, SimulationPlugin, GamePlugin))
            .init_resource::<ButtonInput<KeyCode>>()
            .init_resource::<Seen>()
            .insert_resource(TimeUpdateStrategy::FixedTimesteps(1))
            .add_systems(FixedUpdate, spy.before(Pass::Edit));
        furnish(&mut app);
        let scene = scene::load("empty").expect("the scene comes with the game");
        let blueprint = scene.build(&[], None, &EffectModes::new()).expect("its defaults are valid");
        Checkpoint::of_scene(Arc::new(blueprint)).restore(app.world_mut());
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

    /// What a button of the HUD asks for.
    fn act(&mut self, action: Action) {
        self.0.world_mut().resource_mut::<Orders>().push(Order::Act(action));
        self.frame();
    }

    /// Pours some of what is chosen in the middle of the world, and lets it stand.
    fn pour_and_stop(&mut self) {
        self.point_at(self.middle());
        self.press();
        self.frames(3);
        self.release();
        self.frames(2);
        self.chord(&[KeyCode::Space]);
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

    fn was_told(&self, part: &str) -> bool {
        self.world().resource::<Toasts>().texts().any(|text| text.contains(part))
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
