//! What the player works with: the one table of tools beside the elements. Palette, panel of elements, touch bar, keys and help
//! follow from the table.

use crate::{
    game::{
        brush_mode::BrushMode,
        icons::{self, Icon},
        language::spoken,
    },
    kernel::{
        brush::Stroke,
        element::{Category, Element, ElementId, ElementTable},
        heat::units::ROOM,
    },
    lab::{
        colours::Reference,
        hand::{AIR_BRUSH, PRESS_STEP, WARM_STEP, throw, wind},
    },
    scene::effects::Effect,
    sim::intent::Intent,
};
use bevy::prelude::KeyCode;
use bevy_egui::egui::Color32;
use glam::Vec2;
use std::fmt;

/// Colour of lines and icons that stand for no element.
const PLAIN: Color32 = Color32::from_rgb(216, 223, 234);
/// An icon with no channel above this can hardly be seen.
const DIMMEST: u8 = 110;
/// Outline of a brush that moves air.
const AIR_PEN: Color32 = Color32::from_rgb(150, 230, 216);

/// The tools beside the elements, in the order of the palette. A new one is a new row.
pub static TOOLS: [&ToolRow; 6] = [&ERASER, &WIND, &PRESSURE, &HEAT, &TEMPERATURE, &IGNITE];

/// Takes away what is there.
pub static ERASER: ToolRow = ToolRow {
    name: "erase",
    icon: icons::eraser,
    pen: Color32::from_rgb(255, 184, 92),
    key: KeyCode::KeyX,
    help: "eraser",
    needs: None,
    least_radius: 0.0,
    left: |dab| Some(Intent::Erase { stroke: dab.stroke }),
    right: |dab| Some(Intent::Erase { stroke: dab.stroke }),
    has_shapes: true,
    has_temperature: false,
};

/// Sets the air moving along the drag.
pub static WIND: ToolRow = ToolRow {
    name: "wind",
    icon: icons::wind,
    pen: AIR_PEN,
    key: KeyCode::KeyW,
    help: "wind: drag to blow",
    needs: Some(Effect::Air),
    least_radius: AIR_BRUSH,
    left: |dab| wind(dab.velocity, dab.reference).map(|velocity| Intent::Blow { stroke: dab.stroke, velocity }),
    right: |dab| Some(Intent::Erase { stroke: dab.stroke }),
    has_shapes: false,
    has_temperature: false,
};

/// Adds pressure with the left button, sucks with the right.
pub static PRESSURE: ToolRow = ToolRow {
    name: "pressure",
    icon: icons::pressure,
    pen: AIR_PEN,
    key: KeyCode::KeyQ,
    help: "pressure: left adds, right sucks",
    needs: Some(Effect::Air),
    least_radius: AIR_BRUSH,
    left: |dab| Some(Intent::Press { stroke: dab.stroke, amount: PRESS_STEP * dab.share }),
    right: |dab| Some(Intent::Press { stroke: dab.stroke, amount: -PRESS_STEP * dab.share }),
    has_shapes: false,
    has_temperature: false,
};

/// Warms with the left button, cools with the right.
pub static HEAT: ToolRow = ToolRow {
    name: "heat",
    icon: icons::flame,
    pen: Color32::from_rgb(255, 150, 90),
    key: KeyCode::KeyT,
    help: "heat: left warms, right cools",
    needs: Some(Effect::Heat),
    least_radius: 0.0,
    left: |dab| Some(Intent::Warm { stroke: dab.stroke, degrees: WARM_STEP * dab.share }),
    right: |dab| Some(Intent::Warm { stroke: dab.stroke, degrees: -WARM_STEP * dab.share }),
    has_shapes: false,
    has_temperature: false,
};

/// Sets the chosen temperature with the left button, that of the room with the right.
pub static TEMPERATURE: ToolRow = ToolRow {
    name: "degrees",
    icon: icons::thermometer,
    pen: Color32::from_rgb(255, 118, 128),
    key: KeyCode::KeyC,
    help: "degrees: left sets a temperature, right that of the room",
    needs: Some(Effect::Heat),
    least_radius: 0.0,
    left: |dab| Some(Intent::SetTemperature { stroke: dab.stroke, kelvin: dab.kelvin }),
    right: |dab| Some(Intent::SetTemperature { stroke: dab.stroke, kelvin: ROOM }),
    has_shapes: true,
    has_temperature: true,
};

