//! The scenes that there are, and where the player is among them.

use crate::{
    game::{disk, files},
    scene::{self, SceneFile},
    sim::state::Setup,
};
use bevy::prelude::Resource;
use bevy_egui::egui::{Rect, Vec2};
use std::{collections::BTreeMap, path::PathBuf};

/// Where the player's own scene files are, if anywhere.
#[derive(Resource, Clone, Debug, Default)]
pub struct SceneFolder(pub Option<PathBuf>);

impl SceneFolder {
    /// That of the user: `scenes` in the folder of the user's data.
    pub fn of_user() -> Self {
        Self(files::folders().pop().map(|folder| folder.join("scenes")))
    }
}

/// A scene of the gallery.
pub(super) struct Entry {
    /// By which it is played: a name, or the path of a file of the player's.
    pub(super) call: String,
    /// What it is.
    pub(super) scene: SceneFile,
    /// Whether it is the player's own.
    pub(super) is_own: bool,
}

/// A scene that is being set up.
pub(super) struct SetUp {
    /// Which.
    pub(super) index: usize,
    /// The values of its parameters.
    pub(super) values: BTreeMap<String, f64>,
    /// The detail.
    pub(super) detail: f64,
}

/// The gallery's state. While it is closed only the scenes that come with the game are kept.
#[derive(Resource, Default)]
pub struct SceneMenu {
    pub(super) entries: Vec<Entry>,
    /// What is wrong with files of the player's.
    pub(super) faults: Vec<String>,
    pub(super) is_open: bool,
    /// What is searched.
    pub(super) text: String,
    /// The scene that is looked at.
    pub(super) focus: Option<usize>,
    /// Whether that has to be brought into sight.
    pub(super) follow: bool,
    pub(super) set_up: Option<SetUp>,
    /// The scenes whose tiles are in sight.
    pub(super) in_sight: Vec<usize>,
    /// Where the tiles were in the last frame, in their order.
    pub(super) tiles: Vec<(usize, Rect)>,
}

impl SceneMenu {
    /// Reads the scenes that come with the game.
    pub(super) fn of_game() -> Self {
        let of =
            |name: &'static str| Some(Entry { call: name.to_owned(), scene: scene::load(name).ok()?, is_own: false });
        let entries = scene::builtin_names().into_iter().filter_map(of).collect();
        Self { entries, ..Self::default() }
    }

    /// Reads the files of the player's folder, too.
    pub(super) fn open(&mut self, folder: &SceneFolder) {
        self.is_open = true;
        let Some(folder) = &folder.0 else { return };
        let mut paths: Vec<PathBuf> = disk::list(folder).into_iter().map(|(path, _)| path).collect();
        paths.retain(|path| path.extension().is_some_and(|ending| ending == "ron"));
        paths.sort();
        let mut own = Vec::new();
        for path in paths {
            let call = path.to_string_lossy().into_owned();
            match scene::load(&call) {
                Ok(scene) => own.push(Entry { call, scene, is_own: true }),
                Err(error) => self.faults.push(error.to_string()),
            }
        }
        self.entries.splice(0..0, own);
    }

    /// Forgets all that was for the player's eyes.
    pub(super) fn close(&mut self) {
        let mut entries = std::mem::take(&mut self.entries);
        entries.retain(|entry| !entry.is_own);
        *self = Self { entries, ..Self::default() };
    }

    /// Goes to the page of a scene, with its parameters as they are in force or by default.
    pub(super) fn set_up(&mut self, index: usize, setup: &Setup) {
        let Some(Entry { scene, .. }) = self.entries.get(index) else { return };
        let playing = scene.name() == setup.blueprint.name;
        let value = |(name, spec): (&String, &scene::ParameterSpec)| {
            let now = setup.blueprint.parameters.get(name).copied().filter(|_| playing);
            (name.clone(), now.unwrap_or(spec.default))
        };
        let values = scene.parameters().iter().map(value).collect();
        let detail = if playing { setup.asked_detail() } else { 1.0 };
        self.focus = Some(index);
        self.set_up = Some(SetUp { index, values, detail });
    }

    /// Looks at the next tile in a direction (right and down count), or at the first.
    pub(super) fn go(&mut self, way: Vec2) {
        let Some(&(first, _)) = self.tiles.first() else { return };
        let here = self.tiles.iter().find(|(index, _)| Some(*index) == self.focus).map(|(_, rect)| *rect);
        let Some(here) = here else {
            (self.focus, self.follow) = (Some(first), true);
            return;
        };
        let next = if way.x == 0.0 { self.across(here, way.y) } else { self.along(way.x) };
        if next.is_some() {
            (self.focus, self.follow) = (next, true);
        }
    }

