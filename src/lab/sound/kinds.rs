//! What the elements sound like: follows from their rows, so that a new one sounds as its like.

use crate::kernel::element::{Category, Element, ElementId, ElementTable};

/// How a lump of an element sounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Voice {
    /// It splashes and rushes.
    Liquid,
    /// It strikes and hisses.
    Grain,
    /// Only what it becomes is heard.
    Mute,
}

/// What is known of an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    /// How it sounds where it moves.
    pub(super) voice: Voice,
    /// Density, kg/m².
    pub(super) density: f32,
    /// Coefficient of friction among its grains, 0 of what is none.
    pub(super) friction: f32,
    /// How thick a liquid is: by what share less it splashes and rushes than water, 0 … 1.
    pub(super) thickness: f32,
    /// What it gives off by burning, W/m²; 0 of what does not burn.
    pub(super) burning: f32,
    /// The gas that it boils to.
    pub(super) steam: Option<ElementId>,
}

/// Viscosity at which a liquid splashes half as much, m²/s.
const THICK: f32 = 0.03;

impl Kind {
    fn of(element: &Element, elements: &ElementTable) -> Self {
        let voice = match element.category {
            Category::Liquids => Voice::Liquid,
            Category::Powders => Voice::Grain,
            Category::Solids | Category::Gases => Voice::Mute,
        };
        let boils = element.changes.iter().filter(|change| change.above.is_some()).flat_map(|change| &change.into);
        let steam = boils.filter_map(|name| elements.find(name)).find(|id| elements.get(*id).is_gas());
        // tan φ, to 2 % up to 50°.
        let radians = element.friction.to_radians();
        let friction = radians * (1.0 + 0.4 * radians * radians);
        Self {
            voice,
            density: element.density,
            friction,
            thickness: element.viscosity / (element.viscosity + THICK),
            burning: burning(element, elements),
            steam,
        }
    }
}

/// What a lump gives off by burning, W/m²: only of what comes into being hot enough to go on burning, as embers do.
fn burning(element: &Element, elements: &ElementTable) -> f32 {
    let Some(decay) = &element.decays else { return 0.0 };
    if !decay.above.is_some_and(|above| element.spawn >= above) {
        return 0.0;
    }
    let left: f32 = decay.into.iter().filter_map(|name| elements.find(name)).map(|id| elements.get(id).energy).sum();
    let released = element.energy - left / decay.into.len().max(1) as f32;
    1e6 * released.max(0.0) / decay.seconds
}

/// What is known of all elements.
pub(super) fn kinds(elements: &ElementTable) -> Vec<Kind> {
    elements.rows().iter().map(|element| Kind::of(element, elements)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    #[test]
    fn elements_sound_as_what_they_are() {
        let elements = scene::elements().unwrap();
        let kinds = kinds(&elements);
        let kind = |name: &str| kinds[elements.find(name).unwrap().index()];
        assert_eq!(
            [kind("water").voice, kind("sand").voice, kind("steam").voice],
            [Voice::Liquid, Voice::Grain, Voice::Mute]
        );
        assert_eq!(kind("water").steam, elements.find("steam"));
        assert_eq!(kind("oil").steam, None);
        for (name, burns) in
            [("ember", true), ("burning_wood", true), ("burning_oil", true), ("wood", false), ("water", false)]
        {
            assert_eq!(kind(name).burning > 0.0, burns, "{name}");
        }
        assert!(kind("honey").thickness > 0.5 && kind("water").thickness == 0.0);
        assert!((kind("sand").friction - 0.675).abs() < 0.02);
    }
}
