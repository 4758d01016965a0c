//! A group of particles that the passes work on side by side, and how groups are shared out to threads.

use crate::{
    parallel::{Parts, cut, fork, piece},
    simd::{Lanes, MOST_LANES},
};
use std::ops::Range;

/// Fewer groups than this a piece do not pay for handing it over.
const FEWEST_GROUPS: usize = 16;

/// A buffer of groups has one in so many to spare: their number changes a little from tick to tick.
const SPARE_GROUPS: usize = 4;

/// [`Group::lanes`] of a group of which all are worked on.
pub(crate) const ALL_LANES: u16 = u16::MAX;

/// A run of consecutive particles with the runs of candidates that may touch any of them; those of rock are held
/// apart, as most boxes have none near ([`RockBins::around`](super::rock::RockBins::around)). 36 bytes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Group {
    /// Its number among all groups.
    pub number: u32,
    /// First particle.
    pub first: u32,
    /// Lanes that are worked on, the lowest bit for the first of [`MOST_LANES`] particles; [`ALL_LANES`] for all that
    /// there are.
    pub lanes: u16,
    /// Number of particles, at most the lane width.
    pub len: u8,
    /// Whether the kernel of any of them may reach a wall of the box.
    pub near_wall: bool,
    /// Movable candidates, one run a strip.
    pub movable: [Run; 3],
}

/// A run of consecutive entries.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run {
    first: u32,
    end: u32,
}

impl Run {
    pub(crate) fn new(first: u32, end: u32) -> Self {
        Self { first, end }
    }

    /// As a range of indices.
    #[inline(always)]
    pub fn range(self) -> Range<usize> {
        self.first as usize..self.end as usize
    }
}

impl Group {
    /// The particles.
    #[inline(always)]
    pub fn particles(&self) -> Range<usize> {
        self.first as usize..self.first as usize + usize::from(self.len)
    }

    /// `new` in the lanes that are worked on, `old()` in the others.
    #[inline(always)]
    pub(crate) fn choose<L: Lanes>(&self, new: L, old: impl FnOnce() -> L) -> L {
        if self.lanes == ALL_LANES {
            return new;
        }
        let chosen: [f32; MOST_LANES] = std::array::from_fn(|lane| f32::from(self.lanes >> lane & 1));
        L::load(&chosen).if_less(L::splat(0.5), old(), new)
    }
}

/// Makes room for `count` groups or what belongs to one, and for few more.
pub(super) fn make_room<T: Clone + Default>(entries: &mut Vec<T>, count: usize) {
    if count > entries.capacity() {
        entries.reserve_exact(count + count / SPARE_GROUPS - entries.len());
    }
    entries.resize(count, T::default());
}

/// Runs `work` over pieces of `groups`, on up to `threads` threads of the current rayon pool. Each call gets its groups,
/// the index of their first particle, and the outputs from that particle on, up to its last.
pub(crate) fn split<const K: usize, T, F>(groups: &[Group], outputs: [&mut [T]; K], threads: usize, work: &F)
where
    T: Send,
    F: Fn(&[Group], usize, [&mut [T]; K]) + Sync,
{
    let most = piece(groups.len(), threads, FEWEST_GROUPS);
    fork(GroupParts { groups, base: 0, outputs }, most, &|part: GroupParts<K, T>| {
        work(part.groups, part.base, part.outputs);
    });
}

/// Groups with what belongs to their particles, the first of which is number `base`.
struct GroupParts<'a, const K: usize, T> {
    groups: &'a [Group],
    base: usize,
    outputs: [&'a mut [T]; K],
}

impl<const K: usize, T: Send> Parts for GroupParts<'_, K, T> {
    fn size(&self) -> usize {
        self.groups.len()
    }

    fn halve(self) -> (Self, Self) {
        let (left, right) = self.groups.split_at(self.groups.len() / 2);
        let boundary = right[0].first as usize;
        let (left_outputs, right_outputs) = cut(self.outputs, boundary - self.base);
        (
            Self { groups: left, base: self.base, outputs: left_outputs },
            Self { groups: right, base: boundary, outputs: right_outputs },
        )
    }
}
