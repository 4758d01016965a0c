//! Where there is liquid, or grains, piece by piece of each row: sweeps over the pressure equation leave out what is dry, so that
//! water in the corners of a wide box, or in thin sheets, costs what it is and not what it spans, and those of friction what is
//! far from grains.

use std::ops::Range;

/// Columns of a piece on the finest level: as many as the lanes of sums, which begin anew in each.
pub(super) const PIECE: usize = 16;

/// Columns of a piece on the coarsest levels: pairs of columns are one on the next.
const PAIR: usize = 2;

/// Rows on either side of a piece in which what sweeps read has to be 0: a pair of rows is restricted as one, and each is multiplied
/// with those around it.
const ROWS_AROUND: usize = 2;

/// Bits of a word.
const BITS: usize = u64::BITS as usize;

/// Which pieces of a level's rows have liquid, or whatever else is looked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Pieces {
    /// Columns of a piece.
    piece: usize,
    /// Columns of the level.
    columns: usize,
    /// Rows from the first to the last with liquid.
    rows: Range<usize>,
    /// Words of a row.
    words: usize,
    /// A bit for each piece of each row, the first piece in the lowest.
    bits: Vec<u64>,
    /// Cells in wet pieces, for each row on the mean.
    per_row: usize,
}

impl Pieces {
    /// None yet, of the finest level of a grid or, for `depth` > 0, of a coarser one, with so many columns and rows of cells.
    pub fn new(columns: usize, rows: usize, depth: usize) -> Self {
        let piece = (PIECE >> depth.min(PIECE.ilog2() as usize)).max(PAIR);
        let words = columns.div_ceil(piece).div_ceil(BITS);
        Self { piece, columns, rows: 1..1, words, bits: vec![0; words * (rows + 3)], per_row: 0 }
    }

    /// Rows from the first to the last with liquid.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// Cells in wet pieces of a row, on the mean.
    pub fn per_row(&self) -> usize {
        self.per_row
    }

    /// Finds them where cells are marked in `liquid`, rows of `stride` of them, within these rows and columns. A piece has to begin
    /// with the first of the columns.
    pub fn find(&mut self, liquid: &[f32], stride: usize, rows: Range<usize>, columns: Range<usize>) {
        self.find_by(rows, columns, |row, columns| {
            let cells = &liquid[row * stride..][columns];
            cells.iter().fold(0, |any, cell| any | cell.to_bits()) != 0
        });
    }

    /// Finds those of the finest level's rows and columns of which `is_one` says that they are: it is asked with a row and a piece's
    /// columns. A piece has to begin with the first of the columns.
    #[inline(always)]
    pub fn find_by(&mut self, rows: Range<usize>, columns: Range<usize>, is_one: impl Fn(usize, Range<usize>) -> bool) {
        self.bits.fill(0);
        let first = (columns.start - 1) / PIECE;
        for row in rows.clone() {
            let bits = &mut self.bits[row * self.words..(row + 1) * self.words];
            for (piece, start) in (first..).zip(columns.clone().step_by(PIECE)) {
                let any = is_one(row, start..(start + PIECE).min(columns.end));
                bits[piece / BITS] |= u64::from(any) << (piece % BITS);
            }
        }
        self.bound(rows);
    }

    /// Makes it those pieces of the same columns that another has in a row or in up to `reach` rows below and above it.
    pub fn widen(&mut self, other: &Self, reach: usize) {
        self.bits.fill(0);
        let words = self.words;
        let last = self.bits.len() / words;
        let rows = other.rows.start.saturating_sub(reach)..(other.rows.end + reach).min(last);
        for row in other.rows.clone() {
            for near in row.saturating_sub(reach)..(row + reach + 1).min(last) {
                for (bits, more) in self.bits[near * words..(near + 1) * words].iter_mut().zip(other.of(row)) {
                    *bits |= more;
                }
            }
        }
        self.bound(rows);
    }

    /// Makes it all pieces of all rows.
    pub fn fill(&mut self) {
        self.bits.fill(0);
        for piece in 0..self.columns.div_ceil(self.piece) {
            self.bits.iter_mut().skip(piece / BITS).step_by(self.words).for_each(|word| *word |= 1 << (piece % BITS));
        }
        self.bound(0..self.bits.len() / self.words);
    }

    /// Shows `visit` the pieces that another of the same rows has not: row and columns.
    pub fn without(&self, other: &Self, mut visit: impl FnMut(usize, Range<usize>)) {
        for row in self.rows.clone() {
            let bits = |k: usize| self.of(row)[k] & !other.of(row)[k];
            for pieces in (RunsOf { bits, words: self.words, at: 0 }) {
                visit(row, self.columns_of(pieces));
            }
        }
    }

