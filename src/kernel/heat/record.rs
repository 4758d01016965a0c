//! What is booked of a world's matter: heat that came and went, and who changed.

use super::curve::Change;
use crate::element::ElementId;
use serde::{Deserialize, Serialize};

/// What belongs to a world's state of its heat, its changes and its reactions, beside what its lumps hold.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct HeatRecord {
    /// What the air got, less what it gave, quanta.
    pub to_air: i64,
    /// What tools gave, less what they took, quanta.
    pub by_hand: i64,
    /// What grew from light, quanta.
    pub by_light: i64,
    /// What lumps got beside their own when they became one of several products, less what they gave: it comes to nothing each
    /// time that all had their turn.
    pub lent: i64,
    /// Gas that the air got of matter, less what it gave, in [parts](GAS_PARTS) of d² at the surroundings' pressure.
    pub gas: i64,
    /// Lumps that went into the air.
    pub gone: u64,
    /// Lumps that became rock, or were rock before.
    pub turned: u64,
    /// Pairs that reacted.
    pub reacted: u64,
    /// How often the changes of each element below and above a temperature and its decay have come to pass: whose turn it is
    /// among what comes of them. Empty where none has.
    pub turns: Vec<[u32; 3]>,
}

/// Parts of a d² that gas is booked in.
pub const GAS_PARTS: f64 = 1_048_576.0;

/// The place of the decay among an element's turns; those of its changes are [`HeatCurve::done`](super::curve::HeatCurve::done)'s.
pub const DECAY: usize = 2;

impl HeatRecord {
    /// Energy that matter gave away, less what it got, quanta: with what matter has it is the same for ever.
    pub fn outside(&self) -> i64 {
        self.to_air - self.by_hand - self.by_light - self.lent
    }

    /// Whose turn it is among so many.
    fn turn(&self, element: ElementId, place: usize, count: usize) -> usize {
        self.turns.get(element.index()).map_or(0, |turns| turns[place]) as usize % count
    }

    /// What a lump gets beside its own by a change that comes to pass next, quanta. It is lent.
    pub(super) fn lend(&mut self, element: ElementId, place: usize, change: &Change) -> i32 {
        let share = change.shares[self.turn(element, place, change.shares.len())];
        self.lent += i64::from(share);
        share
    }

    /// What comes of a change next, out of what comes of it in turn.
    pub fn next(&self, element: ElementId, place: usize, into: &[Option<ElementId>]) -> Option<ElementId> {
        into[self.turn(element, place, into.len())]
    }

    /// Notes that a change came to pass.
    pub fn count(&mut self, element: ElementId, place: usize) {
        if self.turns.len() <= element.index() {
            self.turns.resize(element.index() + 1, [0; 3]);
        }
        let turn = &mut self.turns[element.index()][place];
        *turn = turn.wrapping_add(1);
    }
}
