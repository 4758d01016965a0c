//! The one table of keys and buttons. Input looks actions up in it, help prints it, the palette shows its keys. Tools,
//! views and panels bring their keys along in their own tables. What is written here holds at first: the keymap changes it.
//! Keys are physical: they stand where they stand on a US keyboard, whatever is printed on them.

use crate::game::{
    actions::{Action, Gesture, Take},
    brush_mode::BrushMode,
    input::chord::{ALT, CTRL_SHIFT, Chord},
    language::spoken,
    tools::{TOOLS, Tool},
    views::table::VIEWS,
};
use bevy::prelude::{KeyCode, MouseButton, Resource};
use std::fmt;
use tr::tr;

pub use crate::game::input::chord::{CTRL, Mods, NONE, SHIFT};

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
    key(
        code,
        NONE,
        Action::Element(digit),
        Group::Choose,
        "choose a favourite; over a tile of the panel: keep its element there",
    )
}

/// The keys and buttons that no tool, view or panel brings along.
#[rustfmt::skip]
const OWN: &[Binding] = {
    use {Action as A, Gesture as G, Group as H, KeyCode as K, MouseButton as B};
    &[
    button(B::Left, NONE, A::Hold(G::Use), "use the chosen tool: pour, draw, blow"),
    button(B::Right, NONE, A::Hold(G::Erase), "erase (pressure tool: suck)"),
    button(B::Left, SHIFT, A::Hold(G::Line), "draw a line"),
    button(B::Left, CTRL, A::Hold(G::Rectangle), "draw a rectangle"),
    button(B::Left, CTRL_SHIFT, A::Hold(G::Fill), "fill the space around the pointer"),
    button(B::Left, ALT, A::Sample, "choose the element under the pointer"),
    button(B::Middle, NONE, A::Hold(G::Pan), "choose the element under the pointer; drag: move the picture"),
    wheel(1, NONE, A::Brush(1), H::Draw, "size of the brush"),
    wheel(-1, NONE, A::Brush(-1), H::Draw, "size of the brush"),
    key(K::F8, NONE, A::MouseKeys, H::Draw, "mouse keys: the arrows move the pointer, Enter and \\ are its buttons"),
    key(K::Enter, NONE, A::Press(B::Left), H::Draw, "the left button, with mouse keys"),
    key(K::NumpadEnter, NONE, A::Press(B::Left), H::Draw, "the left button, with mouse keys"),
    key(K::Backslash, NONE, A::Press(B::Right), H::Draw, "the right button, with mouse keys"),
    key(K::BracketLeft, NONE, A::Brush(-1), H::Draw, "size of the brush"),
    key(K::BracketRight, NONE, A::Brush(1), H::Draw, "size of the brush"),
    key(K::Tab, NONE, A::BrushShape, H::Draw, "shape of the brush"),
    key(K::Insert, NONE, A::BrushMode(BrushMode::Replace), H::Draw, "replace: what is there becomes the element; again: draw"),
    key(K::Semicolon, NONE, A::BrushMode(BrushMode::Replace), H::Draw, "replace: what is there becomes the element; again: draw"),
    key(K::Delete, NONE, A::BrushMode(BrushMode::EraseOnly), H::Draw, "erase only the chosen element; again: draw"),
    key(K::Semicolon, CTRL, A::BrushMode(BrushMode::EraseOnly), H::Draw, "erase only the chosen element; again: draw"),
    key(K::KeyU, NONE, A::BrushMode(BrushMode::Spring), H::Draw, "springs and drains: left and right button set them; again: draw"),
    key(K::KeyC, CTRL, A::Take(Take::Copy), H::Draw, "copy: drag a frame around a piece of the world; a click pastes it"),
    key(K::KeyX, CTRL, A::Take(Take::Cut), H::Draw, "cut: the same, and it goes"),
    key(K::KeyV, CTRL, A::TakeUpStamp, H::Draw, "take up the last stamp: a click pastes it, Esc lays it down"),
    key(K::KeyR, SHIFT, A::TurnStamp, H::Draw, "turn the stamp a quarter"),
    key(K::KeyH, SHIFT, A::MirrorStamp, H::Draw, "mirror the stamp, left and right"),
    key(K::KeyV, SHIFT, A::FlipStamp, H::Draw, "mirror the stamp, top and bottom"),
    key(K::KeyZ, CTRL, A::Undo, H::Draw, "undo"),
    key(K::KeyY, CTRL, A::Redo, H::Draw, "redo"),
    key(K::KeyZ, CTRL_SHIFT, A::Redo, H::Draw, "redo"),

    digit(K::Digit1, '1'), digit(K::Digit2, '2'), digit(K::Digit3, '3'), digit(K::Digit4, '4'), digit(K::Digit5, '5'),
    digit(K::Digit6, '6'), digit(K::Digit7, '7'), digit(K::Digit8, '8'), digit(K::Digit9, '9'), digit(K::Digit0, '0'),

    key(K::Space, NONE, A::Pause, H::World, "pause"),
    key(K::KeyP, NONE, A::Pause, H::World, "pause"),
    key(K::KeyF, NONE, A::Step, H::World, "one tick"),
    key(K::Period, NONE, A::Step, H::World, "one tick"),
    key(K::Minus, NONE, A::Speed(-1), H::World, "slower"),
    key(K::NumpadSubtract, NONE, A::Speed(-1), H::World, "slower"),
    key(K::Equal, SHIFT, A::Speed(1), H::World, "faster"),
    key(K::NumpadAdd, NONE, A::Speed(1), H::World, "faster"),
    key(K::Equal, NONE, A::ClearAir, H::World, "clear the air"),
    key(K::Backspace, NONE, A::Rewind, H::World, "hold: back in time, up to 30 s; let go: on from there"),
    key(K::KeyR, NONE, A::Reset, H::World, "reset the scene (can be undone)"),
    key(K::KeyS, CTRL, A::Save, H::World, "save the world"),
    key(K::F9, NONE, A::Record, H::World, "record; again: end the recording and write it"),
    key(K::F9, SHIFT, A::KeepLastMinute, H::World, "write the last minute as a recording"),

    key(K::KeyV, NONE, A::NextView, H::Look, "next view"),
    key(K::KeyZ, NONE, A::Zoom(1), H::Look, "zoom in at the pointer"),
    key(K::KeyZ, SHIFT, A::Zoom(-1), H::Look, "zoom out"),
    wheel(1, CTRL, A::Zoom(1), H::Look, "zoom in at the pointer"),
    wheel(-1, CTRL, A::Zoom(-1), H::Look, "zoom out"),
    key(K::ArrowLeft, NONE, A::Pan(-1, 0), H::Look, "move the picture"),
    key(K::ArrowRight, NONE, A::Pan(1, 0), H::Look, "move the picture"),
    key(K::ArrowUp, NONE, A::Pan(0, 1), H::Look, "move the picture"),
    key(K::ArrowDown, NONE, A::Pan(0, -1), H::Look, "move the picture"),
    key(K::KeyH, NONE, A::Hud, H::Look, "hide the HUD"),
    key(K::KeyM, SHIFT, A::Mute, H::Look, "sound off, and on again"),
    key(K::KeyB, NONE, A::Split, H::Look, "A/B split: the same world at two qualities"),
    key(K::KeyL, NONE, A::Lens, H::Look, "hold, or press once: the truth lens, this moment at reference inside a ring"),
    key(K::KeyG, NONE, A::Gauge, H::Look, "set a gauge under the pointer; on its mark: take it away"),
    key(K::KeyG, SHIFT, A::GaugeLine, H::Look, "begin, and again elsewhere end, a line that measures the flow through it"),
    key(K::F11, NONE, A::FullScreen, H::Look, "full screen"),
    key(K::F2, NONE, A::Screenshot, H::Look, "screenshot that carries its world, and opens as one"),
    #[cfg(target_arch = "wasm32")]
    key(K::F2, SHIFT, A::CopyLink, H::Look, "copy a link to this world (if it is small)"),
    key(K::Escape, NONE, A::Close, H::Look, "close"),
    ]
};

