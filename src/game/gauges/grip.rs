//! Gauges under the pointer: what of one can be gripped, and where a drag takes it.

use crate::{
    game::{camera::WorldCamera, gauges::desk::mark},
    kernel::units::Scale,
    lab::gauges::{
        place::Place,
        set::{Gauge, Gauges},
    },
};
use glam::Vec2;

/// Radius of what counts as on a mark, and on an end of a line, logical pixels.
const ON_MARK: f32 = 12.0;
const ON_END: f32 = 7.0;

/// What of a gauge moves with the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of it, by its mark.
    Whole,
    /// The first end of a line.
    From,
    /// The second.
    To,
}

/// A gauge that is gripped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Its number.
    pub number: u32,
    /// What is gripped.
    pub part: Part,
    /// Where it was then.
    was: Place,
}

impl Grip {
    /// What is gripped of a gauge at a pixel. A mark is before the ends, so that no line is too short to be moved.
    fn of(gauge: &Gauge, pixel: Vec2, camera: &WorldCamera, scale: Scale) -> Option<Self> {
        let near = |at: Vec2, reach: f32| (at - pixel).length() <= reach;
        let is_at = |end: Vec2| near(camera.to_pixel(scale.vec_to_kernel(end)), ON_END);
        let part = match gauge.place {
            _ if near(mark(gauge, camera, scale), ON_MARK) => Part::Whole,
            Place::Line { to, .. } if is_at(to) => Part::To,
            Place::Line { from, .. } if is_at(from) => Part::From,
            _ => return None,
        };
        Some(Self { number: gauge.number, part, was: gauge.place })
    }

    /// Where the gauge is after a drag of `way`, m. It stays in a box of `size`, m.
    pub fn place(self, way: Vec2, size: Vec2) -> Place {
        let inside = |at: Vec2| at.clamp(Vec2::ZERO, size);
        match (self.was, self.part) {
            (Place::Spot { at, radius }, _) => Place::Spot { at: inside(at + way), radius },
            (Place::Line { from, to }, Part::From) => Place::Line { from: inside(from + way), to },
            (Place::Line { from, to }, Part::To) => Place::Line { from, to: inside(to + way) },
            (Place::Line { from, to }, Part::Whole) => {
                // At an edge it keeps its length.
                let way = way.clamp(-from.min(to), size - from.max(to));
                Place::Line { from: inside(from + way), to: inside(to + way) }
            }
        }
    }
}

/// What is gripped of the gauges at a pixel: a mark before the end of any line.
pub fn at(pixel: Vec2, gauges: &Gauges, camera: &WorldCamera, scale: Scale) -> Option<Grip> {
    let grips = || gauges.iter().filter_map(|gauge| Grip::of(gauge, pixel, camera, scale));
    grips().find(|grip| grip.part == Part::Whole).or_else(|| grips().next())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_its_length_at_the_edge_and_an_end_stays_in_the_box() {
        let (from, to, size) = (Vec2::new(2.0, 1.0), Vec2::new(4.0, 3.0), Vec2::new(10.0, 5.0));
        let after = |part: Part, way: (f32, f32)| {
            let grip = Grip { number: 1, part, was: Place::Line { from, to } };
            grip.place(way.into(), size)
        };
        let line = |from: (f32, f32), to: (f32, f32)| Place::Line { from: from.into(), to: to.into() };
        assert_eq!(after(Part::Whole, (1.0, 1.0)), line((3.0, 2.0), (5.0, 4.0)));
        assert_eq!(after(Part::Whole, (-9.0, 9.0)), line((0.0, 3.0), (2.0, 5.0)));
        assert_eq!(after(Part::From, (-9.0, 1.0)), line((0.0, 2.0), (4.0, 3.0)));
        assert_eq!(after(Part::To, (9.0, -1.0)), line((2.0, 1.0), (10.0, 2.0)));
    }
}
