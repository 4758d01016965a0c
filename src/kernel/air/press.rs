//! What the air pushes the matter by that stands in its way (`crowd`).

use super::grid::Air;
use crate::{
    element::{ElementId, ElementParams},
    particles::Particles,
};
use glam::Vec2;

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
        crowd.begin(self.pressure.len());
        for (i, element) in particles.element.iter().enumerate().filter(|(_, element)| stands(elements, **element)) {
            let (cells, count) = self.open_near(self.cell_at(particles.position(i)));
            for k in &cells[..count] {
                crowd.add(*k, 1.0 / count as f32, elements.mass[element.index()]);
            }
        }
        crowd.end(self.cell * self.cell);
        self.scratch.crowd = crowd;
    }

    /// Lets it pass all matter freely.
    pub fn uncrowd(&mut self) {
        self.scratch.crowd.clear();
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
                    let push = held * stiffness * (self.overpressure(beside) - self.overpressure(k)) / mass;
                    crowd.push[k][axis] += push;
                    crowd.push[beside][axis] += push;
                }
            }
        }
        self.scratch.crowd = crowd;
    }

    /// Pushes particles for `dt` s by what [`Air::press_matter`] found, up to the speed `most` (d/s). Returns how many would have
    /// got faster than that.
    pub fn push_matter(&self, elements: &ElementParams, particles: &mut Particles, most: f32, dt: f32) -> u64 {
        let (push, mut cuts) = (&self.scratch.crowd.push, 0);
        if push.is_empty() {
            return cuts;
        }
        for i in 0..particles.len() {
            if stands(elements, particles.element[i]) {
                let (cells, count) = self.open_near(self.cell_at(particles.position(i)));
                let sum: Vec2 = cells[..count].iter().map(|k| push[*k]).sum();
                let (before, change) = (particles.velocity(i), sum * (dt / count.max(1) as f32));
                let (speed, most) = ((before + change).length(), most.max(before.length()));
                cuts += u64::from(speed > most);
                let share = if speed > most { most / speed } else { 1.0 };
                (particles.vx[i], particles.vy[i]) = ((before + change) * share).into();
            }
        }
        cuts
    }

    /// Middles of the cells in which it pushes matter by more than this, d/s².
    pub fn pushed(&self, least: f32) -> impl Iterator<Item = Vec2> + '_ {
        let pushed = self.scratch.crowd.push.iter().enumerate().filter(move |(_, push)| push.length() > least);
        pushed.map(|(k, _)| self.centre(k % self.stride() - 1, k / self.stride() - 1))
    }
}
