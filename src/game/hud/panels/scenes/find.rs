//! Search among scenes: by title, by element and by words.

use super::menu::Entry;
use crate::{
    game::{
        language::{sorted_as, spoken},
        tools::spaced,
    },
    scene::{DEFAULT_SCENE, SceneCategory, SceneFile},
};

/// The scenes that hold every word of the text, those first in whose titles it stands; then by category, and there by title, but
/// the default one first.
pub(super) fn find(entries: &[Entry], text: &str) -> Vec<usize> {
    let words: Vec<String> = text.split_whitespace().map(str::to_lowercase).collect();
    let of = |scene: &SceneFile| {
        words.iter().map(|word| rank(scene, word)).try_fold(0, |worst, rank| Some(rank?.max(worst)))
    };
    let mut found: Vec<(u8, usize)> =
        entries.iter().enumerate().filter_map(|(index, entry)| Some((of(&entry.scene)?, index))).collect();
    found.sort_by_cached_key(|(rank, index)| {
        let Entry { call, scene, .. } = &entries[*index];
        (*rank, scene.category(), call != DEFAULT_SCENE, sorted_as(&spoken(scene.title())))
    });
    found.into_iter().map(|(_, index)| index).collect()
}

/// How well a word fits a scene, 0 best; nothing if it does not. It is looked for in the player's language and in
/// English.
fn rank(scene: &SceneFile, word: &str) -> Option<u8> {
    let translated = rank_in(scene, word, &spoken);
    let english = rank_in(scene, word, &str::to_owned);
    translated.into_iter().chain(english).min()
}

fn rank_in(scene: &SceneFile, word: &str, said: &dyn Fn(&str) -> String) -> Option<u8> {
    let title = said(scene.title()).to_lowercase();
    let begins = |text: &str| {
        said(text).split(|letter: char| !letter.is_alphanumeric()).any(|other| other.to_lowercase().starts_with(word))
    };
    match title.find(word) {
        Some(0) => Some(0),
        Some(_) => Some(1),
        None if scene.elements().into_iter().any(|element| begins(&spaced(element))) => Some(2),
        None => {
            let category = scene.category().map_or("", SceneCategory::title);
            [scene.invitation(), scene.description(), category].into_iter().any(begins).then_some(3)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::menu::SceneMenu;
    use super::*;

    fn names(text: &str) -> Vec<String> {
        let menu = SceneMenu::of_game();
        find(&menu.entries, text).into_iter().map(|index| menu.entries[index].call.clone()).collect()
    }

    #[test]
    fn a_scene_is_found_by_its_title_its_elements_and_words_about_it() {
        assert_eq!(names("").len(), SceneMenu::of_game().entries.len());
        assert_eq!(names("WATERF"), ["waterfall"]);
        assert_eq!(names("hour")[0], "hourglass");
        assert!(names("mercury").contains(&"layers".to_owned()), "it is poured there");
        assert_eq!(names("mercury")[0], "mercury_maze", "a title comes first");
        assert!(names("village").contains(&"avalanche".to_owned()) || names("huts").contains(&"avalanche".to_owned()));
        assert!(names("heat").contains(&"volcano".to_owned()), "by its category");
        assert_eq!(names("xyzzy"), [""; 0]);
    }

    #[test]
    fn scenes_stand_by_category_and_title() {
        let menu = SceneMenu::of_game();
        let found: Vec<_> = find(&menu.entries, "").into_iter().map(|index| &menu.entries[index]).collect();
        assert_eq!(found[0].call, "waterfall");
        let order = |entry: &&Entry| (entry.scene.category(), entry.scene.title().to_lowercase());
        assert!(found[1..].is_sorted_by_key(order));
    }

    #[test]
    fn every_word_has_to_fit() {
        assert_eq!(names("oil lamp")[0], "oil_lamp");
        assert!(!names("oil lamp").contains(&"layers".to_owned()), "it has oil and no lamp");
        assert!(names("snow wind").contains(&"snow_globe".to_owned()));
        assert_eq!(names("snow xyzzy"), [""; 0]);
    }
}
