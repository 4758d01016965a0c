//! Mouse keys: the pointer by the keyboard alone, for whoever has no mouse or can't use one. Keys that else move the picture move
//! the pointer, and others are its buttons. What comes of it are the events of a mouse, so that the world and the HUD see no
//! difference.

use crate::game::{
    actions::Action,
    camera::WorldCamera,
    input::{bindings::Bindings, keys::HudKeys, pointer::Pointer},
};
use bevy::{
    ecs::system::SystemParam,
    input::{ButtonState, mouse::MouseButtonInput},
    prelude::{
        ButtonInput, Entity, KeyCode, Local, MessageWriter, MouseButton, Query, Real, Res, ResMut, Resource, Time, With,
    },
    window::{CursorMoved, PrimaryWindow, WindowEvent},
};
use glam::Vec2;

/// How far a key moves the pointer as it goes down, logical pixels.
const STEP: f32 = 3.0;
/// Speed of the pointer just after that and once a key was held for [`RISE`] s, logical pixels a second.
const SPEED: [f32; 2] = [60.0, 900.0];
/// Time in which the speed rises, s.
const RISE: f32 = 1.0;

/// Whether keys move the pointer.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MouseKeys(pub bool);

/// Whether they do.
pub fn are_on(mouse_keys: Res<MouseKeys>) -> bool {
    mouse_keys.0
}

/// What keys do to the pointer, from frame to frame.
#[derive(Debug, Default)]
pub struct Hold {
    /// For how long it has been moved, s.
    moved: f32,
    /// Buttons that are down.
    down: Vec<MouseButton>,
}

/// Says what a mouse would have said.
#[derive(SystemParam)]
pub struct Mouse<'w, 's> {
    windows: Query<'w, 's, Entity, With<PrimaryWindow>>,
    events: MessageWriter<'w, WindowEvent>,
    moves: MessageWriter<'w, CursorMoved>,
    buttons: MessageWriter<'w, MouseButtonInput>,
}

impl Mouse<'_, '_> {
    fn window(&self) -> Entity {
        self.windows.single().unwrap_or(Entity::PLACEHOLDER)
    }

    /// Moves the pointer to a place of the window, logical pixels.
    pub fn move_to(&mut self, position: Vec2) {
        let moved = CursorMoved { window: self.window(), position, delta: None };
        self.events.write(moved.clone().into());
        self.moves.write(moved);
    }

    fn button(&mut self, button: MouseButton, state: ButtonState) {
        let input = MouseButtonInput { button, state, window: self.window() };
        self.events.write(input.into());
        self.buttons.write(input);
    }
}

/// Moves the pointer and its buttons by keys. Modifiers are left to what a button does with them.
pub fn run(
    mouse_keys: Res<MouseKeys>,
    (keys, bindings, hud): (Res<ButtonInput<KeyCode>>, Res<Bindings>, Res<HudKeys>),
    (pointer, time): (Res<Pointer>, Res<Time<Real>>),
    mut camera: ResMut<WorldCamera>,
    mut hold: Local<Hold>,
    mut mouse: Mouse,
) {
    if !mouse_keys.0 {
        hold.moved = 0.0;
        hold.down.drain(..).for_each(|button| mouse.button(button, ButtonState::Released));
        return;
    }
    let is_down = |key: KeyCode, action: Action| keys.pressed(key) && hud.leave(key, action);
    let rows = || bindings.iter().filter_map(|binding| binding.chord().map(|chord| (chord.key, binding.action)));
    let (mut way, mut begins) = (Vec2::ZERO, false);
    for (key, action) in rows().filter(|(key, action)| is_down(*key, *action)) {
        if let Action::Pan(right, up) = action {
            way += Vec2::new(right as f32, -up as f32);
            begins |= keys.just_pressed(key);
        }
    }
    let mut at = pointer.at.unwrap_or(camera.window() / 2.0);
    hold.moved = if way == Vec2::ZERO { 0.0 } else { hold.moved + time.delta_secs() };
    if way != Vec2::ZERO {
        let [slow, fast] = SPEED;
        let speed = slow + (fast - slow) * (hold.moved / RISE).min(1.0);
        let wanted = at + way * (speed * time.delta_secs()).max(if begins { STEP } else { 0.0 });
        at = wanted.clamp(Vec2::ZERO, (camera.window() - 1.0).max(Vec2::ZERO));
        // At the edge of the window it pushes the picture.
        camera.pan(at - wanted);
        mouse.move_to(at);
    }
    for (key, action) in rows() {
        if let Action::Press(button) = action
            && keys.just_pressed(key)
            && hud.leave(key, action)
            && !hold.down.contains(&button)
        {
            mouse.move_to(at);
            mouse.button(button, ButtonState::Pressed);
            hold.down.push(button);
        }
    }
    hold.down.retain(|button| {
        let is_held = rows().any(|(key, action)| action == Action::Press(*button) && keys.pressed(key));
        if !is_held {
            mouse.button(*button, ButtonState::Released);
        }
        is_held
    });
}
