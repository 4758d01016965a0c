//! An element that is like another one but for what its dials say.

use crate::kernel::{
    element::{Element, ElementId, ElementTable, ElementTouch},
    heat::{
        table::{AIR, HeatTable},
        units::ROOM,
    },
};

/// Longest name, letters.
pub const LONGEST_NAME: usize = 32;

/// An element called `name` to which all happens that happens to one of a table; where that grows, this grows.
pub fn like(elements: &ElementTable, base: ElementId, name: &str) -> Element {
    let row = elements.get(base);
    let mut own = Element { name: name.to_owned(), key: None, ..row.clone() };
    free_heat(&mut own, HeatTable::new(elements).curve(base).latent());
    // A row that says what becomes of two stands with one of them.
    own.touches.retain(|touch| touch.with != row.name);
    own.touches.extend(elements.iter().filter_map(|(_, other)| turned(other, &row.name)));
    for ElementTouch { into: (first, second), .. } in &mut own.touches {
        for product in [first, second] {
            if *product == row.name {
                name.clone_into(product);
            }
        }
    }
    own
}

/// What becomes of an element called `name` where it touches another, as that one's row says it.
fn turned(other: &Element, name: &str) -> Option<ElementTouch> {
    let touch = other.touches.iter().find(|touch| touch.with == name)?;
    let (first, second) = touch.into.clone();
    (other.name != name).then(|| ElementTouch { with: other.name.clone(), into: (second, first), ..touch.clone() })
}

/// Has the heat of its changes follow from what comes of it, so that it may hold more or less heat than its base. What is never
/// at rest at room temperature needs that of one change to stand beside the others at all. `latent`: what the base's changes
/// take, below and above, MJ/m².
fn free_heat(own: &mut Element, [below, above]: [f32; 2]) {
    let mut is_anchored = own
        .changes
        .iter()
        .all(|change| change.above.is_none_or(|above| above > ROOM) && change.below.is_none_or(|below| below < ROOM));
    // What the air gets follows from nothing.
    for change in own.changes.iter_mut().filter(|change| change.into.iter().all(|into| into != AIR)) {
        let anchors = !is_anchored && change.into.len() == 1;
        is_anchored |= anchors;
        change.latent = anchors.then_some(if change.above.is_some() { above } else { below });
    }
}

/// What is left of what was typed as a name: an element is called by small letters, digits and `_`.
pub fn name_of(text: &str) -> String {
    let letter = |letter: char| match letter.to_ascii_lowercase() {
        letter if letter.is_ascii_lowercase() || letter.is_ascii_digit() => Some(letter),
        ' ' | '_' | '-' => Some('_'),
        _ => None,
    };
    text.chars().filter_map(letter).take(LONGEST_NAME).collect()
}

/// A name for an element like `base` that no row of the tables has.
pub fn free_name(base: &str, tables: &[&ElementTable]) -> String {
    let numbered = |number: usize| {
        let end = if number == 1 { String::new() } else { format!("_{number}") };
        let room = LONGEST_NAME - "my_".len() - end.len();
        format!("my_{}{end}", base.chars().take(room).collect::<String>())
    };
    let is_free = |name: &String| tables.iter().all(|table| table.find(name).is_none());
    (1..=ElementTable::MOST).map(numbered).find(is_free).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{self, effects::EffectModes},
        sim::checkpoint::Checkpoint,
    };
    use std::sync::Arc;

    fn start() -> Checkpoint {
        let blueprint = scene::load("empty").unwrap().build(&[], None, &EffectModes::new()).unwrap();
        Checkpoint::of_scene(Arc::new(blueprint))
    }

    #[test]
    fn what_is_like_an_element_behaves_like_it() {
        let start = start();
        let elements = start.setup.elements();
        for (id, element) in elements.iter() {
            let own = like(elements, id, "own");
            let mixed =
                start.clone().with_element(own).unwrap_or_else(|fault| panic!("like {}: {fault}", element.name));
            let mixed = mixed.setup.elements();
            let own = mixed.find("own").unwrap();
            let heat = HeatTable::new(mixed);
            for kelvin in [200.0, 300.0, 600.0, 1500.0] {
                let [a, b] = [id, own].map(|id| heat.curve(id).heat_towards(kelvin));
                // A lump holds some 10⁸ quanta; what a table says is rounded to a megajoule.
                assert!((a - b).abs() < 200_000, "{} at {kelvin} K: {a} and {b} quanta", element.name);
            }
        }
    }

    #[test]
    fn it_reacts_as_its_base_does_and_grows_where_that_grows() {
        let elements = scene::elements().unwrap();
        let of = |base: &str| like(&elements, elements.find(base).unwrap(), "own");
        let into = |own: &Element, with: &str| {
            own.touches.iter().find(|touch| touch.with == with).map(|touch| touch.into.clone())
        };
        let pair = |a: &str, b: &str| Some((a.to_owned(), b.to_owned()));
        assert_eq!(into(&of("acid"), "rock"), pair("water", "sand"));
        assert_eq!(into(&of("rock"), "acid"), pair("sand", "water"), "the row stands with the acid");
        assert_eq!(into(&of("plant"), "water"), pair("own", "own"));
        assert_eq!(into(&of("honey"), "rock"), None);
    }

    #[test]
    fn names_are_made_of_what_is_typed_and_none_is_given_twice() {
        assert_eq!(name_of("Dark Honey-2!"), "dark_honey_2");
        assert_eq!((name_of("ß ä").as_str(), name_of(&"x".repeat(99)).len()), ("_", LONGEST_NAME));
        let table = |names: &[&str]| ElementTable::new(names.iter().map(|name| Element::plain(name, false)).collect());
        assert_eq!(free_name("honey", &[&table(&["honey"])]), "my_honey");
        assert_eq!(free_name("honey", &[&table(&["my_honey"]), &table(&["my_honey_2"])]), "my_honey_3");
        assert_eq!(free_name(&"x".repeat(32), &[&table(&[&format!("my_{}", "x".repeat(29))])]).len(), LONGEST_NAME);
    }
}
