//! Which tiles of the box have something to be drawn, so that the shaders go over these pixels only.

use glam::{IVec2, UVec2, Vec2};

/// Edge of a tile, d.
pub const TILE: f32 = 8.0;

/// A tile as an instance: column and row, two u16.
pub type TileInstance = u32;

/// Marks of the tiles of a box.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tiles {
    dimensions: UVec2,
    marked: Vec<bool>,
}

impl Tiles {
    /// Takes all marks off.
    pub fn clear(&mut self, size: Vec2) {
        self.dimensions = (size / TILE).ceil().as_uvec2().max(UVec2::ONE);
        self.marked.clear();
        self.marked.resize((self.dimensions.x * self.dimensions.y) as usize, false);
    }

    /// Marks all that a disc reaches.
    pub fn mark(&mut self, at: Vec2, radius: f32) {
        // What is below 0 or no number becomes 0. Rounding down by `floor` would be a call.
        let [low, high] = [at - radius, at + radius].map(|at| (at / TILE).as_uvec2().min(self.dimensions - 1));
        let mut mark = |x: u32, y: u32| self.marked[(y * self.dimensions.x + x) as usize] = true;
        if (high - low).max_element() <= 1 {
            // Whether it reaches one tile or two is anyone's guess, also the processor's: no loop.
            for (x, y) in [(low.x, low.y), (high.x, low.y), (low.x, high.y), (high.x, high.y)] {
                mark(x, y);
            }
            return;
        }
        for y in low.y..=high.y {
            (low.x..=high.x).for_each(|x| mark(x, y));
        }
    }

    /// Marks those of a cell, and of the cells within `reach` of it.
    pub fn mark_cell(&mut self, cell: IVec2, reach: i32) {
        let most = self.dimensions.as_ivec2() - 1;
        let low = ((cell - reach) / TILE as i32).clamp(IVec2::ZERO, most);
        let high = ((cell + reach) / TILE as i32).clamp(IVec2::ZERO, most);
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                self.marked[(y * (most.x + 1) + x) as usize] = true;
            }
        }
    }

    /// The marked ones.
    pub fn list(&self, out: &mut Vec<TileInstance>) {
        out.clear();
        let marked = self.marked.iter().enumerate().filter(|(_, marked)| **marked);
        out.extend(marked.map(|(k, _)| {
            let k = k as u32;
            (k % self.dimensions.x) | ((k / self.dimensions.x) << 16)
        }));
    }
}

/// Which tiles are drawn by which pass.
#[derive(Default)]
pub struct PictureTiles {
    /// Bodies of matter.
    pub bodies: Vec<TileInstance>,
    /// Gases.
    pub gases: Vec<TileInstance>,
    /// Rock.
    pub rock: Vec<TileInstance>,
    /// Rock that looks otherwise than in the frame before.
    pub changed: Vec<TileInstance>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marked(at: Vec2, radius: f32) -> Vec<TileInstance> {
        let mut tiles = Tiles::default();
        tiles.clear(Vec2::new(30.0, 20.0));
        tiles.mark(at, radius);
        let mut out = Vec::new();
        tiles.list(&mut out);
        out
    }

    #[test]
    fn a_disc_marks_all_tiles_that_it_reaches_and_no_other() {
        assert_eq!(marked(Vec2::splat(4.0), 1.0), [0]);
        assert_eq!(marked(Vec2::new(8.5, 4.0), 1.0), [0, 1]);
        assert_eq!(marked(Vec2::new(8.0, 8.0), 1.0), [0, 1, 1 << 16, 1 | 1 << 16]);
        assert_eq!(marked(Vec2::new(-5.0, 40.0), 1.0), [2 << 16], "what is outside belongs to the edge");
    }

    #[test]
    fn a_cell_marks_the_tiles_of_those_around_it() {
        let mut tiles = Tiles::default();
        let mut marked = |cell: [i32; 2], reach: i32| {
            tiles.clear(Vec2::new(30.0, 20.0));
            tiles.mark_cell(IVec2::from(cell), reach);
            let mut out = Vec::new();
            tiles.list(&mut out);
            out
        };
        assert_eq!(marked([4, 4], 2), [0]);
        assert_eq!(marked([7, 1], 1), [0, 1]);
        assert_eq!(marked([9, 9], 2), [0, 1, 1 << 16, 1 | 1 << 16]);
        assert_eq!(marked([0, 19], 1), [2 << 16]);
    }

    #[test]
    fn what_is_no_number_marks_a_tile_and_breaks_nothing() {
        assert!(marked(Vec2::NAN, 1.0).len() <= 1);
    }
}
