//! Which particles cross a line from one tick to the next. It goes by their numbers, whatever their order is, and takes the way of
//! a tick as straight: it is one step of the count, and on which side a particle ends up does not depend on the way between.

use crate::kernel::{element::ElementId, particles::Particles};
use glam::{DVec2, Vec2};

/// A particle as it was seen.
#[derive(Clone, Copy, Debug)]
struct Seen {
    id: u32,
    element: ElementId,
    /// Where, d.
    at: Vec2,
}

/// A particle that has moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// What it is now.
    pub element: ElementId,
    /// Where it was, d.
    pub from: Vec2,
    /// Where it is, d.
    pub to: Vec2,
}

/// Where the particles were when they were seen last, in the order of their numbers: 16 bytes each, and as many to sort the next.
#[derive(Clone, Debug, Default)]
pub struct Crossings {
    seen: Vec<Seen>,
    next: Vec<Seen>,
}

impl Crossings {
    /// Bytes held.
    pub fn held(&self) -> usize {
        (self.seen.capacity() + self.next.capacity()) * size_of::<Seen>()
    }

    /// Sees where the particles are.
    pub fn look(&mut self, particles: &Particles) {
        self.follow(particles, |_| {});
    }

    /// Sees where the particles are, and shows `visit` those that were seen before and have moved since.
    pub fn follow(&mut self, particles: &Particles, mut visit: impl FnMut(Moved)) {
        let Self { seen, next } = self;
        next.clear();
        next.extend((0..particles.len()).map(|i| Seen {
            id: particles.id[i],
            element: particles.element[i],
            at: particles.position(i),
        }));
        next.sort_unstable_by_key(|seen| seen.id);
        let mut before = seen.iter().peekable();
        for now in next.iter() {
            while before.next_if(|before| before.id < now.id).is_some() {}
            if let Some(before) = before.next_if(|before| before.id == now.id && before.at != now.at) {
                visit(Moved { element: now.element, from: before.at, to: now.at });
            }
        }
        std::mem::swap(seen, next);
    }
}

/// How often a way (d) crosses a line from `a` to `b` (d) to its right: 1, −1 for the other way, or 0.
///
/// A place on the line counts as to its left, and of the line's ends the first belongs to it: so what goes to and fro adds up to
/// nothing, and through two lines that meet everything goes once.
pub fn crosses(moved: &Moved, a: Vec2, b: Vec2) -> i64 {
    let [from, to, a, b] = [moved.from, moved.to, a, b].map(Vec2::as_dvec2);
    let along = b - a;
    let [before, after] = [from, to].map(|at: DVec2| along.perp_dot(at - a));
    if (before >= 0.0) == (after >= 0.0) {
        return 0;
    }
    let through = from + (to - from) * (before / (before - after));
    let share = (through - a).dot(along) / along.length_squared();
    match (0.0..1.0).contains(&share) {
        true if before >= 0.0 => 1,
        true => -1,
        false => 0,
    }
}
