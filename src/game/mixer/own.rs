//! The elements that the player has made, kept from session to session.

use crate::{
    game::kept::{KeptFile, parse},
    kernel::element::{Element, ElementTable},
    scene::elements::{Fault, check},
    sim::new_file::Unwritten,
};
use bevy::prelude::Resource;
use std::path::Path;

/// The file that they are kept in.
const FILE: &str = "elements.ron";
/// Most that are kept: as many as fit beside those that come with the game, and one's sight.
pub const MOST: usize = 60;

/// Elements of the player's own, the newest first.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct OwnElements {
    kept: Vec<Element>,
    file: KeptFile,
}

impl OwnElements {
    /// Those of the user, beside the elements that come with the game. What is wrong with the file is told in a line of the log.
    pub fn of_user(standard: &ElementTable) -> Self {
        Self::of_file(KeptFile::of_user(FILE), standard)
    }

    /// Those that a folder keeps, or none yet.
    pub fn of_folder(folder: &Path, standard: &ElementTable) -> Self {
        Self::of_file(KeptFile::of_folder(folder, FILE), standard)
    }

    fn of_file(file: KeptFile, standard: &ElementTable) -> Self {
        Self { kept: file.read_by(|bytes| read(bytes, standard)), file }
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Element> {
        self.kept.iter()
    }

    /// The one of a name.
    pub fn find(&self, name: &str) -> Option<&Element> {
        self.kept.iter().find(|element| element.name == name)
    }

    /// Keeps one, in the place of the one of its name; the oldest gives way where there are too many.
    ///
    /// # Errors
    /// If it can't be kept for the next session.
    pub fn keep(&mut self, element: Element) -> Result<(), Unwritten> {
        self.kept.retain(|other| other.name != element.name);
        self.kept.insert(0, element);
        self.kept.truncate(MOST);
        self.file.write(&self.kept)
    }

    /// Forgets the one of a name.
    ///
    /// # Errors
    /// If it comes back in the next session.
    pub fn forget(&mut self, name: &str) -> Result<(), Unwritten> {
        self.kept.retain(|other| other.name != name);
        self.file.write(&self.kept)
    }
}

/// Why there can be no such element beside those of a table, in one line.
pub fn fault(element: &Element, standard: &ElementTable) -> Option<String> {
    if standard.find(&element.name).is_some() {
        return Some(format!("name: `{}` comes with the game; allowed: another name", element.name));
    }
    let rows: Vec<Element> = standard.rows().iter().chain([element]).cloned().collect();
    check(&rows).err().map(|Fault { field, what, .. }| format!("{field}: {what}"))
}

/// Those that a file holds and that there can be, and what is wrong with the others.
fn read(bytes: &[u8], standard: &ElementTable) -> (Vec<Element>, Option<String>) {
    let rows: Vec<Element> = match parse(bytes, |_| Ok(())) {
        Ok(rows) => rows,
        Err(fault) => return (Vec::new(), Some(format!("not read, so there are none of your own: {fault}"))),
    };
    let (mut kept, mut faults) = (Vec::<Element>::new(), Vec::new());
    for row in rows {
        let is_taken = kept.iter().any(|other| other.name == row.name);
        match fault(&row, standard) {
            _ if is_taken => faults.push(format!("`{}` stands twice", row.name.escape_debug())),
            Some(fault) => faults.push(format!("`{}`: {fault}", row.name.escape_debug())),
            None if kept.len() < MOST => kept.push(row),
            None => faults.push(format!("`{}`: there are more than {MOST}", row.name)),
        }
    }
    (kept, (!faults.is_empty()).then(|| format!("left out: {}", faults.join("; "))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    fn element(name: &str) -> Element {
        Element::plain(name, false)
    }

    fn names(own: &OwnElements) -> Vec<&str> {
        own.iter().map(|element| element.name.as_str()).collect()
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn they_outlive_the_session_the_newest_first() {
        let standard = scene::elements().unwrap();
        let folder = std::env::temp_dir().join(format!("powder-elements-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        let mut own = OwnElements::of_folder(&folder, &standard);
        for name in ["tar_2", "ink", "tar_2"] {
            own.keep(element(name)).unwrap();
        }
        assert_eq!(names(&own), ["tar_2", "ink"]);
        assert_eq!(OwnElements::of_folder(&folder, &standard), own);
        own.forget("tar_2").unwrap();
        assert_eq!(names(&OwnElements::of_folder(&folder, &standard)), ["ink"]);
        (0..70).for_each(|number| own.keep(element(&format!("own_{number}"))).unwrap());
        assert_eq!((own.iter().count(), own.find("ink")), (MOST, None));
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn what_can_t_be_is_left_out_and_named() {
        let standard = scene::elements().unwrap();
        let rows = [element("ink"), element("water"), element("ink"), Element { density: 0.0, ..element("air_2") }];
        let text = ron::to_string(&rows.to_vec()).unwrap();
        let (kept, fault) = read(text.as_bytes(), &standard);
        assert_eq!(kept.len(), 1);
        let fault = fault.unwrap();
        for part in ["`water`: name: `water` comes with the game", "`ink` stands twice", "`air_2`: density: 0"] {
            assert!(fault.contains(part), "{fault}");
        }
        for text in ["", "[(name: \"x\"", "\u{0}"] {
            let (kept, fault) = read(text.as_bytes(), &standard);
            assert!(kept.is_empty() && fault.unwrap().starts_with("not read"));
        }
    }
}
