//! Where a gauge is.

use crate::sim::state::Setup;
use glam::Vec2;

/// Radius of a gauge that does not say, in the scene's own spacings.
const SPACINGS: f32 = 3.0;

/// Least radius, in spacings of the run: the nearest particle of a liquid is always within it.
const LEAST: f32 = 1.0;

/// Shortest line, in spacings of the run.
const SHORTEST: f32 = 0.5;

/// Where a gauge is, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// All around a place.
    Spot {
        /// Where.
        at: Vec2,
        /// How far around.
        radius: f32,
    },
    /// Through a line. What crosses it to the right of the way from one end to the other counts as positive.
    Line {
        /// One end.
        from: Vec2,
        /// The other.
        to: Vec2,
    },
}

/// Radius of a gauge in a scene that does not say, m.
pub fn usual_radius(setup: &Setup) -> f32 {
    let scale = setup.blueprint.scale;
    (SPACINGS * scale.own_spacing()).max(LEAST * scale.spacing)
}

impl Place {
    /// Whether a gauge can be there.
    ///
    /// # Errors
    /// If it can't: what is wrong, and what is allowed.
    pub fn check(self, setup: &Setup) -> Result<(), String> {
        let (scale, spacing) = (setup.blueprint.scale, setup.blueprint.scale.spacing);
        let size = scale.vec_to_metres(setup.blueprint.domain.size);
        let inside = |at: Vec2| match at.cmpge(Vec2::ZERO).all() && at.cmple(size).all() {
            true => Ok(()),
            false => Err(format!(
                "{},{} is not in the box; allowed: x from 0 to {:.4}, y from 0 to {:.4} m",
                at.x, at.y, size.x, size.y
            )),
        };
        match self {
            Self::Spot { at, radius } => {
                let (least, most) = (LEAST * spacing, size.max_element());
                let fits = radius >= least * 0.999 && radius <= most;
                let bad = format!("a radius of {radius} m; allowed: {least:.4} (a spacing) to {most:.4} m");
                inside(at).and(if fits { Ok(()) } else { Err(bad) })
            }
            Self::Line { from, to } => {
                let (length, least) = ((to - from).length(), SHORTEST * spacing);
                let bad = format!("a line of {length} m; allowed: {least:.4} m (half a spacing) or more");
                inside(from).and(inside(to)).and(if length >= least { Ok(()) } else { Err(bad) })
            }
        }
    }
}
