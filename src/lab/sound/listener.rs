//! Who listens: from in front of the picture, in the middle of what it shows.

use glam::Vec2;

/// Distance at which a source is as loud as it is, m; at twice of it a quarter of its power arrives. Changing this affects how
/// loud everything is.
const REFERENCE: f32 = 12.0;

/// Most by which being near makes a source more powerful.
const NEAREST: f32 = 16.0;

/// Where the listener is. The further the picture is zoomed in, the nearer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listener {
    /// Middle of what is seen, m.
    pub centre: Vec2,
    /// Width of what is seen, m; above 0.
    pub width: f32,
}

/// How a source arrives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arrival {
    /// How much of its power.
    pub(super) share: f32,
    /// From which side, −1 … 1.
    pub(super) pan: f32,
}

impl Listener {
    /// One before the whole of a box of `size` (m).
    pub fn of_box(size: Vec2) -> Self {
        Self { centre: size / 2.0, width: size.x }
    }

    /// Distance to the plane of the world: what is seen fills a right angle.
    fn distance(self) -> f32 {
        (0.5 * self.width).max(0.1)
    }

    /// What of a source at a point (m) arrives: power falls with the square of the distance, and the side is the sine of the
    /// angle from straight ahead.
    pub(super) fn hears(self, at: Vec2) -> Arrival {
        let (offset, depth) = (at - self.centre, self.distance());
        let (plane, side) = (depth * depth, offset.x * offset.x);
        let share = (REFERENCE * REFERENCE / (plane + offset.length_squared())).min(NEAREST);
        Arrival { share, pan: offset.x / (plane + side).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_is_louder_and_what_is_mirrored_comes_from_the_other_side() {
        let far = Listener { centre: Vec2::new(12.0, 6.0), width: 24.0 };
        let near = Listener { width: 8.0, ..far };
        let (at, mirrored) = (Vec2::new(16.0, 5.0), Vec2::new(8.0, 5.0));
        let (here, there, closer) = (far.hears(at), far.hears(mirrored), near.hears(at));
        assert_eq!((here.share, here.pan), (there.share, -there.pan));
        assert!(here.pan > 0.2 && closer.share > 2.0 * here.share && closer.pan > here.pan);
        assert!(far.hears(Vec2::new(40.0, 5.0)).share < 0.5 * here.share, "what is out of the picture is faint");
        assert_eq!(far.hears(far.centre).pan, 0.0);
    }
}
