//! The chosen tool and the brush.

use crate::{
    game::{
        brush_mode::BrushMode,
        icons::{self, Icon},
        tools::{Dab, Tool},
    },
    kernel::{
        brush::{BrushShape, Stroke},
        element::ElementId,
        heat::units::{COLDEST, HOTTEST},
    },
    lab::colours::Reference,
};
use bevy::prelude::Resource;
use glam::Vec2;
use std::ops::RangeInclusive;

/// Smallest and largest brush, half its width in d.
pub const BRUSH_RANGE: RangeInclusive<f32> = 0.5..=40.0;
/// Temperatures that can be set, K.
pub const TEMPERATURE_RANGE: RangeInclusive<f32> = COLDEST..=HOTTEST;
/// The temperature that is set before the player chooses another, K: it boils water, and sets fire to most of what can burn.
const FIRST_TEMPERATURE: f32 = 773.0;
/// Factor of one step of brush size.
const BRUSH_STEP: f32 = 1.25;

/// The player's choice of tool and brush.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Toolbox {
    /// The chosen tool.
    pub tool: Tool,
    /// Outline of the brush.
    pub shape: BrushShape,
    /// What a brush with an element does.
    mode: BrushMode,
    /// Half the width of the brush, in the scene's own spacings.
    radius: f32,
    /// Temperature that is set, K.
    kelvin: f32,
    /// The scene's own spacing, d: a brush is as wide in metres at every detail.
    pub unit: f32,
}

impl Default for Toolbox {
    fn default() -> Self {
        let tool = Tool::Element(ElementId(0));
        Self { tool, shape: BrushShape::Disc, mode: BrushMode::Draw, radius: 4.0, kelvin: FIRST_TEMPERATURE, unit: 1.0 }
    }
}

impl Toolbox {
    /// The same brush with another tool.
    pub fn with(self, tool: Tool) -> Self {
        Self { tool, ..self }
    }

    /// Half the width of the brush of the chosen tool, in the scene's own spacings.
    pub fn radius(&self) -> f32 {
        match self.tool {
            Tool::Element(_) => self.radius,
            Tool::Other(row) => self.radius.max(row.least_radius),
        }
    }

    /// Half the width of the brush of the chosen tool, d.
    pub fn reach(&self) -> f32 {
        self.radius() * self.unit
    }

    /// Sets half the width of the brush, in the scene's own spacings.
    pub fn set_radius(&mut self, radius: f32) {
        self.radius = radius.clamp(*BRUSH_RANGE.start(), *BRUSH_RANGE.end());
    }

    /// What the brush does to what is there; only an element's has a choice.
    pub fn mode(&self) -> BrushMode {
        if matches!(self.tool, Tool::Element(_)) { self.mode } else { BrushMode::Draw }
    }

    /// Chooses what a brush with an element does.
    pub fn set_mode(&mut self, mode: BrushMode) {
        self.mode = mode;
    }

    /// Temperature that is set, K; none if the chosen tool has none.
    pub fn kelvin(&self) -> Option<f32> {
        matches!(self.tool, Tool::Other(row) if row.has_temperature).then_some(self.kelvin)
    }

    /// Chooses the temperature that is set, K.
    pub fn set_kelvin(&mut self, kelvin: f32) {
        self.kelvin = kelvin.clamp(*TEMPERATURE_RANGE.start(), *TEMPERATURE_RANGE.end());
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

    /// The icon of the outline.
    pub fn shape_icon(&self) -> Icon {
        if self.shape == BrushShape::Disc { icons::round_brush } else { icons::square_brush }
    }

    /// The brush dragged from one point to another.
    pub fn stroke(&self, from: Vec2, to: Vec2) -> Stroke {
        Stroke { shape: self.shape, from, to, radius: self.reach() }
    }

    /// A stroke of a drag of a velocity (d/s), in a world where this is fast, within a share of a tick.
    pub fn dab(&self, stroke: Stroke, velocity: Vec2, reference: Reference, share: f32) -> Dab {
        Dab { stroke, mode: self.mode, velocity, reference, kelvin: self.kelvin, share }
    }

    /// A whole line or rectangle, which is no matter of how fast it was drawn.
    pub fn whole(&self, stroke: Stroke) -> Dab {
        self.dab(stroke, Vec2::ZERO, Reference { fall: 0.0, wind: 0.0 }, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::tools::{IGNITE, TEMPERATURE, WIND};

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
        tools.tool = Tool::Other(&WIND);
        assert_eq!(tools.radius(), WIND.least_radius);
    }

    #[test]
    fn only_a_tool_that_sets_a_temperature_has_one_and_it_stays_in_its_range() {
        let mut tools = Toolbox::default().with(Tool::Other(&IGNITE));
        assert_eq!(tools.kelvin(), None);
        tools.tool = Tool::Other(&TEMPERATURE);
        for (kelvin, set) in [(400.0, 400.0), (0.0, COLDEST), (1e9, HOTTEST)] {
            tools.set_kelvin(kelvin);
            assert_eq!(tools.kelvin(), Some(set));
        }
    }
}
