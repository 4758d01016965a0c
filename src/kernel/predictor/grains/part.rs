//! What takes part in friction: faces that a stress moves, and cells and corners that can have one.

use crate::{
    parallel::Sweep,
    predictor::{
        grains::{
            bed::Bed,
            fields::{Fields, Two},
        },
        stencil::Axis,
        transfer::Faces,
    },
};
use std::ops::Range;

/// Least mass of a face, of a full one's: what is lighter would be moved at once by any stress.
const LEAST_MASS: f32 = 0.25;

/// Mass of a face in a bed, of one whose cells are full.
const COMPACT: f32 = 1.08;

/// Finds what a stress moves faces by.
pub(super) struct Lighten<'a> {
    pub bed: &'a Bed<'a>,
    pub columns: Range<usize>,
    pub faces: &'a Faces,
}

impl<'b> Sweep<Two<'b>> for Lighten<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut u, mut v): Two) {
        let Self { bed, columns, faces } = self;
        for (j, (u, v)) in rows.zip(u.each().zip(v.each())) {
            for (axis, lightness, counts) in [(Axis::U, u, &faces.u), (Axis::V, v, &faces.v)] {
                for column in columns.clone() {
                    let k = bed.grid.row(j) + column;
                    let is_moved = bed.is_touched(axis, k) && bed.open(axis, k) > 0.0;
                    let mass = (COMPACT * counts[k][0] / bed.full).clamp(LEAST_MASS, 1.0);
                    let density = faces.matter.as_ref().map_or(1.0, |matter| matter.of(axis)[k][1]);
                    lightness[column] = if is_moved { density / mass } else { 0.0 };
                }
            }
        }
    }
}

/// Strain of a substep up to which grains are still, in g Δt a cell.
const STILL: f32 = 0.1;

/// Whether a strain (d/s a cell) is next to none.
#[inline(always)]
pub(super) fn is_still(bed: &Bed, strain: f32) -> bool {
    strain <= STILL * bed.kick.length()
}

/// Takes the stress of what takes no part any more, and lays it by if it was still: it may have fallen asleep. What moved is gone,
/// and its stress would stir what comes there next.
#[inline(always)]
pub(super) fn lay_by(stress: &mut f32, kept: &mut f32, is_still: bool) {
    if *stress != 0.0 {
        (*stress, *kept) = (0.0, if is_still { *stress } else { 0.0 });
    }
}

/// Finds how far cells and corners step along the gradient, not at all those that take no part: these have no stress.
///
/// **The bound.** What stresses x change the faces by has the energy `½ Σ l (ΔS + ΔT)²` over the faces, l their lightness, and a step
/// along its gradient is stable if it is no longer than what a diagonal D with `Σ l (ΔS + ΔT)² ≤ xᵀ D⁻¹ x` has. Where l is the
/// same everywhere the products ΔS ΔT add up to 0, for any stress; so with any constant m, they are those of `l − m`, and
/// `Σ l (ΔS + ΔT)² ≤ Σ (l + |l − m|) (ΔS² + ΔT²)`. As `ΔS² ≤ 2 (S² + S'²)`, D is `½ / Σ (l + |l − m|)` over the faces around.
pub(super) struct TakePart<'a> {
    pub bed: &'a Bed<'a>,
    pub columns: Range<usize>,
    pub lightness: &'a Fields,
    /// m: what most faces among grains have.
    pub mean: f32,
    pub strain: &'a Fields,
}

impl<'b> Sweep<((Two<'b>, Two<'b>), Two<'b>)> for TakePart<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((stress, kept), (mut cells, mut corners)): ((Two, Two), Two)) {
        let Self { bed, columns, lightness: [u, v], mean, strain } = self;
        let stride = bed.grid.stride;
        let step =
            |around: [f32; 4]| 0.5 / around.iter().map(|lightness| lightness + (lightness - mean).abs()).sum::<f32>();
        let ((mut s, mut t), (mut kept_s, mut kept_t)) = (stress, kept);
        let stress = s.each().zip(kept_s.each()).zip(t.each().zip(kept_t.each()));
        for (j, (((s, kept_s), (t, kept_t)), (cells, corners))) in
            rows.zip(stress.zip(cells.each().zip(corners.each())))
        {
            for column in columns.clone() {
                let k = bed.grid.row(j) + column;
                // Corners of which a face is neither moved nor closed are beside the air: nothing is held there.
                let is_held = |axis, k, lightness: f32| lightness > 0.0 || bed.open(axis, k) == 0.0;
                let around = [u[k], u[k - stride], v[k], v[k - 1]];
                let is_moved = |around: [f32; 4]| around.iter().any(|lightness| *lightness > 0.0);
                let takes_part = is_moved(around)
                    && is_held(Axis::U, k, u[k])
                    && is_held(Axis::U, k - stride, u[k - stride])
                    && is_held(Axis::V, k, v[k])
                    && is_held(Axis::V, k - 1, v[k - 1]);
                corners[column] = if takes_part { step(around) } else { 0.0 };
                let around = [u[k], u[k + 1], v[k], v[k + stride]];
                cells[column] = if bed.is_liquid(k) && is_moved(around) { step(around) } else { 0.0 };
                let fields = [(cells[column], &mut *s, &mut *kept_s), (corners[column], &mut *t, &mut *kept_t)];
                for ((step, stress, kept), strain) in fields.into_iter().zip(strain.iter()) {
                    let (stress, kept) = (&mut stress[column], &mut kept[column]);
                    if step == 0.0 {
                        lay_by(stress, kept, is_still(bed, strain[k]));
                    } else if *kept != 0.0 {
                        (*stress, *kept) = (*kept, 0.0);
                    }
                }
            }
        }
    }
}
