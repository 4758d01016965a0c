//! What a particle can be made of. The rows come from `assets/elements.ron`; the kernel only looks them up.

use serde::{Deserialize, Serialize};

/// Row of an element in the [`ElementTable`]; a particle stores it in one byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ElementId(pub u8);

impl ElementId {
    /// The row as an index.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

/// One row of the element table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Name in scenes, on the command line and in the palette; unique.
    pub name: String,
    /// The digit key that selects it, `'0'`–`'9'`; unique.
    pub key: char,
    /// Colour, sRGB.
    pub colour: [u8; 3],
    /// Fixed elements never move: they stop liquids and air and are stored in the rock grid.
    pub fixed: bool,
    /// Density, kg/m²; 1 … 100 000. Weighs the particle in energy, momentum and drag.
    pub density: f32,
    /// XSPH viscosity c (Macklin & Müller 2013, eq. 17): share of the velocity difference to its neighbours that a
    /// particle gives up each tick, however many substeps that has; raising it makes the liquid thicker. 0 … 0.5.
    #[serde(default)]
    pub viscosity: f32,
    /// Vorticity confinement ε (eq. 16), m/s² for each 1/s of vorticity; raising it keeps eddies alive longer. 0 … 1.
    #[serde(default)]
    pub vorticity: f32,
    /// Drag coefficient C of F = C v², kg/m. Raising it lets the air carry the particle more. 0 … 1000.
    #[serde(default)]
    pub drag: f32,
    /// Share of the free sites under the brush that one tick of pouring fills. 0 < flow ≤ 1.
    #[serde(default = "one")]
    pub flow: f32,
}

impl Element {
    /// An element as heavy as water, with nothing else to it.
    pub fn plain(name: &str, fixed: bool) -> Self {
        Self {
            name: name.into(),
            key: '1',
            colour: [40, 130, 220],
            fixed,
            density: 1000.0,
            viscosity: 0.0,
            vorticity: 0.0,
            drag: 0.0,
            flow: 1.0,
        }
    }
}

fn one() -> f32 {
    1.0
}

/// All elements, in the order of the palette. Never empty, at most 255 rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ElementTable {
    rows: Vec<Element>,
}

impl ElementTable {
    /// A table of already validated rows.
    pub fn new(rows: Vec<Element>) -> Self {
        debug_assert!(rows.len() <= 255, "an element id is one byte, and one value of it means none");
        Self { rows }
    }

    /// The row of `id`. Ids come from this table, so the row exists.
    pub fn get(&self, id: ElementId) -> &Element {
        &self.rows[id.index()]
    }

    /// The element called `name`.
    pub fn find(&self, name: &str) -> Option<ElementId> {
        self.iter().find(|(_, element)| element.name == name).map(|(id, _)| id)
    }

    /// All rows with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (ElementId, &Element)> {
        self.rows.iter().enumerate().map(|(row, element)| (ElementId(row as u8), element))
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row at all.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}
