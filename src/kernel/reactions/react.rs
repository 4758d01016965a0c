//! Contacts whose dice fell become what their reaction says.

use super::{
    contacts::{Contacts, Fallen, Partner},
    table::ReactionTable,
};
use crate::{
    element::ElementId,
    heat::{HeatRecord, Warm},
    relabel::{Relabelled, gas_of},
    solids::Solids,
};

/// A pair that reacts: the particle, and its contact.
type Pair = (u32, Fallen);

/// Gas that two lumps give off together as they react, d²: where one takes as much as the other gives, none comes up.
fn gas_of_pair(warm: &Warm, before: [ElementId; 2], after: [Option<ElementId>; 2]) -> f32 {
    gas_of(warm.elements, before[0], &after[..1]) + gas_of(warm.elements, before[1], &after[1..])
}

/// Buffers of the reactions, which are kept.
#[derive(Clone, Debug, Default)]
pub struct Reactions {
    contacts: Contacts,
    /// The contact that each particle took, by its place in the store.
    taken: Vec<Option<Fallen>>,
    pairs: Vec<Pair>,
}

impl Reactions {
    /// Lets what touches react for a tick, on up to `threads` threads of the current rayon pool. `counts`: lumps of each
    /// element, rock and particles. `relabelled` gets who is another element.
    pub fn react(
        &mut self,
        warm: &mut Warm,
        (reactions, counts): (&ReactionTable, &[u32]),
        record: &mut HeatRecord,
        relabelled: &mut Relabelled,
        tick: u64,
        threads: usize,
    ) {
        relabelled.begin();
        self.pair(warm, reactions, counts, tick, threads);
        for (i, Fallen { partner, reaction, .. }) in &self.pairs {
            let i = *i as usize;
            let [own, other] = reactions.products(*reaction, warm.particles.element[i]);
            match *partner {
                Partner::Particle(j) => {
                    let j = j as usize;
                    if !relabelled.can_be(warm, i, own) || !relabelled.can_be(warm, j, other) {
                        continue;
                    }
                    let before = [i, j].map(|k| warm.particles.element[k]);
                    let mut gas = gas_of_pair(warm, before, [own, other]);
                    for (k, (product, before)) in [i, j].into_iter().zip([own, other].into_iter().zip(before)) {
                        if product != Some(before) {
                            relabelled.particle(warm, record, k, product, std::mem::take(&mut gas));
                        }
                    }
                }
                Partner::Rock(cell) => {
                    let hardens = own.is_some_and(|own| warm.elements.get(own).fixed);
                    let beside = hardens.then(|| Solids::cell_of(warm.particles.position(i)));
                    if !relabelled.can_be(warm, i, own) || !Relabelled::rock_can_be(warm, cell, other, beside) {
                        continue;
                    }
                    let Some((rock, _)) = warm.solids.get(cell) else { continue };
                    let before = warm.particles.element[i];
                    let mut gas = gas_of_pair(warm, [before, rock], [own, other]);
                    if own != Some(before) {
                        relabelled.particle(warm, record, i, own, std::mem::take(&mut gas));
                    }
                    if other != Some(rock) {
                        relabelled.rock(warm, record, cell, other, gas);
                    }
                }
            }
            record.reacted += 1;
        }
        relabelled.end(warm.particles);
    }

    /// Finds the pairs: those that took each other, and of those that took a rock the lowest; in the order of their ids.
    fn pair(&mut self, warm: &Warm, reactions: &ReactionTable, counts: &[u32], tick: u64, threads: usize) {
        let Self { contacts, taken, pairs } = self;
        pairs.clear();
        contacts.find(warm, reactions, counts, tick, threads);
        taken.clear();
        for (i, fallen) in contacts.fallen() {
            taken.resize(warm.particles.len(), None);
            taken[i] = Some(fallen);
        }
        for (i, fallen) in taken.iter().enumerate() {
            let Some(fallen) = fallen else { continue };
            let both = match fallen.partner {
                Partner::Particle(j) => {
                    i < j as usize && taken[j as usize].is_some_and(|other| other.rank == fallen.rank)
                }
                Partner::Rock(_) => true,
            };
            if both {
                pairs.push((i as u32, *fallen));
            }
        }
        // Of those that took one rock the lowest stays.
        let cell = |(_, fallen): &Pair| match fallen.partner {
            Partner::Rock(cell) => Some(cell.to_array()),
            Partner::Particle(_) => None,
        };
        pairs.sort_unstable_by_key(|pair| (cell(pair), pair.1.rank));
        pairs.dedup_by(|later, earlier| cell(later).is_some() && cell(later) == cell(earlier));
        pairs.sort_unstable_by_key(|(_, fallen)| fallen.rank.1);
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let contact = size_of::<Option<Fallen>>();
        self.contacts.memory() + contact * self.taken.capacity() + size_of::<Pair>() * self.pairs.capacity()
    }
}
