//! Runs of sorted particles that the passes work on side by side, with the runs of what may touch any of them.

use crate::{
    bins::{
        cells::CellGrid,
        group::{ALL_LANES, Group, Run},
        sort::Sort,
    },
    parallel::{Parts, fork, piece},
};

/// A group ends where its particles would spread wider than this many radii: in thin spray a wide group would draw in
/// everything that lies between.
const GROUP_SPAN_RADII: u32 = 8;
/// Fewer groups than this do not pay for another thread.
const WORTH_A_PIECE: usize = 16;

/// The groups of a strip.
#[derive(Clone, Copy, Debug)]
pub(super) struct StripGroups {
    strip: u32,
    /// Number of groups in the strips before it.
    first: u32,
}

/// Where groups are cut.
#[derive(Clone, Copy)]
pub(super) struct Cutter<'a> {
    pub grid: &'a CellGrid,
    pub starts: &'a [u32],
    /// First rock of each cell; empty where there is none.
    pub rock: &'a [u32],
    /// Sorted positions, d.
    pub x: &'a [f32],
    /// Particles in a group at most.
    pub width: usize,
}

impl Cutter<'_> {
    /// Calls `work` with the first particle, that after the last, and the first and the last column of every group of a
    /// strip.
    #[inline(always)]
    fn for_each(&self, strip: usize, mut work: impl FnMut(usize, usize, u32, u32)) {
        let start = strip * self.grid.columns;
        let (mut first, end) = (self.starts[start] as usize, self.starts[start + self.grid.columns] as usize);
        while first < end {
            let mut next = end.min(first + self.width);
            let low = self.grid.column(self.x[first]);
            let mut high = self.grid.column(self.x[next - 1]);
            let last = low + CellGrid::columns_of(GROUP_SPAN_RADII);
            if high > last {
                next = first + self.x[first..next].partition_point(|&x| self.grid.column(x) <= last);
                high = self.grid.column(self.x[next - 1]);
            }
            work(first, next, low, high);
            first = next;
        }
    }

    /// Counts the groups of all strips; returns how many there are.
    pub fn count(&self, sort: &Sort, strips: &mut Vec<StripGroups>) -> usize {
        strips.clear();
        let mut groups = 0;
        for strip in sort.strips.clone() {
            strips.push(StripGroups { strip: strip as u32, first: groups });
            self.for_each(strip, |_, _, _, _| groups += 1);
        }
        groups as usize
    }

    /// Fills the groups of strips in, and the runs of rock of each, where there is any; both begin with those of the first.
    pub fn fill(&self, strips: &[StripGroups], groups: &mut [Group], rock: &mut [[Run; 3]], threads: usize) {
        let most = piece(groups.len(), threads, WORTH_A_PIECE);
        fork(Filling { strips, groups, rock }, most, &|part: Filling| {
            let (mut groups, mut rock) = (part.groups.iter_mut(), part.rock.iter_mut());
            for strip in part.strips {
                self.fill_strip(strip, &mut groups, &mut rock);
            }
        });
    }

    fn fill_strip<'g>(
        &self,
        &StripGroups { strip, first: mut number }: &StripGroups,
        groups: &mut impl Iterator<Item = &'g mut Group>,
        rock: &mut impl Iterator<Item = &'g mut [Run; 3]>,
    ) {
        let strip = strip as usize;
        let near_floor_or_top = self.grid.is_near_floor_or_top(strip);
        self.for_each(strip, |first, next, low, high| {
            let columns = self.grid.columns_around(low, high);
            let runs = |starts: &[u32]| {
                [strip - 1, strip, strip + 1].map(|strip| {
                    let start = strip * self.grid.columns;
                    Run::new(starts[start + columns.start], starts[start + columns.end])
                })
            };
            if let Some(group) = groups.next() {
                *group = Group {
                    number,
                    first: first as u32,
                    lanes: ALL_LANES,
                    len: (next - first) as u8,
                    near_wall: near_floor_or_top || self.grid.is_near_side(low, high),
                    movable: runs(self.starts),
                };
            }
            if let Some(rock) = rock.next() {
                *rock = runs(self.rock);
            }
            number += 1;
        });
    }
}

/// Strips with their groups, and with the rock of each, where there is any.
struct Filling<'a> {
    strips: &'a [StripGroups],
    groups: &'a mut [Group],
    rock: &'a mut [[Run; 3]],
}

impl Parts for Filling<'_> {
    /// Groups, if they are in several strips.
    fn size(&self) -> usize {
        if self.strips.len() > 1 { self.groups.len() } else { 0 }
    }

    fn halve(self) -> (Self, Self) {
        let half = (self.groups.len() / 2) as u32 + self.strips[0].first;
        let middle = self.strips.partition_point(|strip| strip.first < half).clamp(1, self.strips.len() - 1);
        let (lower, upper) = self.strips.split_at(middle);
        let count = (upper[0].first - lower[0].first) as usize;
        let (lower_groups, upper_groups) = self.groups.split_at_mut(count);
        let (lower_rock, upper_rock) = self.rock.split_at_mut(count.min(self.rock.len()));
        (
            Self { strips: lower, groups: lower_groups, rock: lower_rock },
            Self { strips: upper, groups: upper_groups, rock: upper_rock },
        )
    }
}
