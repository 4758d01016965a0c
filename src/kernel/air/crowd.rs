//! Matter that crowds stands in the way of the air, and the air pushes it.
//!
//! A lone lump is dragged (`feedback`), and lets the air by. A heap or a pool does not: the voids of a bed let through so little
//! that gas which comes up in it lifts it first (Ergun 1952 has the pressure that holds a bed up). Here a face lets through
//! the part κ of what it would, the lesser one of the cells on both sides: all where lumps take less than [`LOOSE`] of the cell,
//! [`LEAK`] where they take [`DENSE`] or more.
//!
//! What a face holds back of the difference of pressure pushes on the matter of both cells, as one: `(1 − κ) ΔP` on the length of
//! the face. Summed over a bed that is the pressure below it less that above it. The pressure of the model's gas is
//! `P = ρ c² ∫ p dh` (`law`), at the temperature θ it has, `ρ c² G(e)/θ` with G = ½ (e² − 1) up to 16 (`STIFF`).
//!
//! **Energy.** Gas behind matter works on it, and loses nothing by that until the matter has gone out of its cell and lets it by:
//! it then spreads as into the open. So what matter gains is at most what the gas loses as it spreads, and the air's wind has
//! as much: both together at most twice what came with the gas.
//!
//! Nothing of this exists while the effect `expansion` has nothing to do.

use super::shape::Shape;
use glam::Vec2;

/// Part of a cell that lumps take up to which air passes freely.
const LOOSE: f32 = 0.3;
/// Part from which on it hardly passes: less than the densest there is, as a cell rarely lies wholly in a heap.
const DENSE: f32 = 0.8;
/// Part of the air that passes what is dense. Changing this affects how long gas stays in a heap.
const LEAK: f32 = 0.02;

/// What stands in the way of the air. Follows from the state.
#[derive(Debug, Default)]
pub(super) struct Crowd {
    /// Mass of the lumps in each cell, kg/m² d²; empty where nothing stands in its way.
    pub(super) mass: Vec<f32>,
    /// The cells that have any.
    pub(super) cells: Vec<usize>,
    /// Part that each cell lets through.
    pub(super) through: Vec<f32>,
    /// The left and the lower face of each cell: what they let through.
    open: [Vec<f32>; 2],
    /// What the air pushes the matter of each cell by, d/s².
    pub(super) push: Vec<Vec2>,
}

impl Crowd {
    /// Nothing is in the way any more.
    pub(super) fn clear(&mut self) {
        [&mut self.mass, &mut self.through].into_iter().for_each(Vec::clear);
        self.cells.clear();
        self.push.clear();
    }

    /// Makes room for lumps in so many cells.
    pub(super) fn begin(&mut self, cells: usize) {
        self.clear();
        self.mass.resize(cells, 0.0);
        self.through.resize(cells, 0.0);
    }

    /// Adds a part of a lump of a mass (kg/m² d²) to a cell.
    pub(super) fn add(&mut self, cell: usize, part: f32, mass: f32) {
        if self.mass[cell] == 0.0 && mass * part > 0.0 {
            self.cells.push(cell);
        }
        self.mass[cell] += mass * part;
        self.through[cell] += part;
    }

    /// Finds what cells of an area (d²) let through of the air, once all lumps are in.
    pub(super) fn end(&mut self, area: f32) {
        for part in &mut self.through {
            let dense = (*part / area - LOOSE) * (1.0 / (DENSE - LOOSE));
            *part = (1.0 - dense).clamp(LEAK, 1.0);
        }
    }

    /// Whether anything stands in its way.
    pub(super) fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// What the left and the lower face of each cell let through.
    pub(super) fn open<'a>(&'a self, shape: &'a Shape) -> [&'a [f32]; 2] {
        if self.is_empty() { [&shape.open_x, &shape.open_y] } else { self.open.each_ref().map(|faces| &faces[..]) }
    }

    /// Finds what faces let through that the shape leaves open.
    pub(super) fn close(&mut self, shape: &Shape, stride: usize) {
        if self.is_empty() {
            return;
        }
        let Self { through, open, .. } = self;
        for ((faces, open), step) in open.iter_mut().zip([&shape.open_x, &shape.open_y]).zip([1, stride]) {
            faces.clear();
            faces.extend_from_slice(open);
            for (k, face) in faces.iter_mut().enumerate().skip(step) {
                *face *= through[k].min(through[k - step]);
            }
        }
    }

    /// Bytes held.
    pub(super) fn memory_bytes(&self) -> usize {
        let Self { mass, cells, through, open: [x, y], push } = self;
        (mass.capacity() + through.capacity() + x.capacity() + y.capacity()) * 4
            + cells.capacity() * size_of::<usize>()
            + push.capacity() * size_of::<Vec2>()
    }
}