/// Sets fire to what can burn.
pub static IGNITE: ToolRow = ToolRow {
    name: "ignite",
    icon: icons::burning_match,
    pen: Color32::from_rgb(255, 214, 92),
    key: KeyCode::KeyI,
    help: "match: sets fire to what can burn",
    needs: Some(Effect::Decay),
    least_radius: 0.0,
    left: |dab| Some(Intent::Ignite { stroke: dab.stroke }),
    right: |dab| Some(Intent::Erase { stroke: dab.stroke }),
    has_shapes: true,
    has_temperature: false,
};

/// A row of the table.
pub struct ToolRow {
    /// Name in the palette; unique.
    pub name: &'static str,
    /// Its icon.
    pub icon: Icon,
    /// Colour of the brush's outline.
    pub pen: Color32,
    /// The key that chooses it.
    pub key: KeyCode,
    /// What the help says.
    pub help: &'static str,
    /// The effect without which it does nothing.
    pub needs: Option<Effect>,
    /// Its brush is at least this, in the scene's own spacings.
    pub least_radius: f32,
    /// What the left button does along a piece of a drag.
    pub left: fn(&Dab) -> Option<Intent>,
    /// What the right button does there.
    pub right: fn(&Dab) -> Option<Intent>,
    /// Whether it draws lines and rectangles, and does in all of them what the left button does along a drag. If not, it works
    /// along the drag, whichever modifier is held, and takes a fast drag as a row of dabs.
    pub has_shapes: bool,
    /// Whether the player chooses a temperature for it.
    pub has_temperature: bool,
}

/// A piece of a drag, within one tick.
pub struct Dab {
    /// Where, d.
    pub stroke: Stroke,
    /// What an element does there.
    pub mode: BrushMode,
    /// Smoothed velocity of the drag, d/s.
    pub velocity: Vec2,
    /// What is fast in this world.
    pub reference: Reference,
    /// The chosen temperature, K.
    pub kelvin: f32,
    /// Its share of the tick.
    pub share: f32,
}

/// Rows with the same name are the same tool.
impl PartialEq for ToolRow {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl fmt::Debug for ToolRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// What the left button does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tool {
    /// Draws an element.
    Element(ElementId),
    /// Does what a row of [`TOOLS`] says.
    Other(&'static ToolRow),
}

impl Tool {
    /// Every tool, in the order of the palette: the elements first, by their categories.
    pub fn all(elements: &ElementTable) -> impl Iterator<Item = Self> {
        let of = |category| elements.iter().filter(move |(_, element)| element.category == category);
        let ids = Category::ALL.into_iter().flat_map(of).map(|(id, _)| Self::Element(id));
        ids.chain(TOOLS.into_iter().map(Self::Other))
    }

    /// Some of them under their headings: the elements' categories, and the tools last.
    pub fn groups(elements: &ElementTable, some: &[Self]) -> Vec<(&'static str, Vec<Self>)> {
        let category = |tool: &Self| match *tool {
            Self::Element(id) => Some(elements.get(id).category),
            Self::Other(_) => None,
        };
        let headings = Category::ALL.into_iter().map(|category| (category.name(), Some(category)));
        let of = |heading| some.iter().copied().filter(|tool| category(tool) == heading).collect::<Vec<_>>();
        let groups = headings.chain([("tools", None)]).map(|(title, heading)| (title, of(heading)));
        groups.filter(|(_, of)| !of.is_empty()).collect()
    }

    /// Name in the palette.
    pub fn label(self, elements: &ElementTable) -> String {
        spoken(&spaced(self.name(elements)))
    }

    /// Name in files and for scripts.
    pub fn name(self, elements: &ElementTable) -> &str {
        match self {
            Self::Element(id) => &elements.get(id).name,
            Self::Other(row) => row.name,
        }
    }

    /// Icon and its colour.
    pub fn icon(self, elements: &ElementTable) -> (Icon, Color32) {
        match self {
            Self::Element(id) => {
                let element = elements.get(id);
                (icon_of(element.category), lit(colour_of(element)))
            }
            Self::Other(row) => (row.icon, PLAIN),
        }
    }

    /// Colour of the brush's outline.
    pub fn pen(self, elements: &ElementTable) -> Color32 {
        match self {
            Self::Element(id) => colour_of(elements.get(id)).lerp_to_gamma(Color32::WHITE, 0.35),
            Self::Other(row) => row.pen,
        }
    }

