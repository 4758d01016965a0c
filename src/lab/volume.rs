//! The volume error: whether the liquid takes the room that its particles stand for.
//!
//! A particle stands for a square of edge s, s² = d²/ρ₀ (ρ₀ being the rest density as a multiple of the lattice's); it
//! covers that square around it, on samples of s/4. Gaps narrower than s between squares count as covered (a
//! morphological closing with a square), for so far apart stand neighbours in a liquid; then what lies outside the box
//! or in rock is taken off. A lattice of spacing s covers exactly s² a particle, and so does a drop of one particle.

use crate::kernel::{particles::Particles, solids::Solids};
use glam::Vec2;

/// Samples along the square of a particle.
const FINE: i32 = 4;

/// Samples by which the closing spreads and shrinks: it fills gaps of twice as many.
const SPREAD: usize = 2;

/// Empty samples around the box, so that nothing spreads over the edge.
const MARGIN: i32 = 2 * FINE;

/// Most samples: 256 MB. A liquid with more squares in its box is not measured.
const MOST_SAMPLES: f64 = 2e9;

/// Room that the particles cover against the room that they stand for: 0 for a liquid that keeps its volume, −0.1 for one
/// that lost a tenth. `None` without particles, or if the box is too large for the squares.
pub fn volume_error(particles: &Particles, rock: &Solids, size: Vec2, rest_density: f64) -> Option<f64> {
    let per_spacing = rest_density.sqrt() * f64::from(FINE);
    let samples = f64::from(size.x) * f64::from(size.y) * per_spacing * per_spacing;
    if particles.is_empty() || samples > MOST_SAMPLES {
        return None;
    }
    let covered = covered_samples(particles, rock, size, per_spacing as f32);
    Some(covered as f64 / f64::from(FINE * FINE) / particles.len() as f64 - 1.0)
}

/// Samples that the movable particles cover, `per_spacing` of them along d.
fn covered_samples(particles: &Particles, rock: &Solids, size: Vec2, per_spacing: f32) -> u64 {
    // The cast saturates: a particle far outside falls off the map.
    let samples = |length: f32| (length * per_spacing).round() as i32;
    let (width, height) = (samples(size.x), samples(size.y));
    let mut map = Bitmap::new(width + 2 * MARGIN, height + 2 * MARGIN);
    let half = 0.5 * FINE as f32 / per_spacing;
    for (&x, &y) in particles.x.iter().zip(&particles.y) {
        if x.is_finite() && y.is_finite() {
            let corner = [x, y].map(|at| samples(at - half).saturating_add(MARGIN));
            map.fill_square(corner[0], corner[1]);
        }
    }
    map.closed();
    for (cell, _, _) in rock.iter() {
        let [left, right] = [cell.x, cell.x + 1].map(|x| samples(x as f32) + MARGIN);
        for y in samples(cell.y as f32)..samples(cell.y as f32 + 1.0) {
            map.clear_row(left, right, y + MARGIN);
        }
    }
    map.count(MARGIN..MARGIN + width, MARGIN..MARGIN + height)
}

/// One bit a sample, rows padded to whole words.
struct Bitmap {
    width: i32,
    height: i32,
    words: usize,
    bits: Vec<u64>,
    scratch: Vec<u64>,
}

impl Bitmap {
    fn new(width: i32, height: i32) -> Self {
        let words = (width as usize).div_ceil(64);
        let bits = vec![0; words * height as usize];
        Self { width, height, words, scratch: bits.clone(), bits }
    }

    /// The words of row `y` that hold the samples `x … x + FINE`, with their masks.
    fn span(&self, x: i32, y: i32) -> [(usize, u64); 2] {
        let first = y as usize * self.words + x as usize / 64;
        let mask = ((1_u128 << FINE) - 1) << (x % 64);
        let last = (y as usize + 1) * self.words - 1;
        [(first, mask as u64), ((first + 1).min(last), (mask >> 64) as u64)]
    }

    fn fill_square(&mut self, x: i32, y: i32) {
        if x >= 0 && y >= 0 && x <= self.width - FINE && y <= self.height - FINE {
            for row in y..y + FINE {
                for (word, mask) in self.span(x, row) {
                    self.bits[word] |= mask;
                }
            }
        }
    }

    /// Clears the samples `left … right` of row `y`, as far as they are on the map.
    fn clear_row(&mut self, left: i32, right: i32, y: i32) {
        if y >= 0 && y < self.height {
            let row = &mut self.bits[y as usize * self.words..][..self.words];
            for x in left.clamp(0, self.width)..right.clamp(0, self.width) {
                row[x as usize / 64] &= !(1 << (x % 64));
            }
        }
    }

    /// Spreads by [`SPREAD`] samples in all directions and shrinks by as many.
    fn closed(&mut self) {
        for _ in 0..SPREAD {
            self.combine_across(|a, b| a | b);
            self.combine_along(|a, b| a | b);
        }
        for _ in 0..SPREAD {
            self.combine_across(|a, b| a & b);
            self.combine_along(|a, b| a & b);
        }
    }

