//! What the player holds: the chosen tool and the brush.

use crate::kernel::{
    brush::{BrushShape, Stroke},
    element::{ElementId, ElementTable},
};
use bevy::prelude::Resource;
use glam::Vec2;

/// Smallest and largest brush, half its width in d.
pub const BRUSH_RANGE: std::ops::RangeInclusive<f32> = 0.5..=40.0;
/// Factor of one step of brush size.
const BRUSH_STEP: f32 = 1.25;
/// The air tools feel like nothing with a small brush: theirs is at least this, d.
const AIR_BRUSH: f32 = 6.0;

/// What the left button does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// Draws an element.
    Element(ElementId),
    /// Takes away what is there.
    Erase,
    /// Sets the air moving along the drag.
    Wind,
    /// Adds pressure with the left button, sucks with the right.
    Pressure,
}

impl Tool {
    /// The tools beside the elements, in the order of the palette.
    pub const OTHERS: [Self; 3] = [Self::Erase, Self::Wind, Self::Pressure];

    /// Name in the palette.
    pub fn name(self, elements: &ElementTable) -> &str {
        match self {
            Self::Element(id) => &elements.get(id).name,
            Self::Erase => "erase",
            Self::Wind => "wind",
            Self::Pressure => "pressure",
        }
    }

    /// Whether it works on the air.
    pub fn is_air(self) -> bool {
        matches!(self, Self::Wind | Self::Pressure)
    }
}

/// The player's choice of tool and brush.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Toolbox {
    /// The chosen tool.
    pub tool: Tool,
    /// Outline of the brush.
    pub shape: BrushShape,
    radius: f32,
}

impl Default for Toolbox {
    fn default() -> Self {
        Self { tool: Tool::Element(ElementId(0)), shape: BrushShape::Disc, radius: 4.0 }
    }
}

impl Toolbox {
    /// The same brush with another tool.
    pub fn with(self, tool: Tool) -> Self {
        Self { tool, ..self }
    }

    /// The chosen element, if the tool is one.
    pub fn element(&self) -> Option<ElementId> {
        match self.tool {
            Tool::Element(element) => Some(element),
            Tool::Erase | Tool::Wind | Tool::Pressure => None,
        }
    }

    /// Half the width of the brush of the chosen tool, d.
    pub fn radius(&self) -> f32 {
        if self.tool.is_air() { self.radius.max(AIR_BRUSH) } else { self.radius }
    }

    /// Sets half the width of the brush, d.
    pub fn set_radius(&mut self, radius: f32) {
        self.radius = radius.clamp(*BRUSH_RANGE.start(), *BRUSH_RANGE.end());
    }

    /// Makes the brush larger (or smaller, if negative) by so many steps.
    pub fn grow(&mut self, steps: i32) {
        let mut radius = self.radius();
        for _ in 0..steps.unsigned_abs() {
            radius = if steps > 0 { radius * BRUSH_STEP } else { radius / BRUSH_STEP };
        }
        self.set_radius(radius);
    }

    /// The other outline.
    pub fn turn_shape(&mut self) {
        self.shape = match self.shape {
            BrushShape::Disc => BrushShape::Square,
            BrushShape::Square | BrushShape::Rectangle => BrushShape::Disc,
        };
    }

    /// The brush dragged from one point to another.
    pub fn stroke(&self, from: Vec2, to: Vec2) -> Stroke {
        Stroke { shape: self.shape, from, to, radius: self.radius() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_brush_stays_in_its_range_and_steps_are_inverse() {
        let mut tools = Toolbox::default();
        tools.grow(2);
        tools.grow(-2);
        assert!((tools.radius() - 4.0).abs() < 1e-4);
        tools.grow(100);
        assert_eq!(tools.radius(), *BRUSH_RANGE.end());
        tools.grow(-100);
        assert_eq!(tools.radius(), *BRUSH_RANGE.start());
    }

    #[test]
    fn air_tools_have_a_brush_that_can_be_felt() {
        let mut tools = Toolbox::default();
        tools.set_radius(1.0);
        tools.tool = Tool::Wind;
        assert_eq!(tools.radius(), AIR_BRUSH);
    }
}
