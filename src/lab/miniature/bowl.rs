//! A miniature of one element: what flows or piles up is poured onto a ledge and into a bowl, a gas comes from below, and what
//! is fixed stands in a shower of water.

use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::{Category, Element},
        params::Preset,
    },
    lab::miniature::world::Miniature,
    scene::{self, effects::EffectModes},
    sim::{checkpoint::Checkpoint, intent::Intent},
};
use glam::Vec2;
use std::sync::Arc;

/// How long there is something to see, ticks: then all is poured, and most of it lies still.
pub const BOWL_TICKS: u64 = 720;

const POURED: &str = r#"(title: "Bowl", spacing: 0.1, size: (6.4, 4), contents: [
    (element: "rock", shape: Polygon(points: [(-1, -1), (-1, 1.3), (0.3, 1.2), (0.9, 0.5), (5.5, 0.5), (6.1, 1.2), (7.4, 1.3), (7.4, -1)])),
    (element: "rock", shape: Polygon(points: [(2.3, 1.75), (3.8, 2.15), (3.8, 1.95), (2.3, 1.55)]))],
    emitters: [(element: "water", min: (3, 3.3), max: (3.5, 3.8), velocity: (0, -1), rate: 110, total: 700)])"#;
const RISING: &str = r#"(title: "Bowl", spacing: 0.1, size: (6.4, 4), contents: [
    (element: "rock", shape: Rect(min: (0, 0), max: (6.4, 0.3))),
    (element: "rock", shape: Polygon(points: [(1.6, 2.6), (3.2, 3.1), (4.8, 2.6), (4.8, 2.4), (3.2, 2.9), (1.6, 2.4)]))],
    emitters: [(element: "steam", min: (2.9, 0.4), max: (3.5, 0.8), velocity: (0, 1), rate: 60, total: 400)])"#;
const SHOWERED: &str = r#"(title: "Bowl", spacing: 0.1, size: (6.4, 4), contents: [
    (element: "rock", shape: Rect(min: (0, 0), max: (6.4, 0.4)))],
    emitters: [(element: "water", min: (2.9, 3.4), max: (3.5, 3.8), velocity: (0, -1), rate: 90, total: 500)])"#;

impl Miniature {
    /// A miniature of an element, beside those that come with the game.
    ///
    /// # Errors
    /// If there can be no such element: one line that says why, and what is allowed.
    pub fn of_element(element: &Element) -> Result<Self, String> {
        let text = match element.category {
            _ if element.fixed => SHOWERED,
            Category::Gases => RISING,
            _ => POURED,
        };
        let built =
            scene::from_text("bowl", text).and_then(|scene| scene.build(&[], Some(Preset::Fast), &EffectModes::new()));
        let scene = Checkpoint::of_scene(Arc::new(built.map_err(|error| error.to_string())?));
        let scene = scene.with_element(element.clone())?.setup.blueprint;
        let Some(id) = scene.elements.find(&element.name) else { return Err(format!("no element `{}`", element.name)) };
        let mut scene = Arc::unwrap_or_clone(scene);
        if !element.fixed {
            scene.emitters.iter_mut().for_each(|emitter| emitter.element = id);
        }
        let mut miniature = Self::of_blueprint(scene, 0, Arc::default());
        if element.fixed {
            let at = |x: f32, y: f32| Vec2::new(x, y);
            for (from, to) in
                [(at(20.0, 16.0), at(44.0, 16.0)), (at(22.0, 4.0), at(22.0, 14.0)), (at(42.0, 4.0), at(42.0, 14.0))]
            {
                let stroke = Stroke { shape: BrushShape::Square, from, to, radius: 2.0 };
                miniature.push(Intent::Stamp { element: id, stroke });
            }
        }
        Ok(miniature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_element_is_seen_to_do_something() {
        let elements = scene::elements().unwrap();
        for name in ["honey", "sand", "steam", "wood", "lava"] {
            let element = elements.get(elements.find(name).unwrap());
            let mut miniature = Miniature::of_element(element).unwrap();
            (0..30).for_each(|_| miniature.tick());
            let early = miniature.draw().to_vec();
            (0..30).for_each(|_| miniature.tick());
            assert_ne!(miniature.draw(), early, "{name} does nothing");
        }
    }

    #[test]
    fn what_can_t_be_says_why() {
        let element = Element { density: -1.0, ..Element::plain("own", false) };
        let told = Miniature::of_element(&element).err().unwrap();
        assert!(told.starts_with("density: -1 is out of range; allowed: "), "{told}");
    }
}
