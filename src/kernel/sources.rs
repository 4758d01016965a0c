//! What keeps adding to the world and taking away: particles that flow in and out, and air that is driven.

use crate::{
    brush::{BrushShape, Stroke},
    element::{ElementId, ElementTable},
    units::TICKS_PER_SECOND,
};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Points that are looked at together.
pub(crate) const BLOCK: usize = 64;

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

    /// Whether any of the points is inside.
    pub(crate) fn contains_any(self, [x, y]: [&[f32]; 2]) -> bool {
        let Self { min, max } = self;
        let mut blocks = x.chunks(BLOCK).zip(y.chunks(BLOCK));
        // Without a branch for each point, a block is looked at in lanes.
        let is_inside = |x: f32, y: f32| (x >= min.x) & (y >= min.y) & (x < max.x) & (y < max.y);
        blocks.any(|(x, y)| x.iter().zip(y).fold(false, |any, (&x, &y)| any | is_inside(x, y)))
    }

    /// The square around a brush where it stands, of a site at least; all of a rectangle that is drawn.
    pub fn under(stroke: &Stroke) -> Self {
        let (low, high) = match stroke.shape {
            BrushShape::Rectangle => (stroke.from.min(stroke.to), stroke.from.max(stroke.to)),
            BrushShape::Disc | BrushShape::Square => (stroke.to - stroke.radius, stroke.to + stroke.radius),
        };
        let wider = (0.5 * (1.0 - (high - low))).max(Vec2::ZERO);
        Self { min: low - wider, max: high + wider }
    }

    /// Sites in it, about.
    pub fn sites(self) -> f32 {
        (self.max - self.min).element_product()
    }

    /// The part of it that is in another, if there is any.
    pub fn within(self, other: Self) -> Option<Self> {
        self.meets(other).then(|| Self { min: self.min.max(other.min), max: self.max.min(other.max) })
    }

    /// Whether the two share any place.
    pub fn meets(self, other: Self) -> bool {
        self.min.cmplt(other.max).all() && other.min.cmplt(self.max).all()
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

impl Emitter {
    /// One that goes on pouring what a brush pours where it stands: at rest, at the flow of the element.
    pub fn of_brush(element: ElementId, stroke: &Stroke, elements: &ElementTable) -> Self {
        let area = Rect::under(stroke);
        let rate = area.sites() * elements.get(element).flow * TICKS_PER_SECOND as f32;
        Self { element, area, velocity: Vec2::ZERO, rate, total: None, start: 0, given: 0, due: 0.0 }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_area_is_what_a_brush_is_over_and_never_less_than_a_site() {
        let at = Vec2::new(10.3, 5.2);
        let wide = Rect::under(&Stroke::dab(BrushShape::Disc, at, 3.0));
        assert_eq!((wide.min, wide.max), (at - 3.0, at + 3.0));
        let narrow = Rect::under(&Stroke::dab(BrushShape::Square, at, 0.1));
        assert!((narrow.sites() - 1.0).abs() < 1e-5 && narrow.contains(at));
        let drawn = Rect::under(&Stroke::rectangle(Vec2::new(8.0, 1.0), Vec2::new(2.0, 1.2)));
        assert_eq!((drawn.min.x, drawn.max.x), (2.0, 8.0));
        assert!((drawn.max.y - drawn.min.y - 1.0).abs() < 1e-5, "a line is a site wide");
    }

    #[test]
    fn areas_meet_where_they_overlap() {
        let of = |low: f32, high: f32| Rect { min: Vec2::splat(low), max: Vec2::splat(high) };
        assert!(of(0.0, 2.0).meets(of(1.0, 3.0)) && of(0.0, 9.0).meets(of(4.0, 5.0)));
        assert!(!of(0.0, 2.0).meets(of(2.0, 3.0)), "a common edge is no common place");
    }
}
