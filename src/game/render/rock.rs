//! Rock as a picture: a texel a cell, made anew only where the rock changed.

use crate::{
    game::render::{look::Finish, tiles::Tiles},
    kernel::{element::ElementId, solids::Solids},
    lab::{colours::Rgb, maps::BurialMap},
    sim::generation::Generation,
};
use glam::{IVec2, UVec2, Vec2};
use std::ops::Range;

/// Cells to either side of a point that are looked up when its rock is baked: a texel and a tenth away, and between two texels.
const LOOKED_UP: i32 = 2;

/// The rock of a world, and what of it is new in a frame.
#[derive(Default)]
pub struct RockMap {
    /// Red, green and blue of each cell of rock, and 255 less its finish; or nothing. Row by row from the bottom.
    pub texels: Vec<u8>,
    /// Columns and rows.
    pub size: UVec2,
    /// Rows with new texels.
    pub rows: Range<u32>,
    /// Whether all of them are new.
    pub is_new: bool,
    /// Tiles with rock, or with a cell beside it.
    pub tiles: Tiles,
    /// Tiles that look otherwise than in the frame before.
    pub changed: Tiles,
    /// What the texel of each cell follows from, now and before; 0 where no rock is.
    causes: [Vec<u64>; 2],
    /// A bit for each cell that is rock, in the same order; no word if there is none.
    solid: Vec<u64>,
    burial: BurialMap,
    /// World, its version, and metres of a d.
    of: Option<(Generation, u64, f32)>,
}

impl RockMap {
    /// Follows the rock of a world with so many metres to a d. `texel`: colour and finish of a cell, by its element, id and how deep it
    /// is buried, and by nothing else.
    pub fn follow(
        &mut self,
        rock: &Solids,
        (generation, spacing): (Generation, f32),
        texel: impl Fn(IVec2, ElementId, u32, f32) -> (Rgb, Finish),
    ) {
        (self.is_new, self.rows) = (false, 0..0);
        let before = self.of.replace((generation, rock.version(), spacing));
        if before == self.of {
            return;
        }
        if before.is_none_or(|(of, _, d)| (of, d) != (generation, spacing)) {
            self.begin(rock);
        }
        self.burial.measure(rock);
        self.find(rock);
        self.changed.clear(self.size.as_vec2());
        let columns = self.size.x as usize;
        for y in 0..self.size.y {
            let row = y as usize * columns..(y as usize + 1) * columns;
            let [now, before] = self.causes.each_ref().map(|causes| &causes[row.clone()]);
            if now == before {
                continue;
            }
            let texels = &mut self.texels[4 * row.start..4 * row.end];
            for (x, (now, _)) in now.iter().zip(before).enumerate().filter(|(_, (now, before))| now != before) {
                let cell = IVec2::new(x as i32, y as i32);
                let new = (*now != 0)
                    .then(|| texel(cell, ElementId((now >> 8) as u8), (now >> 32) as u32, self.burial.at(cell)));
                texels[4 * x..][..4].copy_from_slice(&new.map_or([0; 4], bytes));
                self.changed.mark_cell(cell, LOOKED_UP);
            }
            self.rows = if self.rows.is_empty() { y..y + 1 } else { self.rows.start..self.rows.end.max(y + 1) };
        }
    }

    /// Whether there was rock at a point, d, when it was last followed.
    pub fn is_at(&self, point: Vec2) -> bool {
        if self.solid.is_empty() {
            return false;
        }
        let cell = Solids::cell_of(point);
        if cell.min_element() < 0 || cell.as_uvec2().cmpge(self.size).any() {
            return false;
        }
        let k = (cell.y as u32 * self.size.x + cell.x as u32) as usize;
        self.solid[k / 64] >> (k % 64) & 1 != 0
    }

    /// Makes all of it anew, in colours that change by themselves: `texel` is that of a cell, by its element.
    pub fn repaint(&mut self, rock: &Solids, texel: impl Fn(IVec2, ElementId) -> (Rgb, Finish)) {
        self.begin(rock);
        self.of = None;
        let columns = self.size.x as usize;
        rock.iter().for_each(|(cell, element, _)| {
            let k = cell.y as usize * columns + cell.x as usize;
            self.texels[4 * k..][..4].copy_from_slice(&bytes(texel(cell, element)));
            self.tiles.mark_cell(cell, 1);
        });
    }

