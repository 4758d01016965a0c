//! A key with the modifiers that are held with it: as it is pressed, as a file has it, as a player reads it.

use bevy::prelude::{ButtonInput, KeyCode};
use serde::{Deserialize, Serialize};
use std::{fmt, mem, str::FromStr};
use tr::tr;

/// The modifier keys that must be held, and no others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Mods {
    /// Ctrl, or Cmd on a Mac.
    pub ctrl: bool,
    /// Shift.
    pub shift: bool,
    /// Alt.
    pub alt: bool,
}

/// No modifier.
pub const NONE: Mods = Mods { ctrl: false, shift: false, alt: false };
/// Ctrl alone.
pub const CTRL: Mods = Mods { ctrl: true, ..NONE };
/// Shift alone.
pub const SHIFT: Mods = Mods { shift: true, ..NONE };
/// Alt alone.
pub const ALT: Mods = Mods { alt: true, ..NONE };
/// Ctrl and Shift.
pub const CTRL_SHIFT: Mods = Mods { ctrl: true, shift: true, ..NONE };

/// The keys that can't be more than held with others.
const MODIFIERS: [KeyCode; 8] = {
    use KeyCode as K;
    [K::ControlLeft, K::ControlRight, K::SuperLeft, K::SuperRight, K::ShiftLeft, K::ShiftRight, K::AltLeft, K::AltRight]
};

/// The keys that an action can be on. The system has the others: locks, the keys of media and power, those of input methods.
#[rustfmt::skip]
const KEYS: &[KeyCode] = {
    use KeyCode as K;
    &[
        K::KeyA, K::KeyB, K::KeyC, K::KeyD, K::KeyE, K::KeyF, K::KeyG, K::KeyH, K::KeyI, K::KeyJ, K::KeyK, K::KeyL, K::KeyM,
        K::KeyN, K::KeyO, K::KeyP, K::KeyQ, K::KeyR, K::KeyS, K::KeyT, K::KeyU, K::KeyV, K::KeyW, K::KeyX, K::KeyY, K::KeyZ,
        K::Digit1, K::Digit2, K::Digit3, K::Digit4, K::Digit5, K::Digit6, K::Digit7, K::Digit8, K::Digit9, K::Digit0,
        K::Backquote, K::Minus, K::Equal, K::BracketLeft, K::BracketRight, K::Backslash, K::IntlBackslash, K::Semicolon,
        K::Quote, K::Comma, K::Period, K::Slash, K::Space, K::Tab, K::Enter, K::Backspace, K::Insert, K::Delete, K::Home,
        K::End, K::PageUp, K::PageDown, K::ArrowLeft, K::ArrowRight, K::ArrowUp, K::ArrowDown,
        K::Numpad0, K::Numpad1, K::Numpad2, K::Numpad3, K::Numpad4, K::Numpad5, K::Numpad6, K::Numpad7, K::Numpad8, K::Numpad9,
        K::NumpadAdd, K::NumpadSubtract, K::NumpadMultiply, K::NumpadDivide, K::NumpadDecimal, K::NumpadEnter,
        K::F1, K::F2, K::F3, K::F4, K::F5, K::F6, K::F7, K::F8, K::F9, K::F10, K::F11, K::F12,
        K::F13, K::F14, K::F15, K::F16, K::F17, K::F18, K::F19, K::F20, K::F21, K::F22, K::F23, K::F24,
    ]
};

impl Mods {
    /// The modifiers that are held now.
    pub fn held(keys: &ButtonInput<KeyCode>) -> Self {
        let mut held = NONE;
        keys.get_pressed().for_each(|key| held.follow(*key, true));
        held
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

    /// Whether all of these are among `held`.
    pub fn are_among(self, held: Self) -> bool {
        (!self.ctrl || held.ctrl) && (!self.shift || held.shift) && (!self.alt || held.alt)
    }

    /// What a file calls them.
    fn names(self) -> impl Iterator<Item = &'static str> {
        let all = [(self.ctrl, "Ctrl"), (self.shift, "Shift"), (self.alt, "Alt")];
        all.into_iter().filter_map(|(held, name)| held.then_some(name))
    }
}

