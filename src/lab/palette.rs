//! Plain colours for pictures, sRGB.

use crate::kernel::element::Element;
use glam::Vec2;

/// An sRGB colour.
pub type Rgb = [u8; 3];

/// Around the box.
pub const SURROUNDINGS: Rgb = [11, 13, 18];

/// Moving air.
const WIND: Rgb = [72, 208, 190];

/// The empty box at a height given as a share of the box.
pub fn box_colour(height: f32) -> Rgb {
    [(16, 25), (19, 31), (27, 43)].map(|(low, high)| (low as f32 + (high - low) as f32 * height) as u8)
}

/// An element.
pub fn colour(element: &Element) -> Rgb {
    element.colour
}

/// Colour and opacity (0 … 1) of air at a velocity (d/s); half of the strongest at `wind`.
pub fn air_colour(wind: f32, velocity: Vec2) -> (Rgb, f32) {
    let share = 2.0 * velocity.length() / wind;
    (WIND, 0.4 * share / (1.0 + share))
}
