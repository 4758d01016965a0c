//! The shape that a tool covers while it is dragged.

use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Outline of a brush.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum BrushShape {
    /// Round.
    #[default]
    Disc,
    /// Axis-parallel.
    Square,
}

/// A brush dragged in a straight line, or a rectangle (`BrushShape::Square` with radius 0 spans `from … to`).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Outline of the brush.
    pub shape: BrushShape,
    /// Where the drag begins, d.
    pub from: Vec2,
    /// Where it ends, d.
    pub to: Vec2,
    /// Half the brush's width, d; at least half a site is always covered.
    pub radius: f32,
}

impl Stroke {
    /// A brush that stands still.
    pub fn dab(shape: BrushShape, at: Vec2, radius: f32) -> Self {
        Self { shape, from: at, to: at, radius }
    }

    /// The filled rectangle between two corners.
    pub fn rectangle(a: Vec2, b: Vec2) -> Self {
        Self { shape: BrushShape::Square, from: a.min(b), to: a.max(b), radius: 0.0 }
    }
}
