//! What the colours need to know of a place's surroundings: how deep the liquid is there, how deep inside rock it lies.

use crate::kernel::solids::Solids;
use glam::{IVec2, Vec2};

/// Depth at which half of the shading is reached, d.
const HALF_DEPTH: f32 = 22.0;
/// Edge of a cell of the depth map, d.
const DEPTH_CELL: f32 = 4.0;
/// A cell with fewer particles than this holds spray, not a body of liquid (full are `DEPTH_CELL`²).
const SPRAY: u32 = 8;
/// Columns to either side over which depth is averaged.
const REACH: usize = 2;

/// How much liquid stands above each place, on a coarse grid.
#[derive(Clone, Debug, Default)]
pub struct DepthMap {
    columns: usize,
    rows: usize,
    count: Vec<u32>,
    /// Liquid above the row that is measured, d, and whether the cell right above it holds a body of liquid.
    above: Vec<f32>,
    body: Vec<bool>,
    share: Vec<u8>,
}

impl DepthMap {
    /// Measures matter in a box of `size` d: places, each with how many particles are there. Reuses the memory of the last time.
    pub fn measure(&mut self, size: Vec2, matter: impl Iterator<Item = (Vec2, u32)>) {
        self.columns = ((size.x / DEPTH_CELL).ceil() as usize).max(1);
        self.rows = ((size.y / DEPTH_CELL).ceil() as usize).max(1);
        let cells = self.columns * self.rows;
        self.count.clear();
        self.count.resize(cells, 0);
        self.share.resize(cells, 0);
        for (at, particles) in matter {
            let column = ((at.x / DEPTH_CELL) as u32 as usize).min(self.columns - 1);
            let row = ((at.y / DEPTH_CELL) as u32 as usize).min(self.rows - 1);
            self.count[row * self.columns + column] += particles;
        }
        self.above.clear();
        self.above.resize(self.columns, 0.0);
        self.body.clear();
        self.body.resize(self.columns, false);
        for row in (0..self.rows).rev() {
            self.measure_row(row);
        }
    }

    /// Spray casts no shade. Neighbouring columns are averaged, so that the surface's noise doesn't stripe the water
    /// below it; only those with liquid, so that the water isn't lighter beside rock. The cell below a body of liquid,
    /// half full at its bottom, goes with it.
    fn measure_row(&mut self, row: usize) {
        let cells = row * self.columns..(row + 1) * self.columns;
        let (counts, shares) = (&self.count[cells.clone()], &mut self.share[cells]);
        for (column, share) in shares.iter_mut().enumerate() {
            let (mut sum, mut parts) = (0.0, 0.0);
            for k in column.saturating_sub(REACH)..(column + REACH + 1).min(counts.len()) {
                if counts[k] >= SPRAY || self.body[k] {
                    sum += self.above[k] + 0.5 * counts[k] as f32 / DEPTH_CELL;
                    parts += 1.0;
                }
            }
            let depth = if parts > 0.0 { sum / parts } else { 0.0 };
            *share = (255.0 * depth / (depth + HALF_DEPTH)) as u8;
        }
        for (column, &count) in counts.iter().enumerate() {
            self.body[column] = count >= SPRAY;
            self.above[column] += if count >= SPRAY { count as f32 / DEPTH_CELL } else { 0.0 };
        }
    }

    /// Columns and rows of the map.
    pub fn dimensions(&self) -> (usize, usize) {
        (self.columns, self.rows)
    }

    /// What the map covers, d: the box rounded up to whole cells.
    pub fn extent(&self) -> Vec2 {
        Vec2::new(self.columns as f32, self.rows as f32) * DEPTH_CELL
    }

    /// Depth shares of the cells, 0 … 255, row by row from the bottom.
    pub fn shares(&self) -> &[u8] {
        &self.share
    }

    /// Depth share at a point, 0 … 1, smooth between the cells.
    pub fn at(&self, point: Vec2) -> f32 {
        if self.share.is_empty() {
            return 0.0;
        }
        let p = (point / DEPTH_CELL - 0.5).max(Vec2::ZERO);
        let (column, row) = ((p.x as usize).min(self.columns - 1), (p.y as usize).min(self.rows - 1));
        let (right, up) = ((column + 1).min(self.columns - 1), (row + 1).min(self.rows - 1));
        let t = (p - Vec2::new(column as f32, row as f32)).clamp(Vec2::ZERO, Vec2::ONE);
        let value = |c: usize, r: usize| f32::from(self.share[r * self.columns + c]) / 255.0;
        let low = value(column, row) * (1.0 - t.x) + value(right, row) * t.x;
        let high = value(column, up) * (1.0 - t.x) + value(right, up) * t.x;
        low * (1.0 - t.y) + high * t.y
    }
}

/// Distance from the rock's surface at which it is as dark as it gets, cells.
const CORE: u8 = 14;

/// Binary digits of [`CORE`].
const DIGITS: usize = (u8::BITS - CORE.leading_zeros()) as usize;
/// Cells that are looked at together.
const WORD: usize = u64::BITS as usize;

/// How far inside rock each cell lies. The walls of the box count as rock.
#[derive(Clone, Debug, Default)]
pub struct BurialMap {
    /// Words of a row: a bit for each cell.
    words: usize,
    /// Steps to the nearest open cell, at most [`CORE`], as binary digits, the lowest first; a straight step counts 1, a diagonal one
    /// too.
    steps: [Vec<u64>; DIGITS],
    /// Rock that is further in than the steps counted so far, and of that what has more of it on both sides.
    inner: Vec<u64>,
    flanked: Vec<u64>,
}

