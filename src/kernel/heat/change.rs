//! Lumps whose change is done become what it leads to. They keep their heat, their place, their speed and their number.

use super::{curve::Change, matter::Warm};
use crate::{element::ElementId, relabel::Relabelled};
use glam::IVec2;
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
    fn next(&self, element: ElementId, place: usize, change: &Change) -> Option<ElementId> {
        let turn = self.turns.get(element.index()).map_or(0, |turns| turns[place]);
        change.into[turn as usize % change.into.len()]
    }

    fn count(&mut self, element: ElementId, place: usize) {
        if self.turns.len() <= element.index() {
            self.turns.resize(element.index() + 1, [0; 2]);
        }
        let turn = &mut self.turns[element.index()][place];
        *turn = turn.wrapping_add(1);
    }
}

/// Gives lumps whose change is done the element that it leads to.
pub fn change(warm: &mut Warm, record: &mut HeatRecord, relabelled: &mut Relabelled) {
    relabelled.begin();
    for i in 0..warm.particles.len() {
        let table = warm.table;
        let (element, heat) = (warm.particles.element[i], warm.particles.heat_of(i));
        let Some((place, change)) = table.curve(element).done(heat) else { continue };
        let product = record.next(element, place, change);
        if relabelled.can_be(warm, i, product) {
            record.count(element, place);
            relabelled.particle(warm, record, i, product);
        }
    }
    relabelled.end(warm.particles);
    if warm.solids.heats().is_empty() {
        return;
    }
    let (solids, table) = (&*warm.solids, warm.table);
    let done = |(cell, element, _)| table.curve(element).done(solids.heat(cell)).map(|_| cell);
    let cells: Vec<IVec2> = solids.iter().filter_map(done).collect();
    for cell in cells {
        let Some((element, _)) = warm.solids.get(cell) else { continue };
        let Some((place, change)) = table.curve(element).done(warm.solids.heat(cell)) else { continue };
        let product = record.next(element, place, change);
        record.count(element, place);
        relabelled.rock(warm, record, cell, product);
    }
}
