//! What of single lumps stands in the air.

use super::{
    surface::open_length,
    weights::{REACH, WEIGHT, weight_between},
};
use crate::{
    cells::Cells,
    element::{ElementId, ElementTable},
    particles::Particles,
    simd::{Array, Lanes},
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

/// Finds what of single lumps stands in the air. Of what is not of their own kind gases don't cover them, and grains by half: air
/// comes through a heap.
#[derive(Clone, Debug, Default)]
pub struct Exposure {
    cells: Cells,
}

impl Exposure {
    /// Gathers what may cover others in a box of a size, d.
    pub fn gather(&mut self, particles: &Particles, size: Vec2) {
        self.cells.sort(particles, size, REACH, |_| true);
    }

    /// Length of the open surface of a lump at a place among what was gathered, d; 1 at a plane surface.
    pub fn of(
        &self,
        (particles, solids, elements): (&Particles, &Solids, &ElementTable),
        element: ElementId,
        at: Vec2,
    ) -> f32 {
        let covers = |other: ElementId| match elements.get(other) {
            _ if other == element => 1.0,
            other if other.is_gas() => 0.0,
            other if other.friction > 0.0 => 0.5,
            _ => 1.0,
        };
        let weight = |place: Vec2| weight_between(at, place);
        let mut neighbours = 0.0;
        for (_, near) in self.cells.around(at) {
            let near = near.iter().map(|i| *i as usize);
            let weights = near.map(|i| covers(particles.element[i]) * weight(particles.position(i)));
            neighbours += weights.sum::<f32>();
        }
        // Beyond the box stands rock.
        let (cell, reach) = (Solids::cell_of(at), REACH.ceil() as i32);
        for y in -reach..=reach {
            let cells = (-reach..=reach).map(|x| cell + IVec2::new(x, y));
            neighbours += cells.filter(|cell| solids.is_solid(*cell)).map(|cell| weight(centre(cell))).sum::<f32>();
        }
        // It is its own neighbour in that sum.
        let mut length = [0.0];
        open_length(Array::<1>::splat(neighbours - WEIGHT)).store(&mut length);
        length[0]
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.cells.memory()
    }
}
