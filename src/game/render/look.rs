//! How the elements look: which of the picture's ways of drawing each takes. It follows from the element table.

use crate::{
    kernel::{
        element::{Category, Element, ElementId, ElementTable},
        heat::{curve::HeatCurve, table::HeatTable},
    },
    lab::colours::{DULL, Rgb},
};

/// Thicker liquids don't foam, m²/s: air that they take in does not come out in the time that foam lives.
const FOAMING: f32 = 0.01;
/// Heavier ones neither, kg/m²: what falls into them bounces off.
const FOAM_WEIGHT: f32 = 3000.0;

/// From this conductivity on it shines like metal, W/mK.
const METALLIC: f32 = 20.0;

/// How the surface of fixed matter is made. The shader knows them by these numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// Grain and cracks.
    Stone = 0,
    /// Fibres: of what grew.
    Fibres = 1,
    /// Smooth, with a gleam along its edges.
    Polished = 2,
}

impl Finish {
    /// That of an element.
    pub fn of(element: &Element) -> Self {
        if element.conductivity >= METALLIC {
            Self::Polished
        } else if element.decays.is_some() {
            Self::Fibres
        } else {
            Self::Stone
        }
    }
}

/// Look of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    category: Category,
    /// Its own colour.
    pub colour: Rgb,
    /// Whether it is a liquid that air makes white.
    pub foams: bool,
    /// Heat from which on it glows, quanta.
    pub glows_from: i32,
}

impl Look {
    fn of(element: &Element, curve: &HeatCurve) -> Self {
        let thin = element.viscosity < FOAMING && element.density < FOAM_WEIGHT;
        Self {
            glows_from: curve.heat_reaching(DULL),
            category: element.category,
            colour: element.colour,
            foams: element.category == Category::Liquids && thin,
        }
    }

    /// Whether it is drawn as clouds.
    pub fn is_gas(self) -> bool {
        self.category == Category::Gases
    }

    /// Whether it is drawn as grains.
    pub fn is_powder(self) -> bool {
        self.category == Category::Powders
    }
}

/// Looks of all elements.
#[derive(Clone, Debug, Default)]
pub struct Looks(Vec<Look>);

impl Looks {
    /// Those of a table, by the curves of its elements.
    pub fn new(elements: &ElementTable, curves: &HeatTable) -> Self {
        Self(elements.iter().map(|(id, element)| Look::of(element, curves.curve(id))).collect())
    }

    /// That of an element of the table.
    pub fn of(&self, element: ElementId) -> Look {
        self.0[element.index()]
    }
}
