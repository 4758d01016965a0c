//! What takes part in friction: faces that a stress moves, and cells and corners that can have one.

use crate::{
    parallel::Sweep,
    predictor::{
        grains::{
            bed::Bed,
            fields::{Fields, Two},
            near::Near,
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
    pub near: &'a Near,
    pub faces: &'a Faces,
}

impl<'b> Sweep<Two<'b>> for Lighten<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, (mut u, mut v): Two) {
        let Self { bed, near, faces } = self;
        for (j, (u, v)) in rows.zip(u.each().zip(v.each())) {
            for (axis, lightness, counts) in [(Axis::U, u, &faces.u), (Axis::V, v, &faces.v)] {
                for columns in near.runs(j) {
                    for column in columns {
                        let k = bed.grid.row(j) + column;
                        let mass = (COMPACT * counts[k][0] / bed.full).clamp(LEAST_MASS, 1.0);
                        let density = faces.matter.as_ref().map_or(1.0, |matter| matter.of(axis)[k][1]);
                        lightness[column] = if bed.is_moved(axis, k) { density / mass } else { 0.0 };
                    }
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
/// **The bound.** What the stresses change the faces by has the energy `½ Σ l (ΔS + ΔT)²` over the faces, l their lightness: a
/// quadratic form of a matrix A. Along its gradient a step of 1 over the sum of the magnitudes of a row of A is stable for each of
/// its stresses, whatever the others do (Gershgorin). In the row of a cell or a corner stand the lightness of the four faces
/// around it (Σ l on the diagonal, and l for the next of its kind beyond each), and for each of the four of the other kind around it
/// the difference of the two faces between them, u and v: `2 Σ l + Σ |l_u − l_v|`.
pub(super) struct TakePart<'a> {
    pub bed: &'a Bed<'a>,
    pub near: &'a Near,
    pub lightness: &'a Fields,
    pub strain: &'a Fields,
}

impl<'b> Sweep<((Two<'b>, Two<'b>), Two<'b>)> for TakePart<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, ((stress, kept), (mut cells, mut corners)): ((Two, Two), Two)) {
        let Self { bed, near, lightness: [u, v], strain } = self;
        let stride = bed.grid.stride;
        let step = |[a, b]: [f32; 2], [c, d]: [f32; 2]| {
            1.0 / (2.0 * (a + b + c + d) + (a - c).abs() + (a - d).abs() + (b - c).abs() + (b - d).abs())
        };
        let ((mut s, mut t), (mut kept_s, mut kept_t)) = (stress, kept);
        let stress = s.each().zip(kept_s.each()).zip(t.each().zip(kept_t.each()));
        for (j, (((s, kept_s), (t, kept_t)), (cells, corners))) in
            rows.zip(stress.zip(cells.each().zip(corners.each())))
        {
            for columns in near.runs(j) {
                for column in columns {
                    let k = bed.grid.row(j) + column;
                    // Corners of which a face is neither moved nor closed are beside the air: nothing is held there.
                    let is_held = |axis, k, lightness: f32| lightness > 0.0 || bed.open(axis, k) == 0.0;
                    let (beside, above) = ([u[k], u[k - stride]], [v[k], v[k - 1]]);
                    let is_moved = |faces: [f32; 2]| faces[0] > 0.0 || faces[1] > 0.0;
                    let takes_part = (is_moved(beside) || is_moved(above))
                        && is_held(Axis::U, k, u[k])
                        && is_held(Axis::U, k - stride, u[k - stride])
                        && is_held(Axis::V, k, v[k])
                        && is_held(Axis::V, k - 1, v[k - 1]);
                    corners[column] = if takes_part { step(beside, above) } else { 0.0 };
                    let (beside, above) = ([u[k], u[k + 1]], [v[k], v[k + stride]]);
                    let takes_part = bed.is_liquid(k) && (is_moved(beside) || is_moved(above));
                    cells[column] = if takes_part { step(beside, above) } else { 0.0 };
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
}