    /// Each sample together with its left and right neighbour.
    fn combine_across(&mut self, with: impl Fn(u64, u64) -> u64) {
        for (from, to) in self.bits.chunks_exact(self.words).zip(self.scratch.chunks_exact_mut(self.words)) {
            for k in 0..from.len() {
                let below = if k > 0 { from[k - 1] >> 63 } else { 0 };
                let above = from.get(k + 1).map_or(0, |word| word << 63);
                to[k] = with(with(from[k] << 1 | below, from[k]), from[k] >> 1 | above);
            }
        }
        std::mem::swap(&mut self.bits, &mut self.scratch);
    }

    /// Each sample together with the ones above and below it.
    fn combine_along(&mut self, with: impl Fn(u64, u64) -> u64) {
        let (words, len) = (self.words, self.bits.len());
        for (k, to) in self.scratch.iter_mut().enumerate() {
            let below = if k >= words { self.bits[k - words] } else { 0 };
            let above = if k + words < len { self.bits[k + words] } else { 0 };
            *to = with(with(below, self.bits[k]), above);
        }
        std::mem::swap(&mut self.bits, &mut self.scratch);
    }

    fn count(&self, columns: std::ops::Range<i32>, rows: std::ops::Range<i32>) -> u64 {
        let mut count = 0;
        for y in rows {
            let row = &self.bits[y as usize * self.words..][..self.words];
            for (k, word) in row.iter().enumerate() {
                let at = k as i32 * 64;
                let from = (columns.start - at).clamp(0, 64) as u32;
                let to = (columns.end - at).clamp(0, 64) as u32;
                let mask = (((1_u128 << to) - 1) & !((1_u128 << from) - 1)) as u64;
                count += u64::from((word & mask).count_ones());
            }
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::ElementId;
    use crate::lab::testing::{lattice, world};
    use glam::IVec2;

    #[test]
    fn a_lattice_and_a_lone_particle_take_their_own_room() {
        let size = Vec2::new(60.0, 33.3);
        let rock = Solids::new(60, 34);
        assert_eq!(volume_error(&world(lattice(50, 20, 1.0)), &rock, size, 1.0), Some(0.0));
        assert_eq!(volume_error(&world([Vec2::new(31.3, 12.9)]), &rock, size, 1.0), Some(0.0));
        assert_eq!(volume_error(&Particles::default(), &rock, size, 1.0), None);
    }

    #[test]
    fn a_pressed_lattice_has_lost_volume_and_a_loose_one_gained() {
        let (size, rock) = (Vec2::new(80.0, 60.0), Solids::new(80, 60));
        for spacing in [0.8_f32, 0.9, 1.1] {
            let error = volume_error(&world(lattice(50, 40, spacing)), &rock, size, 1.0).unwrap();
            let expected = f64::from(spacing * spacing) - 1.0;
            assert!((error - expected).abs() < 0.02, "{spacing}: {error} is not {expected}");
        }
        for spacing in [0.25_f32, 0.8, 1.7] {
            let found =
                volume_error(&world(lattice(40, 30, spacing)), &rock, size, f64::from(spacing).powi(-2)).unwrap();
            assert!(found.abs() < 0.02, "at its own rest density it keeps its volume: {found} at {spacing} d");
        }
    }

    #[test]
    fn the_lattice_may_lie_anywhere_and_stand_disordered() {
        let (size, rock) = (Vec2::new(70.0, 70.0), Solids::new(70, 70));
        let (sin, cos) = (0.6, 0.8);
        let turned =
            lattice(40, 40, 1.0).into_iter().map(|p| Vec2::new(cos * p.x - sin * p.y + 28.0, sin * p.x + cos * p.y));
        let error = volume_error(&world(turned), &rock, size, 1.0).unwrap();
        assert!(error.abs() < 0.03, "turned by 37°: {error}");
        let shaken = lattice(40, 40, 1.0).into_iter().enumerate().map(|(k, p)| {
            let angle = k as f32 * 2.4;
            p + 5.0 + 0.3 * Vec2::from_angle(angle)
        });
        let error = volume_error(&world(shaken), &rock, size, 1.0).unwrap();
        assert!(error.abs() < 0.03, "shaken by 0.3 d: {error}");
    }

    #[test]
    fn room_outside_the_box_and_in_rock_is_not_covered() {
        let size = Vec2::new(70.0, 10.0);
        let mut rock = Solids::new(70, 10);
        let corner = world([Vec2::new(0.0, 0.0)]);
        assert_eq!(volume_error(&corner, &rock, size, 1.0), Some(-0.75), "three quarters of the square are outside");
        assert_eq!(volume_error(&world([Vec2::splat(1e9), Vec2::NAN]), &rock, size, 1.0), Some(-1.0));
        for x in 0..70 {
            rock.insert(IVec2::new(x, 0), ElementId(1), x as u32);
        }
        let found = volume_error(&world(lattice(70, 3, 1.0)), &rock, size, 1.0).unwrap();
        assert!((found + 1.0 / 3.0).abs() < 1e-9, "the lowest of three rows is in rock: {found}");
    }
}
