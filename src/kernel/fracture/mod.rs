//! Rock breaks where the air presses on it harder than it bears.
//!
//! A wall fails in shear along the rim of what is pushed out of it, and bears `2 τ t/w` for a thickness t and a breadth w. Here
//! it bears the strength of its element for each metre that it is thick, and all of its thickness goes at once. What pushes is
//! the overpressure of the air at its face less that on the far side. Rock of [`THICK`] or more, and what lies before something
//! that bears everything, is crushed at the face instead, layer by layer, at most at the speed of [`CRACK`].
//!
//! What comes of it is loose, keeps its heat and its number, and is at rest where it was; the air pushes it from then on as all
//! that stands in its way.
//!
//! Matter that presses on rock does not break it, and rock bears any pull.

pub mod table;
#[cfg(test)]
mod tests;

use crate::{
    air::Air,
    heat::{HeatRecord, Warm},
    relabel::Relabelled,
    solids::{Solids, centre},
    units::{Scale, TICK_SECONDS},
};
use glam::IVec2;
use table::{Fracture, FractureTable};

/// Thickness from which on rock is no wall, m: it bears what a wall of this thickness does.
const THICK: f32 = 2.0;

/// Speed at which it is crushed, m/s, at least a layer a tick. Changing this affects how long gas must press.
const CRACK: f32 = 6.0;

/// Overpressure that a layer of particles of a strength (Pa/m) bears, ρ c² of the air.
fn layer(strength: f32, air: &Air, scale: Scale) -> f32 {
    strength * scale.spacing / air.params().stiffness(scale)
}

/// Whether the air presses anywhere harder than a layer of the weakest of what is there bears, by how many lumps there are of each
/// element.
pub fn presses(air: &Air, table: &FractureTable, counts: &[u32], scale: Scale) -> bool {
    table.weakest(counts).is_some_and(|weakest| air.highest_overpressure() > layer(weakest, air, scale))
}

/// Breaks what the air presses on harder than it bears, for a tick.
pub fn fracture(
    warm: &mut Warm,
    table: &FractureTable,
    air: &Air,
    record: &mut HeatRecord,
    relabelled: &mut Relabelled,
) {
    relabelled.begin();
    let layers = (warm.scale.to_kernel(CRACK) * TICK_SECONDS).round().max(1.0) as u32;
    let thick = warm.scale.to_kernel(THICK).ceil() as i32;
    for _ in 0..layers {
        let cells = broken(warm.solids, table, air, (warm.scale, thick));
        if cells.is_empty() {
            return;
        }
        for cell in cells {
            let fracture = warm.solids.get(cell).and_then(|(element, _)| table.of(element));
            let into = fracture.map(|fracture| fracture.into);
            if into.is_some() && Relabelled::rock_can_be(warm, cell, into, None) {
                relabelled.rock(warm, record, cell, into, 0.0);
            }
        }
    }
}

/// Cells of rock that bear less than what presses on them, some of them twice. `thick`: layers of what is no wall.
fn broken(solids: &Solids, table: &FractureTable, air: &Air, (scale, thick): (Scale, i32)) -> Vec<IVec2> {
    let presses = |cell, out| if solids.is_solid(cell) { 0.0 } else { air.overpressure_at(centre(cell), out) };
    let mut cells = Vec::new();
    solids.iter().for_each(|(cell, element, _)| {
        let fracture = table.of(element).filter(|_| !solids.is_enclosed(cell));
        let Some(Fracture { above, .. }) = fracture else { return };
        let own = layer(*above, air, scale);
        for out in [IVec2::NEG_X, IVec2::X, IVec2::NEG_Y, IVec2::Y] {
            let front = presses(cell + out, out);
            // What not even a single layer feels is not looked at further.
            if front <= own {
                continue;
            }
            match wall(solids, table, (cell, out), thick) {
                Some(Wall { layers, strength })
                    if front - presses(cell - out * layers, -out) > layer(strength, air, scale) =>
                {
                    cells.extend((0..layers).map(|layer| cell - out * layer));
                }
                None if front > own * thick as f32 => cells.push(cell),
                _ => {}
            }
        }
    });
    cells
}

/// Rock between two faces.
struct Wall {
    /// Layers of particles.
    layers: i32,
    /// The strengths of all of them together, Pa/m.
    strength: f32,
}

/// The wall behind a face of a cell that looks `out`; none if it has `thick` layers or more, or some that nothing breaks.
fn wall(solids: &Solids, table: &FractureTable, (face, out): (IVec2, IVec2), thick: i32) -> Option<Wall> {
    let mut strength = 0.0;
    for layers in 0..thick {
        let cell = face - out * layers;
        if !solids.is_solid(cell) {
            return Some(Wall { layers, strength });
        }
        strength += table.of(solids.get(cell)?.0)?.above;
    }
    None
}
