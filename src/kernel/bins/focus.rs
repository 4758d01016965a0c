//! Where the liquid is still too dense: the groups that the solver iterates again.

use crate::bins::{
    cells::CellGrid,
    group::{ALL_LANES, Group},
};
use std::ops::Range;

/// Densities that are looked at together: most are fine.
const BLOCK: usize = 64;

/// What is known of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tile {
    /// Nothing in it or around it is too dense.
    Calm,
    /// Something around it is.
    Near,
    /// Something in it is.
    Dense,
}

/// The groups in and around the tiles that hold something too dense. Tiles are cells of the world, not runs of particles:
/// so neither the width of a group nor the number of threads decides which particles are in.
#[derive(Clone, Debug, Default)]
pub(super) struct Focus {
    /// Those of the strips that hold particles are up to date.
    tiles: Vec<Tile>,
    pub groups: Vec<Group>,
}

impl Focus {
    /// Finds them among `groups`, which lie in `strips`. The particles stand at `at` (d); those whose density is above
    /// `bound` are too dense.
    pub fn find(
        &mut self,
        grid: &CellGrid,
        strips: &Range<usize>,
        groups: &[Group],
        at: [&[f32]; 2],
        density: &[f32],
        bound: f32,
    ) {
        let stride = grid.tile_columns();
        self.tiles.resize(grid.rows * stride, Tile::Calm);
        self.tiles[(strips.start - 1) * stride..(strips.end + 1) * stride].fill(Tile::Calm);
        self.mark(grid, at, density, bound);
        let mut found = std::mem::take(&mut self.groups);
        found.clear();
        found.extend(groups.iter().filter_map(|group| {
            let lanes = self.lanes(grid, at, group);
            (lanes != 0).then(|| Group { lanes, ..group.clone() })
        }));
        self.groups = found;
    }

    fn mark(&mut self, grid: &CellGrid, [x, y]: [&[f32]; 2], density: &[f32], bound: f32) {
        let stride = grid.tile_columns();
        for (block, densities) in density.chunks(BLOCK).enumerate() {
            if !densities.iter().fold(false, |any, density| any | (*density > bound)) {
                continue;
            }
            for (k, _) in densities.iter().enumerate().filter(|(_, density)| **density > bound) {
                let tile = grid.tile(x[block * BLOCK + k], y[block * BLOCK + k]);
                if self.tiles[tile] == Tile::Dense {
                    continue;
                }
                for row in [tile - stride, tile, tile + stride] {
                    for near in &mut self.tiles[row - 1..=row + 1] {
                        *near = if *near == Tile::Calm { Tile::Near } else { *near };
                    }
                }
                self.tiles[tile] = Tile::Dense;
            }
        }
    }

    /// The lanes of a group in tiles that are not calm.
    fn lanes(&self, grid: &CellGrid, [x, y]: [&[f32]; 2], group: &Group) -> u16 {
        let own = group.particles();
        let tile = |i: usize| grid.tile(x[i], y[i]);
        let (first, last) = (tile(own.start), tile(own.end - 1));
        // Particles of one strip are sorted by column.
        let is_strip = first <= last && last - first < grid.tile_columns();
        let is_calm = |tile: &Tile| *tile == Tile::Calm;
        if is_strip && self.tiles[first..=last].iter().all(is_calm) {
            return 0;
        }
        if is_strip && !self.tiles[first..=last].iter().any(is_calm) {
            return ALL_LANES;
        }
        own.enumerate().fold(0, |lanes, (lane, i)| lanes | u16::from(!is_calm(&self.tiles[tile(i)])) << lane)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<Tile>() * self.tiles.capacity() + size_of::<Group>() * self.groups.capacity()
    }
}
