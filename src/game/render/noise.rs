//! A texture of noise that tiles, made once: what breaks up rock, clouds, flames and foam.

use crate::kernel::random::{mix, share};

/// Texels along an edge.
pub const EDGE: usize = 128;
/// Octaves of the smooth noise, and cells along the edge in the first.
const OCTAVES: [(u32, f32); 4] = [(8, 0.5), (16, 0.27), (32, 0.15), (64, 0.08)];

/// Four channels of noise, 0 … 255, about the middle: two smooth ones, a grainy one, one of cells.
pub fn texels() -> Vec<u8> {
    let mut out = Vec::with_capacity(4 * EDGE * EDGE);
    for y in 0..EDGE {
        for x in 0..EDGE {
            let (u, v) = (x as f32 / EDGE as f32, y as f32 / EDGE as f32);
            let smooth = |seed| OCTAVES.iter().map(|&(cells, weight)| weight * lattice(u, v, cells, seed)).sum::<f32>();
            let grain = 0.6 * lattice(u, v, 64, 3) + 0.4 * lattice(u, v, 128, 4);
            out.extend([smooth(1), smooth(2), grain, cells(u, v, 16)].map(|value| (255.0 * value) as u8));
        }
    }
    out
}

/// Smooth noise between random values on a lattice of so many cells along the edge.
fn lattice(u: f32, v: f32, cells: u32, seed: u32) -> f32 {
    let (x, y) = (u * cells as f32, v * cells as f32);
    let (left, low) = (x as u32, y as u32);
    let ease = |t: f32| t * t * (3.0 - 2.0 * t);
    let (s, t) = (ease(x - left as f32), ease(y - low as f32));
    let at = |dx, dy| random((left + dx) % cells, (low + dy) % cells, seed);
    let row = |dy| at(0, dy) * (1.0 - s) + at(1, dy) * s;
    row(0) * (1.0 - t) + row(1) * t
}

/// Distance to the nearest of random points, one in each of so many cells along the edge.
fn cells(u: f32, v: f32, cells: u32) -> f32 {
    let (x, y) = (u * cells as f32, v * cells as f32);
    let mut nearest = 1.0f32;
    for (dx, dy) in (0..3).flat_map(|dy| (0..3).map(move |dx| (dx, dy))) {
        // From the cell before, and never below 0.
        let (cx, cy) = (x as u32 + cells + dx - 1, y as u32 + cells + dy - 1);
        let at = |seed| random(cx % cells, cy % cells, seed);
        let (px, py) = (cx as f32 - cells as f32 + at(5), cy as f32 - cells as f32 + at(6));
        nearest = nearest.min((px - x).hypot(py - y));
    }
    nearest
}

fn random(x: u32, y: u32, seed: u32) -> f32 {
    share(mix(x ^ mix(y ^ mix(seed))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_tiles_and_varies() {
        let texels = texels();
        let at = |x: usize, y: usize, c: usize| f32::from(texels[4 * (y * EDGE + x) + c]);
        for c in [0, 1, 3] {
            let seam = (0..EDGE).map(|y| (at(0, y, c) - at(EDGE - 1, y, c)).abs()).fold(0.0, f32::max);
            let inside = (0..EDGE).map(|y| (at(65, y, c) - at(64, y, c)).abs()).fold(0.0, f32::max);
            assert!(seam < 2.5 * inside + 8.0, "channel {c}: {seam} at the seam, {inside} inside");
        }
        for c in 0..4 {
            let all = texels.iter().skip(c).step_by(4);
            let (low, high) = (all.clone().min(), all.max());
            assert!(low.is_some_and(|low| *low < 80) && high.is_some_and(|high| *high > 170), "{low:?} {high:?}");
        }
    }
}
