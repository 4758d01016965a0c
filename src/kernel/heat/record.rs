//! What is booked of a world's matter: heat that came and went, and who changed.

use super::curve::Change;
use crate::element::ElementId;
use serde::{Deserialize, Serialize};

/// What belongs to a world's state of its heat, beside what its lumps hold.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct HeatRecord {
    /// What the air got, less what it gave, quanta.
    pub to_air: i64,
    /// What tools gave, less what they took, quanta.
    pub by_hand: i64,
    /// Lumps that went into the air.
    pub gone: u64,
    /// Lumps that became rock, or were rock before.
    pub turned: u64,
    /// Pairs that reacted.
    pub reacted: u64,
    /// How often the changes of each element below and above a temperature have come to pass: whose turn it is among what
    /// comes of them. Empty where none has.
    pub turns: Vec<[u32; 2]>,
}

impl HeatRecord {
    /// What comes of a change next.
    pub(super) fn next(&self, element: ElementId, place: usize, change: &Change) -> Option<ElementId> {
        let turn = self.turns.get(element.index()).map_or(0, |turns| turns[place]);
        change.into[turn as usize % change.into.len()]
    }

    /// Notes that a change came to pass.
    pub(super) fn count(&mut self, element: ElementId, place: usize) {
        if self.turns.len() <= element.index() {
            self.turns.resize(element.index() + 1, [0; 2]);
        }
        let turn = &mut self.turns[element.index()][place];
        *turn = turn.wrapping_add(1);
    }
}