    /// Whether the piece of a column, one beside it or one above these is among them.
    pub fn is_near(&self, row: usize, column: usize) -> bool {
        let piece = (column - 1) / self.piece;
        let has = |row: usize, piece: usize| {
            self.of(row).get(piece / BITS).is_some_and(|word| word >> (piece % BITS) & 1 != 0)
        };
        (row..row + 2).any(|row| (piece.saturating_sub(1)..piece + 2).any(|piece| has(row, piece)))
    }

    /// Finds the first and the last of these rows that has any.
    fn bound(&mut self, rows: Range<usize>) {
        let has_any = |row: &usize| self.of(*row).iter().any(|word| *word != 0);
        let (first, last) = (rows.clone().find(has_any), rows.rev().find(has_any));
        self.rows = first.zip(last).map_or(1..1, |(first, last)| first..last + 1);
        self.count();
    }

    /// Columns of the finest level from the first wet piece to the last.
    pub fn columns(&self) -> Range<usize> {
        let ends = |row: usize| self.runs(row).reduce(|all, run| all.start..run.end);
        let all = self.rows.clone().filter_map(ends);
        all.reduce(|all, of| all.start.min(of.start)..all.end.max(of.end)).unwrap_or(1..1)
    }

    /// A coarse piece is wet where any that it is made of is.
    pub fn coarsen(&mut self, fine: &Self) {
        let rows = fine.rows.start.div_ceil(2)..fine.rows.end / 2 + 1;
        let (words, merges) = (self.words, self.piece == fine.piece);
        self.bits.fill(0);
        for row in rows.clone() {
            for below in [2 * row - 1, 2 * row] {
                for (k, word) in fine.of(below).iter().enumerate() {
                    if merges {
                        let mut left = *word;
                        while left != 0 {
                            let piece = (k * BITS + left.trailing_zeros() as usize) / 2;
                            self.bits[row * words + piece / BITS] |= 1 << (piece % BITS);
                            left &= left - 1;
                        }
                    } else {
                        self.bits[row * words + k] |= word;
                    }
                }
            }
        }
        self.rows = if fine.rows.is_empty() { 1..1 } else { rows };
        self.count();
    }

    fn count(&mut self) {
        let cells: usize = self.rows.clone().flat_map(|row| self.runs(row)).map(|run| run.len()).sum();
        self.per_row = cells.div_ceil(self.rows.len().max(1));
    }

    fn of(&self, row: usize) -> &[u64] {
        self.bits.get(row * self.words..(row + 1) * self.words).unwrap_or_default()
    }

    /// The columns of a row that are in wet pieces, as runs of pieces side by side.
    #[inline(always)]
    pub fn runs(&self, row: usize) -> impl Iterator<Item = Range<usize>> + use<'_> {
        let bits = &self.bits[row * self.words..(row + 1) * self.words];
        RunsOf { bits: |k: usize| bits[k], words: self.words, at: 0 }.map(|pieces| self.columns_of(pieces))
    }

    /// The columns of some pieces.
    #[inline(always)]
    fn columns_of(&self, pieces: Range<usize>) -> Range<usize> {
        1 + pieces.start * self.piece..1 + (pieces.end * self.piece).min(self.columns)
    }

    /// Rows with liquid, and those around them that sweeps read.
    pub fn rows_around(&self) -> Range<usize> {
        let all = self.bits.len() / self.words;
        self.rows.start.saturating_sub(ROWS_AROUND)..(self.rows.end + ROWS_AROUND).min(all)
    }

    /// Shows `visit` what is dry of the rows around wet pieces and reaches no further than sweeps read: row and columns, with the
    /// padding.
    pub fn around(&self, mut visit: impl FnMut(usize, Range<usize>)) {
        if self.rows.is_empty() {
            return;
        }
        // Of two that are one on the next level, the other is read to its end, and a column more.
        let beyond = if self.piece == PAIR { 2 } else { 1 };
        for row in self.rows_around() {
            let near = row.saturating_sub(ROWS_AROUND)..row + ROWS_AROUND + 1;
            let any = |k: usize| near.clone().fold(0, |any, row| any | self.of(row).get(k).copied().unwrap_or(0));
            let dry = |k: usize| {
                let (own, before, after) = (any(k), if k > 0 { any(k - 1) } else { 0 }, any(k + 1));
                let beside = |n: usize| own << n | before >> (BITS - n) | own >> n | after << (BITS - n);
                (1..=beyond).fold(own, |all, n| all | beside(n)) & !self.of(row)[k]
            };
            for pieces in (RunsOf { bits: dry, words: self.words, at: 0 }) {
                let columns = self.columns_of(pieces);
                if columns.is_empty() {
                    continue;
                }
                // The padding beside the first and the last column is read, too.
                let start = if columns.start == 1 { 0 } else { columns.start };
                visit(row, start..columns.end + usize::from(columns.end == self.columns + 1));
            }
        }
    }

    /// Sets what is read around wet pieces to 0 in a field of rows of `stride` cells.
    pub fn clear_around(&self, field: &mut [f32], stride: usize) {
        self.around(|row, columns| field[row * stride + columns.start..row * stride + columns.end].fill(0.0));
    }

    /// `a · b` over the wet pieces of a row of the finest level, with a fixed order of sums.
    #[inline(always)]
    pub fn dot(&self, row: usize, a: &[f32], b: &[f32]) -> f64 {
        let mut lanes = [0.0_f32; PIECE];
        let whole = self.columns / PIECE;
        let is_wet = |piece: usize| self.bits[row * self.words + piece / BITS] >> (piece % BITS) & 1 != 0;
        // The last piece may be shorter; what it lacks counts for nothing.
        if !self.columns.is_multiple_of(PIECE) && is_wet(whole) {
            let rest = 1 + whole * PIECE..1 + self.columns;
            for (lane, (a, b)) in lanes.iter_mut().zip(a[rest.clone()].iter().zip(&b[rest])) {
                *lane = a * b;
            }
        }
        for run in self.runs(row) {
            let (a, b) = (a[run.clone()].as_chunks::<PIECE>().0, b[run].as_chunks::<PIECE>().0);
            for (a, b) in a.iter().zip(b) {
                for lane in 0..PIECE {
                    lanes[lane] += a[lane] * b[lane];
                }
            }
        }
        let [mut eight, mut four] = [[0.0_f32; 8], [0.0; 8]];
        for lane in 0..8 {
            eight[lane] = lanes[lane] + lanes[lane + 8];
        }
        for lane in 0..4 {
            four[lane] = eight[lane] + eight[lane + 4];
        }
        f64::from((four[0] + four[2]) + (four[1] + four[3]))
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<u64>() * self.bits.capacity()
    }
}

