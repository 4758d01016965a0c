//! Matter that crowds stands in the way of the air, and the air pushes it.
//!
//! A lone lump is dragged (`feedback`), and lets the air by. A heap or a pool does not: the voids of a bed let through so little
//! that gas which comes up in it lifts it first (Ergun 1952 has the pressure that holds a bed up). Here a face lets through
//! the part κ of what it would, the lesser one of the cells on both sides: all where lumps take less than [`LOOSE`] of the cell,
//! [`LEAK`] where they take [`DENSE`] or more.
//!
//! What a face holds back of the difference of pressure pushes on the matter of both cells, as one: `(1 − κ) ΔP` on the length of
//! the face. Summed over a bed that is the pressure below it less that above it. The pressure of the model's gas is
//! `P = ρ c² ∫ p dh` (`law`), at the temperature θ it has, `ρ c² G(e)/θ` with G = ½ (e² − 1) up to [`STIFF`].
//!
//! **Energy.** Gas behind matter works on it, and loses nothing by that until the matter has gone out of its cell and lets it by:
//! it then spreads as into the open. So what matter gains is at most what the gas loses as it spreads, and the air's wind has
//! as much: both together at most twice what came with the gas.
//!
//! Nothing of this exists while the effect `expansion` has nothing to do.

use super::{grid::Air, law::STIFF, shape::Shape};
use crate::{
    element::{ElementId, ElementParams},
    particles::Particles,
};
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
    mass: Vec<f32>,
    /// Part that each cell lets through.
    pub(super) through: Vec<f32>,
    /// The left and the lower face of each cell: what they let through.
    open: [Vec<f32>; 2],
    /// What the air pushes the matter of each cell by, d/s².
    push: Vec<Vec2>,
}

impl Crowd {
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
        let Self { mass, through, open: [x, y], push } = self;
        (mass.capacity() + through.capacity() + x.capacity() + y.capacity()) * 4 + push.capacity() * size_of::<Vec2>()
    }
}

/// Whether an element stands in the way of the air: gases go with it.
fn stands(elements: &ElementParams, element: ElementId) -> bool {
    elements.weight[element.index()] == 1.0
}

impl Air {
    /// Lets matter stand in its way for the next tick: finds where it crowds. Air at rest has nothing to hold back.
    pub fn crowd(&mut self, elements: &ElementParams, particles: &Particles) {
        self.uncrowd();
        if self.is_quiet() {
            return;
        }
        let mut crowd = std::mem::take(&mut self.scratch.crowd);
        crowd.mass.resize(self.pressure.len(), 0.0);
        crowd.through.resize(self.pressure.len(), 0.0);
        for (i, element) in particles.element.iter().enumerate().filter(|(_, element)| stands(elements, **element)) {
            let (cells, count) = self.open_near(self.cell_at(particles.position(i)));
            for k in &cells[..count] {
                crowd.mass[*k] += elements.mass[element.index()] / count as f32;
                crowd.through[*k] += 1.0 / count as f32;
            }
        }
        let per_area = 1.0 / (self.cell * self.cell);
        for part in &mut crowd.through {
            let dense = (*part * per_area - LOOSE) * (1.0 / (DENSE - LOOSE));
            *part = (1.0 - dense).clamp(LEAK, 1.0);
        }
        self.scratch.crowd = crowd;
    }

    /// Lets it pass all matter freely.
    pub fn uncrowd(&mut self) {
        let crowd = &mut self.scratch.crowd;
        [&mut crowd.mass, &mut crowd.through].into_iter().for_each(Vec::clear);
        crowd.push.clear();
    }

    /// Finds what it pushes the matter by that stands in its way.
    pub fn press_matter(&mut self) {
        let mut crowd = std::mem::take(&mut self.scratch.crowd);
        crowd.push.clear();
        if !crowd.is_empty() {
            crowd.push.resize(self.pressure.len(), Vec2::ZERO);
            let stiffness = self.params.density * self.params.sound_speed * self.params.sound_speed * self.cell;
            for k in self.cells().filter(|k| !self.solid[*k]) {
                for (axis, beside) in [k - 1, k - self.stride()].into_iter().enumerate() {
                    let mass = crowd.mass[k] + crowd.mass[beside];
                    if self.solid[beside] || mass == 0.0 {
                        continue;
                    }
                    let held = 1.0 - crowd.through[k].min(crowd.through[beside]);
                    let push = held * stiffness * (self.thrust(beside) - self.thrust(k)) / mass;
                    crowd.push[k][axis] += push;
                    crowd.push[beside][axis] += push;
                }
            }
        }
        self.scratch.crowd = crowd;
    }

    /// Pushes particles for `dt` s by what [`Air::press_matter`] found.
    pub fn push_matter(&self, elements: &ElementParams, particles: &mut Particles, dt: f32) {
        let push = &self.scratch.crowd.push;
        if push.is_empty() {
            return;
        }
        for i in 0..particles.len() {
            if stands(elements, particles.element[i]) {
                let (cells, count) = self.open_near(self.cell_at(particles.position(i)));
                let sum: Vec2 = cells[..count].iter().map(|k| push[*k]).sum();
                let change = sum * (dt / count.max(1) as f32);
                particles.vx[i] += change.x;
                particles.vy[i] += change.y;
            }
        }
    }

    /// Middles of the cells in which it pushes matter by more than this, d/s².
    pub fn pushed(&self, least: f32) -> impl Iterator<Item = Vec2> + '_ {
        let pushed = self.scratch.crowd.push.iter().enumerate().filter(move |(_, push)| push.length() > least);
        pushed.map(|(k, _)| self.centre(k % self.stride() - 1, k / self.stride() - 1))
    }

    /// Pressure of a cell above that of the surroundings, ρ c².
    fn thrust(&self, k: usize) -> f32 {
        let e = self.pushing(k);
        let thrust = if e <= STIFF { 0.5 * (e * e - 1.0) } else { 0.5 * (STIFF * STIFF - 1.0) + STIFF * (e - STIFF) };
        thrust / (1.0 + self.warmth_of(k))
    }
}
