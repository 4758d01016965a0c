//! The one table of keys and buttons. Input looks actions up in it, help prints it, the palette shows its keys.
//! Keys are physical: they stand where they stand on a US keyboard, whatever is printed on them.

use crate::game::{tools::Tool, views::table::View};
use bevy::prelude::{ButtonInput, KeyCode, MouseButton};
use std::fmt;

/// What a player can do with a key, a button or a click on the HUD.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Begins something that lasts while the button is held.
    Hold(Gesture),
    /// Chooses the element under the pointer.
    Sample,
    /// Chooses the element with this digit.
    Element(char),
    /// Chooses a tool that is not an element.
    Tool(Tool),
    /// Opens the search for elements.
    Search,
    /// Makes the brush larger or smaller by steps.
    Brush(i32),
    /// Turns the brush from round to square and back.
    BrushShape,
    /// Stops and starts time.
    Pause,
    /// Runs one tick.
    Step,
    /// Halves (−1) or doubles (+1) the speed.
    Speed(i32),
    /// Back to the start of the scene.
    Reset,
    /// Takes the last edit back.
    Undo,
    /// Makes it again.
    Redo,
    /// Brings the air to rest.
    ClearAir,
    /// Shows a view.
    View(&'static View),
    /// Shows the next view.
    NextView,
    /// Zooms at the pointer, in (+1) or out (−1).
    Zoom(i32),
    /// Moves the picture while the key is held: right and up count.
    Pan(i32, i32),
    /// Shows or hides the HUD.
    Hud,
    /// Writes the world into a file.
    Save,
    /// Begins a recording, or ends it.
    Record,
    /// Writes the last minute as a recording.
    KeepLastMinute,
    /// Opens the list of save files.
    Saves,
    /// Opens the scene menu.
    Scenes,
    /// Opens the settings.
    Settings,
    /// Shows the books of the simulation.
    Details,
    /// Shows the physics exam.
    Exam,
    /// Shows the stability gauntlet.
    Gauntlet,
    /// Shows what accuracy costs.
    Accuracy,
    /// Puts the world beside itself at another quality, or ends that.
    Split,
    /// Shows this table.
    Help,
    /// Full screen and back.
    FullScreen,
    /// Writes a picture of the window.
    Screenshot,
    /// Closes whatever is open.
    Close,
}

/// What a held button does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Works with the chosen tool along the way of the pointer.
    Use,
    /// Draws a straight line when released.
    Line,
    /// Draws a filled rectangle when released.
    Rectangle,
    /// Fills the room around the pointer.
    Fill,
    /// Erases along the way of the pointer; with the pressure tool, sucks.
    Erase,
    /// Moves the picture; a click without moving samples.
    Drag,
}

/// The modifier keys that must be held, and no others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mods {
    /// Ctrl, or Cmd on a Mac.
    pub ctrl: bool,
    /// Shift.
    pub shift: bool,
    /// Alt.
    pub alt: bool,
}

const NONE: Mods = Mods { ctrl: false, shift: false, alt: false };
const CTRL: Mods = Mods { ctrl: true, ..NONE };
const SHIFT: Mods = Mods { shift: true, ..NONE };
const ALT: Mods = Mods { alt: true, ..NONE };
const CTRL_SHIFT: Mods = Mods { ctrl: true, shift: true, ..NONE };

impl Mods {
    /// The modifiers that are held now.
    pub fn held(keys: &ButtonInput<KeyCode>) -> Self {
        use KeyCode as K;
        Self {
            ctrl: keys.any_pressed([K::ControlLeft, K::ControlRight, K::SuperLeft, K::SuperRight]),
            shift: keys.any_pressed([K::ShiftLeft, K::ShiftRight]),
            alt: keys.any_pressed([K::AltLeft, K::AltRight]),
        }
    }

    /// A key goes down or up.
    pub fn follow(&mut self, key: KeyCode, down: bool) {
        use KeyCode as K;
        match key {
            K::ControlLeft | K::ControlRight | K::SuperLeft | K::SuperRight => self.ctrl = down,
            K::ShiftLeft | K::ShiftRight => self.shift = down,
            K::AltLeft | K::AltRight => self.alt = down,
            _ => {}
        }
    }
}

