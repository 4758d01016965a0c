//! The search as a whole: sorts the particles and cuts them into groups.

use crate::{
    bins::{
        cells::CellGrid,
        focus::{Binned, Focus},
        group::{ALL_LANES, Group, Run, make_room},
        groups::{Cutter, StripGroups},
        rock::RockBins,
        sort::Sort,
        strip::Strip,
    },
    parallel::Team,
    particles::Particles,
    simd::InstructionSet,
    solids::Solids,
};
use glam::Vec2;
use std::ops::Range;

/// Rounding allowance of the search margin, d.
pub(super) const MARGIN_ROUNDING: f32 = 1e-3;
/// Fewer particles than this are no crowd, however much room they ask for.
const LEAST_CROWD: usize = 8;

/// How neighbours are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Neighbours {
    /// By bins.
    #[default]
    Binned,
    /// Every particle with every other, O(n²): the reference for tests and for the binning table.
    Brute,
}

/// The cells, what is in them, and the groups. Buffers are kept from substep to substep.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    pub(super) grid: CellGrid,
    sort: Sort,
    strips: Vec<StripGroups>,
    groups: Vec<Group>,
    focus: Focus,
    rock: RockBins,
}

impl Bins {
    /// Fits the cells to a box of `size` d for a kernel of radius `radius` d whose particles may each move by
    /// `longest_correction` d while they are binned, and bins the rock if it or the cells changed.
    pub fn resize(&mut self, size: Vec2, radius: f32, longest_correction: f32, solids: &Solids) {
        self.grid = CellGrid::new(size, radius + 2.0 * longest_correction + MARGIN_ROUNDING);
        self.rock.follow(&self.grid, solids);
    }

    /// Bins the rock anew next time, whatever its version: another world's rock may have the same.
    pub fn forget_rock(&mut self) {
        self.rock = RockBins::default();
    }

    /// Sorts the particles by cell and builds the groups over them, as wide as the lanes. Within a cell the order stays.
    /// `spare` and `order` are buffers for a number of each particle, in which none is left; `settle` may then change the positions of
    /// each strip.
    pub(crate) fn bin(
        &mut self,
        particles: &mut Particles,
        [spare, order]: [&mut Vec<f32>; 2],
        neighbours: Neighbours,
        instructions: InstructionSet,
        threads: usize,
        settle: &(impl Fn(Strip) + Sync),
    ) {
        spare.resize(particles.len(), 0.0);
        order.resize(particles.len(), 0.0);
        let mut words = bytemuck::cast_vec(std::mem::take(spare));
        let source: &mut [u32] = bytemuck::cast_slice_mut(order);
        self.sort.place(&self.grid, [&particles.x, &particles.y], [&mut words, source], instructions, threads);
        self.sort.reorder(particles, source, &mut words, threads);
        *spare = bytemuck::cast_vec(words);
        self.sort.settle(&self.grid, particles, threads, settle);
        match neighbours {
            Neighbours::Binned => self.group(&particles.x, instructions.width(), threads),
            Neighbours::Brute => self.group_with_all(particles.len(), instructions.width()),
        }
    }

    /// Cuts the sorted particles into groups of up to `width`.
    pub(super) fn group(&mut self, x: &[f32], width: usize, threads: usize) {
        let Self { grid, sort, strips, groups, rock, .. } = self;
        let cutter = Cutter { grid, starts: &sort.starts, rock: &rock.starts, x, width };
        let count = cutter.count(sort, strips);
        make_room(groups, count);
        make_room(&mut rock.runs, if rock.starts.is_empty() { 0 } else { count });
        cutter.fill(strips, groups, &mut rock.runs, threads);
    }

    fn group_with_all(&mut self, particles: usize, width: usize) {
        let all = |len: usize| [Run::new(0, len as u32), Run::default(), Run::default()];
        self.groups.clear();
        self.groups.extend((0..).zip((0..particles).step_by(width)).map(|(number, first)| Group {
            number,
            first: first as u32,
            lanes: ALL_LANES,
            len: width.min(particles - first) as u8,
            near_wall: true,
            movable: all(particles),
        }));
        self.rock.runs.clear();
        self.rock.runs.resize(self.groups.len(), all(self.rock.x.len()));
    }

    /// The particles of each cell in which there are `fill` or more to a d², and eight at least.
    pub(crate) fn crowds(&self, fill: f32) -> impl Iterator<Item = Range<usize>> {
        let most = (fill * self.grid.cell_area()).ceil() as usize;
        self.sort.crowds(&self.grid, most.max(LEAST_CROWD))
    }

    /// The groups, in the order of their particles; together they hold each particle once.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// Narrows [`Bins::focused`] down to what stands within reach of a particle whose density is above `bound`. The
    /// particles were binned at `at` (d).
    pub(crate) fn focus(&mut self, at: [&[f32]; 2], density: &[f32], bound: f32, team: Team) {
        let Self { grid, sort, groups, focus, .. } = self;
        focus.find(&Binned { grid, sort, groups, at }, density, bound, team);
    }

    /// The groups of the last [`Bins::focus`], in the order of their particles. Of some only a part is worked on.
    pub(crate) fn focused(&self) -> &[Group] {
        self.focus.groups()
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
