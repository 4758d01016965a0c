//! Lumps whose change is done become what it leads to. They keep their heat, their place, their speed and their number.

use super::{curve::Change, matter::Warm};
use crate::{
    element::ElementId,
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};
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

/// What changed. Buffers are kept.
#[derive(Clone, Debug, Default)]
pub struct Changed {
    /// Where particles are another element than before, or gone, d.
    pub places: Vec<Vec2>,
    /// Particles that go.
    gone: Vec<bool>,
    /// Rock that becomes another element.
    rock: Vec<IVec2>,
    /// Particles in each cell of the box, where one of them may become rock.
    crowd: Vec<u8>,
}

/// Gives lumps whose change is done the element that it leads to.
pub fn change(warm: &mut Warm, record: &mut HeatRecord, changed: &mut Changed) {
    changed.places.clear();
    changed.rock.clear();
    changed.gone.clear();
    changed.crowd.clear();
    for i in 0..warm.particles.len() {
        let (element, heat) = (warm.particles.element[i], warm.particles.heat_of(i));
        let Some((place, change)) = warm.table.curve(element).done(heat) else { continue };
        let at = warm.particles.position(i);
        match record.next(element, place, change) {
            Some(product) if !warm.elements.get(product).fixed => warm.particles.element[i] = product,
            Some(product) if !becomes_rock(warm, changed, i, product, heat) => continue,
            other => {
                if other.is_none() {
                    record.to_air += i64::from(heat);
                    record.gone += 1;
                } else {
                    record.turned += 1;
                }
                changed.gone.resize(warm.particles.len(), false);
                changed.gone[i] = true;
            }
        }
        record.count(element, place);
        changed.places.push(at);
    }
    if !changed.gone.is_empty() {
        warm.particles.retain(|_, i| !changed.gone[i]);
    }
    let Warm { solids, table, .. } = warm;
    if !solids.heats().is_empty() {
        let is_done =
            |(cell, element, _): &(IVec2, ElementId, u32)| table.curve(*element).done(solids.heat(*cell)).is_some();
        changed.rock.extend(solids.iter().filter(is_done).map(|(cell, ..)| cell));
    }
    for cell in &changed.rock {
        melt(warm, *cell, record);
    }
}

/// Puts rock in the place of a particle, if it is alone in its cell.
fn becomes_rock(warm: &mut Warm, changed: &mut Changed, i: usize, product: ElementId, heat: i32) -> bool {
    let Warm { particles, solids, .. } = warm;
    let index = |cell: IVec2| cell.y as usize * solids.columns() as usize + cell.x as usize;
    if changed.crowd.is_empty() {
        changed.crowd.resize(solids.columns() as usize * solids.rows() as usize, 0);
        let cells = (0..particles.len()).map(|other| Solids::cell_of(particles.position(other)));
        for cell in cells.filter(|cell| solids.contains(*cell)) {
            let count = &mut changed.crowd[index(cell)];
            *count = count.saturating_add(1);
        }
    }
    let cell = Solids::cell_of(particles.position(i));
    if !solids.contains(cell) || changed.crowd[index(cell)] > 1 || !solids.insert(cell, product, particles.id[i]) {
        return false;
    }
    solids.set_heat(cell, heat);
    true
}

/// Gives rock whose change is done what it leads to.
fn melt(warm: &mut Warm, cell: IVec2, record: &mut HeatRecord) {
    let Warm { particles, solids, elements, table, domain, .. } = warm;
    let Some((element, id)) = solids.get(cell) else { return };
    let heat = solids.heat(cell);
    let Some((place, change)) = table.curve(element).done(heat) else { return };
    let product = record.next(element, place, change);
    record.count(element, place);
    solids.remove(cell);
    match product {
        Some(product) if elements.get(product).fixed => {
            solids.insert(cell, product, id);
            solids.set_heat(cell, heat);
        }
        Some(product) => {
            // A cell that the box ends in may have its centre beyond the wall.
            particles.push_warm(id, product, domain.keep_inside(centre(cell)), Vec2::ZERO, heat);
            record.turned += 1;
        }
        None => {
            record.to_air += i64::from(heat);
            record.gone += 1;
        }
    }
}
