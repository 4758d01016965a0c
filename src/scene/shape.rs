//! Shapes with their numbers put in: which points of the plane they hold. Lengths in d.

use crate::scene::{
    builtin::Origin,
    error::SceneError,
    file::Shape,
    image::Mask,
    number::{Evaluator, Number, Pair, Range},
};
use glam::DVec2;
use std::fmt::Display;

/// Coordinates and lengths that a file may give, m.
const COORDINATE: Range = Range::real(-1e6, 1e6);
const LENGTH: Range = Range::real(1e-6, 1e6);

/// Rounding in "4 * columns * d" must not decide whether a site is in a shape, d.
const SLACK: f64 = 1e-6;

/// A region of the plane.
#[derive(Clone, Debug)]
pub(super) enum Region {
    Rect { min: DVec2, max: DVec2 },
    Disc { centre: DVec2, radius: f64 },
    Line { from: DVec2, to: DVec2, radius: f64 },
    Polygon { points: Vec<DVec2> },
    Image { mask: Mask, min: DVec2, max: DVec2 },
}

impl Region {
    /// Puts the numbers in; `spacing` is d in m, `field` the path of the placement.
    pub(super) fn new(
        values: &Evaluator<'_>,
        origin: &Origin,
        spacing: f64,
        field: &dyn Display,
        shape: &Shape,
    ) -> Result<Self, SceneError> {
        let point = |name: &dyn Display, pair: &Pair| {
            values.pair(format_args!("{field}.{name}"), pair, COORDINATE).map(|metres| metres / spacing)
        };
        let length = |name: &dyn Display, number: &Number| {
            values.number(format_args!("{field}.{name}"), number, LENGTH).map(|metres| metres / spacing)
        };
        match shape {
            Shape::Rect { min, max } => {
                let (min, max) = corners(values, spacing, &format_args!("{field}.rect"), min, max)?;
                Ok(Self::Rect { min, max })
            }
            Shape::Disc { centre, radius } => {
                Ok(Self::Disc { centre: point(&"disc.centre", centre)?, radius: length(&"disc.radius", radius)? })
            }
            Shape::Line { from, to, width } => Ok(Self::Line {
                from: point(&"line.from", from)?,
                to: point(&"line.to", to)?,
                radius: 0.5 * length(&"line.width", width)?,
            }),
            Shape::Polygon { points } => {
                if !(3..=1000).contains(&points.len()) {
                    let what = format!("{} points; allowed: 3 to 1000", points.len());
                    return Err(values.fault(format_args!("{field}.polygon.points"), what));
                }
                let corner = |(k, pair)| point(&format_args!("polygon.points[{k}]"), pair);
                Ok(Self::Polygon { points: points.iter().enumerate().map(corner).collect::<Result<_, _>>()? })
            }
            Shape::Image { file, min, max } => {
                let (min, max) = corners(values, spacing, &format_args!("{field}.image"), min, max)?;
                let mask = origin.read(file).and_then(|bytes| Mask::decode(&bytes));
                let mask = mask.map_err(|what| {
                    values.fault(format_args!("{field}.image.file"), format_args!("`{file}`: {what}"))
                })?;
                Ok(Self::Image { mask, min, max })
            }
        }
    }