/// What stands before the key, as a player reads it: `Ctrl+Shift+`.
impl fmt::Display for Mods {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.names().try_for_each(|name| write!(f, "{}+", tr!("key" => name)))
    }
}

/// Whether a key is a modifier.
pub fn is_modifier(key: KeyCode) -> bool {
    MODIFIERS.contains(&key)
}

/// A key, and the modifiers that are held with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Chord {
    /// The physical key.
    pub key: KeyCode,
    /// What must be held with it.
    pub mods: Mods,
}

impl Chord {
    /// A key with modifiers.
    pub const fn new(key: KeyCode, mods: Mods) -> Self {
        Self { key, mods }
    }

    /// Why no action can be on it, in English; nothing if one can.
    pub fn refusal(self) -> Option<&'static str> {
        use KeyCode as K;
        let Self { key, mods } = self;
        let is_function = format!("{key:?}").strip_prefix('F').is_some_and(|number| number.parse::<u8>().is_ok());
        match key {
            K::Escape => Some("Esc always closes and leaves"),
            _ if !KEYS.contains(&key) => Some("the system has that key"),
            K::Tab | K::Space | K::F4 if mods.alt => Some("the system has it: it changes, moves or closes windows"),
            K::Delete | K::Backspace if mods.alt && mods.ctrl => Some("the system has it: it ends the session"),
            _ if is_function && mods.alt && mods.ctrl => Some("the system has it: it changes the screen"),
            K::KeyQ | K::KeyW | K::KeyH | K::KeyM if mods.ctrl && cfg!(target_os = "macos") => {
                Some("the system has it: it hides or closes windows")
            }
            _ if cfg!(target_arch = "wasm32") && self.is_the_browsers() => Some("the browser has it"),
            _ => None,
        }
    }

    /// Whether a browser takes it: what `web/page.js` does not keep from it, but for what does nothing in a page without a text.
    fn is_the_browsers(self) -> bool {
        use KeyCode as K;
        let with_control = [K::KeyS, K::KeyO, K::KeyZ, K::KeyY, K::KeyC, K::KeyX, K::KeyV, K::Semicolon];
        let own = [K::F5, K::F6, K::F7, K::F12];
        self.mods.alt || own.contains(&self.key) || self.mods.ctrl && !with_control.contains(&self.key)
    }
}

/// As a file has it: modifiers and the W3C's name of the key, `Ctrl+Shift+KeyZ`.
impl From<Chord> for String {
    fn from(chord: Chord) -> Self {
        let held: String = chord.mods.names().flat_map(|name| [name, "+"]).collect();
        format!("{held}{:?}", chord.key)
    }
}

impl TryFrom<String> for Chord {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl FromStr for Chord {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (held, name) = text.rsplit_once('+').map_or((None, text), |(held, name)| (Some(held), name));
        let mut mods = NONE;
        for part in held.into_iter().flat_map(|held| held.split('+')) {
            let held = match part {
                "Ctrl" => &mut mods.ctrl,
                "Shift" => &mut mods.shift,
                "Alt" => &mut mods.alt,
                _ => return Err(format!("{text:?}: {part:?} is not held with a key; allowed: Ctrl, Shift, Alt")),
            };
            if mem::replace(held, true) {
                return Err(format!("{text:?}: {part} stands twice"));
            }
        }
        let key = KEYS.iter().copied().find(|key| format!("{key:?}") == name);
        let key = key.ok_or_else(|| {
            format!("{text:?}: {name:?} is no key to choose; allowed: names such as KeyA, Digit1, F1, ArrowLeft, Space")
        })?;
        Ok(Self { key, mods })
    }
}

/// As a player reads it.
impl fmt::Display for Chord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Two keys are known by what Shift makes of them.
        match (self.key, self.mods) {
            (KeyCode::Slash, SHIFT) => return f.write_str("?"),
            (KeyCode::Equal, SHIFT) => return f.write_str("+"),
            _ => {}
        }
        write!(f, "{}{}", self.mods, key_name(self.key))
    }
}

