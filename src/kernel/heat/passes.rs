//! The two passes of the exchange between what moves and what is near it, in the order of their cells: lanes over lumps that follow
//! each other, and those around them one by one.
//!
//! What is beyond a lump's reach has no weight, and adds 0 to its sums: so a lane finds what its lump would by itself, to the bit.

use super::{exchanged::Exchanged, grid::HeatGrid, sorted::Sorted, weights::weight};
use crate::simd::{Lanes, Pass};
use std::ops::Range;

/// Cells from one lump of a group to the next: as many as a group has around it that ends with the one and begins with the other.
const WIDEST_GAP: usize = 3;

/// Lumps that are worked on side by side, and the cells around any of them.
struct Group {
    lumps: Range<usize>,
    around: [Range<usize>; 3],
}

/// The lumps that a pass works on, and where.
#[derive(Clone, Copy)]
pub(super) struct Nearby<'a> {
    pub grid: &'a HeatGrid,
    /// Cells in which anything flows.
    pub flows: &'a [bool],
    pub own: &'a Sorted,
}

impl Nearby<'_> {
    /// The lumps `range` in groups of up to `width`, each in one row of cells without a wide gap and with any in a cell in which
    /// something flows.
    #[inline(always)]
    fn groups(&self, range: Range<usize>, width: usize) -> impl Iterator<Item = Group> {
        let mut next = range.start;
        let cell = |k: usize| self.own.cell[k] as usize;
        std::iter::from_fn(move || {
            while next < range.end {
                let first = next;
                let most = self.own.row_end(self.grid, cell(first)).min(range.end).min(first + width);
                let end = (first + 1..most).find(|k| cell(*k) - cell(k - 1) > WIDEST_GAP).unwrap_or(most);
                next = end;
                if (first..end).any(|k| self.flows[cell(k)]) {
                    return Some(Group { lumps: first..end, around: self.grid.around(cell(first), cell(end - 1)) });
                }
            }
            None
        })
    }

    /// Shows `visit` those of some lumps that are near a group, one by one, with the weights of each beside those of the group.
    #[inline(always)]
    fn each<L: Lanes>(&self, group: &Group, others: &Sorted, mut visit: impl FnMut(usize, L)) {
        let [x, y] = [&self.own.x, &self.own.y].map(|field| L::load(&field[group.lumps.clone()]));
        for cells in &group.around {
            for j in others.of(cells.clone()) {
                visit(j, weight(L::splat(others.x[j]) - x, L::splat(others.y[j]) - y));
            }
        }
    }
}

/// Finds how much is around each lump. Those of groups in which nothing flows are left as they are.
pub(super) struct LookAround<'a> {
    pub nearby: Nearby<'a>,
    /// What is around them, with its √k′, √(W/mK).
    pub others: &'a [(&'a Sorted, &'a [f32])],
    /// The first lump of those that are written.
    pub base: usize,
    /// Out: weights, and weights times √k′, together; of what looks at its own kind with its own.
    pub out: [&'a mut [f32]; 2],
}

impl Pass for LookAround<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { nearby, others, base, out: [whole, through] } = self;
        for group in nearby.groups(base..base + whole.len(), L::WIDTH) {
            let mut sums = [L::splat(0.0); 2];
            for (others, conduction) in others {
                nearby.each(&group, others, |j, weights: L| {
                    sums = [sums[0] + weights, sums[1] + weights * L::splat(conduction[j])];
                });
            }
            let out = group.lumps.start - base..group.lumps.end - base;
            sums[0].store(&mut whole[out.clone()]);
            sums[1].store(&mut through[out]);
        }
    }
}

/// Finds what flows in a step. Those of groups in which nothing flows get nothing.
pub(super) struct Flow<'a> {
    pub nearby: Nearby<'a>,
    pub exchanged: Exchanged<'a>,
    /// What is around them.
    pub others: &'a [(&'a Sorted, Exchanged<'a>)],
    /// The first lump of those that are written.
    pub base: usize,
    /// Out: what they gain, quanta.
    pub gained: &'a mut [i32],
}

impl Pass for Flow<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { nearby, exchanged, others, base, gained } = self;
        gained.fill(0);
        for group in nearby.groups(base..base + gained.len(), L::WIDTH) {
            let own = exchanged.own(|field| L::load(&field[group.lumps.clone()]));
            let mut sums = L::no_sums();
            for (others, exchanged) in others {
                nearby.each(&group, others, |j, weights: L| {
                    let flow = own.flow(exchanged, weights, |field| L::splat(field[j]));
                    sums = flow.add_rounded(sums);
                });
            }
            gained[group.lumps.start - base..group.lumps.end - base]
                .copy_from_slice(&L::sums(sums)[..group.lumps.len()]);
        }
    }
}
