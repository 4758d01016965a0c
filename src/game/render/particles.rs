//! Movable particles as instances: position between two ticks and colour.

use crate::{
    game::{render::matter::Instance, views::table::View},
    kernel::{element::ElementTable, particles::Particles},
};
use glam::Vec2;

/// Colours of each element over the range of what is shown, precomputed.
const LEVELS: usize = 64;

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

/// Packs all particles, coloured by their `shares` of the scale of the view's quantity. `at`: where each is drawn.
pub fn pack(
    particles: &Particles,
    table: &ColourTable,
    shares: &[f32],
    at: impl Fn(usize) -> Vec2,
    out: &mut Vec<Instance>,
) {
    out.clear();
    out.extend(particles.element.iter().zip(shares).enumerate().map(|(i, (element, share))| {
        let at = at(i);
        [at.x.to_bits(), at.y.to_bits(), table.at(element.index(), *share), 0]
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        game::views::table::{ELEMENTS, VIEWS},
        kernel::element::{Element, ElementId},
    };

    fn packed(view: &View, velocity: Vec2, share: f32) -> Instance {
        let mut particles = Particles::default();
        particles.push(0, ElementId(0), Vec2::new(10.0, 20.0), velocity);
        let mut table = ColourTable::default();
        table.fill(view, &ElementTable::new(vec![Element::plain("water", false)]));
        let mut out = Vec::new();
        pack(&particles, &table, &[share], |_| Vec2::new(9.5, 21.0), &mut out);
        out[0]
    }

    #[test]
    fn an_instance_stands_where_it_is_told() {
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