/// A key, a button or the wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trigger {
    /// A physical key.
    Key(KeyCode),
    /// A mouse button.
    Button(MouseButton),
    /// The wheel, turned away from the player (+1) or towards (−1).
    Wheel(i32),
}

/// Headings of the help.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Mouse and brush.
    Draw,
    /// Elements and tools.
    Choose,
    /// Time and world.
    World,
    /// Views and window.
    Look,
}

impl Group {
    /// All headings, in the order of the help.
    pub const ALL: [Self; 4] = [Self::Draw, Self::Choose, Self::World, Self::Look];

    /// Text of the heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::Draw => "Draw",
            Self::Choose => "Choose",
            Self::World => "World",
            Self::Look => "Look",
        }
    }
}

/// One row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// What must be pressed or turned.
    pub trigger: Trigger,
    /// What must be held with it.
    pub mods: Mods,
    /// What it does.
    pub action: Action,
    /// Where the help shows it.
    pub group: Group,
    /// What the help says; rows with the same text are shown as one.
    pub help: &'static str,
}

const fn key(key: KeyCode, mods: Mods, action: Action, group: Group, help: &'static str) -> Binding {
    Binding { trigger: Trigger::Key(key), mods, action, group, help }
}

const fn button(button: MouseButton, mods: Mods, action: Action, help: &'static str) -> Binding {
    Binding { trigger: Trigger::Button(button), mods, action, group: Group::Draw, help }
}

const fn wheel(up: i32, mods: Mods, action: Action, group: Group, help: &'static str) -> Binding {
    Binding { trigger: Trigger::Wheel(up), mods, action, group, help }
}

const fn digit(code: KeyCode, digit: char) -> Binding {
    key(code, NONE, Action::Element(digit), Group::Choose, "choose an element")
}

const fn view(code: KeyCode, view: View) -> Binding {
    key(code, SHIFT, Action::View(view), Group::Look, "choose a view")
}

