//! Putting a piece of a world into it.

use super::{
    matter::{EditReport, Matter},
    occupancy::Occupancy,
};
use crate::{
    particles::Particle,
    piece::{Piece, Turn},
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

impl Matter<'_> {
    /// Puts a piece of the same spacing where its lower left cell is `low`, turned as `turn` says: into free room. What has less
    /// room there than it had where it was taken from, and less than a new particle needs, is left out: so lumps are
    /// nowhere nearer together than that, and pressure makes no more of it than it would have made there.
    pub fn paste(&mut self, piece: &Piece, low: IVec2, turn: Turn) -> EditReport {
        let mut report = EditReport { crowded: piece.count() as u64, ..EditReport::default() };
        let high = low.saturating_add(turn.size(piece.size)) - 1;
        let (first, last) = (low.max(IVec2::ZERO), high.min(self.size() - 1));
        if first.cmpgt(last).any() {
            return report;
        }
        let mut taken = Occupancy::default();
        taken.look(self.particles, first, last);
        taken.look_at_rock(self.solids, first, last);
        for rock in &piece.rock {
            let cell = low + turn.cell(rock.cell, piece.size);
            let fits = self.solids.contains(cell) && !taken.holds(cell) && taken.has_room(centre(cell), rock.room);
            if fits && self.elements.get(rock.element).fixed && self.may_place(&mut report) {
                let id = self.take_id();
                self.solids.insert(cell, rock.element, id);
                self.solids.set_heat(cell, rock.heat);
            }
        }
        for i in 0..piece.particles.len() {
            let particle = turned(piece, i, low, turn);
            let at = Vec2::new(particle.x, particle.y);
            let is_inside = at.cmpge(Vec2::ZERO).all() && at.cmple(self.domain.size).all();
            let fits = is_inside && !self.solids.is_solid(Solids::cell_of(at)) && taken.has_room(at, piece.room[i]);
            if fits && !self.elements.get(particle.element).fixed && self.may_place(&mut report) {
                let id = self.take_id();
                self.particles.add(Particle { id, ..particle });
            }
        }
        report
    }

    /// Whether there is room for one more that fits, which is booked either way.
    fn may_place(&mut self, report: &mut EditReport) -> bool {
        let may = self.room_left() > 0;
        report.crowded -= 1;
        report.placed += u64::from(may);
        report.refused += u64::from(!may);
        may
    }
}

/// Particle `i` of a piece whose lower left cell is `low`.
fn turned(piece: &Piece, i: usize, low: IVec2, turn: Turn) -> Particle {
    let particle = piece.particles.get(i);
    let at = low.as_vec2() + turn.place(Vec2::new(particle.x, particle.y), piece.size);
    let velocity = turn.direction(Vec2::new(particle.vx, particle.vy));
    let push = turn.direction(Vec2::new(particle.push_x, particle.push_y));
    let (x, y, vx, vy, push_x, push_y) = (at.x, at.y, velocity.x, velocity.y, push.x, push.y);
    Particle { x, y, vx, vy, push_x, push_y, ..particle }
}
