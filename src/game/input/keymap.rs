//! Which keys the player has chosen, kept from session to session. The keymap alone changes the table of keys; whoever asks for
//! a key asks that table.
//!
//! A key is never on two actions: what is put on one that is in use changes places with the action there. So whatever is chosen,
//! and in whatever order, no action loses a key.

use crate::game::{
    actions::Action,
    input::{
        bindings::{Bindings, Slot},
        chord::Chord,
        layouts::Layout,
    },
    kept::{KeptFile, parse},
};
use bevy::prelude::{ResMut, Resource};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, mem};

/// The file that they are kept in.
const FILE: &str = "keys.ron";

/// The keys of actions that are not on those of the layout, by the actions' names.
type Changes = BTreeMap<String, Vec<Chord>>;

/// What is kept.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Kept {
    /// The layout that is in force.
    layout: Layout,
    /// What the player has changed in each.
    changes: BTreeMap<Layout, Changes>,
}

/// The layout, and what the player has changed in it.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Keymap {
    kept: Kept,
    file: KeptFile,
}

/// What became of a choice.
#[derive(Clone, Debug, PartialEq)]
pub enum Chosen {
    /// The action is on the key, which was free.
    Free,
    /// It is, and the action that was there is on the key that it had.
    Swapped(Slot),
    /// It was there before.
    Same,
}

impl Keymap {
    /// That of the user. Its file is read when the table of keys is complete.
    pub fn of_user() -> Self {
        Self { file: KeptFile::of_user(FILE), ..Self::default() }
    }

    /// One that a folder keeps.
    #[cfg(test)]
    pub fn of_folder(folder: &std::path::Path) -> Self {
        Self { file: KeptFile::of_folder(folder, FILE), ..Self::default() }
    }

    /// The layout that is in force.
    pub fn layout(&self) -> Layout {
        self.kept.layout
    }

    /// What has been changed in the layout that is in force.
    fn changes(&self) -> Option<&Changes> {
        self.kept.changes.get(&self.kept.layout)
    }

    /// Whether anything is on another key than the layout's.
    pub fn is_changed(&self) -> bool {
        self.changes().is_some()
    }

    /// Whether this action is.
    pub fn has_changed(&self, action: Action) -> bool {
        self.changes().is_some_and(|changes| changes.contains_key(&action.name()))
    }

    /// Reads what is kept, and puts it in force. What is wrong with the file is told in a line of the log.
    fn read(&mut self, bindings: &mut Bindings) {
        self.kept = self.file.read_by(|bytes| read(bytes, bindings));
        self.put_in_force(bindings);
    }

    fn put_in_force(&self, bindings: &mut Bindings) {
        self.kept.layout.put_in_force(bindings);
        for (name, chords) in self.changes().into_iter().flatten() {
            let Some(action) = named(bindings, name) else { continue };
            for (place, chord) in chords.iter().enumerate() {
                swap(bindings, Slot { action, place }, *chord);
            }
        }
    }

    /// Puts an action on a key.
    pub fn choose(&mut self, bindings: &mut Bindings, slot: Slot, chord: Chord) -> Chosen {
        let chosen = swap(bindings, slot, chord);
        let mut layout = bindings.clone();
        self.kept.layout.put_in_force(&mut layout);
        let changes = self.kept.changes.entry(self.kept.layout).or_default();
        // Another version's action is kept for it.
        changes.retain(|name, _| named(&layout, name).is_none());
        for row in layout.changeable() {
            let now = bindings.chords(row.action);
            if now != layout.chords(row.action) {
                changes.insert(row.action.name(), now);
            }
        }
        self.kept.changes.retain(|_, changes| !changes.is_empty());
        chosen
    }

    /// Puts all on the keys of a layout, but what has been changed in that.
    pub fn lay_out(&mut self, bindings: &mut Bindings, layout: Layout) {
        self.kept.layout = layout;
        self.put_in_force(bindings);
    }

    /// Puts all on the keys of the layout that is in force.
    pub fn reset(&mut self, bindings: &mut Bindings) {
        self.kept.changes.remove(&self.kept.layout);
        self.put_in_force(bindings);
    }

    /// Writes it; or says in one line why it is not kept.
    pub fn keep(&self) -> Result<(), String> {
        self.file.write(&self.kept).map_err(|error| error.to_string())
    }
}