    /// Begins with none.
    fn begin(&mut self, rock: &Solids) {
        self.size = UVec2::new(rock.columns() as u32, rock.rows() as u32);
        let cells = (self.size.x * self.size.y) as usize;
        self.texels.clear();
        self.texels.resize(4 * cells, 0);
        for causes in &mut self.causes {
            causes.clear();
            causes.resize(cells, 0);
        }
        self.tiles.clear(self.size.as_vec2());
        (self.is_new, self.rows) = (true, 0..self.size.y);
    }

    /// Finds where rock is, and what its texels follow from.
    fn find(&mut self, rock: &Solids) {
        self.tiles.clear(self.size.as_vec2());
        self.causes.swap(0, 1);
        let [now, _] = &mut self.causes;
        now.fill(0);
        self.solid.clear();
        if rock.count() > 0 {
            self.solid.resize(now.len().div_ceil(64), 0);
        }
        let columns = self.size.x as usize;
        rock.iter().for_each(|(cell, element, id)| {
            let k = cell.y as usize * columns + cell.x as usize;
            self.solid[k / 64] |= 1 << (k % 64);
            // The steps out of rock are never 0.
            now[k] = u64::from(self.burial.steps(cell)) | u64::from(element.0) << 8 | u64::from(id) << 32;
            self.tiles.mark_cell(cell, 1);
        });
    }
}

fn bytes(([r, g, b], finish): (Rgb, Finish)) -> [u8; 4] {
    [r, g, b, 255 - finish as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As those of the game: they depend on all that they may.
    fn texel(cell: IVec2, element: ElementId, id: u32, burial: f32) -> (Rgb, Finish) {
        ([(cell.x + 7 * cell.y) as u8, element.0 ^ id as u8, (200.0 * burial) as u8], Finish::Fibres)
    }

    fn follow(map: &mut RockMap, rock: &Solids) {
        map.follow(rock, (Generation::default(), 0.1), texel);
    }

    #[test]
    fn rock_has_a_texel_where_it_is_and_air_has_none() {
        let mut rock = Solids::new(8, 4);
        rock.insert(IVec2::new(3, 2), ElementId(5), 7);
        let mut map = RockMap::default();
        follow(&mut map, &rock);
        let mut wanted = vec![0; 4 * 8 * 4];
        wanted[4 * 19..4 * 20].copy_from_slice(&[17, 2, 0, 254]);
        assert_eq!(map.texels, wanted);
        assert!(map.is_new && map.rows == (0..4));
    }

    #[test]
    fn what_changes_is_made_anew_and_all_is_as_if_it_had_been_so_from_the_start() {
        let mut rock = Solids::new(90, 40);
        for (x, y) in (0..90).flat_map(|x| (0..20).map(move |y| (x, y))) {
            rock.insert(IVec2::new(x, y), ElementId(1), 100 * y as u32 + x as u32);
        }
        let mut map = RockMap::default();
        follow(&mut map, &rock);
        type Change = fn(&mut Solids);
        let changes: [(Change, Range<u32>, [bool; 2]); 5] = [
            (|_| {}, 0..0, [false, false]),
            // What is up to 13 cells below it is a step less deep in.
            (|rock| assert!(rock.remove(IVec2::new(20, 19))), 6..20, [true, false]),
            (|rock| assert!(rock.insert(IVec2::new(80, 30), ElementId(2), 1)), 30..31, [false, true]),
            (|rock| assert!(rock.replace(IVec2::new(81, 0), ElementId(2))), 0..1, [false, true]),
            (|rock| assert!(rock.remove(IVec2::new(80, 30))), 30..31, [false, true]),
        ];
        for (change, rows, tiles) in changes {
            change(&mut rock);
            follow(&mut map, &rock);
            let mut fresh = RockMap::default();
            follow(&mut fresh, &rock);
            assert!(map.texels == fresh.texels && map.tiles == fresh.tiles);
            assert_eq!((map.is_new, &map.rows), (false, &rows));
            let mut changed = Vec::new();
            map.changed.list(&mut changed);
            let is_near = |column: u32| !rows.is_empty() && changed.iter().any(|tile| tile & 0xffff == column);
            assert_eq!([is_near(20 / 8), is_near(80 / 8)], tiles);
        }
    }
}
