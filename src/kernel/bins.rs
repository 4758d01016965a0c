//! Binned neighbour search: strips as high as the search reaches, cut into thin columns.
//!
//! Particles are counting-sorted by cell (row by row), so that whatever may touch a run of consecutive particles lies in
//! three contiguous runs, one in each of three strips. Runs of consecutive particles are the groups that the passes work
//! on side by side. Rock is binned into the same cells, once for every change of the rock.
//!
//! The search reaches further than the kernel by a margin: particles move on while the solver iterates, and each may move
//! by the correction limit. So no pair is missed, and since pairs beyond the kernel add exact zeros, neither the width of
//! a group nor the search itself shows in the result.
//!
//! Rooms: `cells` the geometry, `sort` the particles, `groups`, `focus` those that are iterated again, `rock`.

mod cells;
mod focus;
mod groups;
mod rock;
mod sort;
#[cfg(test)]
mod tests;

pub use rock::RockBins;
pub(crate) use sort::Strip;

use crate::{
    parallel::spread,
    particles::Particles,
    simd::{InstructionSet, Lanes},
    solids::Solids,
};
use cells::CellGrid;
use focus::Focus;
use glam::Vec2;
use groups::{Cutter, StripGroups};
use sort::{Sort, fetch_names};
use std::ops::Range;

/// Rounding allowance of the search margin, d.
const MARGIN_ROUNDING: f32 = 1e-3;
/// The buffer of groups has one in so many to spare: their number changes a little from tick to tick.
const SPARE_GROUPS: usize = 8;

/// Fewer particles than this are not handed to another thread to get their ids.
const WORTH_NAMING: usize = 8192;

/// How neighbours are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Neighbours {
    /// By bins.
    #[default]
    Binned,
    /// Every particle with every other, O(n²): the reference for tests and for the binning table.
    Brute,
}

/// [`Group::lanes`] of a group of which all are worked on.
pub(crate) const ALL_LANES: u16 = u16::MAX;
/// Most lanes of any instruction set.
pub(crate) const MOST_LANES: usize = u16::BITS as usize;

/// A run of consecutive particles with the runs of candidates that may touch any of them. 56 bytes.
#[derive(Clone, Debug, Default)]
pub struct Group {
    /// First particle.
    pub first: u32,
    /// Lanes that are worked on, the lowest bit for the first particle; [`ALL_LANES`] for all that there are.
    pub lanes: u16,
    /// Number of particles, at most the lane width.
    pub len: u8,
    /// Whether the kernel of any of them may reach a wall of the box.
    pub near_wall: bool,
    /// Movable candidates, one run a strip.
    pub movable: [Run; 3],
    /// Rock candidates, one run a strip.
    pub rock: [Run; 3],
}

/// A run of consecutive entries.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run {
    first: u32,
    end: u32,
}

impl Run {
    fn new(first: u32, end: u32) -> Self {
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

/// The cells, what is in them, and the groups. Buffers are kept from substep to substep.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    grid: CellGrid,
    sort: Sort,
    strips: Vec<StripGroups>,
    groups: Vec<Group>,
    focus: Focus,
    rock: RockBins,
}

impl Bins {
    /// Lays the cells over a box of `size` d for a kernel of radius `radius` d whose particles may each move by
    /// `longest_correction` d while they are binned, and bins the rock if it or the cells changed.
    pub fn lay(&mut self, size: Vec2, radius: f32, longest_correction: f32, solids: &Solids) {
        self.grid = CellGrid::new(size, radius + 2.0 * longest_correction + MARGIN_ROUNDING);
        self.rock.follow(&self.grid, solids);
    }

    /// Bins the rock anew next time, whatever its version: another world's rock may have the same.
    pub fn forget_rock(&mut self) {
        self.rock.forget();
    }

    /// Sorts the particles by cell and builds the groups over them, as wide as the lanes. Within a cell the order stays.
    /// `spare` is room for a coordinate or velocity each; `settle` may then change the positions of each strip.
    pub(crate) fn bin(
        &mut self,
        particles: &mut Particles,
        spare: [&mut Vec<f32>; 4],
        neighbours: Neighbours,
        instructions: InstructionSet,
        threads: usize,
        settle: &(impl Fn(Strip) + Sync),
    ) {
        self.sort.sort(&self.grid, particles, spare, instructions, threads, settle);
        let ids = &particles.id;
        let (source, names) = self.sort.names();
        spread([names], WORTH_NAMING, threads, &|base, [names]| {
            let source = &source[base..base + names.len()];
            fetch_names(names, ids, source);
        });
        self.sort.keep_names(&mut particles.id);
        match neighbours {
            Neighbours::Binned => self.group(&particles.x, instructions.width(), threads),
            Neighbours::Brute => self.group_with_all(particles.len(), instructions.width()),
        }
    }

    fn group(&mut self, x: &[f32], width: usize, threads: usize) {
        let Self { grid, sort, strips, groups, rock, .. } = self;
        let cutter = Cutter { grid, starts: &sort.starts, rock, x, width };
        let count = cutter.count(sort, strips);
        if count > groups.capacity() {
            groups.reserve_exact(count + count / SPARE_GROUPS - groups.len());
        }
        groups.resize_with(count, Group::default);
        cutter.fill(strips, groups, threads);
    }

    fn group_with_all(&mut self, particles: usize, width: usize) {
        let all = |len: usize| [Run::new(0, len as u32), Run::default(), Run::default()];
        self.groups.clear();
        self.groups.extend((0..particles).step_by(width).map(|first| Group {
            first: first as u32,
            lanes: ALL_LANES,
            len: width.min(particles - first) as u8,
            near_wall: true,
            movable: all(particles),
            rock: all(self.rock.x.len()),
        }));
    }

    /// Whether a cell may hold a crowd. Costs nothing: it follows from what the sort found.
    pub(crate) fn is_crowded(&self) -> bool {
        self.sort.is_crowded()
    }

    /// The particles of each crowded cell.
    pub(crate) fn crowds(&self) -> impl Iterator<Item = Range<usize>> {
        self.sort.crowds(&self.grid)
    }

    /// The groups, in the order of their particles; together they hold each particle once.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Narrows [`Bins::focused`] down to what stands within reach of a particle whose density is above `bound`. The
    /// particles were binned at `at` (d).
    pub(crate) fn focus(&mut self, at: [&[f32]; 2], density: &[f32], bound: f32) {
        self.focus.find(&self.grid, &self.sort.strips, &self.groups, at, density, bound);
    }

    /// The groups of the last [`Bins::focus`], in the order of their particles. Of some only a part is worked on.
    pub(crate) fn focused(&self) -> &[Group] {
        &self.focus.groups
    }

    /// The binned rock.
    pub fn rock(&self) -> &RockBins {
        &self.rock
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.sort.memory()
            + self.rock.memory()
            + size_of::<StripGroups>() * self.strips.capacity()
            + size_of::<Group>() * self.groups.capacity()
            + self.focus.memory()
    }
}
