//! Where rock stands that exchanges heat: on the sites of its lattice, so that what is near a site stands at fixed distances.
//!
//! Of rows of sites only pieces are kept that are needed. Those that follow each other in a row do so here, too, with a blank one
//! before and one behind them: what is up to [`REACHED`] sites before or behind a site stands as far before or behind it here,
//! and of the rows below and above it one only has to know where the piece of the same columns stands.

use crate::{simd::MOST_LANES, solids};
use glam::IVec2;

/// Sites of a piece.
pub(super) const PIECE: usize = solids::STRIDE;
const _: () = assert!(PIECE == MOST_LANES, "a piece fills the lanes");

/// Sites along a row or a column that a site reaches: as many as [`REACH`](super::weights::REACH) has.
pub(super) const REACHED: usize = 2;
/// Rows that a site reaches, its own among them.
pub(super) const ROWS: usize = 2 * REACHED + 1;

/// The place of what is far from rock; what stands beside it is blank, too.
const BLANK: u32 = 1;

/// The pieces that are kept, by their places.
#[derive(Clone, Debug, Default)]
pub(super) struct Sites {
    /// Pieces of a row, with one before and one behind the box.
    stride: usize,
    /// Where each piece of all rows is kept, with [`REACHED`] rows below and above the box.
    places: Vec<u32>,
    /// What is kept: places in `places`, 0 for what is blank.
    kept: Vec<u32>,
}

impl Sites {
    /// Keeps nothing of a box of so many columns and rows.
    pub fn clear(&mut self, columns: i32, rows: i32) {
        self.stride = (columns.max(0) as usize).div_ceil(PIECE) + 2;
        self.places.clear();
        self.places.resize(self.stride * (rows.max(0) as usize + 2 * REACHED), BLANK);
        self.kept.clear();
    }

    /// Number of sites that are kept.
    pub fn len(&self) -> usize {
        PIECE * self.kept.len()
    }

    /// Keeps the piece that begins with a site, which comes behind all others row by row, and gives the place of that.
    pub fn keep(&mut self, first: IVec2) -> usize {
        let piece = (first.y as usize + REACHED) * self.stride + 1 + first.x as usize / PIECE;
        if self.kept.is_empty() {
            self.kept.resize(BLANK as usize + 1, 0);
        }
        let behind = self.kept.last().map_or(0, |last| if *last == 0 { 0 } else { *last as usize + 1 });
        if behind != piece {
            self.end_run();
            let before = self.places[piece - 1];
            if before == BLANK {
                self.blank(piece - 1);
            }
        }
        self.places[piece] = self.kept.len() as u32;
        self.kept.push(piece as u32);
        PIECE * (self.kept.len() - 1)
    }

    /// Ends what is kept.
    pub fn end(&mut self) {
        self.end_run();
        if !self.kept.is_empty() {
            // What is beside the last blank one, as far as lanes reach.
            self.kept.push(0);
        }
    }

    fn end_run(&mut self) {
        if let Some(last) = self.kept.last().filter(|last| **last != 0) {
            self.blank(*last as usize + 1);
        }
    }

    fn blank(&mut self, piece: usize) {
        self.places[piece] = self.kept.len() as u32;
        self.kept.push(0);
    }

    /// The places of the first sites of a piece and of those below and above it, from the lowest; `None` if it is blank.
    #[inline(always)]
    pub fn rows_around(&self, first: usize) -> Option<[usize; ROWS]> {
        let piece = self.kept[first / PIECE] as usize;
        let below = piece.checked_sub(REACHED * self.stride)?;
        Some(std::array::from_fn(|row| PIECE * self.places[below + row * self.stride] as usize))
    }

    /// The first sites of the pieces that are kept and not blank: their places here, and where they are.
    pub fn pieces(&self) -> impl Iterator<Item = (usize, IVec2)> {
        let kept = self.kept.iter().enumerate().filter(|(_, piece)| **piece != 0);
        kept.map(|(place, piece)| (PIECE * place, self.site(*piece as usize)))
    }

    #[inline(always)]
    fn site(&self, piece: usize) -> IVec2 {
        let (row, column) = (piece / self.stride - REACHED, piece % self.stride - 1);
        IVec2::new((PIECE * column) as i32, row as i32)
    }

    /// The site of a place; `None` if that is blank.
    #[inline(always)]
    pub fn at(&self, place: usize) -> Option<IVec2> {
        let piece = self.kept[place / PIECE] as usize;
        (piece != 0).then(|| self.site(piece) + IVec2::new((place % PIECE) as i32, 0))
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        4 * (self.places.capacity() + self.kept.capacity())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn what_is_near_a_site_stands_at_fixed_distances_from_it() {
        for (seed, share) in [(1, 3), (2, 8), (3, 40), (4, 1)] {
            let (columns, rows) = (PIECE as i32 * 9 + 5, 24);
            let mut random = Random::new(seed);
            let mut sites = Sites::default();
            sites.clear(columns, rows);
            // What is kept, by site: its own number; 0 elsewhere.
            let mut number = std::collections::BTreeMap::new();
            let mut kept = Vec::new();
            for y in 0..rows {
                for x in (0..columns).step_by(PIECE).filter(|_| random.below(share) == 0).collect::<Vec<_>>() {
                    let first = sites.keep(IVec2::new(x, y));
                    kept.resize(first + PIECE, 0);
                    for k in 0..PIECE as i32 {
                        kept[first + k as usize] = 1 + (y * 1000 + x + k);
                        number.insert((x + k, y), kept[first + k as usize]);
                    }
                }
            }
            sites.end();
            kept.resize(sites.len(), 0);
            let mut seen = 0;
            for (first, site) in sites.pieces() {
                let around = sites.rows_around(first).expect("it is kept");
                for k in 0..PIECE {
                    let at = site + IVec2::new(k as i32, 0);
                    assert_eq!(sites.at(first + k), Some(at));
                    for (row, start) in (-(REACHED as i32)..).zip(around) {
                        for step in -(REACHED as i32)..=REACHED as i32 {
                            let found = kept[(start + k).strict_add_signed(step as isize)];
                            let expected = number.get(&(at.x + step, at.y + row)).copied().unwrap_or(0);
                            assert_eq!(found, expected, "{step}, {row} from {at}");
                            seen += 1;
                        }
                    }
                }
            }
            assert_eq!(seen, number.len() * ROWS * ROWS);
            assert!((0..sites.len()).step_by(PIECE).filter(|first| sites.rows_around(*first).is_none()).count() > 2);
        }
    }
}
