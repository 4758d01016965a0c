//! What the air pushes the matter by that stands in its way (`crowd`).

use super::{crowd::Crowd, grid::Air};
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
            let (mass, k) = (elements.mass[element.index()], self.cell_at(particles.position(i)));
            if !self.solid[k] {
                crowd.add(k, 1.0, mass);
                continue;
            }
            let (cells, count) = self.open_near(k);
            cells[..count].iter().for_each(|k| crowd.add(*k, 1.0 / count as f32, mass));
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
            let Crowd { mass, cells, through, push, .. } = &mut crowd;
            let mut press = |k: usize, beside: usize, axis: usize| {
                if self.solid[k] || self.solid[beside] {
                    return;
                }
                let held = 1.0 - through[k].min(through[beside]);
                let both = mass[k] + mass[beside];
                let change = held * stiffness * (self.overpressure(beside) - self.overpressure(k)) / both;
                push[k][axis] += change;
                push[beside][axis] += change;
            };
            for k in &*cells {
                for (axis, step) in [1, self.stride()].into_iter().enumerate() {
                    press(*k, k - step, axis);
                    // What has matter beyond it is pressed from there.
                    if mass[k + step] == 0.0 {
                        press(k + step, *k, axis);
                    }
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
                let k = self.cell_at(particles.position(i));
                let (sum, count) = if self.solid[k] {
                    let (cells, count) = self.open_near(k);
                    (cells[..count].iter().map(|k| push[*k]).sum(), count.max(1))
                } else {
                    (push[k], 1)
                };
                let (before, change) = (particles.velocity(i), sum * (dt / count as f32));
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
        // Most are not pushed at all.
        let is_pushed = move |push: &Vec2| *push != Vec2::ZERO && push.length() > least;
        let pushed = self.scratch.crowd.push.iter().enumerate().filter(move |(_, push)| is_pushed(push));
        pushed.map(|(k, _)| self.centre(k % self.stride() - 1, k / self.stride() - 1))
    }
}
