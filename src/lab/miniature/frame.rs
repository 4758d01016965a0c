//! Where the box of a world lies on a picture.

use crate::lab::colours::Rgb;
use glam::Vec2;

/// Width of a picture, pixels.
pub const WIDTH: usize = 256;
/// Height of a picture, pixels.
pub const HEIGHT: usize = 160;

/// How much larger than it fits a wide box is shown.
const CROP: f32 = 1.15;

/// Where the box lies on the picture.
pub(super) struct Frame {
    /// Pixels of a spacing.
    pixels: f32,
    /// The box's lower left corner, pixels from the upper left.
    corner: Vec2,
    /// The box, d.
    size: Vec2,
}

impl Frame {
    /// As large as it fits a box of `size` d, in the middle; of a wide one a little at its ends is left out.
    pub(super) fn new(size: Vec2) -> Self {
        let picture = Vec2::new(WIDTH as f32, HEIGHT as f32);
        let share = picture / size;
        let pixels = (CROP * share.x).min(share.y);
        let pixels = pixels.max(share.min_element());
        let gap = (picture - size * pixels) / 2.0;
        Self { pixels, corner: Vec2::new(gap.x, picture.y - gap.y), size }
    }

    /// Pixels of a spacing.
    pub(super) fn pixels(&self) -> f32 {
        self.pixels
    }

    /// Size of the box, d.
    pub(super) fn size(&self) -> Vec2 {
        self.size
    }

    /// The place of a pixel's centre, d.
    pub(super) fn place(&self, pixel: usize) -> Vec2 {
        let at = Vec2::new((pixel % WIDTH) as f32, (pixel / WIDTH) as f32) + 0.5 - self.corner;
        Vec2::new(at.x, -at.y) / self.pixels
    }

    /// The place on the picture, pixels from the upper left.
    pub(super) fn pixel(&self, place: Vec2) -> Vec2 {
        self.corner + Vec2::new(place.x, -place.y) * self.pixels
    }

    /// Whether a place is in the box.
    pub(super) fn holds(&self, place: Vec2) -> bool {
        place.cmpge(Vec2::ZERO).all() && place.cmple(self.size).all()
    }
}

/// Light, 0 … 1 a channel: the square of the sRGB value, nearly the true curve.
pub(super) fn light(colour: Rgb) -> [f32; 3] {
    colour.map(|channel| {
        let value = f32::from(channel) / 255.0;
        value * value
    })
}