/// What is printed on a key of a US keyboard, but words in the player's language. The keys have the names of the W3C:
/// `KeyA`, `Digit1`, `F1`, `ArrowLeft`.
fn key_name(key: KeyCode) -> String {
    let name = format!("{key:?}");
    if let Some(name) = name.strip_prefix("Numpad") {
        let sign = match name {
            "Add" => "+",
            "Subtract" => "-",
            "Multiply" => "*",
            "Divide" => "/",
            "Decimal" => ".",
            _ => name,
        };
        let sign = tr!("key" => sign);
        return tr!("num {}", sign);
    }
    let sign = match name.as_str() {
        "ArrowLeft" => "left",
        "ArrowRight" => "right",
        "ArrowUp" => "up",
        "ArrowDown" => "down",
        "Escape" => "Esc",
        "Period" => ".",
        "Comma" => ",",
        "Minus" => "-",
        "Equal" => "=",
        "Slash" => "/",
        "Backslash" => "\\",
        "IntlBackslash" => "<",
        "Semicolon" => ";",
        "Quote" => "'",
        "Backquote" => "`",
        "BracketLeft" => "[",
        "BracketRight" => "]",
        "PageUp" => "Page up",
        "PageDown" => "Page down",
        name => name.trim_start_matches("Key").trim_start_matches("Digit"),
    };
    tr!("key" => sign)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chord_is_read_as_it_is_written_and_each_has_a_name_of_its_own() {
        let all = [NONE, CTRL, SHIFT, ALT, CTRL_SHIFT, Mods { ctrl: true, shift: true, alt: true }];
        let mut names = std::collections::BTreeSet::new();
        for &key in KEYS {
            for mods in all {
                let chord = Chord { key, mods };
                assert_eq!(String::from(chord).parse(), Ok(chord));
                assert!(names.insert(chord.to_string()), "`{chord}` is two chords");
            }
            let name = key_name(key);
            assert!(
                !["Key", "Digit", "Arrow", "Numpad", "Bracket"].iter().any(|word| name.contains(word)),
                "`{name}` is printed on no key"
            );
        }
        assert_eq!(String::from(Chord::new(KeyCode::KeyZ, CTRL_SHIFT)), "Ctrl+Shift+KeyZ");
        assert_eq!(Chord::new(KeyCode::KeyZ, CTRL_SHIFT).to_string(), "Ctrl+Shift+Z");
    }

    #[test]
    fn what_is_no_chord_is_said_in_one_line() {
        for (text, part) in [
            ("", "no key"),
            ("KeyÄ", "no key"),
            ("keya", "no key"),
            ("Escape", "no key"),
            ("Ctrl+", "no key"),
            ("Ctrl+ShiftLeft", "no key"),
            ("Strg+KeyZ", "not held"),
            ("+KeyZ", "not held"),
            ("Ctrl+Ctrl+KeyZ", "twice"),
        ] {
            let fault = text.parse::<Chord>().expect_err(text);
            assert!(fault.contains(part) && fault.lines().count() == 1, "{text}: {fault}");
        }
    }

    #[test]
    fn what_the_system_has_is_refused() {
        use KeyCode as K;
        let ctrl_alt = Mods { ctrl: true, alt: true, ..NONE };
        for (key, mods) in
            [(K::Escape, NONE), (K::Escape, CTRL), (K::CapsLock, NONE), (K::PrintScreen, NONE), (K::F4, ALT)]
        {
            assert!(Chord { key, mods }.refusal().is_some(), "{key:?} {mods:?}");
        }
        assert!(Chord::new(K::F2, ctrl_alt).refusal().is_some());
        assert!(Chord::new(K::Delete, ctrl_alt).refusal().is_some());
        for (key, mods) in [(K::KeyF, NONE), (K::F4, NONE), (K::Tab, SHIFT), (K::Delete, CTRL_SHIFT)] {
            assert_eq!(Chord { key, mods }.refusal().filter(|_| !cfg!(target_arch = "wasm32")), None, "{key:?}");
        }
    }

    #[test]
    fn modifiers_are_followed_and_compared() {
        let mut mods = NONE;
        for (key, down) in [(KeyCode::ShiftLeft, true), (KeyCode::ControlRight, true), (KeyCode::KeyA, true)] {
            mods.follow(key, down);
        }
        assert_eq!(mods, CTRL_SHIFT);
        assert!(SHIFT.are_among(mods) && NONE.are_among(mods) && !ALT.are_among(mods) && !mods.are_among(CTRL));
    }
}
