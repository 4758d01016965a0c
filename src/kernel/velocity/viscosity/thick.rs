//! What takes all of several passes, brought together, so that they cost what it is and not what lies between.

use super::{
    matter::Matter,
    pass::{Once, Setting},
};
use crate::{
    bins::{Group, Run},
    element::ElementId,
    particles::Particles,
};

/// One part in so many of all particles: where more take all passes, to bring them together saves too little for what it holds.
const FEW: usize = 2;

/// Particles that take all passes: to them all others are nothing any more after the first. The arrays have an entry for each of them,
/// in the order of the groups.
#[derive(Clone, Debug, Default)]
pub(crate) struct Thick {
    /// Which they are.
    particles: Vec<u32>,
    element: Vec<ElementId>,
    /// Velocities, d/s, and those after a pass.
    vx: Vec<f32>,
    vy: Vec<f32>,
    next_x: Vec<f32>,
    next_y: Vec<f32>,
    /// What does not change from pass to pass: see [`Matter`].
    x: Vec<f32>,
    y: Vec<f32>,
    density: Vec<f32>,
    volumes: Vec<f32>,
    masses: Vec<f32>,
    shares: Vec<f32>,
    loads: Vec<f32>,
    /// Groups of them.
    groups: Vec<Group>,
    /// How many of them come before each particle, and how many there are.
    before: Vec<u32>,
}

impl Thick {
    /// Brings those of `matter` together that take all passes; `false` if they are not few.
    pub(super) fn gather(&mut self, matter: Matter, groups: &[Group], takes_all: impl Fn(ElementId) -> bool) -> bool {
        if matter.element.iter().filter(|element| takes_all(**element)).count() > matter.element.len() / FEW {
            self.clear();
            return false;
        }
        self.particles.clear();
        self.before.clear();
        for (i, element) in matter.element.iter().enumerate() {
            self.before.push(self.particles.len() as u32);
            if takes_all(*element) {
                self.particles.push(i as u32);
            }
        }
        self.before.push(self.particles.len() as u32);
        let which = &self.particles;
        self.element.clear();
        self.element.extend(which.iter().map(|i| matter.element[*i as usize]));
        for (to, from) in [
            (&mut self.vx, matter.vx),
            (&mut self.vy, matter.vy),
            (&mut self.x, matter.x),
            (&mut self.y, matter.y),
            (&mut self.density, matter.density),
            (&mut self.volumes, matter.volumes),
            (&mut self.masses, matter.masses),
            (&mut self.shares, matter.shares),
            (&mut self.loads, matter.loads),
        ] {
            to.clear();
            to.extend(which.iter().map(|i| from[*i as usize]));
        }
        self.next_x.resize(which.len(), 0.0);
        self.next_y.resize(which.len(), 0.0);
        let place = |i: usize| self.before[i];
        let run = |run: Run| Run::new(place(run.range().start), place(run.range().end));
        self.groups.clear();
        self.groups.extend(groups.iter().filter_map(|group| {
            let [first, end] = [group.particles().start, group.particles().end].map(place);
            let (len, movable) = ((end - first) as u8, group.movable.map(run));
            (len > 0).then_some(Group { first, len, movable, ..*group })
        }));
        true
    }

    /// Takes them through a pass.
    pub(super) fn pass(&mut self, setting: &Setting, once: Once) {
        let Self { element, vx, vy, next_x, next_y, x, y, density, volumes, masses, shares, loads, groups, .. } = self;
        let matter = Matter { element, x, y, vx, vy, density, volumes, masses, shares, loads };
        setting.pass(matter, groups, once, [next_x, next_y]);
        std::mem::swap(vx, next_x);
        std::mem::swap(vy, next_y);
    }

    /// Gives the particles what velocities they have now.
    pub(super) fn hand_back(&self, particles: &mut Particles) {
        for (i, (vx, vy)) in self.particles.iter().zip(self.vx.iter().zip(&self.vy)) {
            (particles.vx[*i as usize], particles.vy[*i as usize]) = (*vx, *vy);
        }
    }

    /// Whether none are held.
    #[cfg(test)]
    pub fn is_empty(&self) -> bool {
        self.particles.is_empty()
    }

    /// Gives all memory back.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { vx, vy, next_x, next_y, x, y, density, volumes, masses, shares, loads, .. } = self;
        let floats = [vx, vy, next_x, next_y, x, y, density, volumes, masses, shares, loads];
        4 * (floats.iter().map(|field| field.capacity()).sum::<usize>()
            + self.particles.capacity()
            + self.before.capacity())
            + size_of::<ElementId>() * self.element.capacity()
            + size_of::<Group>() * self.groups.capacity()
    }
}