/// Every key, button and turn of the wheel that means something.
#[rustfmt::skip]
pub const BINDINGS: &[Binding] = {
    use {Action as A, Gesture as G, Group as H, KeyCode as K, MouseButton as B};
    &[
    button(B::Left, NONE, A::Hold(G::Use), "use the chosen tool: pour, draw, blow"),
    button(B::Right, NONE, A::Hold(G::Erase), "erase (pressure tool: suck)"),
    button(B::Left, SHIFT, A::Hold(G::Line), "draw a line"),
    button(B::Left, CTRL, A::Hold(G::Rectangle), "draw a rectangle"),
    button(B::Left, CTRL_SHIFT, A::Hold(G::Fill), "fill the room around the pointer"),
    button(B::Left, ALT, A::Sample, "choose the element under the pointer"),
    button(B::Middle, NONE, A::Hold(G::Drag), "choose the element under the pointer; drag: move the picture"),
    wheel(1, NONE, A::Brush(1), H::Draw, "size of the brush"),
    wheel(-1, NONE, A::Brush(-1), H::Draw, "size of the brush"),
    key(K::BracketLeft, NONE, A::Brush(-1), H::Draw, "size of the brush"),
    key(K::BracketRight, NONE, A::Brush(1), H::Draw, "size of the brush"),
    key(K::Tab, NONE, A::BrushShape, H::Draw, "shape of the brush"),
    key(K::KeyZ, CTRL, A::Undo, H::Draw, "undo"),
    key(K::KeyY, CTRL, A::Redo, H::Draw, "redo"),
    key(K::KeyZ, CTRL_SHIFT, A::Redo, H::Draw, "redo"),

    digit(K::Digit1, '1'), digit(K::Digit2, '2'), digit(K::Digit3, '3'), digit(K::Digit4, '4'), digit(K::Digit5, '5'),
    digit(K::Digit6, '6'), digit(K::Digit7, '7'), digit(K::Digit8, '8'), digit(K::Digit9, '9'), digit(K::Digit0, '0'),
    key(K::KeyE, NONE, A::Search, H::Choose, "search elements and tools"),
    key(K::KeyX, NONE, A::Tool(Tool::Erase), H::Choose, "eraser"),
    key(K::KeyW, NONE, A::Tool(Tool::Wind), H::Choose, "wind: drag to blow"),
    key(K::KeyQ, NONE, A::Tool(Tool::Pressure), H::Choose, "pressure: left adds, right sucks"),

    key(K::Space, NONE, A::Pause, H::World, "pause"),
    key(K::KeyP, NONE, A::Pause, H::World, "pause"),
    key(K::KeyF, NONE, A::Step, H::World, "one tick"),
    key(K::Period, NONE, A::Step, H::World, "one tick"),
    key(K::Minus, NONE, A::Speed(-1), H::World, "slower"),
    key(K::NumpadSubtract, NONE, A::Speed(-1), H::World, "slower"),
    key(K::Equal, SHIFT, A::Speed(1), H::World, "faster"),
    key(K::NumpadAdd, NONE, A::Speed(1), H::World, "faster"),
    key(K::Equal, NONE, A::ClearAir, H::World, "clear the air"),
    key(K::KeyR, NONE, A::Reset, H::World, "reset the scene (can be undone)"),
    key(K::KeyS, CTRL, A::Save, H::World, "save the world"),
    key(K::KeyO, CTRL, A::Saves, H::World, "load a saved world (can be undone)"),
    key(K::F9, NONE, A::Record, H::World, "record; again: end the recording and write it"),
    key(K::F9, SHIFT, A::KeepLastMinute, H::World, "write the last minute as a recording"),
    key(K::KeyM, NONE, A::Scenes, H::World, "scene menu"),

    key(K::KeyV, NONE, A::NextView, H::Look, "next view"),
    view(K::Digit1, View::Elements), view(K::Digit2, View::Speed), view(K::Digit3, View::Density),
    view(K::Digit4, View::Pressure), view(K::Digit5, View::Wind), view(K::Digit6, View::Stability),
    key(K::KeyZ, NONE, A::Zoom(1), H::Look, "zoom in at the pointer"),
    key(K::KeyZ, SHIFT, A::Zoom(-1), H::Look, "zoom out"),
    wheel(1, CTRL, A::Zoom(1), H::Look, "zoom in at the pointer"),
    wheel(-1, CTRL, A::Zoom(-1), H::Look, "zoom out"),
    key(K::ArrowLeft, NONE, A::Pan(-1, 0), H::Look, "move the picture"),
    key(K::ArrowRight, NONE, A::Pan(1, 0), H::Look, "move the picture"),
    key(K::ArrowUp, NONE, A::Pan(0, 1), H::Look, "move the picture"),
    key(K::ArrowDown, NONE, A::Pan(0, -1), H::Look, "move the picture"),
    key(K::KeyH, NONE, A::Hud, H::Look, "hide the HUD"),
    key(K::KeyA, NONE, A::Accuracy, H::Look, "accuracy: what it costs, and the autopilot"),
    key(K::KeyB, NONE, A::Split, H::Look, "A/B split: the same world at two qualities"),
    key(K::F3, NONE, A::Details, H::Look, "details: what runs and what it costs"),
    key(K::F4, NONE, A::Settings, H::Look, "settings"),
    key(K::F6, NONE, A::Exam, H::Look, "physics exam: known answers, computed and compared"),
    key(K::F7, NONE, A::Gauntlet, H::Look, "stability gauntlet: hard cases, to watch and to run"),
    key(K::F1, NONE, A::Help, H::Look, "this help"),
    key(K::Slash, SHIFT, A::Help, H::Look, "this help"),
    key(K::F11, NONE, A::FullScreen, H::Look, "full screen"),
    key(K::F2, NONE, A::Screenshot, H::Look, "screenshot"),
    key(K::Escape, NONE, A::Close, H::Look, "close"),
    ]
};

/// The action bound to a trigger with exactly these modifiers.
pub fn find(trigger: Trigger, mods: Mods) -> Option<Action> {
    BINDINGS.iter().find(|binding| binding.trigger == trigger && binding.mods == mods).map(|binding| binding.action)
}

