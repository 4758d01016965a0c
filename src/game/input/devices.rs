//! Reads keyboard, mouse and fingers once a frame, event by event in the order in which they happened: at a low frame rate a
//! whole stroke, or a chord of keys, lies between two frames.

use crate::game::input::{bindings::Mods, keys::HudKeys, pointer::PointerInput, touch::Fingers};
use bevy::{
    input::ButtonState,
    prelude::{ButtonInput, KeyCode, Local, MessageReader, Real, Res, ResMut, Time},
    window::WindowEvent,
};

/// Turns the events of a frame into what they mean.
pub fn read_devices(
    mut events: MessageReader<WindowEvent>,
    keyboard: Res<ButtonInput<KeyCode>>,
    hud: Res<HudKeys>,
    time: Res<Time<Real>>,
    mut mods: Local<Mods>,
    mut fingers: ResMut<Fingers>,
    mut pointer: PointerInput,
) {
    pointer.begin_frame();
    for event in events.read() {
        match event {
            WindowEvent::KeyboardInput(key) => {
                mods.follow(key.key_code, key.state == ButtonState::Pressed);
                if key.state == ButtonState::Pressed && !key.repeat {
                    pointer.key(key.key_code, *mods, *hud);
                }
            }
            WindowEvent::CursorMoved(moved) => pointer.move_to(moved.position),
            WindowEvent::CursorLeft(_) => pointer.leave(),
            WindowEvent::MouseButtonInput(button) => {
                fingers.in_use = false;
                match button.state {
                    ButtonState::Pressed => pointer.press(button.button, *mods),
                    ButtonState::Released => pointer.release(button.button),
                }
            }
            WindowEvent::MouseWheel(wheel) => pointer.scroll(wheel, *mods),
            WindowEvent::TouchInput(touch) => fingers.follow(touch, &mut pointer),
            WindowEvent::WindowFocused(focus) if !focus.focused => pointer.let_go(),
            _ => {}
        }
    }
    // Releases outside the window are never seen: between events the truth is what Bevy holds for pressed.
    if events.is_empty() {
        *mods = Mods::held(&keyboard);
    }
    fingers.end_frame(time.delta_secs(), &mut pointer);
    pointer.end_frame(time.delta_secs());
}