/// Runs of set bits, as numbers of the first and behind the last.
struct RunsOf<F> {
    bits: F,
    words: usize,
    at: usize,
}

impl<F: Fn(usize) -> u64> Iterator for RunsOf<F> {
    type Item = Range<usize>;

    #[inline(always)]
    fn next(&mut self) -> Option<Range<usize>> {
        let first = self.next_bit(0)?;
        self.at = first;
        let end = self.next_bit(u64::MAX).unwrap_or(self.words * BITS);
        self.at = end;
        Some(first..end)
    }
}

impl<F: Fn(usize) -> u64> RunsOf<F> {
    /// The next bit that is set, or that is not with all bits `turned`.
    #[inline(always)]
    fn next_bit(&self, turned: u64) -> Option<usize> {
        let mut k = self.at / BITS;
        let mut left = if k < self.words { ((self.bits)(k) ^ turned) & (u64::MAX << (self.at % BITS)) } else { 0 };
        while left == 0 {
            k += 1;
            if k >= self.words {
                return None;
            }
            left = (self.bits)(k) ^ turned;
        }
        Some(k * BITS + left.trailing_zeros() as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use std::collections::BTreeSet;

    type Cells = BTreeSet<(usize, usize)>;

    /// Wet cells, by the definition: all of a piece of which one is marked.
    fn pieces(marked: &Cells, piece: usize, columns: usize) -> Cells {
        let of = |column: usize| (column - 1) / piece * piece + 1;
        let all = marked.iter().flat_map(|(row, column)| (of(*column)..of(*column) + piece).map(|at| (*row, at)));
        all.filter(|(_, column)| *column <= columns).collect()
    }

    fn wet_cells(wet: &Pieces) -> Cells {
        wet.rows().flat_map(|row| wet.runs(row).flatten().map(move |column| (row, column))).collect()
    }

    #[test]
    fn wet_pieces_and_what_is_read_around_them_are_those_of_the_definition() {
        let mut random = Random::new(5);
        for (columns, rows, drops) in [(1, 1, 1), (37, 9, 3), (1024, 12, 20), (1025, 12, 40), (2600, 7, 200)] {
            let stride = columns + 2;
            let drop = |random: &mut Random| (1 + random.below(rows), 1 + random.below(columns));
            let mut marked: Cells = (0..drops).map(|_| drop(&mut random)).collect();
            let mut liquid = vec![0.0; stride * (rows + 3)];
            marked.iter().for_each(|(row, column)| liquid[row * stride + column] = 1.0);
            let mut wet = Pieces::new(columns, rows, 0);
            wet.find(&liquid, stride, 1..rows + 1, 1..columns + 1);
            let (mut columns, mut rows) = (columns, rows);
            for depth in 0..7 {
                let expected = pieces(&marked, [16, 8, 4, 2, 2, 2, 2][depth], columns);
                assert_eq!(wet_cells(&wet), expected, "depth {depth} of {columns} columns");
                let mut around = Cells::new();
                wet.around(|row, columns| around.extend(columns.map(|column| (row, column))));
                assert!(around.is_disjoint(&expected), "depth {depth}: what is wet is cleared");
                // At least the rows and columns beside a cell, and on the coarsest those of the other of its pair, too.
                let reach = if depth < 3 { 1 } else { 3 };
                for (row, column) in &expected {
                    for row in row - 1..=row + 1 {
                        for column in column.saturating_sub(reach).max(1)..=(column + reach).min(columns) {
                            let at = (row, column);
                            assert!(
                                around.contains(&at) || expected.contains(&at),
                                "depth {depth}: {at:?} is not cleared"
                            );
                        }
                    }
                }
                let mut coarse = Pieces::new(columns.div_ceil(2), rows.div_ceil(2), depth + 1);
                coarse.coarsen(&wet);
                marked =
                    wet_cells(&wet).into_iter().map(|(row, column)| (row.div_ceil(2), column.div_ceil(2))).collect();
                (wet, columns, rows) = (coarse, columns.div_ceil(2), rows.div_ceil(2));
            }
        }
    }

    #[test]
    fn pieces_near_others_and_those_left_are_those_of_the_definition() {
        let mut random = Random::new(7);
        for (columns, rows, count, reach) in [(1, 1, 1, 4), (37, 9, 3, 1), (1040, 30, 12, 4), (2600, 20, 200, 3)] {
            let mut find = || {
                let marked: Cells = (0..count).map(|_| (1 + random.below(rows), 1 + random.below(columns))).collect();
                let mut found = Pieces::new(columns, rows, 0);
                let is_marked = |row: usize, of: Range<usize>| of.into_iter().any(|at| marked.contains(&(row, at)));
                found.find_by(1..rows + 1, 1..columns + 1, is_marked);
                (found, marked)
            };
            let (found, marked) = find();
            let own = pieces(&marked, 16, columns);
            assert_eq!(wet_cells(&found), own);
            let mut wide = Pieces::new(columns, rows, 0);
            wide.widen(&found, reach);
            let near = |row: usize| row.saturating_sub(reach)..(row + reach + 1).min(rows + 3);
            let expected: Cells = own.iter().flat_map(|(row, column)| near(*row).map(|row| (row, *column))).collect();
            assert_eq!(wet_cells(&wide), expected);
            let ([other, _], mut left) = ([find().0, wide.clone()], Cells::new());
            wide.without(&other, |row, run| left.extend(run.map(|column| (row, column))));
            assert_eq!(left, expected.difference(&wet_cells(&other)).copied().collect());
            for (row, column) in (0..rows + 3).flat_map(|row| (1..columns + 1).step_by(16).map(move |at| (row, at))) {
                let is_near = |(r, c): &(usize, usize)| {
                    (row..row + 2).contains(r)
                        && (column - 1) / 16 <= (c - 1) / 16 + 1
                        && (c - 1) / 16 <= (column - 1) / 16 + 1
                };
                assert_eq!(found.is_near(row, column), own.iter().any(is_near), "{row}, {column}");
            }
            wide.fill();
            assert_eq!(wet_cells(&wide).len(), columns * (rows + 3));
        }
    }

    #[test]
    fn a_sum_over_wet_pieces_is_that_over_all_to_the_bit() {
        let (columns, stride) = (1030, 1032);
        let mut random = Random::new(9);
        let mut a: Vec<f32> = (0..3 * stride).map(|_| random.offset()).collect();
        let is_drop = |k: usize| (k % stride) % 100 < 7 && (1..=columns).contains(&(k % stride));
        a.iter_mut().enumerate().for_each(|(k, a)| *a = if is_drop(k) { *a } else { 0.0 });
        let sum = |liquid: &[f32]| {
            let mut wet = Pieces::new(columns, 1, 0);
            wet.find(liquid, stride, 1..2, 1..columns + 1);
            wet.dot(1, &a[stride..2 * stride], &a[stride..2 * stride])
        };
        let some = sum(&a);
        assert_eq!(some.to_bits(), sum(&vec![1.0; a.len()]).to_bits());
        let exact: f64 = a[stride..2 * stride].iter().map(|a| f64::from(*a) * f64::from(*a)).sum();
        assert!((some - exact).abs() < 1e-6 * exact, "{some} and {exact}");
    }
}
