//! Choosing keys: for which action the player is asked to press one, and what became of what was pressed.

use crate::game::{
    input::{
        bindings::{Bindings, Slot},
        chord::{Chord, Mods, is_modifier},
        keymap::{Chosen, Keymap},
        layouts::Layout,
    },
    language::spoken,
};
use bevy::prelude::{KeyCode, Mut, Res, Resource, World};
use tr::tr;

/// What is said of the last choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Told {
    /// One line.
    pub text: String,
    /// Whether it could not be done.
    pub warning: bool,
}

/// What is done with keys beside pressing them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KeyOrder {
    /// Put an action on a key.
    Choose(Slot, Chord),
    /// Put all on the keys of a layout, with what has been changed in it.
    Layout(Layout),
    /// Forget what has been changed in the layout.
    Reset,
}

/// Whether keys are being chosen, and what is asked for.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct KeyEditor {
    /// Whether the help lets the player choose keys.
    pub open: bool,
    asked: Option<Slot>,
    told: Option<Told>,
}

impl KeyEditor {
    /// The next key is for this; asked for it again, it is for nothing.
    pub fn ask(&mut self, slot: Slot) {
        self.asked = Some(slot).filter(|slot| self.asked != Some(*slot));
        self.told = None;
    }

    /// What the next key is for, if it does not do what it does.
    pub fn asked(&self) -> Option<Slot> {
        self.asked
    }

    /// What is said of the last choice.
    pub fn told(&self) -> Option<&Told> {
        self.told.as_ref()
    }

    /// A key goes down while one is asked for: what is to be done with it. Esc leaves all as it is, and a modifier waits for its key.
    pub fn hear(&mut self, key: KeyCode, mods: Mods) -> Option<KeyOrder> {
        if is_modifier(key) {
            return None;
        }
        self.told = None;
        let slot = self.asked.take()?;
        (key != KeyCode::Escape).then_some(KeyOrder::Choose(slot, Chord { key, mods }))
    }
}

/// Run condition: the next key is for an action.
pub fn asks(editor: Res<KeyEditor>) -> bool {
    editor.asked.is_some()
}

/// Does something with keys, keeps it, and says what.
pub fn carry_out(world: &mut World, order: KeyOrder) {
    world.resource_scope(|world, mut keymap: Mut<Keymap>| {
        world.resource_scope(|world, mut bindings: Mut<Bindings>| {
            let mut editor = world.resource_mut::<KeyEditor>();
            let text = match order {
                KeyOrder::Choose(slot, chord) => {
                    if let Some(why) = chord.refusal() {
                        let (chord, why) = (chord.to_string(), spoken(why));
                        let text = tr!("Not {chord}: {why}. Press another key; Esc leaves it", chord, why);
                        (editor.asked, editor.told) = (Some(slot), Some(Told { text, warning: true }));
                        return;
                    }
                    choose(&mut keymap, &mut bindings, slot, chord)
                }
                KeyOrder::Layout(layout) => {
                    keymap.lay_out(&mut bindings, layout);
                    match keymap.is_changed() {
                        true => tr!("The keys of {}, with what you changed in it", layout.name()),
                        false => tr!("The keys of {}", layout.name()),
                    }
                }
                KeyOrder::Reset => {
                    keymap.reset(&mut bindings);
                    tr!("All keys are those of {} again", keymap.layout().name())
                }
            };
            let told = match keymap.keep() {
                Ok(()) => Told { text, warning: false },
                Err(fault) => Told { text: tr!("{}, but not kept: {}", text, fault), warning: true },
            };
            (editor.asked, editor.told) = (None, Some(told));
        });
    });
}

/// Puts an action on a key; says what is where now.
fn choose(keymap: &mut Keymap, bindings: &mut Bindings, slot: Slot, chord: Chord) -> String {
    let name = |slot: Slot| slot.action.label(&bindings.help(slot.action));
    let (mine, theirs) = (name(slot), bindings.slot(chord).map(name));
    let chosen = keymap.choose(bindings, slot, chord);
    let chord = chord.to_string();
    match (chosen, theirs) {
        (Chosen::Swapped(other), Some(theirs)) if other.action != slot.action => {
            let now = bindings.chords(other.action)[other.place].to_string();
            tr!("{chord} is for “{mine}” now; “{theirs}”, which had it, is on {now}", chord, mine, theirs, now)
        }
        _ => tr!("{chord} is for “{mine}” now", chord, mine),
    }
}
