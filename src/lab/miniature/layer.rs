//! Sums of particles on the pixels: how much of them is there, and in which colour.

use glam::Vec2;

/// A kernel sum over particles for each pixel.
pub(super) struct Layer {
    width: usize,
    height: usize,
    /// Weight, and weighted light of red, green and blue; row by row from the top.
    sums: Vec<[f32; 4]>,
}

impl Layer {
    /// Nothing, for so many pixels.
    pub(super) fn new(width: usize, height: usize) -> Self {
        Self { width, height, sums: vec![[0.0; 4]; width * height] }
    }

    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.sums.fill([0.0; 4]);
    }

    /// Adds a particle at a place (pixels, from the upper left) that reaches `radius` pixels far. Its kernel is (1 − q²)²;
    /// particles that stand `radius`/`reach` apart sum up to 1.
    pub(super) fn add(&mut self, at: Vec2, radius: f32, reach: f32, light: [f32; 3]) {
        if !at.is_finite() {
            return;
        }
        let (low, high) = (at - radius, at + radius);
        let (left, right) = (low.x.max(0.0) as usize, (high.x.max(0.0) as usize + 1).min(self.width));
        let (top, bottom) = (low.y.max(0.0) as usize, (high.y.max(0.0) as usize + 1).min(self.height));
        // The kernel's integral is π/3 of its reach squared.
        let norm = 3.0 / (std::f32::consts::PI * reach * reach);
        let inverse = 1.0 / (radius * radius);
        for y in top..bottom {
            let dy = y as f32 + 0.5 - at.y;
            for x in left..right {
                let dx = x as f32 + 0.5 - at.x;
                let share = 1.0 - (dx * dx + dy * dy) * inverse;
                if share > 0.0 {
                    let weight = norm * share * share;
                    let [sum, red, green, blue] = &mut self.sums[y * self.width + x];
                    *sum += weight;
                    *red += weight * light[0];
                    *green += weight * light[1];
                    *blue += weight * light[2];
                }
            }
        }
    }

    /// Weight and mean light at a pixel.
    pub(super) fn at(&self, pixel: usize) -> (f32, [f32; 3]) {
        let [weight, red, green, blue] = self.sums[pixel];
        if weight > 0.0 { (weight, [red, green, blue].map(|sum| sum / weight)) } else { (0.0, [0.0; 3]) }
    }

    /// Weight at a pixel.
    pub(super) fn weight(&self, pixel: usize) -> f32 {
        self.sums[pixel][0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn particles_that_stand_a_spacing_apart_fill_their_pixels_once() {
        let mut layer = Layer::new(60, 60);
        for y in 0..20 {
            for x in 0..20 {
                layer.add(Vec2::new(3.0 * x as f32 + 1.5, 3.0 * y as f32 + 1.5), 4.5, 1.5, [0.25, 0.5, 1.0]);
            }
        }
        let (weight, light) = layer.at(30 * 60 + 30);
        assert!((weight - 1.0).abs() < 0.15, "{weight}");
        assert!((light[1] - 0.5).abs() < 1e-4 && (light[2] - 1.0).abs() < 1e-4, "{light:?}");
        assert!(layer.weight(0) < 0.7 * weight, "at a corner there is less");
        layer.add(Vec2::NAN, 4.5, 1.5, [1.0; 3]);
        layer.add(Vec2::splat(-1e9), 4.5, 1.5, [1.0; 3]);
        layer.clear();
        assert_eq!(layer.at(30 * 60 + 30), (0.0, [0.0; 3]));
    }
}
