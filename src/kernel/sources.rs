//! What a scene keeps adding to the world: particles that flow in and air that is driven.

use crate::element::ElementId;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// A rectangle in d, `min < max` in both components.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rect {
    /// Lower left corner, d.
    pub min: Vec2,
    /// Upper right corner, d.
    pub max: Vec2,
}

impl Rect {
    /// Whether the point is inside (the lower and left edges count, the others do not).
    pub fn contains(self, point: Vec2) -> bool {
        point.cmpge(self.min).all() && point.cmplt(self.max).all()
    }
}

/// An emitter: fills the free sites of its rectangle with particles until it has given its total.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Emitter {
    /// What flows.
    pub element: ElementId,
    /// Where, d.
    pub area: Rect,
    /// Velocity of a new particle, d/s.
    pub velocity: Vec2,
    /// Particles a second at most.
    pub rate: f32,
    /// Particles in all, if it ever ends.
    pub total: Option<u32>,
    /// First tick at which it flows.
    pub start: u64,
    /// Particles given so far (state).
    pub given: u32,
    /// Share of a particle that is due (state), 0 … 1.
    pub due: f32,
}

/// A wind: drives the air in its rectangle towards a velocity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wind {
    /// Where, d.
    pub area: Rect,
    /// Velocity that the air tends to there, d/s.
    pub velocity: Vec2,
    /// How fast it tends to it, 1/s: after a time t the difference is down to 1/(1 + rate·t).
    pub rate: f32,
}

/// A drain: takes away the movable particles that enter its rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drain {
    /// Where, d.
    pub area: Rect,
}
