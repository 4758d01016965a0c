//! Where rock stood when something was last made of it, so that what follows from rock is made anew only near what changed.

use crate::solids::{STRIDE, Solids};
use std::ops::Range;

/// Bits of a word.
const BITS: usize = u64::BITS as usize;
const _: () = assert!(BITS.is_multiple_of(STRIDE), "a stride is in one word");

/// Sites with rock, a bit each.
#[derive(Clone, Debug, Default)]
pub(super) struct Outline {
    columns: i32,
    rows: i32,
    /// Words of rows, from the lowest; empty without rock.
    words: Vec<u64>,
}

impl Outline {
    /// Follows the rock, and gives the columns and rows of sites from the first to the last that changed. Of another box all did.
    pub fn follow(&mut self, solids: &Solids) -> Option<[Range<i32>; 2]> {
        let all = [0..solids.columns(), 0..solids.rows()];
        let before = std::mem::take(self);
        *self = Self::new(solids);
        if (before.columns, before.rows) != (self.columns, self.rows) {
            return Some(all);
        }
        let per_row = self.per_row();
        let word = |words: &[u64], k: usize| words.get(k).copied().unwrap_or_default();
        let mut changed: Option<[Range<i32>; 2]> = None;
        for k in 0..self.words.len().max(before.words.len()) {
            let bits = word(&self.words, k) ^ word(&before.words, k);
            if bits == 0 {
                continue;
            }
            let (row, first) = ((k / per_row) as i32, (k % per_row * BITS) as i32);
            let columns = first + bits.trailing_zeros() as i32..first + (BITS as u32 - bits.leading_zeros()) as i32;
            let [across, up] = changed.unwrap_or([columns.clone(), row..row]);
            changed = Some([across.start.min(columns.start)..across.end.max(columns.end), up.start..row + 1]);
        }
        changed
    }

    fn new(solids: &Solids) -> Self {
        let mut outline = Self { columns: solids.columns(), rows: solids.rows(), words: Vec::new() };
        if solids.count() == 0 {
            return outline;
        }
        let per_row = outline.per_row();
        outline.words.resize(per_row * outline.rows.max(0) as usize, 0);
        solids.strides().for_each(|stride| {
            let (column, row) = (stride.first.x as usize, stride.first.y as usize);
            let rock = stride.sites().fold(0, |bits, (k, element)| bits | u64::from(element.is_some()) << k);
            outline.words[row * per_row + column / BITS] |= rock << (column % BITS);
        });
        outline
    }

    /// Words of a row.
    fn per_row(&self) -> usize {
        (self.columns.max(1) as usize).div_ceil(BITS)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<u64>() * self.words.capacity()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::ElementId;
    use glam::IVec2;

    #[test]
    fn what_changed_is_found_from_the_first_to_the_last() {
        let mut solids = Solids::new(150, 40);
        let mut outline = Outline::default();
        assert_eq!(outline.follow(&solids), Some([0..150, 0..40]), "all of a new box");
        assert_eq!((outline.follow(&solids), outline.memory()), (None, 0));
        let cells = [(149, 39), (70, 3), (64, 3), (63, 20), (0, 0)].map(|(x, y)| IVec2::new(x, y));
        for (id, cell) in (0..).zip(cells) {
            assert!(solids.insert(cell, ElementId(0), id));
            assert_eq!(outline.follow(&solids), Some([cell.x..cell.x + 1, cell.y..cell.y + 1]));
        }
        solids.replace(cells[0], ElementId(3));
        assert_eq!(outline.follow(&solids), None, "another element in the same place");
        cells[1..4].iter().for_each(|cell| assert!(solids.remove(*cell)));
        assert_eq!(outline.follow(&solids), Some([63..71, 3..21]));
        [cells[0], cells[4]].iter().for_each(|cell| assert!(solids.remove(*cell)));
        assert_eq!(outline.follow(&solids), Some([0..150, 0..40]));
        assert_eq!(outline.memory(), 0);
    }
}
