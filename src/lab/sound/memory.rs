//! How each particle moved, and what it was, when it was last listened to.

use crate::kernel::element::ElementId;
use glam::Vec2;

/// What is remembered of a particle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Remembered {
    id: u32,
    /// What it was made of.
    pub(super) element: ElementId,
    /// Its velocity, d/s.
    pub(super) velocity: Vec2,
}

/// No particle's: ids count from 0, and a world has not as many.
const NOBODY: Remembered = Remembered { id: u32::MAX, element: ElementId(0), velocity: Vec2::ZERO };

/// A table of places by the last bits of the id. Of two that share a place the one that was put there last is remembered: ids
/// are given in turn, so few do.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    places: Vec<Remembered>,
}

impl Memory {
    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.places.clear();
    }

    /// Makes room for so many. What is remembered is lost when the table grows, as that of a world that has just grown so much.
    pub(super) fn fit(&mut self, particles: usize) {
        if self.places.len() < 2 * particles {
            self.places.clear();
            self.places.resize((2 * particles).next_power_of_two(), NOBODY);
        }
    }

    /// Puts a particle in its place, and gives back what was remembered of it.
    #[inline(always)]
    pub(super) fn replace(&mut self, id: u32, element: ElementId, velocity: Vec2) -> Option<Remembered> {
        let last = self.places.len() - 1;
        let place = &mut self.places[id as usize & last];
        let before = std::mem::replace(place, Remembered { id, element, velocity });
        (before.id == id).then_some(before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_remembers_who_was_there_and_nobody_else() {
        let mut memory = Memory::default();
        memory.fit(10);
        assert!(memory.replace(7, ElementId(1), Vec2::X).is_none());
        let before = memory.replace(7, ElementId(2), Vec2::Y).unwrap();
        assert_eq!((before.element, before.velocity), (ElementId(1), Vec2::X));
        let places = memory.places.len() as u32;
        assert!(memory.replace(7 + places, ElementId(1), Vec2::X).is_none(), "another particle had its place");
        memory.fit(10);
        assert!(memory.replace(7 + places, ElementId(1), Vec2::X).is_some(), "there was room for as many");
    }
}
