//! Where grains are.

use crate::{
    predictor::{
        grains::bed::Bed,
        grid::MacGrid,
        wide::{Wide, in_lanes, load},
    },
    simd::each_lane,
};
use std::ops::Range;

/// Share of the particles of a cell that are grains from which on they touch, and that from which on they bear all.
const TOUCHING: [f32; 2] = [0.3, 0.7];

/// Where grains are among all particles.
#[derive(Clone, Copy)]
pub(super) struct Spread<'a> {
    /// At left and lower faces: number of grains (as weights), and that times sin φ.
    pub grains: &'a [Vec<[f32; 2]>; 2],
    /// The same with the stress that they bear without pressure (d/s) in place of sin φ, if any does.
    pub bound: Option<&'a [Vec<[f32; 2]>; 2]>,
    /// Number of all particles (as weights).
    pub all: [&'a [[f32; 2]]; 2],
}

impl Spread<'_> {
    /// Whether grains reach any of some left or lower faces.
    #[inline(always)]
    pub fn any(&self, faces: Range<usize>) -> bool {
        self.grains.iter().any(|of| of[faces.clone()].iter().fold(false, |any, face| any | (face[0] > 0.0)))
    }

    /// Whether grains touch in any of some cells side by side that have a pressure.
    #[inline(always)]
    pub fn any_touch(&self, bed: &Bed, cells: Range<usize>) -> bool {
        let mut any = false;
        in_lanes(cells, AnyTouch { spread: self, bed, any: &mut any });
        any
    }

    /// Mean sin φ around cells from index `k` on, or around their lower left corners; 0 where no grain is.
    #[inline(always)]
    pub fn sines<const N: usize>(&self, grid: &MacGrid, k: usize) -> [f32; N] {
        means(self.grains, grid, k)
    }

    /// Mean stress (d/s) around them that grains bear without pressure; 0 where they do not touch.
    #[inline(always)]
    pub fn bonds<const N: usize>(&self, grid: &MacGrid, k: usize) -> [f32; N] {
        let Some(bound) = self.bound else { return [0.0; N] };
        let (means, bears) = (means::<N>(bound, grid, k), self.bears::<N>(grid, k));
        each_lane(|i| means[i] * bears[i])
    }

    /// How much of the pressure of cells from index `k` on their grains bear: none where they do not touch.
    #[inline(always)]
    pub fn bears<const N: usize>(&self, grid: &MacGrid, k: usize) -> [f32; N] {
        let [u, v] = self.grains.each_ref().map(|faces| &faces[..]);
        let (grains, all) = (around::<N>([u, v], 0, grid, k), around::<N>(self.all, 0, grid, k));
        each_lane(|i| {
            let share = if all[i] > 0.0 { grains[i] / all[i] } else { 0.0 };
            let share = (share - TOUCHING[0]) / (TOUCHING[1] - TOUCHING[0]);
            let share = if share > 0.0 { share } else { 0.0 };
            if share < 1.0 { share } else { 1.0 }
        })
    }
}

/// Finds whether grains touch in any of some cells.
struct AnyTouch<'a> {
    spread: &'a Spread<'a>,
    bed: &'a Bed<'a>,
    any: &'a mut bool,
}

impl Wide for AnyTouch<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, k: usize) {
        let Self { spread, bed, any } = self;
        if !**any {
            let (bears, liquid) = (spread.bears::<N>(bed.grid, k), load::<N>(bed.liquid, k));
            **any = (0..N).fold(false, |any, i| any | ((liquid[i] > 0.0) & (bears[i] > 0.0)));
        }
    }
}

/// Mean of what grains have around cells from index `k` on, or around their lower left corners; 0 where no grain is.
#[inline(always)]
fn means<const N: usize>(of: &[Vec<[f32; 2]>; 2], grid: &MacGrid, k: usize) -> [f32; N] {
    let [u, v] = of.each_ref().map(|faces| &faces[..]);
    let (weights, sums) = (around::<N>([u, v], 0, grid, k), around::<N>([u, v], 1, grid, k));
    each_lane(|i| if weights[i] > 0.0 { sums[i] / weights[i] } else { 0.0 })
}

/// Sums of a number of the faces of cells.
#[inline(always)]
fn around<const N: usize>([u, v]: [&[[f32; 2]]; 2], number: usize, grid: &MacGrid, k: usize) -> [f32; N] {
    let sides = [(u, k), (u, k + 1), (v, k), (v, k + grid.stride)].map(|(faces, at)| &faces[at..at + N]);
    let mut sums = [0.0; N];
    for faces in sides {
        for i in 0..N {
            sums[i] += faces[i][number];
        }
    }
    sums
}
