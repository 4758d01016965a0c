//! Clicks and moves in one frame. egui gets all moves of a frame before its buttons, each button where the pointer is at last, and
//! looks once a frame at what is there: whoever clicks and goes on within a long frame would have clicked nothing. So events are put
//! into the order in which they came, and what comes after a button waits for the next frame.

use bevy::{
    prelude::{Local, MessageReader, Query, With},
    window::WindowEvent,
};
use bevy_egui::{
    EguiContext, EguiInput, PrimaryEguiContext,
    egui::{
        Event::{self, PointerButton, PointerGone, PointerMoved},
        Pos2,
    },
};
use std::mem;

/// Gives egui what comes up to the first button, and that.
pub fn take_turns(
    mut inputs: Query<(&mut EguiContext, &mut EguiInput), With<PrimaryEguiContext>>,
    mut came: MessageReader<WindowEvent>,
    mut at: Local<Pos2>,
    mut waiting: Local<Vec<Event>>,
) {
    for (mut context, mut input) in &mut inputs {
        let zoom = context.get_mut().zoom_factor();
        let mut events = mem::take(&mut *waiting);
        events.extend(in_order(mem::take(&mut input.events), came.read(), (&mut at, zoom)));
        *waiting = events.split_off(end_of_turn(&events));
        input.events = events;
    }
}

/// The events of a mouse as they came to the window, before all others; `at` is where the pointer was, points, and is at last.
/// Fingers have places of their own, so theirs are left alone.
fn in_order<'a>(
    events: Vec<Event>,
    came: impl Iterator<Item = &'a WindowEvent>,
    (at, zoom): (&mut Pos2, f32),
) -> Vec<Event> {
    let (pointer, others): (Vec<_>, Vec<_>) =
        events.iter().cloned().partition(|event| matches!(event, PointerMoved(_) | PointerButton { .. }));
    let (moves, buttons): (Vec<_>, Vec<_>) = pointer.into_iter().partition(|event| matches!(event, PointerMoved(_)));
    let (mut moves, mut buttons) = (moves.into_iter(), buttons.into_iter());
    let mut ordered = Vec::new();
    for event in came {
        match event {
            WindowEvent::CursorMoved(moved) if moves.next().is_some() => {
                *at = Pos2::new(moved.position.x / zoom, moved.position.y / zoom);
                ordered.push(PointerMoved(*at));
            }
            WindowEvent::MouseButtonInput(_) => match buttons.next() {
                Some(PointerButton { button, pressed, modifiers, .. }) => {
                    ordered.push(PointerButton { pos: *at, button, pressed, modifiers });
                }
                _ => return events,
            },
            WindowEvent::CursorMoved(_) => return events,
            _ => {}
        }
    }
    if moves.next().is_some() || buttons.next().is_some() {
        return events;
    }
    ordered.extend(others);
    ordered
}

/// How many of these events go into one frame.
fn end_of_turn(events: &[Event]) -> usize {
    let Some(button) = events.iter().position(|event| matches!(event, PointerButton { .. })) else {
        return events.len();
    };
    let rest = &events[button + 1..];
    let next = rest.iter().position(|event| matches!(event, PointerMoved(_) | PointerGone | PointerButton { .. }));
    next.map_or(events.len(), |next| button + 1 + next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy::{
        input::{ButtonState, mouse::MouseButtonInput},
        prelude::{Entity, MouseButton, Vec2},
        window::CursorMoved,
    };
    use bevy_egui::egui::{self, Modifiers, PointerButton as Button, RawInput, Rect, pos2, vec2};

    const ON: Pos2 = pos2(20.0, 20.0);
    const OFF: Pos2 = pos2(300.0, 300.0);

    fn button(pos: Pos2, pressed: bool) -> Event {
        PointerButton { pos, button: Button::Primary, pressed, modifiers: Modifiers::NONE }
    }

    /// Whether a button of the screen was clicked by these events, in turns or as they come.
    fn clicks(mut events: Vec<Event>, in_turns: bool) -> bool {
        let context = egui::Context::default();
        let mut clicked = false;
        let mut frame = |events: Vec<Event>| {
            let _ = context.run_ui(RawInput { events, ..RawInput::default() }, |ui| {
                let rect = Rect::from_min_size(Pos2::ZERO, vec2(40.0, 40.0));
                clicked |= ui.put(rect, egui::Button::new("press")).clicked();
            });
        };
        frame(vec![PointerMoved(ON)]);
        while !events.is_empty() {
            let rest = events.split_off(if in_turns { end_of_turn(&events) } else { events.len() });
            frame(mem::replace(&mut events, rest));
        }
        clicked
    }

    #[test]
    fn who_clicks_and_goes_on_within_a_frame_has_clicked() {
        let quick = || vec![PointerMoved(ON), button(ON, true), button(ON, false), PointerMoved(OFF)];
        assert!(!clicks(quick(), false), "egui has learnt it: this file can go");
        assert!(clicks(quick(), true));
        let elsewhere = vec![button(ON, true), PointerMoved(OFF), button(OFF, false)];
        assert!(!clicks(elsewhere, true), "let go elsewhere, it is no click");
    }

    #[test]
    fn a_button_is_where_the_pointer_was_and_comes_before_the_move_that_followed() {
        let window = Entity::PLACEHOLDER;
        let moved = |at: Pos2| {
            WindowEvent::from(CursorMoved { window, position: Vec2::new(2.0 * at.x, 2.0 * at.y), delta: None })
        };
        let state = ButtonState::Released;
        let released = WindowEvent::from(MouseButtonInput { button: MouseButton::Left, state, window });
        let order = |events: Vec<Event>, came: &[WindowEvent]| {
            let mut at = ON;
            (in_order(events, came.iter(), (&mut at, 2.0)), at)
        };
        let text = || Event::Text("a".to_owned());
        let given = || vec![PointerMoved(OFF), text(), button(OFF, false)];
        let expected = (vec![button(ON, false), PointerMoved(OFF), text()], OFF);
        assert_eq!(order(given(), &[released.clone(), moved(OFF)]), expected);
        // What is a finger's is left as it is.
        assert_eq!(order(given(), &[]), (given(), ON));
        assert_eq!(order(vec![PointerMoved(OFF)], &[]), (vec![PointerMoved(OFF)], ON));
        assert_eq!(order(vec![PointerMoved(OFF)], &[released]), (vec![PointerMoved(OFF)], ON));
        assert_eq!(order(vec![text()], &[]), (vec![text()], ON));
    }

    #[test]
    fn what_has_no_button_in_it_does_not_wait() {
        let text = || Event::Text("a".to_owned());
        assert_eq!(end_of_turn(&[PointerMoved(ON), PointerMoved(OFF), text()]), 3);
        assert_eq!(end_of_turn(&[PointerMoved(ON), button(ON, true), text()]), 3);
        assert_eq!(end_of_turn(&[button(ON, true), button(ON, false), text()]), 1);
        assert_eq!(end_of_turn(&[]), 0);
    }
}
