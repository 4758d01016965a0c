//! Lumps that an edit is about: those under a stroke, and those that hang together.

use super::matter::Matter;
use crate::{
    brush::Stroke,
    element::ElementId,
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

/// How far from a point a particle is still meant, d.
const REACH: f32 = 1.5;

/// Some lumps of a world.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Selection {
    /// Whether each particle is one of them; empty if none is.
    pub particles: Vec<bool>,
    /// Cells of the rock among them.
    pub rock: Vec<IVec2>,
}

impl Selection {
    /// Whether particle `i` is one of them.
    pub fn has(&self, i: usize) -> bool {
        self.particles.get(i).copied().unwrap_or_default()
    }
}

impl Matter<'_> {
    /// The lumps under a stroke whose element `is_meant`.
    pub(super) fn under(&self, stroke: &Stroke, is_meant: impl Fn(ElementId) -> bool) -> Selection {
        let Some((low, high)) = stroke.bounds(self.size()) else { return Selection::default() };
        let (low, high) = (low.as_vec2(), (high + 1).as_vec2());
        let is_under = |at: Vec2| at.cmpge(low).all() && at.cmple(high).all() && stroke.covers(at);
        let is_rock = |cell: &IVec2| self.solids.get(*cell).is_some_and(|(element, _)| is_meant(element));
        let of_particles = 0..self.particles.len();
        Selection {
            particles: of_particles
                .map(|i| is_meant(self.particles.element[i]) && is_under(self.particles.position(i)))
                .collect(),
            rock: stroke.cells(self.size()).filter(is_rock).collect(),
        }
    }

    /// The lumps of one element that hang together with the one at a point, if that `is_meant`: cells that hold some of it and
    /// touch at a side, or at a corner that rock does not close.
    pub(super) fn around(&self, at: Vec2, is_meant: impl Fn(ElementId) -> bool) -> Selection {
        let Some((start, element)) = self.lump_at(at).filter(|(_, element)| is_meant(*element)) else {
            return Selection::default();
        };
        let fixed = self.elements.get(element).fixed;
        let size = self.size();
        let index = |cell: IVec2| (cell.y * size.x + cell.x) as usize;
        let mut holds = vec![false; (size.x * size.y) as usize];
        let of_particles = || (0..self.particles.len()).filter(|i| self.particles.element[*i] == element);
        let cell_of = |i: usize| Solids::cell_of(self.particles.position(i));
        if fixed {
            let rock = self.solids.iter().filter(|(_, other, _)| *other == element);
            rock.for_each(|(cell, ..)| holds[index(cell)] = true);
        } else {
            let cells = of_particles().map(cell_of).filter(|cell| self.solids.contains(*cell));
            cells.for_each(|cell| holds[index(cell)] = true);
        }
        let is_open = |cell: IVec2, step: IVec2| {
            let sides = [IVec2::new(step.x, 0), IVec2::new(0, step.y)];
            fixed || sides.iter().any(|side| !self.solids.is_solid(cell + *side))
        };
        let mut found = vec![false; holds.len()];
        found[index(start)] = true;
        let mut cells = vec![start];
        let mut next = 0;
        while let Some(&cell) = cells.get(next) {
            next += 1;
            for step in (-1..=1).flat_map(|y| (-1..=1).map(move |x| IVec2::new(x, y))) {
                let other = cell + step;
                let enters = self.solids.contains(other) && holds[index(other)] && !found[index(other)];
                if enters && is_open(cell, step) {
                    found[index(other)] = true;
                    cells.push(other);
                }
            }
        }
        if fixed {
            return Selection { rock: cells, ..Selection::default() };
        }
        let mut particles = vec![false; self.particles.len()];
        for i in of_particles() {
            let cell = cell_of(i);
            particles[i] = self.solids.contains(cell) && found[index(cell)];
        }
        Selection { particles, ..Selection::default() }
    }

    /// The cell and the element of the rock at a point, or else of the particle that is nearest within reach.
    fn lump_at(&self, at: Vec2) -> Option<(IVec2, ElementId)> {
        let cell = Solids::cell_of(at);
        if !at.is_finite() {
            return None;
        }
        if let Some((element, _)) = self.solids.get(cell) {
            return Some((cell, element));
        }
        let away = |i: usize| self.particles.position(i).distance_squared(at);
        let near = (0..self.particles.len()).map(|i| (i, away(i))).filter(|(_, away)| *away < REACH * REACH);
        let (i, _) =
            near.min_by(|a, b| a.1.total_cmp(&b.1).then(self.particles.id[a.0].cmp(&self.particles.id[b.0])))?;
        let cell = Solids::cell_of(self.particles.position(i));
        self.solids.contains(cell).then_some((cell, self.particles.element[i]))
    }

    /// Takes lumps away.
    pub(super) fn remove(&mut self, selection: &Selection) -> u64 {
        let rock = selection.rock.iter().filter(|cell| self.solids.remove(**cell)).count();
        (rock + self.particles.retain(|_, i| !selection.has(i))) as u64
    }

    /// Gives lumps another element, with the heat that it comes into the world with. They keep their number, and what moves
    /// its place and its speed. Rock stands alone in a cell: what else is in one that becomes rock goes. `places` gets where what
    /// moves became something else, d.
    pub(super) fn turn_into(&mut self, element: ElementId, selection: &Selection, places: &mut Vec<Vec2>) -> u64 {
        let (version, heat) = (self.solids.version(), self.heat.spawn_heat(element));
        let fixed = self.elements.get(element).fixed;
        let mut gone = vec![false; self.particles.len()];
        for i in (0..self.particles.len()).filter(|i| selection.has(*i)) {
            if fixed {
                let cell = Solids::cell_of(self.particles.position(i));
                gone[i] = self.solids.insert(cell, element, self.particles.id[i]);
                if gone[i] {
                    self.solids.set_heat(cell, heat);
                }
            } else {
                self.particles.element[i] = element;
                self.particles.set_heat(i, heat);
                places.push(self.particles.position(i));
            }
        }
        let turned = gone.iter().filter(|gone| **gone).count();
        let solids = &*self.solids;
        let is_buried = |at: Vec2| solids.version() != version && solids.is_solid(Solids::cell_of(at));
        let went = self.particles.retain(|particles, i| !gone[i] && !is_buried(particles.position(i)));
        for &cell in &selection.rock {
            let Some((_, id)) = self.solids.get(cell) else { continue };
            self.solids.remove(cell);
            if fixed {
                self.solids.insert(cell, element, id);
                self.solids.set_heat(cell, heat);
            } else {
                // A cell that the box ends in may have its centre beyond the wall.
                let at = self.domain.keep_inside(centre(cell));
                self.particles.push_warm(id, element, at, Vec2::ZERO, heat);
            }
        }
        (went - turned) as u64
    }
}