    /// A rectangle that the region lies in.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        match self {
            Self::Rect { min, max } | Self::Image { min, max, .. } => (*min, *max),
            Self::Disc { centre, radius } => (*centre - *radius, *centre + *radius),
            Self::Line { from, to, radius } => (from.min(*to) - *radius, from.max(*to) + *radius),
            Self::Polygon { points } => points
                .iter()
                .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), point| (min.min(*point), max.max(*point))),
        }
    }

    /// What testing a point costs, in comparisons of two numbers.
    pub(super) fn cost(&self) -> usize {
        match self {
            Self::Polygon { points } => points.len(),
            _ => 1,
        }
    }

    /// Pixels of its picture, if it is one.
    pub(super) fn pixels(&self) -> usize {
        match self {
            Self::Image { mask, .. } => mask.pixels(),
            _ => 0,
        }
    }

    /// Whether the point is inside. Lower and left edges of a rectangle count, the others don't.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        match self {
            Self::Rect { min, max } => point.cmpge(*min - SLACK).all() && point.cmplt(*max - SLACK).all(),
            Self::Disc { centre, radius } => (point - *centre).length_squared() <= radius * radius + SLACK,
            Self::Line { from, to, radius } => {
                let along = *to - *from;
                let length_squared = along.length_squared();
                let share = if length_squared > 0.0 {
                    ((point - *from).dot(along) / length_squared).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                (point - (*from + along * share)).length_squared() <= radius * radius + SLACK
            }
            Self::Polygon { points } => {
                let edges = points.iter().zip(points.iter().cycle().skip(1));
                edges.fold(false, |inside, (a, b)| inside != crosses(*a, *b, point))
            }
            Self::Image { mask, min, max } => {
                let place = (point - *min) / (*max - *min);
                mask.is_dark(place.x, place.y)
            }
        }
    }
}

/// Whether the ray from `point` to the right crosses the edge from `a` to `b`. Each edge owns its lower end only, so that
/// a ray through a corner counts once.
fn crosses(a: DVec2, b: DVec2, point: DVec2) -> bool {
    (a.y <= point.y) != (b.y <= point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
}

/// Both corners of a rectangle, in d.
pub(super) fn corners(
    values: &Evaluator<'_>,
    spacing: f64,
    field: &dyn Display,
    min: &Pair,
    max: &Pair,
) -> Result<(DVec2, DVec2), SceneError> {
    let min = values.pair(format_args!("{field}.min"), min, COORDINATE)?;
    let max = values.pair(format_args!("{field}.max"), max, COORDINATE)?;
    if min.cmplt(max).all() {
        return Ok((min / spacing, max / spacing));
    }
    let what = format!("({}, {}) isn't beyond min; allowed: above {} and {}", max.x, max.y, min.x, min.y);
    Err(values.fault(format_args!("{field}.max"), what))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites(region: &Region) -> usize {
        let inside = |i: i32| region.contains(DVec2::new(f64::from(i % 100) + 0.5, f64::from(i / 100) + 0.5));
        (0..10_000).filter(|i| inside(*i)).count()
    }

    #[test]
    fn areas_come_out_right() {
        let at = DVec2::new;
        let cases = [
            (Region::Rect { min: at(10.0, 10.0), max: at(30.0 + 1e-9, 40.0 - 1e-9) }, 600.0, 0.0),
            (Region::Disc { centre: at(50.0, 50.0), radius: 30.0 }, 2827.4, 12.0),
            (Region::Line { from: at(20.0, 20.0), to: at(60.0, 50.0), radius: 5.0 }, 578.5, 8.0),
            (Region::Line { from: at(20.0, 20.0), to: at(20.0, 20.0), radius: 5.0 }, 78.5, 4.0),
            (Region::Polygon { points: vec![at(0.0, 0.0), at(100.0, 0.0), at(0.0, 100.0)] }, 5000.0, 51.0),
        ];
        for (region, area, tolerance) in cases {
            let count = sites(&region) as f64;
            assert!((count - area).abs() <= tolerance, "{region:?}: {count} sites, area {area}");
        }
    }

    #[test]
    fn bounds_hold_every_site() {
        let at = DVec2::new;
        let line = Region::Line { from: at(60.2, 20.1), to: at(20.4, 50.8), radius: 5.3 };
        let (min, max) = line.bounds();
        for i in 0..10_000 {
            let site = at(f64::from(i % 100) + 0.5, f64::from(i / 100) + 0.5);
            assert!(!line.contains(site) || (site.cmpge(min).all() && site.cmple(max).all()));
        }
    }
}
