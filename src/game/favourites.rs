//! Favourites: which element each digit chooses. The only place that knows. What a table of elements gives a digit as its
//! `key` holds until the player puts another element there; what the player has put is kept from session to session.
//!
//! Elements go by their names: tables differ from world to world, and so do their ids.

use crate::{
    game::{
        actions::Action, input::bindings::Bindings, kept::KeptFile, language::spoken, toasts::Toasts, tools::spaced,
    },
    kernel::element::{ElementId, ElementTable},
    sim::state::Setup,
};
use bevy::prelude::{Mut, Resource, World};
use std::{collections::BTreeMap, path::Path};
use tr::tr;

/// The digits, in the order of their keys.
pub const DIGITS: [char; 10] = ['1', '2', '3', '4', '5', '6', '7', '8', '9', '0'];

/// The file that they are kept in.
const FILE: &str = "favourites.ron";

/// Which element is on which digit.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Favourites {
    /// What the player has put on digits; no name stands twice.
    put: BTreeMap<char, String>,
    file: KeptFile,
}

impl Favourites {
    /// Those of the user. What is wrong with the file is told in a line of the log.
    pub fn of_user() -> Self {
        Self::of_file(KeptFile::of_user(FILE))
    }

    /// Those that a folder keeps, or none yet.
    pub fn of_folder(folder: &Path) -> Self {
        Self::of_file(KeptFile::of_folder(folder, FILE))
    }

    fn of_file(file: KeptFile) -> Self {
        Self { put: file.read_by(read), file }
    }

    /// The element on each of the [`DIGITS`].
    pub fn slots(&self, elements: &ElementTable) -> [Option<ElementId>; DIGITS.len()] {
        let mut slots = DIGITS.map(|digit| self.put.get(&digit).and_then(|name| elements.find(name)));
        for (place, digit) in DIGITS.into_iter().enumerate() {
            if slots[place].is_none() {
                let own = elements.iter().find(|(_, element)| element.key == Some(digit)).map(|(id, _)| id);
                slots[place] = own.filter(|id| !slots.contains(&Some(*id)));
            }
        }
        slots
    }

    /// The element on a digit.
    pub fn element(&self, digit: char, elements: &ElementTable) -> Option<ElementId> {
        let place = DIGITS.iter().position(|other| *other == digit)?;
        self.slots(elements)[place]
    }

    /// The digit that an element is on.
    pub fn digit(&self, element: ElementId, elements: &ElementTable) -> Option<char> {
        let place = self.slots(elements).iter().position(|other| *other == Some(element))?;
        Some(DIGITS[place])
    }

    /// Puts an element on a digit. If it was on another one, what was here goes there; says what and where.
    fn put(&mut self, digit: char, element: ElementId, elements: &ElementTable) -> Option<(ElementId, char)> {
        let (before, from) = (self.element(digit, elements), self.digit(element, elements));
        let name = |id| elements.get(id).name.clone();
        // A name that this table lacks may be put elsewhere by another: it never stands twice.
        self.put.retain(|_, other| *other != elements.get(element).name);
        self.put.insert(digit, name(element));
        let swapped = before.zip(from).filter(|(_, from)| *from != digit);
        if let Some((before, from)) = swapped {
            self.put.retain(|_, other| *other != elements.get(before).name);
            self.put.insert(from, name(before));
        }
        swapped
    }
}

/// Reads what a file has put on digits, and what of it is not to be used.
fn read(bytes: &[u8]) -> (BTreeMap<char, String>, Option<String>) {
    let read: BTreeMap<char, String> = match ron::de::from_bytes(bytes) {
        Ok(read) => read,
        Err(error) => return (BTreeMap::new(), Some(format!("not read, so digits are as at first: {error}"))),
    };
    let (mut put, mut foreign) = (BTreeMap::<char, String>::new(), Vec::new());
    for (digit, name) in read {
        // A name that no table has now may be that of an element of the player's own, or of another world: it stays, and its
        // digit has the default meanwhile.
        if DIGITS.contains(&digit) && !put.values().any(|other| *other == name) {
            put.insert(digit, name);
        } else {
            foreign.push(format!("{digit:?}: {name:?}"));
        }
    }
    let fault = (!foreign.is_empty()).then(|| format!("without effect: {}", foreign.join(", ")));
    (put, fault)
}

