//! Geometry of the cells.

use crate::simd::whole_below;
use glam::Vec2;
use std::ops::Range;

/// Columns in a strip's height: thin columns keep candidate runs short.
const COLUMNS_PER_RADIUS: u32 = 3;
/// Columns of a tile, which so is as wide as it is high.
const COLUMNS_PER_TILE: u32 = COLUMNS_PER_RADIUS;

/// Strips as high as the search reaches, cut into thin columns: one empty strip below and one above the box. Strips, columns
/// and tiles stand symmetrically about the middle of the box, so that what is decided by them is mirrored where the world
/// is: they overhang the box by as much on either side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct CellGrid {
    /// Size of the box, d.
    pub size: Vec2,
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// Height of a strip, d.
    pub reach: f32,
    per_column: f32,
    per_row: f32,
    /// How far they overhang the box on either side: columns along x, strips along y.
    over: Vec2,
}

impl CellGrid {
    /// Cells over a box of `size` d for a search that reaches `reach` d far.
    pub fn new(size: Vec2, reach: f32) -> Self {
        let column = reach / COLUMNS_PER_RADIUS as f32;
        let columns = ((size.x / column) as usize + 1).next_multiple_of(COLUMNS_PER_TILE as usize);
        let strips = (size.y / reach) as usize + 1;
        let over = Vec2::new(columns as f32 - size.x / column, strips as f32 - size.y / reach) / 2.0;
        Self { size, columns, rows: strips + 2, reach, per_column: 1.0 / column, per_row: 1.0 / reach, over }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.columns * self.rows
    }

    /// Area of a cell, d².
    pub fn cell_area(&self) -> f32 {
        self.reach * self.reach / COLUMNS_PER_RADIUS as f32
    }

    /// Column of a coordinate, d. It never falls where x rises.
    #[inline(always)]
    pub fn column(&self, x: f32) -> u32 {
        whole_below(x * self.per_column + self.over.x, 0, self.columns as u32 - 1).0
    }

    /// Cell of a point, d.
    #[inline(always)]
    pub fn cell(&self, x: f32, y: f32) -> u32 {
        self.strip(y) as u32 * self.columns as u32 + self.column(x)
    }

    /// Strip of a coordinate, d: a row of cells, and of tiles.
    #[inline(always)]
    pub fn strip(&self, y: f32) -> usize {
        whole_below(y * self.per_row + (1.0 + self.over.y), 1, self.rows as u32 - 2).0 as usize
    }

    /// Tiles along x, a strip high and as wide, of which the first and the last are empty.
    pub fn tile_columns(&self) -> usize {
        self.columns.div_ceil(COLUMNS_PER_TILE as usize) + 2
    }

    /// Column of tiles of a coordinate, d.
    #[inline(always)]
    pub fn tile_column(&self, x: f32) -> usize {
        (self.column(x) / COLUMNS_PER_TILE) as usize + 1
    }

    /// Columns that hold everything within reach of what is in the columns `first … last`: rounding may put a particle
    /// into the column beside its own, for which the reach has an allowance.
    #[inline(always)]
    pub fn columns_around(&self, first: u32, last: u32) -> Range<usize> {
        let end = last + COLUMNS_PER_RADIUS + 1;
        first.saturating_sub(COLUMNS_PER_RADIUS) as usize..(end as usize).min(self.columns)
    }

    /// Columns that hold everything within reach of what is between `low` and `high`, d along x.
    pub fn columns_near(&self, [low, high]: [f32; 2]) -> Range<usize> {
        if low > high { 0..0 } else { self.columns_around(self.column(low), self.column(high)) }
    }

    /// Columns that `radii` of the search are wide.
    pub fn columns_of(radii: u32) -> u32 {
        radii * COLUMNS_PER_RADIUS
    }

    /// Whether what is in the strip `row` may be within reach of the bottom or the top of the box.
    pub fn is_near_floor_or_top(&self, row: usize) -> bool {
        // The strip reaches from `bottom` to one reach above it.
        let bottom = (row as f32 - 1.0 - self.over.y) * self.reach;
        bottom < self.reach || bottom + 2.0 * self.reach > self.size.y
    }

    /// Whether what is in the columns `first … last` may be within reach of the left or the right side of the box.
    #[inline(always)]
    pub fn is_near_side(&self, first: u32, last: u32) -> bool {
        let near = COLUMNS_PER_RADIUS + self.over.x.ceil() as u32;
        first <= near || self.columns as u32 - 1 - last <= near
    }
}
