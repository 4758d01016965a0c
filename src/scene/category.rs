//! The categories under which the gallery shows scenes.

use serde::Deserialize;

/// What a scene is about. Scene files call it by its name in `snake_case`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SceneCategory {
    /// Liquids that flow, fall and float.
    Water,
    /// Grains that run, slide and pile up.
    Powders,
    /// What burns, melts, boils and freezes.
    Heat,
    /// Wind, pressure and what rises.
    Air,
    /// Set-ups whose answers are known.
    Proofs,
}

impl SceneCategory {
    /// All, in the order of the gallery.
    pub const ALL: [Self; 5] = [Self::Water, Self::Powders, Self::Heat, Self::Air, Self::Proofs];

    /// Its heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::Water => "Water",
            Self::Powders => "Powders",
            Self::Heat => "Heat & fire",
            Self::Air => "Air & gas",
            Self::Proofs => "Proofs",
        }
    }
}
