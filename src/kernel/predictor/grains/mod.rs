//! Grains on the grid: the pressure holds them as it holds a liquid, and friction among them holds slopes.

mod bed;
mod cells;
mod fields;
mod friction;
mod iteration;
mod limits;
mod near;
mod part;
mod pore;
mod spread;
mod strain;
mod ways;

pub(super) use bed::Bed;
pub(super) use ways::GrainWay;

use crate::{
    element::ElementId,
    parallel::{Rows, Sweep, sweep},
    predictor::{
        grains::{friction::Friction, near::Near, pore::Pore, spread::Spread},
        grid::MacGrid,
        level::WORTH_A_PIECE,
        share_out::ShareOut,
        transfer::Faces,
        wide::{Wide, in_lanes, load, store},
    },
    simd::each_lane,
};
use std::ops::Range;

/// How much looser and denser than the liquid would be a bed of grains stays, as a share: what has come to rest is not stirred
/// to make it even.
const LEFT_ALONE: [f32; 2] = [0.06, 0.03];

/// What friction reads of the elements, an entry an element.
#[derive(Clone, Copy, Debug)]
pub struct GrainParams<'a> {
    /// sin φ; 0 of what is no grain.
    pub sines: &'a [f32],
    /// Cohesion by its own density, d/s² ([`ElementParams::cohesion`](crate::element::ElementParams)).
    pub cohesion: &'a [f32],
}

/// The grains, and the stress among them. The buffers are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Grains {
    /// sin φ of each particle; 0 of what is no grain.
    sines: Vec<f32>,
    /// 1 for each grain.
    is_grain: Vec<f32>,
    /// Stress that each bears without pressure, d/s; not read if none bears any.
    bonds: Vec<f32>,
    /// At left and lower faces: number of grains (as weights), and that times sin φ.
    faces: [Vec<[f32; 2]>; 2],
    /// The same with the bonds in place of sin φ, if there are any.
    bound: Option<[Vec<[f32; 2]>; 2]>,
    /// How full cells are, as far as that is to be changed.
    uneven: Vec<f32>,
    near: Near,
    friction: Friction,
    pore: Pore,
    /// Particles of each element.
    counts: Vec<u32>,
    /// Density of the liquids, as a share of the heaviest, if there are any.
    liquids: Option<f32>,
    /// What grains near a face are drawn to.
    ways: [Vec<GrainWay>; 2],
}

impl Grains {
    /// Shares out the grains on the faces. `masses`: those of the elements as shares of the heaviest, if they differ. `dt`: the
    /// substep, s.
    pub fn collect(
        &mut self,
        share: &ShareOut,
        at: [&[f32]; 2],
        elements: &[ElementId],
        (of, masses): (GrainParams, Option<&[f32]>),
        dt: f32,
    ) {
        let Self { sines, is_grain, bonds, faces, bound, counts, liquids, .. } = self;
        counts.clear();
        counts.resize(of.sines.len(), 0);
        elements.iter().for_each(|element| counts[element.index()] += 1);
        *liquids = mean_density_of_liquids(counts, of.sines, masses);
        sines.clear();
        sines.extend(elements.iter().map(|element| of.sines[element.index()]));
        is_grain.clear();
        is_grain.extend(sines.iter().map(|sine| if *sine > 0.0 { 1.0 } else { 0.0 }));
        share.run(at, Some(is_grain), [sines, sines], faces.each_mut());
        if of.cohesion.iter().zip(&*counts).any(|(cohesion, count)| *cohesion > 0.0 && *count > 0) {
            // Stresses are counted by the density of the heaviest and by cells, as the pressure is.
            let by_cell = dt * share.grid.per_cell;
            let bond = |element: usize| by_cell * masses.map_or(1.0, |masses| masses[element]) * of.cohesion[element];
            bonds.clear();
            bonds.extend(elements.iter().map(|element| bond(element.index())));
            share.run(at, Some(is_grain), [bonds, bonds], bound.get_or_insert_default().each_mut());
        } else {
            *bound = None;
        }
    }

    /// How much of the pressure of cell `k` its grains bear.
    pub fn bear(&self, faces: &Faces, grid: &MacGrid, k: usize) -> f32 {
        let [bears] = Spread { grains: &self.faces, bound: None, all: [&faces.u, &faces.v] }.bears::<1>(grid, k);
        bears
    }

    /// sin φ of each particle; 0 of what is no grain.
    pub fn sines(&self) -> &[f32] {
        &self.sines
    }

    /// What grains near the left and lower faces are drawn to.
    pub fn ways(&self) -> &[Vec<GrainWay>; 2] {
        &self.ways
    }

    /// The pressure (its right-hand side) sets out from what the last substep's stress does to the faces.
    pub fn begin(&mut self, bed: &Bed, faces: &Faces, right_side: &mut [f32]) {
        let Self { faces: own, near, friction, .. } = self;
        let spread = Spread { grains: own, bound: None, all: [&faces.u, &faces.v] };
        near.find(bed, (&faces.reached, &faces.area), &spread, |cells| friction.is_stressed(bed, cells));
        friction.begin(bed, near, faces);
        friction.subtract_divergence(bed, near, right_side);
    }

