//! Where the liquid is still too dense: the groups that the solver iterates again.

use crate::{
    bins::{
        cells::CellGrid,
        group::{ALL_LANES, Group, make_room},
        sort::Sort,
        tiles::{Tiles, mark},
    },
    parallel::{Rows, Team, fork, piece},
    simd::{Lanes, Pass},
};
use std::ops::Range;

/// Densities that are looked at together: most are fine.
const BLOCK: usize = 64;
/// Tiles whose marks are looked at together.
const MOST_TILES: usize = u64::BITS as usize;
/// Groups that are looked at together.
const CHUNK: usize = 32;
/// Fewer particles than this are not handed to another thread to be looked at.
const WORTH_A_LOOK: usize = 2048;

/// The groups in and around the tiles that hold something too dense. Tiles are cells of the world, not runs of particles:
/// so neither the width of a group nor the number of threads decides which particles are in.
#[derive(Clone, Debug, Default)]
pub(super) struct Focus {
    /// The tiles that hold something too dense. The strips that hold particles, and the one below and above them, are up to date.
    dense: Tiles,
    /// Those, and the tiles around them, in the strips that hold particles.
    near: Tiles,
    /// What was found, and room for all.
    groups: Vec<Group>,
    /// How many were found in each chunk.
    counts: Vec<usize>,
    /// How many were found.
    found: usize,
}

/// What is looked at.
pub(super) struct Binned<'a> {
    pub grid: &'a CellGrid,
    pub sort: &'a Sort,
    pub groups: &'a [Group],
    /// Sorted positions, d.
    pub at: [&'a [f32]; 2],
}

impl Focus {
    /// Finds them: particles whose density is above `bound` are too dense.
    pub fn find(&mut self, binned: &Binned, density: &[f32], bound: f32, team: Team) {
        let Self { dense, near, groups, counts, found } = self;
        let Team { instructions, threads } = team;
        let strips = binned.sort.strips.clone();
        dense.clear(binned.grid, strips.start - 1..strips.end + 1);
        near.clear(binned.grid, strips.clone());
        // Strips are as full as they are on the mean, about.
        let per_strip = density.len().div_ceil(strips.len().max(1)).max(1);
        let most = (piece(density.len(), threads, WORTH_A_LOOK) / per_strip).max(1);
        fork((strips.clone(), dense.rows(&strips)), most, &|(strips, rows)| {
            instructions.run(MarkDense { binned, density, bound, strips, rows });
        });
        near.widen(dense, strips);
        make_room(groups, binned.groups.len());
        counts.resize(groups.len().div_ceil(CHUNK), 0);
        let chunks = 0..counts.len();
        let band = (Rows { field: &mut groups[..], stride: CHUNK }, Rows { field: &mut counts[..], stride: 1 });
        let most = piece(binned.groups.len(), threads, CHUNK).div_ceil(CHUNK);
        fork((chunks, band), most, &|(chunks, (places, counts))| {
            let groups = &binned.groups[chunks.start * CHUNK..][..places.field.len()];
            instructions.run(Pick { binned, near, groups, places: places.field, counts: counts.field });
        });
        // They close up.
        *found = 0;
        for (chunk, &count) in counts.iter().enumerate() {
            groups.copy_within(chunk * CHUNK..chunk * CHUNK + count, *found);
            *found += count;
        }
    }

    /// What the last search found.
    pub fn groups(&self) -> &[Group] {
        &self.groups[..self.found]
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.dense.memory()
            + self.near.memory()
            + size_of::<Group>() * self.groups.capacity()
            + size_of::<usize>() * self.counts.capacity()
    }
}

/// Marks the tiles of some strips that hold something too dense.
struct MarkDense<'a> {
    binned: &'a Binned<'a>,
    density: &'a [f32],
    bound: f32,
    strips: Range<usize>,
    rows: Rows<'a, u64>,
}

impl Pass for MarkDense<'_> {
    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Binned { grid, sort, at: [x, _], .. } = self.binned;
        let is_dense = |density: &f32| *density > self.bound;
        for (strip, row) in self.strips.zip(self.rows.each()) {
            let own = sort.particles(grid, strip);
            for (x, density) in x[own.clone()].chunks(BLOCK).zip(self.density[own].chunks(BLOCK)) {
                if density.iter().fold(false, |any, density| any | is_dense(density)) {
                    let found = x.iter().zip(density).filter(|(_, density)| is_dense(density));
                    found.for_each(|(x, _)| mark(row, grid.tile_column(*x)));
                }
            }
        }
    }
}

/// Puts those of some groups that are near something too dense into the first places of their chunk, and counts them.
struct Pick<'a> {
    binned: &'a Binned<'a>,
    near: &'a Tiles,
    groups: &'a [Group],
    places: &'a mut [Group],
    counts: &'a mut [usize],
}

impl Pass for Pick<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let chunks = self.groups.chunks(CHUNK).zip(self.places.chunks_mut(CHUNK));
        for ((groups, places), count) in chunks.zip(self.counts) {
            *count = 0;
            for group in groups {
                let lanes = lanes(self.binned, self.near, group);
                if lanes != 0 {
                    places[*count] = Group { lanes, ..*group };
                    *count += 1;
                }
            }
        }
    }
}

/// The lanes of a group that are in tiles near something too dense.
#[inline(always)]
fn lanes(binned: &Binned, near: &Tiles, group: &Group) -> u16 {
    let Binned { grid, at: [x, y], .. } = binned;
    let own = group.particles();
    let ends = [own.start, own.end - 1];
    let ([row, last_row], [first, last]) = (ends.map(|i| grid.strip(y[i])), ends.map(|i| grid.tile_column(x[i])));
    if row != last_row || last - first >= MOST_TILES {
        return lanes_of(own, |i| near.from(grid.strip(y[i]), grid.tile_column(x[i])));
    }
    // Particles of one strip are sorted by column.
    let (near, all) = (near.from(row, first), u64::MAX >> (MOST_TILES - 1 - (last - first)));
    match near & all {
        0 => 0,
        found if found == all => ALL_LANES,
        _ => lanes_of(own, |i| near >> (grid.tile_column(x[i]) - first)),
    }
}

/// The lanes of particles for which the lowest bit is set.
#[inline(always)]
fn lanes_of(particles: Range<usize>, bits: impl Fn(usize) -> u64) -> u16 {
    particles.enumerate().fold(0, |lanes, (lane, i)| lanes | ((bits(i) & 1) as u16) << lane)
}