/// The first binding of an action, for tooltips and the palette.
pub fn of(action: Action) -> Option<&'static Binding> {
    BINDINGS.iter().find(|binding| binding.action == action)
}

impl fmt::Display for Binding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Two keys are known by what Shift makes of them.
        match (self.trigger, self.mods) {
            (Trigger::Key(KeyCode::Slash), SHIFT) => return f.write_str("?"),
            (Trigger::Key(KeyCode::Equal), SHIFT) => return f.write_str("+"),
            _ => {}
        }
        for (held, name) in [(self.mods.ctrl, "Ctrl+"), (self.mods.shift, "Shift+"), (self.mods.alt, "Alt+")] {
            if held {
                f.write_str(name)?;
            }
        }
        match self.trigger {
            Trigger::Key(key) => f.write_str(key_name(key)),
            Trigger::Button(MouseButton::Left) => f.write_str("left button"),
            Trigger::Button(MouseButton::Right) => f.write_str("right button"),
            Trigger::Button(_) => f.write_str("middle button"),
            Trigger::Wheel(_) => f.write_str("wheel"),
        }
    }
}

/// What is printed on a key of a US keyboard.
fn key_name(key: KeyCode) -> &'static str {
    use KeyCode as K;
    match key {
        K::KeyA => "A",
        K::KeyB => "B",
        K::KeyE => "E",
        K::KeyF => "F",
        K::KeyH => "H",
        K::KeyM => "M",
        K::KeyO => "O",
        K::KeyP => "P",
        K::KeyQ => "Q",
        K::KeyR => "R",
        K::KeyS => "S",
        K::KeyV => "V",
        K::KeyW => "W",
        K::KeyX => "X",
        K::KeyY => "Y",
        K::KeyZ => "Z",
        K::Digit0 => "0",
        K::Digit1 => "1",
        K::Digit2 => "2",
        K::Digit3 => "3",
        K::Digit4 => "4",
        K::Digit5 => "5",
        K::Digit6 => "6",
        K::Digit7 => "7",
        K::Digit8 => "8",
        K::Digit9 => "9",
        K::F1 => "F1",
        K::F2 => "F2",
        K::F3 => "F3",
        K::F4 => "F4",
        K::F6 => "F6",
        K::F7 => "F7",
        K::F9 => "F9",
        K::F11 => "F11",
        K::Space => "Space",
        K::Tab => "Tab",
        K::Escape => "Esc",
        K::Period => ".",
        K::Minus | K::NumpadSubtract => "-",
        K::Equal => "=",
        K::NumpadAdd => "+",
        K::Slash => "/",
        K::BracketLeft => "[",
        K::BracketRight => "]",
        K::ArrowLeft => "left",
        K::ArrowRight => "right",
        K::ArrowUp => "up",
        K::ArrowDown => "down",
        _ => "unnamed",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_chord_means_two_things() {
        for (k, a) in BINDINGS.iter().enumerate() {
            for b in &BINDINGS[k + 1..] {
                assert!(
                    a.trigger != b.trigger || a.mods != b.mods,
                    "`{a}` is bound to {:?} and {:?}",
                    a.action,
                    b.action
                );
            }
        }
    }

    #[test]
    fn every_binding_has_a_name_and_a_help() {
        for binding in BINDINGS {
            assert!(!binding.to_string().contains("unnamed"), "{:?} has no name", binding.trigger);
            assert!(!binding.help.is_empty());
        }
    }

    #[test]
    fn modifiers_must_match_exactly() {
        let z = Trigger::Key(KeyCode::KeyZ);
        assert_eq!(find(z, NONE), Some(Action::Zoom(1)));
        assert_eq!(find(z, CTRL), Some(Action::Undo));
        assert_eq!(find(z, CTRL_SHIFT), Some(Action::Redo));
        assert_eq!(find(z, ALT), None);
        assert_eq!(find(Trigger::Button(MouseButton::Left), SHIFT), Some(Action::Hold(Gesture::Line)));
    }
}