    /// Finds the stress under the pressure of the substep, and adds what it changes to the faces' ways.
    pub fn end(&mut self, bed: &Bed, faces: &mut Faces, pressure: &[f32]) {
        let Self { faces: own, bound, near, friction, pore, liquids, ways, .. } = self;
        let spread = Spread { grains: own, bound: bound.as_ref(), all: [&faces.u, &faces.v] };
        pore.solve(bed, near, &spread, pressure, *liquids);
        friction.solve((bed, near), faces, &spread, pressure, pore.pressure());
        friction.hand_over(bed, near, faces, ways);
    }

    /// How full cells are, as far as that is to be changed: a bed of grains is left as it lies.
    pub fn uneven(&mut self, bed: &Bed, faces: &Faces) -> &[f32] {
        let Self { faces: own, bound, near, uneven, .. } = self;
        uneven.resize(bed.grid.len(), 0.0);
        let spread = Spread { grains: own, bound: bound.as_ref(), all: [&faces.u, &faces.v] };
        let work = Uneven { bed, near, filled: &faces.filled, spread };
        let band = Rows::new(uneven, bed.grid.stride, &bed.rows);
        sweep(&work, bed.rows.clone(), band, bed.span.len(), WORTH_A_PIECE, bed.team);
        uneven
    }

    /// What the next substep sets out from: fields of the grid, d/s.
    pub fn kept(&self) -> Vec<Vec<f32>> {
        self.friction.kept().into_iter().chain(self.pore.kept()).cloned().collect()
    }

    /// Grains that set out from what was kept on a grid; from nothing if it was another.
    pub fn resume(grid: &MacGrid, kept: Vec<Vec<f32>>) -> Self {
        match <[Vec<f32>; 8]>::try_from(kept) {
            Ok(kept) if kept.iter().all(|field| field.len() == grid.len()) => {
                let [s, t, kept_s, kept_t, cells, corners, head, share] = kept;
                Self {
                    near: Near::all(grid),
                    friction: Friction::resume([s, t, kept_s, kept_t, cells, corners]),
                    pore: Pore::resume([head, share]),
                    ..Self::default()
                }
            }
            _ => Self { near: Near::all(grid), ..Self::default() },
        }
    }

    /// Cells that friction worked on in the last substep.
    #[cfg(test)]
    pub fn cells(&self, grid: &MacGrid) -> usize {
        self.near.rows(grid).flat_map(|row| self.near.runs(row)).map(|run| run.len()).sum()
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { sines, is_grain, bonds, faces, bound, uneven, near, friction, pore, ways, .. } = self;
        let on_faces = faces.iter().chain(bound.iter().flatten()).map(Vec::capacity);
        let on_faces: usize = on_faces.chain(ways.iter().map(Vec::capacity)).sum();
        4 * (sines.capacity() + is_grain.capacity() + bonds.capacity() + uneven.capacity())
            + 8 * on_faces
            + near.memory()
            + friction.memory()
            + pore.memory()
    }
}

/// Mean density of all that is no grain, as a share of the heaviest; none if all are grains.
fn mean_density_of_liquids(counts: &[u32], sines: &[f32], masses: Option<&[f32]>) -> Option<f32> {
    let liquids = counts.iter().enumerate().filter(|(element, count)| sines[*element] == 0.0 && **count > 0);
    let [mass, count] = liquids.fold([0.0, 0.0], |[mass, sum], (element, count)| {
        let count = *count as f32;
        [mass + count * masses.map_or(1.0, |masses| masses[element]), sum + count]
    });
    (count > 0.0).then(|| mass / count)
}

struct Uneven<'a> {
    bed: &'a Bed<'a>,
    near: &'a Near,
    filled: &'a [f32],
    spread: Spread<'a>,
}

impl Sweep<Rows<'_, f32>> for Uneven<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut out: Rows<f32>) {
        let Self { bed, near, filled, spread } = self;
        for (row, out) in rows.zip(out.each()) {
            let first = bed.grid.row(row);
            out[bed.span.clone()].copy_from_slice(&filled[first..][bed.span.clone()]);
            for columns in near.runs(row).map(|run| bed.within(run)).filter(|columns| !columns.is_empty()) {
                in_lanes(columns, UnevenRow { bed, spread, first, out });
            }
        }
    }
}

struct UnevenRow<'a> {
    bed: &'a Bed<'a>,
    spread: &'a Spread<'a>,
    /// Index of the row's first cell.
    first: usize,
    /// In: how full cells are. Out: how full as far as that is to be changed.
    out: &'a mut [f32],
}

impl Wide for UnevenRow<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, column: usize) {
        let Self { bed, spread, first, out } = self;
        let (filled, bears) = (load::<N>(out, column), spread.bears::<N>(bed.grid, *first + column));
        let uneven = each_lane(|i| {
            let near = (filled[i] - 1.0).clamp(-LEFT_ALONE[0], LEFT_ALONE[1]);
            filled[i] - near * bears[i]
        });
        store::<N>(out, column, uneven);
    }
}
