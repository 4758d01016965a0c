//! Rock as instances: cell, colour and which of its sides are open. Rebuilt only when the rock changed.

use crate::{
    kernel::{element::ElementId, solids::Solids},
    lab::{colours::Rgb, maps::BurialMap},
};
use glam::IVec2;

/// Cell (two u16), then colour and sides (four bytes).
pub type RockInstance = [u32; 2];

/// Sides in the order of their bits: top, right, bottom, left. A set bit means rock or wall there.
const SIDES: [IVec2; 4] = [IVec2::Y, IVec2::X, IVec2::NEG_Y, IVec2::NEG_X];

/// Packs all rock. `colour`: that of a cell, by its element, id and how deep it is buried.
pub fn pack(
    solids: &Solids,
    burial: &mut BurialMap,
    colour: impl Fn(IVec2, ElementId, u32, f32) -> Rgb,
    out: &mut Vec<RockInstance>,
) {
    burial.measure(solids);
    out.clear();
    for (cell, element, id) in solids.iter() {
        let [r, g, b] = colour(cell, element, id, burial.at(cell));
        let sides = (0..SIDES.len()).fold(0, |bits, k| bits | (u8::from(solids.is_solid(cell + SIDES[k])) << k));
        out.push([cell.x as u32 | (cell.y as u32) << 16, u32::from_le_bytes([r, g, b, sides])]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn open_sides_are_told_from_closed_ones() {
        let mut solids = Solids::new(8, 8);
        for (id, cell) in [(0, IVec2::new(0, 3)), (1, IVec2::new(1, 3))] {
            solids.insert(cell, ElementId(0), id);
        }
        let mut out = Vec::new();
        pack(&solids, &mut BurialMap::default(), |_, _, _, _| [1, 2, 3], &mut out);
        assert_eq!(out.len(), 2);
        assert_eq!(out[1][0], 1 | 3 << 16);
        let sides = |k: usize| out[k][1].to_le_bytes()[3];
        assert_eq!(sides(0), 0b1010, "rock at the wall: closed left (wall) and right (rock)");
        assert_eq!(sides(1), 0b1000, "its neighbour: closed left only");
    }
}