/// Puts the element called `name` on a digit and keeps that.
pub fn put(world: &mut World, digit: char, name: &str) {
    world.resource_scope(|world, mut favourites: Mut<Favourites>| {
        let Some(setup) = world.get_resource::<Setup>() else { return };
        let elements = setup.elements();
        let Some(element) = elements.find(name) else { return };
        let swapped = favourites.put(digit, element, elements);
        let key = |digit| world.resource::<Bindings>().key(Action::Element(digit));
        let (name, here) = (spoken(&spaced(name)), key(digit));
        let told = match swapped {
            Some((id, from)) => {
                let (other, there) = (spoken(&spaced(&elements.get(id).name)), key(from));
                tr!("{name} is on {here} now, {other} on {there}", name, here, other, there)
            }
            None => tr!("{name} is on {here} now", name, here),
        };
        let kept = favourites.file.write(&favourites.put);
        let mut toasts = world.resource_mut::<Toasts>();
        match kept {
            Ok(()) => toasts.say(told),
            Err(error) => toasts.warn(tr!("{told}, but not kept: {error}", told, error)),
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::Element;
    use std::{fs, path::PathBuf};

    /// Water on 1 and oil on 2; tar has no digit.
    fn table() -> ElementTable {
        let row = |name, key| Element { key, ..Element::plain(name, false) };
        ElementTable::new(vec![row("water", Some('1')), row("tar", None), row("oil", Some('2'))])
    }

    fn on(favourites: &Favourites, digits: &str) -> Vec<String> {
        let table = table();
        let name = |digit| favourites.element(digit, &table).map_or("", |id| &table.get(id).name).to_owned();
        digits.chars().map(name).collect()
    }

    fn put(favourites: &mut Favourites, digit: char, name: &str) {
        let table = table();
        favourites.put(digit, table.find(name).expect("it is in the table"), &table);
    }

    #[test]
    fn keys_of_the_table_hold_until_something_is_put_there() {
        let mut favourites = Favourites::default();
        assert_eq!(on(&favourites, "1230"), ["water", "oil", "", ""]);
        put(&mut favourites, '2', "tar");
        assert_eq!(on(&favourites, "123"), ["water", "tar", ""]);
        let table = table();
        let digit = |name| favourites.digit(table.find(name).expect("it is in the table"), &table);
        assert_eq!([digit("water"), digit("tar"), digit("oil")], [Some('1'), Some('2'), None]);
    }

    #[test]
    fn an_element_is_on_one_digit_and_two_swap() {
        let mut favourites = Favourites::default();
        put(&mut favourites, '1', "oil");
        assert_eq!(on(&favourites, "12"), ["oil", "water"]);
        put(&mut favourites, '9', "oil");
        assert_eq!(on(&favourites, "129"), ["", "water", "oil"], "nothing was on 9 to go to 1");
        put(&mut favourites, '9', "tar");
        assert_eq!(on(&favourites, "129"), ["", "water", "tar"]);
        put(&mut favourites, '9', "tar");
        assert_eq!(on(&favourites, "129"), ["", "water", "tar"], "it is there");
    }

    #[test]
    fn a_table_without_an_element_has_its_own_on_the_digit() {
        let mut favourites = Favourites::default();
        put(&mut favourites, '1', "tar");
        let other = ElementTable::new(vec![Element { key: Some('1'), ..Element::plain("lava", false) }]);
        assert_eq!(favourites.element('1', &other), other.find("lava"));
        assert_eq!(on(&favourites, "1"), ["tar"]);
    }

    /// An empty folder of a test's own.
    fn folder(name: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("powder-favourites-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        path
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn they_outlive_the_session() {
        let folder = folder("kept");
        let mut favourites = Favourites::of_folder(&folder);
        assert_eq!(on(&favourites, "12"), ["water", "oil"], "there is no file yet");
        put(&mut favourites, '1', "tar");
        put(&mut favourites, '0', "oil");
        favourites.file.write(&favourites.put).expect("the folder of temporary files can be written");
        assert_eq!(Favourites::of_folder(&folder), favourites);
        put(&mut favourites, '1', "water");
        favourites.file.write(&favourites.put).expect("the file gives way to the new one");
        assert_eq!(Favourites::of_folder(&folder), favourites);
        fs::remove_dir_all(folder).expect("it is ours");
    }

    #[test]
    fn a_damaged_file_is_left_out_and_a_foreign_name_has_no_effect() {
        for damaged in [&b""[..], b"{'1': \"oil\"", b"[1, 2]", b"{\"one\": \"oil\"}", b"\xff\xfe", b"a letter"] {
            let (put, fault) = read(damaged);
            assert!(put.is_empty());
            assert!(fault.is_some_and(|fault| fault.starts_with("not read") && fault.lines().count() == 1));
        }
        let (put, fault) = read(br#"{'1': "oil", '2': "magma", 'x': "water", '3': "oil"}"#);
        let favourites = Favourites { put, ..Favourites::default() };
        assert_eq!(on(&favourites, "123"), ["oil", "", ""], "oil is on 1, so no longer on 2");
        let fault = fault.expect("it has what is of no use");
        assert!(["water", "'3'"].iter().all(|part| fault.contains(part)), "{fault}");
        assert!(["magma", "'1'"].iter().all(|part| !fault.contains(part)), "another world may have magma: {fault}");
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn what_can_t_be_kept_is_said() {
        let mut favourites = Favourites::of_folder(Path::new("/dev/null/nowhere"));
        put(&mut favourites, '1', "tar");
        assert!(favourites.file.write(&favourites.put).is_err());
        assert_eq!(on(&favourites, "1"), ["tar"], "it holds for the session");
    }
}
