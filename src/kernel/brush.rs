//! The shape that a tool covers while it is dragged.

use crate::solids::{Solids, centre};
use glam::{IVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Outline of a brush.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum BrushShape {
    /// Round.
    #[default]
    Disc,
    /// Axis-parallel.
    Square,
    /// The rectangle between the two ends of the drag, whatever the radius.
    Rectangle,
}

/// A brush dragged in a straight line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Outline of the brush.
    pub shape: BrushShape,
    /// Where the drag begins, d.
    pub from: Vec2,
    /// Where it ends, d.
    pub to: Vec2,
    /// Half the brush's width, d. However small, a brush covers the site that it points at.
    pub radius: f32,
}

impl Stroke {
    /// A brush that stands still.
    pub fn dab(shape: BrushShape, at: Vec2, radius: f32) -> Self {
        Self { shape, from: at, to: at, radius }
    }

    /// The filled rectangle between two corners.
    pub fn rectangle(a: Vec2, b: Vec2) -> Self {
        Self { shape: BrushShape::Rectangle, from: a.min(b), to: a.max(b), radius: 0.0 }
    }

    /// The same stroke with its lengths times `factor`: in d of another length.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        Self { shape: self.shape, from: self.from * factor, to: self.to * factor, radius: self.radius * factor }
    }

    /// Whether the point is under the brush.
    pub fn covers(&self, point: Vec2) -> bool {
        let (way, from) = (self.to - self.from, point - self.from);
        match self.shape {
            BrushShape::Disc => {
                let share = (from.dot(way) / way.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
                (from - way * share).length_squared() <= self.radius * self.radius
            }
            BrushShape::Square => {
                // The shares of the way at which the square is over the point in x and in y must overlap.
                let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
                for (from, way) in [(from.x, way.x), (from.y, way.y)] {
                    if way == 0.0 {
                        if from.abs() > self.radius {
                            return false;
                        }
                        continue;
                    }
                    let (a, b) = ((from - self.radius) / way, (from + self.radius) / way);
                    (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
                }
                enter <= leave
            }
            BrushShape::Rectangle => {
                point.cmpge(self.from.min(self.to)).all() && point.cmple(self.from.max(self.to)).all()
            }
        }
    }

    /// Whether the brush covers a cell: its centre, or the cell that the drag begins (for a brush, or ends) in.
    fn covers_cell(&self, cell: IVec2) -> bool {
        let is_end = self.shape != BrushShape::Rectangle && cell == Solids::cell_of(self.to);
        self.covers(centre(cell)) || cell == Solids::cell_of(self.from) || is_end
    }

    /// Lowest and highest cell that the stroke can touch in a box of `size` cells; nothing if it misses the box.
    pub fn bounds(&self, size: IVec2) -> Option<(IVec2, IVec2)> {
        if !(self.from.is_finite() && self.to.is_finite() && self.radius.is_finite()) {
            return None;
        }
        let margin = Vec2::splat(self.radius);
        let low = Solids::cell_of(self.from.min(self.to) - margin).max(IVec2::ZERO);
        let high = Solids::cell_of(self.from.max(self.to) + margin).min(size - 1);
        low.cmple(high).all().then_some((low, high))
    }

    /// The covered cells of a box of `size` cells, row by row.
    pub fn cells(&self, size: IVec2) -> impl Iterator<Item = IVec2> {
        let stroke = *self;
        let (low, high) = self.bounds(size).unwrap_or((IVec2::ZERO, IVec2::NEG_ONE));
        (low.y..=high.y)
            .flat_map(move |y| (low.x..=high.x).map(move |x| IVec2::new(x, y)))
            .filter(move |&cell| stroke.covers_cell(cell))
    }
}

/// Share of an air tool's wind or pressure that a point gets in a disc of radius R: `(1 − r²/R²)²`, 0 outside.
pub fn soft_disc(point: Vec2, centre: Vec2, radius: f32) -> f32 {
    let falloff = (1.0 - point.distance_squared(centre) / (radius * radius)).max(0.0);
    falloff * falloff
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: IVec2 = IVec2::new(40, 30);

    fn count(stroke: Stroke) -> usize {
        stroke.cells(SIZE).count()
    }

    #[test]
    fn the_smallest_brush_covers_the_cell_it_points_at() {
        for at in [Vec2::new(3.01, 4.99), Vec2::new(0.0, 0.0), Vec2::new(39.9, 29.9)] {
            let cells: Vec<IVec2> = Stroke::dab(BrushShape::Disc, at, 0.0).cells(SIZE).collect();
            assert_eq!(cells, [Solids::cell_of(at)]);
        }
    }

    #[test]
    fn brushes_cover_their_area() {
        let disc = count(Stroke::dab(BrushShape::Disc, Vec2::splat(15.0), 10.0)) as f32;
        assert!((disc - 314.0).abs() < 12.0, "a disc of radius 10 covers {disc} cells");
        assert_eq!(count(Stroke::dab(BrushShape::Square, Vec2::splat(15.0), 5.0)), 100);
        assert_eq!(count(Stroke::rectangle(Vec2::new(8.9, 3.9), Vec2::new(3.1, 1.1))), 18);
    }

    #[test]
    fn a_fast_drag_leaves_no_gaps() {
        for shape in [BrushShape::Disc, BrushShape::Square] {
            let stroke = Stroke { shape, from: Vec2::new(2.0, 15.0), to: Vec2::new(38.0, 15.0), radius: 2.0 };
            for x in 2..38 {
                assert!(stroke.cells(SIZE).any(|cell| cell == IVec2::new(x, 15)), "{shape:?} misses column {x}");
            }
        }
    }

    #[test]
    fn strokes_outside_or_not_finite_cover_nothing() {
        assert_eq!(count(Stroke::dab(BrushShape::Disc, Vec2::splat(-100.0), 5.0)), 0);
        assert_eq!(count(Stroke::dab(BrushShape::Disc, Vec2::new(f32::NAN, 1.0), 5.0)), 0);
        assert_eq!(count(Stroke::dab(BrushShape::Disc, Vec2::splat(3.0), f32::INFINITY)), 0);
        assert_eq!(count(Stroke::dab(BrushShape::Disc, Vec2::splat(1e30), 5.0)), 0);
    }
}