impl BurialMap {
    /// Measures the rock; reuses the memory of the last time.
    pub fn measure(&mut self, solids: &Solids) {
        let columns = solids.columns() as usize;
        self.words = columns.div_ceil(WORD);
        let all = self.words * solids.rows() as usize;
        for bits in self.steps.iter_mut().chain([&mut self.inner, &mut self.flanked]) {
            bits.clear();
            bits.resize(all, 0);
        }
        solids.iter().for_each(|(cell, ..)| {
            let column = cell.x as usize;
            self.inner[cell.y as usize * self.words + column / WORD] |= 1 << (column % WORD);
        });
        // What is beyond the last column is the wall's.
        if !columns.is_multiple_of(WORD) {
            let beyond = u64::MAX << (columns % WORD);
            self.inner.chunks_exact_mut(self.words).for_each(|row| row[self.words - 1] |= beyond);
        }
        for step in 1..=CORE {
            self.count();
            if step < CORE {
                self.peel();
            }
        }
    }

    /// Counts a step more for all that is further in.
    fn count(&mut self) {
        for (k, inner) in self.inner.iter().enumerate() {
            let mut carry = *inner;
            for digit in &mut self.steps {
                let sum = digit[k] ^ carry;
                carry &= digit[k];
                digit[k] = sum;
            }
        }
    }

    /// Takes away what has an open cell among the eight around it.
    fn peel(&mut self) {
        let words = self.words.max(1);
        for (row, flanked) in self.inner.chunks_exact(words).zip(self.flanked.chunks_exact_mut(words)) {
            for (k, flanked) in flanked.iter_mut().enumerate() {
                let beside = |k: Option<usize>| k.and_then(|k| row.get(k)).copied().unwrap_or(u64::MAX);
                let (left, right) = (beside(k.checked_sub(1)), beside(Some(k + 1)));
                let own = row[k];
                *flanked = own & (own << 1 | left >> (WORD - 1)) & (own >> 1 | right << (WORD - 1));
            }
        }
        let row = |y: usize| self.flanked.chunks_exact(words).nth(y);
        for (y, inner) in self.inner.chunks_exact_mut(words).enumerate() {
            let Some(own) = row(y) else { continue };
            let (below, above) = (y.checked_sub(1).and_then(row).unwrap_or(own), row(y + 1).unwrap_or(own));
            for (inner, ((below, own), above)) in inner.iter_mut().zip(below.iter().zip(own).zip(above)) {
                *inner = below & own & above;
            }
        }
    }

    /// Steps to the nearest open cell: 0 in one, else 1 and more, [`CORE`] deep inside.
    pub fn steps(&self, cell: IVec2) -> u8 {
        let (column, row) = (cell.x as usize, cell.y as usize);
        let digit =
            |bits: &Vec<u64>| bits.get(row * self.words + column / WORD).map_or(0, |word| word >> (column % WORD));
        self.steps.iter().rev().fold(0, |steps, bits| 2 * steps + (digit(bits) & 1) as u8)
    }

    /// How far inside the cell lies: 0 at the surface, 1 deep inside.
    pub fn at(&self, cell: IVec2) -> f32 {
        f32::from(self.steps(cell).max(1) - 1) / f32::from(CORE - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::element::ElementId;

    #[test]
    fn depth_grows_downwards_and_is_zero_in_empty_air() {
        let particles = (0..40).flat_map(|row| (0..40).map(move |column| Vec2::new(column as f32, row as f32) + 0.5));
        let mut map = DepthMap::default();
        map.measure(Vec2::new(40.0, 80.0), particles.map(|at| (at, 1)));
        let (deep, shallow, air) =
            (map.at(Vec2::new(20.0, 2.0)), map.at(Vec2::new(20.0, 36.0)), map.at(Vec2::new(20.0, 70.0)));
        assert!(deep > shallow + 0.3 && shallow > air, "{deep} {shallow} {air}");
        assert_eq!(air, 0.0);
    }

    #[test]
    fn rock_is_buried_deeper_further_from_open_cells_but_not_at_walls() {
        let mut solids = Solids::new(40, 40);
        for y in 0..30 {
            for x in 0..40 {
                solids.insert(IVec2::new(x, y), ElementId(0), (y * 40 + x) as u32);
            }
        }
        let mut map = BurialMap::default();
        map.measure(&solids);
        let at = |x, y| map.at(IVec2::new(x, y));
        assert_eq!(at(20, 29), 0.0);
        assert!(at(20, 25) > at(20, 27) && at(20, 27) > at(20, 29));
        assert_eq!(at(20, 0), 1.0);
        assert_eq!(at(0, 29), 0.0);
        assert_eq!(at(0, 0), 1.0, "the wall is no surface");
    }

    #[test]
    fn the_steps_out_of_rock_are_those_to_the_nearest_open_cell() {
        // Widths on both sides of a word, and one of whole words.
        for (columns, rows, holes) in [(1, 1, 0), (63, 9, 1), (64, 40, 2), (70, 33, 3), (130, 40, 5)] {
            let is_open = |cell: IVec2| {
                (1..=holes).any(|k| cell == IVec2::new(37 * k % columns, 23 * k % rows)) || (holes > 2 && cell.x < 2)
            };
            let cells = || (0..rows).flat_map(|y| (0..columns).map(move |x| IVec2::new(x, y)));
            let mut solids = Solids::new(columns as u32, rows as u32);
            for cell in cells().filter(|cell| !is_open(*cell)) {
                solids.insert(cell, ElementId(0), 0);
            }
            let mut map = BurialMap::default();
            map.measure(&solids);
            for cell in cells() {
                let steps = |open: IVec2| (open - cell).abs().max_element() as u8;
                let nearest = cells().filter(|cell| is_open(*cell)).map(steps).min().unwrap_or(CORE);
                assert_eq!(map.steps(cell), nearest.min(CORE), "{cell} of {columns} × {rows}");
            }
        }
    }
}