/// Reads the keymap's file when the table of keys is complete.
pub fn read_file(mut keymap: ResMut<Keymap>, mut bindings: ResMut<Bindings>) {
    keymap.read(&mut bindings);
}

/// The action that a file calls by a name.
fn named(bindings: &Bindings, name: &str) -> Option<Action> {
    bindings.changeable().into_iter().map(|row| row.action).find(|action| action.name() == name)
}

/// Reads what a file has, and what of it is not to be used. `table` is the complete table of keys.
fn read(bytes: &[u8], table: &Bindings) -> (Kept, Option<String>) {
    let mut foreign = Vec::new();
    match parse(bytes, |kept: &Kept| check(kept, table, &mut foreign)) {
        Ok(kept) => (kept, (!foreign.is_empty()).then(|| format!("without effect: {}", foreign.join(", ")))),
        Err(fault) => (Kept::default(), Some(format!("not read, so keys are as at first: {fault}"))),
    }
}

/// What is wrong with what a file has. The names of actions that this version does not know are `foreign`.
fn check(kept: &Kept, table: &Bindings, foreign: &mut Vec<String>) -> Result<(), String> {
    let mut layout = table.clone();
    for (&name, changes) in &kept.changes {
        name.put_in_force(&mut layout);
        let mut taken: Vec<(Chord, &str)> = Vec::new();
        for (action, chords) in changes {
            let Some(known) = named(&layout, action) else {
                foreign.push(action.clone());
                continue;
            };
            let most = layout.chords(known).len();
            if !(1..=most).contains(&chords.len()) {
                return Err(format!("{action} has {} keys; allowed: 1 … {most}", chords.len()));
            }
            for &chord in chords {
                // What the tables have may change places with anything, even where the browser takes it.
                if let Some(why) = chord.refusal().filter(|_| layout.slot(chord).is_none()) {
                    return Err(format!("{action} is on {chord}: {why}"));
                }
                if let Some((_, other)) = taken.iter().find(|(other, _)| *other == chord) {
                    return Err(format!("{chord} is the key of {other} and of {action}; allowed: one of them"));
                }
                taken.push((chord, action));
            }
        }
    }
    Ok(())
}

