//! How strong the hand of a player is. Tools, and what plays in the place of a player, go by these.

use crate::lab::colours::Reference;
use glam::Vec2;

/// A small brush that moves air cannot be felt: theirs is at least this, half its width, in the scene's own spacings.
pub const AIR_BRUSH: f32 = 6.0;
/// Most wind that a drag makes, in units of [`Reference::wind`]: the speed of sound. Water takes off at some two units.
pub const WIND_LIMIT: f32 = 5.0;
/// Pressure that one tick of the pressure tool adds; the surroundings' is 1.
pub const PRESS_STEP: f32 = 0.4;
/// By how much one tick of the heat tool warms or cools, K: water boils away in half a second.
pub const WARM_STEP: f32 = 6.0;
/// Speed of the wind for each unit of drag speed.
const WIND_GAIN: f32 = 2.5;
/// A drag slower than this makes no wind, in units of [`Reference::wind`].
const WIND_FLOOR: f32 = 0.02;
/// Share of the speed of a drag that what is poured gets, at most that of a fall through the whole box. With all of it the
/// poured would go with the brush and leave no room for more: a swing would throw one drop, not a stream.
const THROW: f32 = 0.5;

/// The wind of a drag of a velocity, d/s; nothing if that is too slow for it.
pub fn wind(drag: Vec2, reference: Reference) -> Option<Vec2> {
    let velocity = (drag * WIND_GAIN).clamp_length_max(WIND_LIMIT * reference.wind);
    (velocity.length() > WIND_FLOOR * reference.wind).then_some(velocity)
}

/// How fast that goes which is poured in a drag of a velocity, d/s.
pub fn throw(drag: Vec2, reference: Reference) -> Vec2 {
    (drag * THROW).clamp_length_max(reference.fall)
}
