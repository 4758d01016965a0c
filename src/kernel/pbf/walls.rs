//! The walls of the box in the density constraint.

use crate::{params::Domain, smoothing::Smoothing};
use glam::Vec2;

/// What the walls that a kernel at `position` (d) reaches do to a particle there: the density that they add, and the sum of
/// `g (x_i − x_j)` over what they are filled with. Where two walls meet, their overlap is counted once (as for a separable
/// kernel).
#[inline]
pub(crate) fn wall_sums(smoothing: &Smoothing, domain: &Domain, position: Vec2) -> (f32, Vec2) {
    let axis = |at: f32, size: f32| {
        let (low, low_push) = smoothing.wall(at);
        let (high, high_push) = smoothing.wall(size - at);
        (low + high, low_push - high_push)
    };
    let (density_x, push_x) = axis(position.x, domain.size.x);
    let (density_y, push_y) = axis(position.y, domain.size.y);
    (density_x + density_y - density_x * density_y, Vec2::new(push_x * (1.0 - density_y), push_y * (1.0 - density_x)))
}
