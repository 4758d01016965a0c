//! Layouts of keys that come with the game: its own, and those that players bring along from elsewhere.

use crate::game::{
    actions::{Action, PanelId, Take},
    favourites::DIGITS,
    input::{
        bindings::Bindings,
        chord::{CTRL, CTRL_SHIFT, Chord, Mods, NONE, SHIFT},
    },
};
use bevy::prelude::KeyCode;
use serde::{Deserialize, Serialize};

/// A layout of keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Layout {
    /// The keys of the tables.
    #[default]
    PowderMaster,
    /// Those that The Powder Toy's README names, for what both can do.
    PowderToy,
}

const fn on(key: KeyCode, mods: Mods) -> Chord {
    Chord::new(key, mods)
}

/// What The Powder Toy has on other keys than this game: what its README, of April 2024, says of controls. What this game needs a
/// key for and The Powder Toy has one of its own on stands below the line.
#[rustfmt::skip]
const POWDER_TOY: &[(Action, &[Chord])] = {
    use {Action as A, KeyCode as K};
    &[
    (A::Pause, &[on(K::Space, NONE)]),
    (A::Screenshot, &[on(K::KeyP, NONE), on(K::F2, NONE)]),
    (A::Take(Take::Copy), &[on(K::KeyS, NONE), on(K::KeyC, CTRL)]),
    (A::TakeUpStamp, &[on(K::KeyL, NONE), on(K::KeyV, CTRL)]),
    (A::TurnStamp, &[on(K::KeyR, NONE)]),
    (A::MirrorStamp, &[on(K::KeyR, SHIFT)]),
    (A::FlipStamp, &[on(K::KeyR, CTRL_SHIFT)]),
    (A::Panel(PanelId("details")), &[on(K::KeyD, NONE), on(K::F3, NONE)]),
    (A::Panel(PanelId("help")), &[on(K::F1, NONE), on(K::KeyH, CTRL)]),
    // ---
    (A::Lens, &[on(K::KeyL, SHIFT)]),
    (A::Reset, &[on(K::Home, NONE)]),
    ]
};

impl Layout {
    /// All, ours first.
    pub const ALL: [Self; 2] = [Self::PowderMaster, Self::PowderToy];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::PowderMaster => "Powder Master",
            Self::PowderToy => "The Powder Toy",
        }
    }

    /// Puts all on its keys. What the system has here is left out; an action with nothing else stays where it was.
    pub fn put_in_force(self, bindings: &mut Bindings) {
        bindings.reset();
        if self == Self::PowderMaster {
            return;
        }
        swap_views_and_favourites(bindings);
        for (action, chords) in POWDER_TOY {
            let free: Vec<Chord> = chords.iter().copied().filter(|chord| chord.refusal().is_none()).collect();
            if !free.is_empty() {
                bindings.set(*action, &free);
            }
        }
    }
}

/// The digits alone choose views there; favourites, which it has not, are chosen with Shift.
fn swap_views_and_favourites(bindings: &mut Bindings) {
    let views =
        bindings.changeable().into_iter().map(|row| row.action).filter(|action| matches!(action, Action::View(_)));
    for (action, mods) in views
        .collect::<Vec<_>>()
        .into_iter()
        .map(|view| (view, NONE))
        .chain(DIGITS.map(|digit| (Action::Element(digit), SHIFT)))
    {
        let chords: Vec<Chord> = bindings.chords(action).into_iter().map(|chord| Chord { mods, ..chord }).collect();
        bindings.set(action, &chords);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::{hud, input::bindings::Trigger};
    use bevy::prelude::App;

    #[test]
    fn no_layout_has_a_conflict_or_leaves_an_action_without_a_key() {
        let mut app = App::new();
        hud::panels::plugin(&mut app);
        let first = app.world().resource::<Bindings>().clone();
        for layout in Layout::ALL {
            let mut bindings = first.clone();
            layout.put_in_force(&mut bindings);
            for (k, a) in bindings.iter().enumerate() {
                for b in bindings.iter().skip(k + 1) {
                    assert!(
                        a.trigger != b.trigger || a.mods != b.mods,
                        "{layout:?}: `{a}`: {:?}, {:?}",
                        a.action,
                        b.action
                    );
                }
            }
            for row in first.changeable() {
                assert!(!bindings.chords(row.action).is_empty(), "{layout:?}: {:?} has no key", row.action);
            }
            assert_eq!(bindings.changeable().len(), first.changeable().len());
        }
    }

    #[test]
    fn the_powder_toy_s_keys_do_what_its_readme_says() {
        let mut app = App::new();
        hud::panels::plugin(&mut app);
        let mut bindings = app.world().resource::<Bindings>().clone();
        for (action, _) in POWDER_TOY {
            assert!(!bindings.chords(*action).is_empty(), "{action:?} is no action of the table");
        }
        Layout::PowderToy.put_in_force(&mut bindings);
        for (key, mods, action) in [
            (KeyCode::Tab, NONE, Action::BrushShape),
            (KeyCode::Space, NONE, Action::Pause),
            (KeyCode::KeyZ, NONE, Action::Zoom(1)),
            (KeyCode::KeyS, NONE, Action::Take(Take::Copy)),
            (KeyCode::KeyL, NONE, Action::TakeUpStamp),
            (KeyCode::KeyK, NONE, Action::Panel(PanelId("stamps"))),
            (KeyCode::KeyP, NONE, Action::Screenshot),
            (KeyCode::F2, NONE, Action::Screenshot),
            (KeyCode::KeyE, NONE, Action::Panel(PanelId("elements"))),
            (KeyCode::KeyF, NONE, Action::Step),
            (KeyCode::KeyH, NONE, Action::Hud),
            (KeyCode::F1, NONE, Action::Panel(PanelId("help"))),
            (KeyCode::KeyD, NONE, Action::Panel(PanelId("details"))),
            (KeyCode::F3, NONE, Action::Panel(PanelId("details"))),
            (KeyCode::Equal, NONE, Action::ClearAir),
            (KeyCode::BracketLeft, NONE, Action::Brush(-1)),
            (KeyCode::BracketRight, NONE, Action::Brush(1)),
            (KeyCode::KeyC, CTRL, Action::Take(Take::Copy)),
            (KeyCode::KeyX, CTRL, Action::Take(Take::Cut)),
            (KeyCode::KeyV, CTRL, Action::TakeUpStamp),
            (KeyCode::KeyZ, CTRL, Action::Undo),
            (KeyCode::KeyY, CTRL, Action::Redo),
            (KeyCode::KeyR, NONE, Action::TurnStamp),
            (KeyCode::KeyR, SHIFT, Action::MirrorStamp),
            (KeyCode::F11, NONE, Action::FullScreen),
        ] {
            assert_eq!(bindings.find(Trigger::Key(key), mods), Some(action), "{}", Chord { key, mods });
        }
        let first_view = bindings.find(Trigger::Key(KeyCode::Digit1), NONE);
        assert!(matches!(first_view, Some(Action::View(_))), "{first_view:?}");
        assert_eq!(bindings.find(Trigger::Key(KeyCode::Digit1), SHIFT), Some(Action::Element('1')));
    }
}
