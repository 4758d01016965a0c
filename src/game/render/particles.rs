//! Movable particles as instances: position between two ticks and colour.

use crate::{
    game::views::table::View,
    kernel::{element::ElementTable, particles::Particles},
};

/// Colours of each element over the range of what is shown, precomputed.
const LEVELS: usize = 64;

/// Position (two f32) and colour (four bytes) of a particle.
pub type ParticleInstance = [u32; 3];

/// A table of colours: a row for each element.
#[derive(Clone, Debug, Default)]
pub struct ColourTable {
    colours: Vec<u32>,
}

impl ColourTable {
    /// The colours of a view over its quantity.
    pub fn fill(&mut self, view: &View, elements: &ElementTable) {
        self.colours.clear();
        for (_, element) in elements.iter() {
            self.colours.extend((0..LEVELS).map(|level| {
                let [r, g, b] = (view.colour)(element, level as f32 / (LEVELS - 1) as f32);
                u32::from_le_bytes([r, g, b, 255])
            }));
        }
    }

    fn at(&self, row: usize, share: f32) -> u32 {
        let level = ((share * LEVELS as f32) as usize).min(LEVELS - 1);
        self.colours.get(row * LEVELS + level).copied().unwrap_or(u32::MAX)
    }
}

/// Packs all particles as they stood `back` seconds ago (straight back along their velocities), coloured by their
/// `shares` of the scale of the view's quantity.
pub fn pack(particles: &Particles, table: &ColourTable, shares: &[f32], back: f32, out: &mut Vec<ParticleInstance>) {
    let count = particles.len();
    out.resize(count, ParticleInstance::default());
    let (x, y) = (&particles.x[..count], &particles.y[..count]);
    let (vx, vy, element) = (&particles.vx[..count], &particles.vy[..count], &particles.element[..count]);
    let shares = &shares[..count];
    for (i, instance) in out.iter_mut().enumerate() {
        let colour = table.at(element[i].index(), shares[i]);
        *instance = [(x[i] - vx[i] * back).to_bits(), (y[i] - vy[i] * back).to_bits(), colour];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        game::views::table::{ELEMENTS, VIEWS},
        kernel::element::{Element, ElementId},
    };
    use glam::Vec2;

    fn packed(view: &View, velocity: Vec2, share: f32) -> ParticleInstance {
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(10.0, 20.0), velocity);
        let mut table = ColourTable::default();
        table.fill(view, &ElementTable::new(vec![Element::plain("water", false)]));
        let mut out = Vec::new();
        pack(&particles, &table, &[share], 0.01, &mut out);
        out[0]
    }

    #[test]
    fn an_instance_stands_where_the_particle_was_a_moment_ago() {
        let instance = packed(&ELEMENTS, Vec2::new(50.0, -100.0), 0.0);
        assert_eq!(f32::from_bits(instance[0]), 9.5);
        assert_eq!(f32::from_bits(instance[1]), 21.0);
    }

    #[test]
    fn colours_follow_what_the_view_shows() {
        let at_rest = packed(&ELEMENTS, Vec2::ZERO, 0.0)[2];
        assert_eq!(at_rest.to_le_bytes(), [40, 130, 220, 255]);
        assert_ne!(packed(&ELEMENTS, Vec2::ZERO, 0.9)[2], at_rest);
    }

    #[test]
    fn absurd_values_take_a_colour_of_the_table() {
        for view in VIEWS {
            let (low, high) = (packed(view, Vec2::ZERO, 0.0)[2], packed(view, Vec2::ZERO, 1.0)[2]);
            for (share, colour) in [(f32::NAN, low), (-1e30, low), (f32::INFINITY, high), (1e30, high)] {
                assert_eq!(packed(view, Vec2::ZERO, share)[2], colour, "{view:?} at {share}");
            }
        }
    }
}