/// One of the keys that an action is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// The action.
    pub action: Action,
    /// Which of its keys, from 0 on.
    pub place: usize,
}

/// Every key, button and turn of the wheel that means something.
#[derive(Resource, Clone, Debug)]
pub struct Bindings {
    /// As the tables have them.
    first: Vec<Binding>,
    /// As they are now.
    now: Vec<Binding>,
}

impl Default for Bindings {
    /// All but the panels' own.
    fn default() -> Self {
        let tools = TOOLS.map(|row| key(row.key, NONE, Action::Tool(Tool::Other(row)), Group::Choose, row.help));
        let views = VIEWS.map(|view| key(view.key, SHIFT, Action::View(view), Group::Look, "choose a view"));
        let first: Vec<Binding> = OWN.iter().copied().chain(tools).chain(views).collect();
        Self { now: first.clone(), first }
    }
}

impl Bindings {
    /// One more.
    pub fn add(&mut self, binding: Binding) {
        self.first.push(binding);
        self.now.push(binding);
    }

    /// All, in the order of the help.
    pub fn iter(&self) -> std::slice::Iter<'_, Binding> {
        self.now.iter()
    }

    /// The action bound to a trigger with exactly these modifiers.
    pub fn find(&self, trigger: Trigger, mods: Mods) -> Option<Action> {
        self.iter().find(|binding| binding.trigger == trigger && binding.mods == mods).map(|binding| binding.action)
    }

    /// The keys of an action, in the order of its places.
    pub fn chords(&self, action: Action) -> Vec<Chord> {
        self.iter().filter(|binding| binding.action == action).filter_map(Binding::chord).collect()
    }

    /// What a key is to an action; nothing if it is free.
    pub fn slot(&self, chord: Chord) -> Option<Slot> {
        let action = self.iter().find(|binding| binding.chord() == Some(chord))?.action;
        let place = self.chords(action).iter().position(|other| *other == chord)?;
        Some(Slot { action, place })
    }

    /// The first row of each action whose keys a player can choose. Esc is none of these keys.
    pub fn changeable(&self) -> Vec<&Binding> {
        let mut found: Vec<&Binding> = Vec::new();
        for binding in self.iter().filter(|binding| binding.chord().is_some() && binding.action != Action::Close) {
            if found.iter().all(|other| other.action != binding.action) {
                found.push(binding);
            }
        }
        found
    }

    /// Puts an action on other keys than it was on. Its rows stay where the first of them stood.
    pub fn set(&mut self, action: Action, chords: &[Chord]) {
        let is_its = |binding: &Binding| binding.action == action && binding.chord().is_some();
        let Some(at) = self.now.iter().position(is_its) else { return };
        let row = self.now[at];
        self.now.retain(|binding| !is_its(binding));
        let rows = chords.iter().map(|chord| Binding { trigger: Trigger::Key(chord.key), mods: chord.mods, ..row });
        self.now.splice(at..at, rows);
    }

    /// Puts all on the keys that the tables have.
    pub fn reset(&mut self) {
        self.now.clone_from(&self.first);
    }

    fn of(&self, action: Action) -> Option<&Binding> {
        self.iter().find(|binding| binding.action == action)
    }

    /// The first key of an action; nothing if it has none.
    pub fn key(&self, action: Action) -> String {
        self.of(action).map(ToString::to_string).unwrap_or_default()
    }

    /// What an action does, in the player's language; nothing if it has no key.
    pub fn help(&self, action: Action) -> String {
        self.of(action).map(|binding| spoken(binding.help)).unwrap_or_default()
    }

    /// What an action does, and its key.
    pub fn tip(&self, action: Action) -> String {
        self.of(action).map(|binding| format!("{} ({binding})", spoken(binding.help))).unwrap_or_default()
    }
}

