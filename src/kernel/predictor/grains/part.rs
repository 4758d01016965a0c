//! What takes part in friction: faces that a stress moves, and cells and corners that can have one.

use crate::{
    predictor::{
        grains::{
            bed::{At, Bed},
            cells::Cells,
            fields::Fields,
        },
        stencil::Axis,
        transfer::Faces,
        wide::{load, store},
    },
    simd::each_lane,
};

/// Least mass of a face, of a full one's: what is lighter would be moved at once by any stress.
const LEAST_MASS: f32 = 0.25;

/// Mass of a face in a bed, of one whose cells are full.
const COMPACT: f32 = 1.08;

/// Finds what a stress moves faces by.
pub(super) struct Lighten<'a> {
    pub faces: &'a Faces,
}

impl Cells<2> for Lighten<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, at: At, [u, v]: &mut [&mut [f32]; 2]) {
        let Self { faces } = self;
        let At { column, k, .. } = at;
        for (axis, out, counts) in [(Axis::U, u, &faces.u), (Axis::V, v, &faces.v)] {
            let counts = &counts[k..k + N];
            let density = match &faces.matter {
                Some(matter) => {
                    let of_faces = &matter.of(axis)[k..k + N];
                    each_lane(|i| of_faces[i][1])
                }
                None => [1.0; N],
            };
            let touched = bed.touched::<N>(axis, k);
            let open = bed.open::<N>(axis, at);
            let lightness = each_lane(|i| {
                let mass = (COMPACT * counts[i][0] / bed.full).clamp(LEAST_MASS, 1.0);
                let is_moved = (touched[i] > 0.0) & (open[i] > 0.0);
                if is_moved { density[i] / mass } else { 0.0 }
            });
            store::<N>(out, column, lightness);
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
///
/// Writes S and T, those that were laid by, and the steps of cells and of corners.
pub(super) struct TakePart<'a> {
    pub lightness: &'a Fields,
    pub strain: &'a Fields,
}

impl Cells<6> for TakePart<'_> {
    #[inline(always)]
    fn find<const N: usize>(&self, bed: &Bed, at: At, rows: &mut [&mut [f32]; 6]) {
        let Self { lightness: [u, v], strain } = self;
        let (At { row, column, k }, stride) = (at, bed.grid.stride);
        let [s, t, kept_s, kept_t, cells, corners] = rows;
        let liquid = load::<N>(bed.liquid, k);
        let [own_u, right] = [k, k + 1].map(|k| load::<N>(u, k));
        let [own_v, upper] = [k, k + stride].map(|k| load::<N>(v, k));
        let of_cells = each_lane(|i| {
            let (beside, above) = ([own_u[i], right[i]], [own_v[i], upper[i]]);
            let takes_part = (liquid[i] > 0.0) & (is_moved(beside) | is_moved(above));
            if takes_part { step(beside, above) } else { 0.0 }
        });
        store::<N>(cells, column, of_cells);
        lay_by_all(of_cells, (s, kept_s), load(&strain[0], k), bed, column);

        let (lower_u, left_v) = (load::<N>(u, k - stride), load::<N>(v, k - 1));
        let open_u = bed.open::<N>(Axis::U, at);
        let open_lower_u = bed.open::<N>(Axis::U, At { row: row - 1, ..at });
        let open_v = bed.open::<N>(Axis::V, at);
        let open_left_v = bed.open::<N>(Axis::V, At { column: column - 1, ..at });
        let of_corners = each_lane(|i| {
            // Corners of which a face is neither moved nor closed are beside the air: nothing is held there.
            let is_held = |lightness: f32, open: f32| (lightness > 0.0) | (open == 0.0);
            let (beside, above) = ([own_u[i], lower_u[i]], [own_v[i], left_v[i]]);
            let takes_part = (is_moved(beside) | is_moved(above))
                & (is_held(own_u[i], open_u[i]) & is_held(lower_u[i], open_lower_u[i]))
                & (is_held(own_v[i], open_v[i]) & is_held(left_v[i], open_left_v[i]));
            if takes_part { step(beside, above) } else { 0.0 }
        });
        store::<N>(corners, column, of_corners);
        lay_by_all(of_corners, (t, kept_t), load(&strain[1], k), bed, column);
    }
}

/// Whether a stress moves one of two faces.
#[inline(always)]
fn is_moved([one, other]: [f32; 2]) -> bool {
    (one > 0.0) | (other > 0.0)
}

/// A stable step, by the lightness of two faces and of those across.
#[inline(always)]
fn step([a, b]: [f32; 2], [c, d]: [f32; 2]) -> f32 {
    1.0 / (2.0 * (a + b + c + d) + (a - c).abs() + (a - d).abs() + (b - c).abs() + (b - d).abs())
}

/// Lays by the stress of those of some cells or corners that make no step, and gives the others theirs back.
#[inline(always)]
fn lay_by_all<const N: usize>(
    step: [f32; N],
    (stress, kept): (&mut [f32], &mut [f32]),
    strain: [f32; N],
    bed: &Bed,
    column: usize,
) {
    let [mut stresses, mut laid_by] = [&*stress, kept].map(|row| load::<N>(row, column));
    for i in 0..N {
        let (now, before) = (stresses[i], laid_by[i]);
        let goes = (step[i] == 0.0) & (now != 0.0);
        let comes = (step[i] != 0.0) & (before != 0.0);
        stresses[i] = if goes {
            0.0
        } else if comes {
            before
        } else {
            now
        };
        let left = if is_still(bed, strain[i]) { now } else { 0.0 };
        laid_by[i] = if goes {
            left
        } else if comes {
            0.0
        } else {
            before
        };
    }
    store(stress, column, stresses);
    store(kept, column, laid_by);
}
