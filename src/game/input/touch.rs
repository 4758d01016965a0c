//! Fingers: one does what the left button does, two move and zoom the picture.
//!
//! A second finger never comes down at the same moment as the first, so the first one waits a moment before it draws.

use crate::game::input::{bindings::Mods, pointer::PointerInput};
use bevy::{
    input::touch::{TouchInput, TouchPhase},
    prelude::{MouseButton, Resource},
};
use glam::Vec2;

/// Time that the first finger waits for a second, s.
const WAIT: f32 = 0.08;
/// A finger that moves this far draws at once, pixels.
const MOVED: f32 = 8.0;
/// Fingers closer than this don't zoom, pixels.
const CLOSEST: f32 = 16.0;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Finger {
    id: u64,
    /// Where it came down, pixels.
    began: Vec2,
    /// Where it is, pixels.
    at: Vec2,
}

/// What the fingers are doing, from the first that comes down to the last that goes up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Doing {
    #[default]
    Nothing,
    /// One finger is down; for how long, s.
    Waiting(f32),
    Drawing,
    Moving,
    /// The touch began over the HUD, or one of two fingers is left: it draws nothing.
    Other,
}

/// The fingers on the screen.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Fingers {
    /// Whether the player uses fingers: then the HUD has tools that are large enough for them.
    pub in_use: bool,
    down: Vec<Finger>,
    doing: Doing,
}

impl Fingers {
    /// A finger comes, moves or goes.
    pub fn follow(&mut self, touch: &TouchInput, pointer: &mut PointerInput) {
        match touch.phase {
            TouchPhase::Started => self.put(touch.id, touch.position, pointer),
            TouchPhase::Moved => self.slide(touch.id, touch.position, pointer),
            TouchPhase::Ended => self.lift(touch.id, true, pointer),
            TouchPhase::Canceled => self.lift(touch.id, false, pointer),
        }
    }

    /// A frame of `seconds` ends.
    pub fn end_frame(&mut self, seconds: f32, pointer: &mut PointerInput) {
        if let Doing::Waiting(waited) = self.doing {
            self.doing = Doing::Waiting(waited + seconds);
            if waited + seconds > WAIT {
                self.draw(pointer);
            }
        }
    }

    fn put(&mut self, id: u64, at: Vec2, pointer: &mut PointerInput) {
        self.in_use = true;
        // The end of an earlier touch may have been missed: a page can lose its events.
        self.down.retain(|finger| finger.id != id);
        self.down.push(Finger { id, began: at, at });
        self.doing = match (self.down.len(), self.doing) {
            (1, _) if pointer.is_over_hud(at) => Doing::Other,
            (1, _) => Doing::Waiting(0.0),
            (_, Doing::Drawing) => {
                pointer.let_go();
                Doing::Moving
            }
            (_, Doing::Waiting(_)) => Doing::Moving,
            (_, doing) => doing,
        };
    }

    fn slide(&mut self, id: u64, at: Vec2, pointer: &mut PointerInput) {
        let before = self.pair();
        let Some(finger) = self.down.iter_mut().find(|finger| finger.id == id) else { return };
        finger.at = at;
        let far = finger.began.distance(at) > MOVED;
        match self.doing {
            Doing::Waiting(_) if far => self.draw(pointer),
            Doing::Drawing => pointer.move_to(at),
            Doing::Moving => {
                if let (Some((middle, width)), Some((old_middle, old_width))) = (self.pair(), before) {
                    pointer.move_picture(old_middle, middle - old_middle, width / old_width);
                }
            }
            _ => {}
        }
    }

    fn lift(&mut self, id: u64, done: bool, pointer: &mut PointerInput) {
        if let (Doing::Waiting(_), true) = (self.doing, done) {
            self.draw(pointer);
        }
        self.down.retain(|finger| finger.id != id);
        match self.doing {
            Doing::Drawing if done => pointer.release(MouseButton::Left),
            Doing::Drawing => pointer.let_go(),
            Doing::Moving => self.doing = Doing::Other,
            _ => {}
        }
        if self.down.is_empty() {
            self.doing = Doing::Nothing;
            pointer.leave();
        }
    }

    /// The finger that waited begins to draw.
    fn draw(&mut self, pointer: &mut PointerInput) {
        let Some(finger) = self.down.first() else { return };
        pointer.move_to(finger.began);
        pointer.press(MouseButton::Left, Mods::default());
        pointer.move_to(finger.at);
        self.doing = Doing::Drawing;
    }

    /// Middle and distance of the first two fingers.
    fn pair(&self) -> Option<(Vec2, f32)> {
        let [a, b, ..] = self.down.as_slice() else { return None };
        Some(((a.at + b.at) / 2.0, a.at.distance(b.at).max(CLOSEST)))
    }
}
