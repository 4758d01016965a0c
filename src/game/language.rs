//! The language that the game speaks. Texts stand in English where they belong, in the code and in the tables of `assets`;
//! `assets/texts/TAG.po` has each of them in another language, in the format of GNU gettext that translators' tools read and
//! write. A new file there is a new language. What is no text of its own stays as it is: names that the command line takes
//! (qualities, effects, parameters), and what is wrong with a file.

use crate::sim::numbers;
use bevy::prelude::{App, First, IntoScheduleConfigs, Resource, World, resource_changed};
use include_dir::{Dir, include_dir};
use std::{path::Path, sync::LazyLock};
use tr::{PoTranslator, Translator, set_translator, tr, unset_translator};

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/texts");
/// The language of the code.
const ENGLISH: &str = "en";

/// A language that the game can speak.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Known {
    /// Its tag in BCP 47, `de`.
    pub tag: &'static str,
    /// What it calls itself.
    pub name: String,
}

/// All, English first.
static KNOWN: LazyLock<Vec<Known>> = LazyLock::new(|| {
    let mut all = vec![Known { tag: ENGLISH, name: "English".to_owned() }];
    all.extend(FILES.files().filter_map(|file| {
        let tag = file.path().file_stem()?.to_str()?;
        // Each file says what its language is called: that is what it makes of "English".
        Some(Known { tag, name: read(tag)?.translate("English", None).into_owned() })
    }));
    all
});

/// What the player chose, and what the system speaks.
#[derive(Resource, Clone, Debug, PartialEq, Eq)]
pub struct Language {
    chosen: Option<&'static str>,
    by_system: &'static str,
}

impl Default for Language {
    fn default() -> Self {
        Self { chosen: None, by_system: ENGLISH }
    }
}

impl Language {
    /// The languages that there are.
    pub fn all() -> &'static [Known] {
        &KNOWN
    }

    /// The one with the tag that was chosen; that of a system with these tags for `None`, or if this version does not know it.
    fn of_user(chosen: Option<&str>, system: impl IntoIterator<Item = String>) -> Self {
        Self { chosen: chosen.and_then(find), by_system: of_system(system) }
    }

    /// The tag that was chosen, if one was.
    pub fn chosen(&self) -> Option<&'static str> {
        self.chosen
    }

    /// Chooses one by its tag, or that of the system.
    pub fn choose(&mut self, tag: Option<&'static str>) {
        self.chosen = tag;
    }

    /// What the system speaks.
    pub fn by_system(&self) -> &'static Known {
        Self::all().iter().find(|known| known.tag == self.by_system).unwrap_or(&Self::all()[0])
    }

    /// The tag of what is spoken.
    pub fn tag(&self) -> &'static str {
        self.chosen.unwrap_or(self.by_system)
    }
}

/// Speaks the language that was chosen the last time, and from then on the one that is chosen.
pub fn plugin(app: &mut App, chosen: Option<&str>) {
    let language = Language::of_user(chosen, sys_locale::get_locales());
    speak(language.tag());
    app.insert_resource(language).add_systems(First, follow.run_if(resource_changed::<Language>));
}

/// Alone in the world: a text may hold others, so nobody may be saying one.
fn follow(world: &mut World) {
    speak(world.resource::<Language>().tag());
}

fn speak(tag: &str) {
    match read(tag) {
        Some(texts) => set_translator!(texts),
        None => unset_translator!(),
    }
}

/// A text of a table in the language that is spoken.
pub fn spoken(english: &str) -> String {
    // What a file has for no text is about the file.
    if english.is_empty() { String::new() } else { tr!(english) }
}

/// A number with the sign of the language between the thousands: `12,345,678`. The decimal point is the same in all.
pub fn grouped(number: impl ToString) -> String {
    numbers::grouped_by(number, &tr!("between thousands" => ","))
}

/// What a text of a list is sorted by: its letters without case and, as in dictionaries of German (DIN 5007-1), without marks.
pub fn sorted_as(text: &str) -> String {
    text.to_lowercase().replace('ä', "a").replace('ö', "o").replace('ü', "u").replace('ß', "ss")
}

/// The first of the system's languages that the game speaks, or English; so is what C programs begin with.
fn of_system(tags: impl IntoIterator<Item = String>) -> &'static str {
    let known = |tag: String| match tag.split('-').next() {
        Some("C" | "POSIX") => Some(ENGLISH),
        primary => primary.and_then(find),
    };
    tags.into_iter().find_map(known).unwrap_or(ENGLISH)
}

fn find(tag: &str) -> Option<&'static str> {
    Language::all().iter().map(|known| known.tag).find(|known| known.eq_ignore_ascii_case(tag))
}

/// The texts of a language; none of English, and none of a file that a test would have refused.
fn read(tag: &str) -> Option<PoTranslator> {
    let text = FILES.get_file(format!("{tag}.po"))?.contents_utf8()?;
    // The parser takes what is no path of a file for its contents; what it is given as bytes it does not look at (rspolib 0.1.2).
    PoTranslator::from_path(Path::new(text)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_language_of_the_system_that_is_known_is_spoken() {
        for (tags, expected) in [
            (&[][..], "en"),
            (&["de-AT"], "de"),
            (&["tlh", "de", "en"], "de"),
            (&["en-GB", "de"], "en"),
            (&["C", "de-DE"], "en"),
            (&["", "DE"], "de"),
        ] {
            assert_eq!(of_system(tags.iter().map(|tag| (*tag).to_owned())), expected, "{tags:?}");
        }
    }

    #[test]
    fn letters_with_marks_stand_by_those_without() {
        let mut words = ["Zoll", "Über", "Straße", "Öl", "oben", "Strasse A", "unten"];
        words.sort_by_key(|word| sorted_as(word));
        assert_eq!(words, ["oben", "Öl", "Straße", "Strasse A", "Über", "unten", "Zoll"]);
    }

    #[test]
    fn a_language_of_another_version_is_that_of_the_system() {
        for (chosen, expected) in [(None, None), (Some("tlh"), None), (Some("de"), Some("de"))] {
            let language = Language::of_user(chosen, ["de-CH".to_owned()]);
            assert_eq!((language.chosen(), language.tag()), (expected, "de"));
        }
        assert_eq!(Language { chosen: Some("de"), by_system: "en" }.tag(), "de");
        assert_eq!(Language { chosen: None, by_system: "de" }.tag(), "de");
    }

    #[test]
    fn each_language_says_what_it_is_called() {
        let names: Vec<&str> = Language::all().iter().map(|known| known.name.as_str()).collect();
        assert_eq!(names, ["English", "Deutsch"]);
    }

    #[test]
    fn each_language_has_its_sign_between_thousands() {
        let german = read("de").unwrap();
        assert_eq!(grouped(13_534), "13,534");
        assert_eq!(numbers::grouped_by(13_534, &german.translate(",", Some("between thousands"))), "13\u{202f}534");
    }
}
