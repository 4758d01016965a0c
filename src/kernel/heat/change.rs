//! Lumps whose change is done become what it leads to. They keep their heat, their place, their speed and their number.

use super::{matter::Warm, record::HeatRecord};
use crate::relabel::{Relabelled, gas_of};
use glam::IVec2;

/// Gives lumps whose change is done the element that it leads to.
pub fn change(warm: &mut Warm, record: &mut HeatRecord, relabelled: &mut Relabelled) {
    relabelled.begin();
    for i in 0..warm.particles.len() {
        let table = warm.table;
        let (element, heat) = (warm.particles.element[i], warm.particles.heat_of(i));
        let Some((place, change)) = table.curve(element).done(heat) else { continue };
        let product = record.next(element, place, &change.into);
        if relabelled.can_be(warm, i, product) {
            warm.particles.set_heat(i, heat.saturating_add(record.lend(element, place, change)));
            record.count(element, place);
            let gas = gas_of(warm.elements, element, &change.into);
            relabelled.particle(warm, record, i, product, gas);
        }
    }
    relabelled.end(warm.particles);
    if warm.solids.heats().is_empty() {
        return;
    }
    let (solids, table) = (&*warm.solids, warm.table);
    let mut cells: Vec<IVec2> = Vec::new();
    solids.iter().for_each(|(cell, element, _)| {
        if table.curve(element).done(solids.heat(cell)).is_some() {
            cells.push(cell);
        }
    });
    for cell in cells {
        let Some((element, _)) = warm.solids.get(cell) else { continue };
        let heat = warm.solids.heat(cell);
        let Some((place, change)) = table.curve(element).done(heat) else { continue };
        let product = record.next(element, place, &change.into);
        if !Relabelled::rock_can_be(warm, cell, product, None) {
            continue;
        }
        warm.solids.set_heat(cell, heat.saturating_add(record.lend(element, place, change)));
        record.count(element, place);
        let gas = gas_of(warm.elements, element, &change.into);
        relabelled.rock(warm, record, cell, product, gas);
    }
}
