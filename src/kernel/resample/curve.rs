//! Hilbert's curve: an order of the places of the plane in which neighbours in the order are neighbours in the plane.

use glam::Vec2;

/// Bits of a coordinate: 32 768 d in steps of 1/32 d.
const BITS: u32 = 20;
/// Steps of a d.
const STEPS: f32 = 32.0;

/// How far along the curve a place (d) is. The curve runs through every square of 2ⁿ steps before it enters the next.
pub fn along(place: Vec2) -> u64 {
    let most = (1 << BITS) - 1;
    // A cast saturates: what is outside is ordered as if at the edge.
    let (mut x, mut y) = (((place.x * STEPS) as u32).min(most), ((place.y * STEPS) as u32).min(most));
    let mut way = 0;
    for bit in (0..BITS).rev() {
        let (right, upper) = (x >> bit & 1, y >> bit & 1);
        way = way << 2 | u64::from((3 * right) ^ upper);
        if upper == 0 {
            if right == 1 {
                (x, y) = (most - x, most - y);
            }
            (x, y) = (y, x);
        }
    }
    way
}
