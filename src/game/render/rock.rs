//! Rock as a picture: a texel a cell, baked only when the rock changed.

use crate::{
    game::render::look::Finish,
    kernel::{element::ElementId, solids::Solids},
    lab::{colours::Rgb, maps::BurialMap},
};
use glam::IVec2;

/// Packs all rock, row by row from the bottom: red, green and blue of each cell of rock, and 255 less its finish; or nothing.
/// `texel`: colour and finish of a cell, by its element, id and how deep it is buried.
pub fn pack(
    solids: &Solids,
    burial: &mut BurialMap,
    texel: impl Fn(IVec2, ElementId, u32, f32) -> (Rgb, Finish),
    out: &mut Vec<u8>,
) {
    burial.measure(solids);
    out.clear();
    out.resize(4 * (solids.columns() * solids.rows()) as usize, 0);
    solids.iter().for_each(|(cell, element, id)| {
        let ([r, g, b], finish) = texel(cell, element, id, burial.at(cell));
        let k = 4 * (cell.y * solids.columns() + cell.x) as usize;
        out[k..k + 4].copy_from_slice(&[r, g, b, 255 - finish as u8]);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rock_has_a_texel_where_it_is_and_air_has_none() {
        let mut solids = Solids::new(8, 4);
        solids.insert(IVec2::new(3, 2), ElementId(0), 7);
        let mut out = vec![9; 3];
        let texel = |cell: IVec2, _, id, _| ([cell.x as u8, cell.y as u8, id as u8], Finish::Fibres);
        pack(&solids, &mut BurialMap::default(), texel, &mut out);
        let mut wanted = vec![0; 4 * 8 * 4];
        wanted[4 * 19..4 * 20].copy_from_slice(&[3, 2, 7, 254]);
        assert_eq!(out, wanted);
    }
}
