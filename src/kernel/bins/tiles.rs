//! Marks on tiles, a bit for each.

use crate::{bins::cells::CellGrid, parallel::Rows};
use std::ops::Range;

/// Bits of a word.
const BITS: usize = u64::BITS as usize;

/// Which tiles are marked, row by row.
#[derive(Clone, Debug, Default)]
pub(super) struct Tiles {
    /// Words of a row. The last is spare, so that two can be read from any tile on.
    words: usize,
    bits: Vec<u64>,
}

impl Tiles {
    /// Fits them to a grid, and takes the marks away in some rows.
    pub fn clear(&mut self, grid: &CellGrid, rows: Range<usize>) {
        self.words = grid.tile_columns().div_ceil(BITS) + 1;
        self.bits.resize(self.words * grid.rows, 0);
        self.bits[rows.start * self.words..rows.end * self.words].fill(0);
    }

    /// Some rows, to be marked in ([`mark`]).
    pub fn rows(&mut self, rows: &Range<usize>) -> Rows<'_, u64> {
        Rows::new(&mut self.bits, self.words, rows)
    }

    /// Marks in some rows what is marked in another one's, or beside that. The first and the last tile of a row must not be.
    pub fn widen(&mut self, other: &Self, rows: Range<usize>) {
        let words = self.words;
        for row in rows {
            let three =
                |word: usize| [row - 1, row, row + 1].iter().fold(0, |any, row| any | other.bits[row * words + word]);
            let (mut before, mut own) = (0, three(0));
            for word in 0..words - 1 {
                let after = three(word + 1);
                self.bits[row * words + word] = own | own << 1 | own >> 1 | before >> (BITS - 1) | after << (BITS - 1);
                (before, own) = (own, after);
            }
        }
    }

    /// The marks of a row from a tile's on, in the order of the bits.
    #[inline(always)]
    pub fn from(&self, row: usize, column: usize) -> u64 {
        let (word, bit) = (row * self.words + column / BITS, column % BITS);
        // A shift by all bits is none.
        self.bits[word] >> bit | self.bits[word + 1] << 1 << (BITS - 1 - bit)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<u64>() * self.bits.capacity()
    }
}

/// Marks a tile of a row.
#[inline(always)]
pub(super) fn mark(row: &mut [u64], column: usize) {
    row[column / BITS] |= 1 << (column % BITS);
}