/// Puts an action on a key; what was there changes places with it.
fn swap(bindings: &mut Bindings, slot: Slot, chord: Chord) -> Chosen {
    let mut chords = bindings.chords(slot.action);
    let Some(mine) = chords.get_mut(slot.place) else { return Chosen::Same };
    let before = mem::replace(mine, chord);
    let other = bindings.slot(chord);
    match other {
        Some(other) if other == slot => return Chosen::Same,
        Some(other) if other.action == slot.action => chords[other.place] = before,
        Some(other) => {
            let mut theirs = bindings.chords(other.action);
            theirs[other.place] = before;
            bindings.set(other.action, &theirs);
        }
        None => {}
    }
    bindings.set(slot.action, &chords);
    other.map_or(Chosen::Free, Chosen::Swapped)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::{
        hud,
        input::{
            bindings::{NONE, SHIFT, Trigger},
            chord::CTRL,
        },
    };
    use bevy::prelude::{App, KeyCode};
    use std::{collections::BTreeSet, fs};

    /// Those of the whole game.
    fn table() -> Bindings {
        let mut app = App::new();
        hud::panels::plugin(&mut app);
        app.world().resource::<Bindings>().clone()
    }

    const PAUSE: Slot = Slot { action: Action::Pause, place: 0 };

    fn key(key: KeyCode) -> Chord {
        Chord::new(key, NONE)
    }

    fn does(bindings: &Bindings, chord: Chord) -> Option<Action> {
        bindings.find(Trigger::Key(chord.key), chord.mods)
    }

    /// How many keys each action has; panics if one key is on two.
    fn counts(bindings: &Bindings) -> Vec<(String, usize)> {
        let chords: Vec<Chord> = bindings.iter().filter_map(|binding| binding.chord()).collect();
        let unlike: BTreeSet<String> = chords.iter().map(|chord| String::from(*chord)).collect();
        assert_eq!(unlike.len(), chords.len(), "a key is on two actions");
        let mut counts: Vec<_> =
            bindings.changeable().iter().map(|row| (row.action.name(), bindings.chords(row.action).len())).collect();
        counts.sort();
        counts
    }

    #[test]
    fn every_action_has_a_name_and_a_label_of_its_own() {
        let table = table();
        let rows = table.changeable();
        let names: BTreeSet<String> = rows.iter().map(|row| row.action.name()).collect();
        let labels: BTreeSet<String> = rows.iter().map(|row| row.action.label(row.help)).collect();
        assert_eq!((names.len(), labels.len()), (rows.len(), rows.len()), "{labels:?}");
        assert!(labels.iter().all(|label| !label.is_empty() && label.chars().count() <= 48), "{labels:?}");
        // Files of before have these.
        for name in
            ["Pause", "Speed(-1)", "Element(3)", "Tool(heat)", "View(Speed)", "Panel(help)", "Take(Copy)", "Pan(0, 1)"]
        {
            assert!(names.contains(name), "{name} is in no list of {names:?}");
        }
    }

    #[test]
    fn a_free_key_is_taken_and_the_old_one_is_free() {
        let (mut bindings, mut keymap) = (table(), Keymap::default());
        let free = Chord::new(KeyCode::F8, CTRL);
        assert_eq!(keymap.choose(&mut bindings, PAUSE, free), Chosen::Free);
        assert_eq!((does(&bindings, free), does(&bindings, key(KeyCode::Space))), (Some(Action::Pause), None));
        assert_eq!(does(&bindings, key(KeyCode::KeyP)), Some(Action::Pause), "its other key stays");
        assert!(keymap.has_changed(Action::Pause) && !keymap.has_changed(Action::Step));
        keymap.choose(&mut bindings, PAUSE, key(KeyCode::Space));
        assert!(!keymap.is_changed(), "all is as it was");
    }

    #[test]
    fn a_key_in_use_changes_places_and_none_is_ever_lost() {
        let (mut bindings, mut keymap) = (table(), Keymap::default());
        let wind = does(&bindings, key(KeyCode::KeyW)).expect("W is a tool's");
        let there = Slot { action: wind, place: 0 };
        assert_eq!(keymap.choose(&mut bindings, PAUSE, key(KeyCode::KeyW)), Chosen::Swapped(there));
        assert_eq!(does(&bindings, key(KeyCode::KeyW)), Some(Action::Pause));
        assert_eq!(does(&bindings, key(KeyCode::Space)), Some(wind));
        assert_eq!(keymap.choose(&mut bindings, PAUSE, key(KeyCode::KeyW)), Chosen::Same);
        let own = Slot { place: 1, ..PAUSE };
        assert_eq!(keymap.choose(&mut bindings, PAUSE, key(KeyCode::KeyP)), Chosen::Swapped(own));
        // Each key of each action in turn on the key of one that is far from it.
        let (before, slots) = (counts(&bindings), every_slot(&bindings));
        for (k, slot) in slots.iter().enumerate() {
            let other = slots[(k * 7 + 3) % slots.len()];
            let chord = bindings.chords(other.action)[other.place];
            keymap.choose(&mut bindings, *slot, chord);
            assert_eq!(does(&bindings, chord), Some(slot.action));
            assert_eq!(counts(&bindings), before);
        }
        let mut again = table();
        keymap.put_in_force(&mut again);
        assert_eq!(chords(&again), chords(&bindings), "what is kept says it all");
    }

    fn every_slot(bindings: &Bindings) -> Vec<Slot> {
        let actions = bindings.changeable().into_iter().map(|row| row.action);
        let slots = |action| (0..bindings.chords(action).len()).map(move |place| Slot { action, place });
        actions.flat_map(slots).collect()
    }

    fn chords(bindings: &Bindings) -> Vec<(String, Vec<Chord>)> {
        bindings.changeable().iter().map(|row| (row.action.name(), bindings.chords(row.action))).collect()
    }

    #[test]
    fn each_layout_keeps_its_own_changes() {
        let (mut bindings, mut keymap) = (table(), Keymap::default());
        keymap.choose(&mut bindings, PAUSE, key(KeyCode::KeyU));
        keymap.lay_out(&mut bindings, Layout::PowderToy);
        assert_eq!(does(&bindings, key(KeyCode::Space)), Some(Action::Pause));
        assert!(!keymap.is_changed());
        keymap.choose(&mut bindings, PAUSE, key(KeyCode::KeyN));
        keymap.lay_out(&mut bindings, Layout::PowderMaster);
        assert_eq!(bindings.chords(Action::Pause), [key(KeyCode::KeyU), key(KeyCode::KeyP)]);
        keymap.reset(&mut bindings);
        assert_eq!(chords(&bindings), chords(&table()));
        keymap.lay_out(&mut bindings, Layout::PowderToy);
        assert_eq!(bindings.chords(Action::Pause), [key(KeyCode::KeyN)]);
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn what_is_chosen_outlives_the_session() {
        let folder = std::env::temp_dir().join(format!("powder-keys-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        let (mut bindings, mut keymap) = (table(), Keymap::of_folder(&folder));
        keymap.read(&mut bindings);
        assert_eq!((chords(&bindings), folder.exists()), (chords(&table()), false), "there is no file yet");
        keymap.lay_out(&mut bindings, Layout::PowderToy);
        keymap.choose(&mut bindings, PAUSE, Chord::new(KeyCode::KeyW, SHIFT));
        keymap.choose(&mut bindings, Slot { action: Action::Undo, place: 0 }, key(KeyCode::KeyE));
        keymap.keep().expect("the folder of temporary files can be written");
        let (mut read, mut again) = (table(), Keymap::of_folder(&folder));
        again.read(&mut read);
        assert_eq!(again, keymap);
        assert_eq!(chords(&read), chords(&bindings));
        fs::write(folder.join(FILE), b"(layout: ").expect("it is ours");
        again.read(&mut read);
        assert_eq!(chords(&read), chords(&table()), "what is damaged is left out");
        fs::remove_dir_all(folder).expect("it is ours");
        let nowhere = Keymap::of_folder(std::path::Path::new("/dev/null/nowhere"));
        assert!(nowhere.keep().is_err_and(|fault| fault.lines().count() == 1));
    }

    #[test]
    fn a_file_that_is_damaged_or_has_a_key_twice_is_refused_in_one_line() {
        let table = table();
        let of = |changes: &str| format!("(layout: PowderMaster, changes: {{PowderMaster: {{{changes}}}}})");
        for (text, part) in [
            (String::new(), ""),
            ("(layout: PowderMaster".to_owned(), ""),
            ("(layout: Qwerty)".to_owned(), "Qwerty"),
            ("(keys: {})".to_owned(), "keys"),
            (of("\"Pause\": [\"KeyU\""), ""),
            (of("\"Pause\": [\"U\"]"), "\"U\" is no key"),
            (of("\"Pause\": [\"Strg+KeyU\"]"), "Strg"),
            (of("\"Pause\": []"), "allowed: 1 … 2"),
            (of("\"Pause\": [\"KeyU\", \"KeyN\", \"F8\"]"), "has 3 keys"),
            (of("\"Pause\": [\"Alt+F4\"]"), "the system"),
            (of("\"Pause\": [\"KeyU\"], \"Step\": [\"KeyU\"]"), "U is the key of Pause and of Step"),
            (of("\"Pause\": [\"KeyU\", \"KeyU\"]"), "Pause and of Pause"),
        ] {
            let (kept, fault) = read(text.as_bytes(), &table);
            assert_eq!(kept, Kept::default());
            let fault = fault.expect("it is damaged");
            assert!(fault.starts_with("not read") && fault.contains(part) && fault.lines().count() == 1, "{fault}");
        }
        assert!(read(b"\xff\xfe", &table).1.is_some_and(|fault| fault.lines().count() == 1));
    }

    #[test]
    fn another_version_s_action_has_no_effect_and_its_keys_stay_in_the_file() {
        let table = table();
        let text = "(changes: {PowderMaster: {\"Fly\": [\"KeyU\"], \"Pause\": [\"KeyW\"]}})";
        let (kept, fault) = read(text.as_bytes(), &table);
        assert_eq!(fault.as_deref(), Some("without effect: Fly"));
        let (mut keymap, mut bindings) = (Keymap { kept, ..Keymap::default() }, table.clone());
        keymap.put_in_force(&mut bindings);
        // The file says nothing of the tool on W, which may be new: it has the key that is given up.
        let wind = does(&table, key(KeyCode::KeyW));
        assert_eq!(bindings.chords(Action::Pause), [key(KeyCode::KeyW), key(KeyCode::KeyP)]);
        assert_eq!((does(&bindings, key(KeyCode::Space)), counts(&bindings)), (wind, counts(&table)));
        keymap.choose(&mut bindings, PAUSE, key(KeyCode::KeyN));
        assert_eq!(keymap.changes().and_then(|changes| changes.get("Fly")), Some(&vec![key(KeyCode::KeyU)]));
    }
}
