//! How far two worlds of the same scene are apart, on a coarse field: share of liquid and its velocity in square cells.
//! A flow is chaotic, particles soon stand elsewhere; what they add up to is compared.

use crate::{
    kernel::particles::Particles,
    scene::blueprint::Blueprint,
    sim::view::{Reference, Rgb},
};
use glam::Vec2;

/// Edge of a cell, d.
pub const CELL: f32 = 4.0;

/// A difference of all the liquid that a cell holds, or of this share of a long fall's speed, is the end of the scale.
const FULL_SPEED: f32 = 0.25;

/// Colours of the heat map from a little to all.
const STOPS: [Rgb; 4] = [[64, 24, 110], [176, 40, 110], [244, 112, 48], [255, 232, 150]];

/// What one world adds up to, cell by cell.
#[derive(Clone, Debug, Default)]
struct Field {
    /// Particles over those at rest, a share.
    share: Vec<f32>,
    /// Sum of the velocities over the particles at rest, d/s.
    flow: Vec<Vec2>,
}

impl Field {
    fn measure(&mut self, particles: &Particles, columns: usize, rows: usize) {
        self.share.clear();
        self.share.resize(columns * rows, 0.0);
        self.flow.clear();
        self.flow.resize(columns * rows, Vec2::ZERO);
        for i in 0..particles.len() {
            let place = particles.position(i) / CELL;
            let (column, row) = ((place.x as usize).min(columns - 1), (place.y as usize).min(rows - 1));
            let cell = row * columns + column;
            self.share[cell] += 1.0;
            self.flow[cell] += particles.velocity(i);
        }
        let full = CELL * CELL;
        self.share.iter_mut().for_each(|share| *share /= full);
        self.flow.iter_mut().for_each(|flow| *flow /= full);
    }
}

/// The difference between two worlds.
#[derive(Clone, Debug, Default)]
pub struct Difference {
    columns: usize,
    rows: usize,
    fields: [Field; 2],
    /// 0 (none) … 1 (the end of the scale).
    heat: Vec<f32>,
}

impl Difference {
    /// Compares the particles of two worlds of the same scene.
    pub fn measure(&mut self, blueprint: &Blueprint, first: &Particles, second: &Particles) {
        let cells = (blueprint.domain.size / CELL).ceil().max(Vec2::ONE);
        (self.columns, self.rows) = (cells.x as usize, cells.y as usize);
        for (field, particles) in self.fields.iter_mut().zip([first, second]) {
            field.measure(particles, self.columns, self.rows);
        }
        let speed = FULL_SPEED * Reference::of(&blueprint.domain, &blueprint.air).fall;
        let [a, b] = &self.fields;
        self.heat.clear();
        self.heat.extend((0..a.share.len()).map(|cell| {
            let share = (a.share[cell] - b.share[cell]).abs();
            let flow = (a.flow[cell] - b.flow[cell]).length() / speed;
            share.max(flow).min(1.0)
        }));
    }

    /// Cells beside each other.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Cells above each other.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether the fields are equal to the bit.
    pub fn is_nothing(&self) -> bool {
        let [a, b] = &self.fields;
        a.share == b.share && a.flow == b.flow
    }

    /// Mean over the cells in which either world has liquid, 0 … 1.
    pub fn mean(&self) -> f32 {
        let [a, b] = &self.fields;
        let wet = (0..self.heat.len()).filter(|&cell| a.share[cell] > 0.0 || b.share[cell] > 0.0);
        let (sum, count) = wet.fold((0.0, 0), |(sum, count), cell| (sum + self.heat[cell], count + 1));
        if count == 0 { 0.0 } else { sum / count as f32 }
    }

    /// Colours of the cells, premultiplied by their opacity, row by row from the bottom: nothing is transparent.
    pub fn texels(&self, out: &mut Vec<u8>) {
        out.clear();
        for &heat in &self.heat {
            let (rgb, opacity) = colour(heat);
            out.extend(rgb.map(|channel| (f32::from(channel) * opacity) as u8));
            out.push((255.0 * opacity) as u8);
        }
    }
}

/// Colour and opacity (0 … 1) of a heat.
pub fn colour(heat: f32) -> (Rgb, f32) {
    if heat <= 0.0 {
        return ([0; 3], 0.0);
    }
    // The root spreads small differences: most are.
    let root = heat.min(1.0).sqrt();
    (crate::sim::view::ramp(&STOPS, root), (0.25 + 1.5 * root).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_heat_is_nothing_to_see_and_more_is_brighter() {
        assert_eq!(colour(0.0), ([0; 3], 0.0));
        let brightness = |heat| {
            let (rgb, opacity) = colour(heat);
            rgb.iter().map(|&channel| f32::from(channel)).sum::<f32>() * opacity
        };
        let seen: Vec<f32> = [0.001, 0.01, 0.1, 0.5, 1.0].map(brightness).into();
        assert!(seen.windows(2).all(|pair| pair[1] > pair[0]) && seen[0] > 20.0, "{seen:?}");
    }
}