    /// The tile before or after, whichever row it is in.
    fn along(&self, right: f32) -> Option<usize> {
        let place = self.tiles.iter().position(|(index, _)| Some(*index) == self.focus)?;
        let next = if right > 0.0 { place + 1 } else { place.checked_sub(1)? };
        self.tiles.get(next).map(|(index, _)| *index)
    }

    /// The tile of the row above or below that is nearest.
    fn across(&self, here: Rect, down: f32) -> Option<usize> {
        let distance = |rect: &Rect| (rect.center().y - here.center().y) * down;
        let beyond = self.tiles.iter().filter(|(_, rect)| distance(rect) > 0.5 * here.height());
        let aside = |rect: &Rect| (rect.center().x - here.center().x).abs();
        let nearest = beyond.min_by(|(_, a), (_, b)| {
            let row = |rect: &Rect| (distance(rect) / here.height()).round();
            row(a).total_cmp(&row(b)).then(aside(a).total_cmp(&aside(b)))
        });
        nearest.map(|(index, _)| *index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_egui::egui::{pos2, vec2};
    use std::fs;

    #[test]
    fn each_scene_has_a_category_and_says_one_thing_to_do() {
        let menu = SceneMenu::of_game();
        let categories: Vec<_> = menu.entries.iter().map(|entry| entry.scene.category()).collect();
        assert!(categories.iter().all(Option::is_some), "one would stand among the player's own");
        assert!(menu.entries.iter().all(|entry| !entry.scene.invitation().is_empty()));
        let proofs = Some(scene::SceneCategory::Proofs);
        assert!(categories.iter().filter(|category| **category != proofs).count() >= 24, "so many are there to play");
    }

    #[test]
    fn arrows_go_from_tile_to_tile_and_from_row_to_row() {
        let tile = |index, column: f32, row: f32| {
            (index, Rect::from_min_size(pos2(100.0 * column, 80.0 * row), vec2(90.0, 70.0)))
        };
        let tiles = vec![tile(5, 0.0, 0.0), tile(2, 1.0, 0.0), tile(9, 2.0, 0.0), tile(1, 0.0, 1.3), tile(0, 1.0, 1.3)];
        let mut menu = SceneMenu { tiles, ..SceneMenu::default() };
        let (right, left, down, up) = (vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0));
        let mut walk = |ways: &[Vec2]| {
            ways.iter().for_each(|way| menu.go(*way));
            menu.focus
        };
        assert_eq!(walk(&[down]), Some(5), "the first way leads to the first tile");
        assert_eq!(walk(&[left, up]), Some(5), "beyond the edge there is none");
        assert_eq!(walk(&[right, right]), Some(9));
        assert_eq!(walk(&[right]), Some(1), "a row goes on in the next");
        assert_eq!(walk(&[right, right]), Some(0), "the last");
        assert_eq!(walk(&[up]), Some(2));
        assert_eq!(walk(&[right, down]), Some(0), "the nearest of a shorter row");
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn own_scenes_are_read_when_it_opens_and_bad_files_are_told() {
        let folder = std::env::temp_dir().join(format!("powder-own-scenes-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("the folder of temporary files can be written");
        fs::write(folder.join("mine.ron"), "(title: \"Mine\", spacing: 0.1, size: (5, 4))").expect("as well");
        fs::write(folder.join("bad.ron"), "(title: \"Bad\", category: watery, spacing: 0.1, size: (5, 4))")
            .expect("as well");
        fs::write(folder.join("note.txt"), "no scene").expect("as well");
        let mut menu = SceneMenu::of_game();
        let count = menu.entries.len();
        menu.open(&SceneFolder(Some(folder.clone())));
        assert_eq!(menu.entries.len(), count + 1);
        assert!(menu.entries[0].is_own && menu.entries[0].scene.category().is_none());
        assert!(scene::load(&menu.entries[0].call).is_ok(), "it is played by its path");
        let [fault] = &menu.faults[..] else { panic!("{:?}", menu.faults) };
        assert!(fault.contains("bad.ron") && fault.contains("watery") && fault.lines().count() == 1, "{fault}");
        menu.close();
        assert_eq!((menu.entries.len(), menu.faults.len()), (count, 0));
        menu.open(&SceneFolder(Some(folder.join("nowhere"))));
        assert_eq!(menu.entries.len(), count);
        fs::remove_dir_all(folder).expect("it is ours");
    }
}