    /// What the help says of it; nothing of an element.
    pub fn help(self) -> &'static str {
        match self {
            Self::Element(_) => "",
            Self::Other(row) => row.help,
        }
    }

    /// The effect without which it does nothing.
    pub fn needs(self) -> Option<Effect> {
        match self {
            Self::Element(_) => None,
            Self::Other(row) => row.needs,
        }
    }

    /// Whether it works along the drag only: it knows no lines, rectangles and fills.
    pub fn is_freehand(self) -> bool {
        matches!(self, Self::Other(row) if !row.has_shapes)
    }

    /// What the left button does along a piece of a drag.
    pub fn left(self, dab: &Dab) -> Option<Intent> {
        match self {
            Self::Element(element) => Some(over(dab, element).unwrap_or_else(|| pour(dab, element))),
            Self::Other(row) => (row.left)(dab),
        }
    }

    /// What the right button does there.
    pub fn right(self, dab: &Dab) -> Option<Intent> {
        match self {
            Self::Element(element) => Some(match dab.mode {
                BrushMode::EraseOnly => Intent::EraseOnly { element, stroke: dab.stroke },
                BrushMode::Draw | BrushMode::Replace | BrushMode::Spring => Intent::Erase { stroke: dab.stroke },
            }),
            Self::Other(row) => (row.right)(dab),
        }
    }

    /// What it does in a whole line or rectangle.
    pub fn shape(self, dab: &Dab) -> Option<Intent> {
        match self {
            Self::Element(element) => Some(over(dab, element).unwrap_or(Intent::Stamp { element, stroke: dab.stroke })),
            Self::Other(row) => row.has_shapes.then(|| (row.left)(dab)).flatten(),
        }
    }

    /// What it does to all that hangs together around a point, d: free room, or what is there.
    pub fn fill(self, mode: BrushMode, at: Vec2) -> Option<Intent> {
        let Self::Element(element) = self else { return None };
        Some(match mode {
            BrushMode::Draw | BrushMode::Spring => Intent::Fill { element, at },
            BrushMode::Replace => Intent::ReplaceAround { element, at },
            BrushMode::EraseOnly => Intent::EraseAround { element, at },
        })
    }
}

/// An element poured by the hand.
fn pour(dab: &Dab, element: ElementId) -> Intent {
    let velocity = throw(dab.velocity, dab.reference);
    Intent::Pour { element, stroke: dab.stroke, velocity, share: dab.share }
}

/// What an element does to what is there, unless it is drawn into free room.
fn over(dab: &Dab, element: ElementId) -> Option<Intent> {
    match dab.mode {
        BrushMode::Draw | BrushMode::Spring => None,
        BrushMode::Replace => Some(Intent::Replace { element, stroke: dab.stroke }),
        BrushMode::EraseOnly => Some(Intent::EraseOnly { element, stroke: dab.stroke }),
    }
}

/// A name on the screen: with spaces between its words.
pub fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

/// The icon of the elements of a category.
fn icon_of(category: Category) -> Icon {
    match category {
        Category::Solids => icons::stone,
        Category::Powders => icons::heap,
        Category::Liquids => icons::droplet,
        Category::Gases => icons::cloud,
    }
}

/// A colour that is seen on a dark tile.
fn lit(colour: Color32) -> Color32 {
    let brightest = colour.r().max(colour.g()).max(colour.b());
    if brightest < DIMMEST { colour.lerp_to_gamma(Color32::WHITE, 0.2) } else { colour }
}

/// Colour of an element.
fn colour_of(element: &Element) -> Color32 {
    let [r, g, b] = element.colour;
    Color32::from_rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tool_stands_under_one_heading_and_those_that_are_no_elements_last() {
        let elements = crate::scene::elements().expect("the table that comes with the game is valid");
        let all: Vec<Tool> = Tool::all(&elements).collect();
        let groups = Tool::groups(&elements, &all);
        assert_eq!(groups.iter().flat_map(|(_, of)| of).copied().collect::<Vec<_>>(), all);
        assert_eq!(groups.last().map(|(title, _)| *title), Some("tools"));
        assert!(Tool::groups(&elements, &all[..1]).len() == 1, "a heading over nothing");
    }

    #[test]
    fn names_of_tools_are_unique() {
        for (k, row) in TOOLS.iter().enumerate() {
            assert!(TOOLS[k + 1..].iter().all(|other| row != other), "{row:?} stands twice");
        }
    }
}
