//! Square tiles over the box, and what lies around them.

use glam::Vec2;

/// Edge of a tile, d. A body sleeps as a whole, and an awake particle in one of its tiles or in one beside them wakes it:
/// so what is awake and what sleeps are further apart than this. That is more than a kernel reaches (4 d and the moves of
/// an iteration), and more than two cells of the predictor's grid up to a kernel radius of 4 d: they do not know of each
/// other. Raising it joins bodies that are apart and wakes them earlier than needed; lowering it would let them touch.
pub(super) const TILE: f32 = 8.0;

/// Rows and columns of tiles with a ring of empty ones around them, so that every tile of the box has all its neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct TileGrid {
    columns: u32,
    rows: u32,
}

impl TileGrid {
    /// Tiles over a box of `size` d.
    pub fn new(size: Vec2) -> Self {
        let along = |length: f32| (length / TILE).ceil().max(1.0) as u32 + 2;
        Self { columns: along(size.x), rows: along(size.y) }
    }

    /// Number of tiles, the ring included.
    pub fn len(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// The tile of a point, d; of the nearest point of the box where it is outside. What is no number is at 0.
    #[inline(always)]
    pub fn tile(&self, x: f32, y: f32) -> usize {
        // A cast saturates.
        let along = |at: f32, tiles: u32| (at * (1.0 / TILE)).min((tiles - 3) as f32) as u32 + 1;
        (along(y, self.rows) * self.columns + along(x, self.columns)) as usize
    }

    /// Lower left and upper right corner of a tile, d.
    pub fn area(&self, tile: usize) -> (Vec2, Vec2) {
        let (column, row) = (tile % self.columns as usize, tile / self.columns as usize);
        let low = (Vec2::new(column as f32, row as f32) - 1.0) * TILE;
        (low, low + TILE)
    }

    /// A tile of the box and the eight around it.
    pub fn around(&self, tile: usize) -> impl Iterator<Item = usize> + use<> {
        let stride = self.columns as usize;
        let corner = tile - stride - 1;
        (0..9).map(move |k| corner + k / 3 * stride + k % 3)
    }

    /// Finds the tiles that are connected with `start` through tiles that `enters` lets in, `start` included. Tiles that touch at
    /// a corner are connected. `enters` must turn down a tile that it has let in before.
    pub fn flood(&self, start: usize, found: &mut Vec<u32>, mut enters: impl FnMut(usize) -> bool) {
        found.clear();
        found.extend(enters(start).then_some(start as u32));
        let mut next = 0;
        while let Some(&tile) = found.get(next) {
            found.extend(self.around(tile as usize).filter(|&near| enters(near)).map(|near| near as u32));
            next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_has_a_tile_with_all_its_neighbours() {
        for size in [Vec2::new(4.0, 4.0), Vec2::new(8.0, 16.0), Vec2::new(284.0, 149.1)] {
            let grid = TileGrid::new(size);
            for k in 0..1000 {
                let at = Vec2::new((k % 37) as f32 / 36.0, (k % 41) as f32 / 40.0) * size;
                let tile = grid.tile(at.x, at.y);
                let (low, high) = grid.area(tile);
                assert!((low.cmple(at) & high.cmpge(at)).all(), "{at} is not in {low} … {high}");
                assert!(grid.around(tile).all(|near| near < grid.len()) && grid.around(tile).any(|near| near == tile));
            }
            for x in [f32::NAN, f32::NEG_INFINITY, -1.0, 1e30] {
                assert!(grid.around(grid.tile(x, 1e30)).all(|near| near < grid.len()), "{x}");
            }
        }
    }

    #[test]
    fn a_flood_finds_what_touches_and_nothing_else() {
        let grid = TileGrid::new(Vec2::new(80.0, 80.0));
        let of = |column: f32, row: f32| grid.tile(8.0 * column + 4.0, 8.0 * row + 4.0);
        let mut open = vec![false; grid.len()];
        let body = [of(1.0, 1.0), of(2.0, 2.0), of(3.0, 2.0), of(0.0, 0.0)];
        body.iter().chain([&of(5.0, 2.0)]).for_each(|&tile| open[tile] = true);
        let mut found = Vec::new();
        grid.flood(body[0], &mut found, |tile| std::mem::take(&mut open[tile]));
        found.sort_unstable();
        let mut expected = body.map(|tile| tile as u32);
        expected.sort_unstable();
        assert_eq!(found, expected);
    }
}