impl Binding {
    /// Its key with modifiers; nothing if it is a button's or the wheel's.
    pub fn chord(&self) -> Option<Chord> {
        match self.trigger {
            Trigger::Key(key) => Some(Chord::new(key, self.mods)),
            _ => None,
        }
    }
}

impl fmt::Display for Binding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.trigger {
            Trigger::Key(key) => return write!(f, "{}", Chord::new(key, self.mods)),
            Trigger::Button(MouseButton::Left) => tr!("left button"),
            Trigger::Button(MouseButton::Right) => tr!("right button"),
            Trigger::Button(_) => tr!("middle button"),
            Trigger::Wheel(_) => tr!("wheel"),
        };
        write!(f, "{}{name}", self.mods)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::hud;
    use bevy::prelude::App;

    /// Those of the whole game.
    fn all() -> Bindings {
        let mut app = App::new();
        hud::panels::plugin(&mut app);
        app.world().resource::<Bindings>().clone()
    }

    #[test]
    fn no_chord_means_two_things() {
        let bindings = all();
        for (k, a) in bindings.iter().enumerate() {
            for b in bindings.iter().skip(k + 1) {
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
    fn every_binding_has_a_help_and_every_key_can_be_written_into_a_file() {
        for binding in all().iter() {
            assert!(!binding.help.is_empty() && !binding.to_string().is_empty());
            if let Some(chord) = binding.chord().filter(|_| binding.action != Action::Close) {
                assert_eq!(String::from(chord).parse(), Ok(chord), "`{binding}` is no key that can be chosen");
            }
        }
    }

    #[test]
    fn an_action_has_its_rows_at_one_place_whatever_its_keys() {
        let mut bindings = Bindings::default();
        let at = |bindings: &Bindings| bindings.iter().position(|binding| binding.action == Action::Pause);
        let (before, first) = (bindings.chords(Action::Pause), at(&bindings));
        let keys = [KeyCode::KeyU, KeyCode::F8, KeyCode::KeyJ].map(|key| Chord::new(key, SHIFT));
        bindings.set(Action::Pause, &keys);
        assert_eq!((bindings.chords(Action::Pause), at(&bindings)), (keys.to_vec(), first));
        assert_eq!(bindings.slot(keys[2]), Some(Slot { action: Action::Pause, place: 2 }));
        assert_eq!((bindings.slot(before[0]), bindings.key(Action::Pause)), (None, "Shift+U".to_owned()));
        bindings.reset();
        assert_eq!((bindings.chords(Action::Pause), at(&bindings)), (before, first));
    }

    #[test]
    fn modifiers_must_match_exactly() {
        let (bindings, z) = (Bindings::default(), Trigger::Key(KeyCode::KeyZ));
        assert_eq!(bindings.find(z, NONE), Some(Action::Zoom(1)));
        assert_eq!(bindings.find(z, CTRL), Some(Action::Undo));
        assert_eq!(bindings.find(z, CTRL_SHIFT), Some(Action::Redo));
        assert_eq!(bindings.find(z, ALT), None);
        assert_eq!(bindings.find(Trigger::Button(MouseButton::Left), SHIFT), Some(Action::Hold(Gesture::Line)));
    }
}
