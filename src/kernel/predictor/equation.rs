//! The rows of the pressure equation: what is done to each cell or face of a row, in lanes. The caller walks the rows.

use crate::predictor::{pockets::is_sealed, rock::Beside, transfer::Way};
use glam::IVec2;
use std::ops::Range;

/// Nearest that the surface is taken to be to a liquid cell's centre, cells, so that the equation stays bounded. Within
/// this the pressure does not follow the surface, and a wave there meets the wrong resistance: at 0.25 the period of
/// sloshing was off by up to 16 % at h = 2.5 d and 33 % at 3 d, depending on where in its cell the surface stood; at 0.05
/// by up to 2.7 %, and nothing costs more (docs/accuracy.md, "The surface").
const LEAST_THETA: f32 = 0.05;

/// Cells of a row that are done together where values are made on the way.
pub(super) const CHUNK: usize = 64;

/// Entries that are left out together where none of them is called for.
const LEFT_OUT: usize = 16;

/// From the first to the last of the marks that is not 0, rounded to whole pieces of [`LEFT_OUT`]; nothing if all are 0.
#[inline(always)]
pub(super) fn marked(marks: &[f32]) -> Range<usize> {
    let mut found = 0..0;
    for (k, piece) in marks.chunks(LEFT_OUT).enumerate() {
        if piece.iter().fold(false, |any, mark| any | (*mark != 0.0)) {
            let start = if found.is_empty() { k * LEFT_OUT } else { found.start };
            found = start..k * LEFT_OUT + piece.len();
        }
    }
    found
}

/// A row of cells, and its neighbours to all sides.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub centre: &'a [f32],
    pub left: &'a [f32],
    pub right: &'a [f32],
    pub lower: &'a [f32],
    pub upper: &'a [f32],
}

impl<'a> Around<'a> {
    /// The entries `cells` of a field and those around them.
    #[inline(always)]
    pub fn new(field: &'a [f32], cells: Range<usize>, stride: usize) -> Self {
        let Range { start, end } = cells;
        Self {
            centre: &field[start..end],
            left: &field[start - 1..end - 1],
            right: &field[start + 1..end + 1],
            lower: &field[start - stride..end - stride],
            upper: &field[start + stride..end + stride],
        }
    }
}

impl<'a> Around<'a> {
    /// The first `n` entries. The compiler sees from it that all are as long.
    #[inline(always)]
    pub fn first(self, n: usize) -> Self {
        let Self { centre, left, right, lower, upper } = self;
        Self { centre: &centre[..n], left: &left[..n], right: &right[..n], lower: &lower[..n], upper: &upper[..n] }
    }

    /// From the first to the last entry that is marked itself or beside one that is, as [`marked`] has it; of up to [`CHUNK`].
    #[inline(always)]
    pub fn marked(self) -> Range<usize> {
        let (n, mut marks) = (self.centre.len(), [0.0_f32; CHUNK]);
        let Self { centre, left, right, lower, upper } = self.first(n);
        for i in 0..n {
            marks[i] = (left[i] + right[i]) + (lower[i] + upper[i]) + centre[i];
        }
        marked(&marks[..n])
    }

    /// The cells on the side that lies `way` of each; the cells themselves for no way.
    #[inline(always)]
    pub fn on(self, way: IVec2) -> &'a [f32] {
        match way {
            IVec2::NEG_X => self.left,
            IVec2::X => self.right,
            IVec2::NEG_Y => self.lower,
            IVec2::Y => self.upper,
            _ => self.centre,
        }
    }

    /// A row of cells with one more at either end, and the rows below and above it.
    #[inline(always)]
    pub fn of_rows(lower: &'a [f32], own: &'a [f32], upper: &'a [f32]) -> Self {
        let n = lower.len();
        Self { centre: &own[1..=n], left: &own[..n], right: &own[2..n + 2], lower, upper: &upper[..n] }
    }
}

/// The faces of a row of cells.
#[derive(Clone, Copy)]
pub(super) struct Sides<'a, T> {
    left: &'a [T],
    right: &'a [T],
    lower: &'a [T],
    upper: &'a [T],
}

impl<'a, T> Sides<'a, T> {
    /// The faces of `cells`.
    #[inline(always)]
    pub fn new(u: &'a [T], v: &'a [T], cells: Range<usize>, stride: usize) -> Self {
        let Range { start, end } = cells;
        Self {
            left: &u[start..end],
            right: &u[start + 1..end + 1],
            lower: &v[start..end],
            upper: &v[start + stride..end + stride],
        }
    }
}

impl<'a, T> Sides<'a, T> {
    /// The first `n` of each. The compiler sees from it that all are as long.
    #[inline(always)]
    fn first(self, n: usize) -> Self {
        let Self { left, right, lower, upper } = self;
        Self { left: &left[..n], right: &right[..n], lower: &lower[..n], upper: &upper[..n] }
    }

    /// The faces of a row of cells from rows of their own: left faces with one more at the end, lower and upper ones.
    #[inline(always)]
    pub fn of_rows(u: &'a [T], lower: &'a [T], upper: &'a [T]) -> Self {
        Self { left: &u[..lower.len()], right: &u[1..], lower, upper }
    }
}

/// How full cells are: the sum of their faces' weights times `share`, and their rock.
#[inline(always)]
pub(super) fn fill(filled: &mut [f32], weights: Sides<[f32; 2]>, rock: &[f32], share: f32) {
    let n = filled.len();
    let (Sides { left, right, lower, upper }, rock) = (weights.first(n), &rock[..n]);
    for i in 0..n {
        filled[i] = share * (left[i][0] + right[i][0] + lower[i][0] + upper[i][0]) + rock[i];
    }
}

/// Marks cells that are full enough to be liquid.
#[inline(always)]
pub(super) fn mark(liquid: &mut [f32], filled: &[f32], liquid_from: &[f32]) {
    let n = liquid.len();
    let (filled, liquid_from) = (&filled[..n], &liquid_from[..n]);
    for i in 0..n {
        liquid[i] = if filled[i] >= liquid_from[i] { 1.0 } else { 0.0 };
    }
}

/// How steeply the pressure falls at faces between the cells before and after each: 1 between liquid cells, 1/θ between
/// a liquid one and air, where the surface (p = 0) lies θ cells from the liquid cell's centre (Enright et al. 2003; a
/// second-order surface). Without it all surfaces within one cell would be level, and a pool could rest with bumps.
///
/// Liquid that ends at the face fills the two cells by 1 and by the rock beyond the face: above it, where the liquid is below.
/// That rock is no liquid; counted as such it would lift the surface under a ledge, and water would climb to it.
///
/// Of the cells before and after each face it wants to know whether they are liquid and how full they are.
#[inline(always)]
pub(super) fn steepness(steep: &mut [f32], liquid: [&[f32]; 2], filled: [&[f32]; 2], beside: Beside) {
    let n = steep.len();
    let Beside { rock, after } = beside;
    let ([wet, wet_after], [filled_before, filled_after]) = (liquid, filled);
    let [rock_before, rock_after] = rock.map(|rock| &rock[..n]);
    let (wet, wet_after, filled_before, filled_after, after) =
        (&wet[..n], &wet_after[..n], &filled_before[..n], &filled_after[..n], &after[..n]);
    for i in 0..n {
        let beyond = if wet[i] > 0.0 { after[i] } else { rock_before[i] + rock_after[i] - after[i] };
        let theta = filled_before[i] + filled_after[i] - 0.5 - beyond;
        let theta = if theta > LEAST_THETA { theta } else { LEAST_THETA };
        let theta = if theta < 1.0 { theta } else { 1.0 };
        steep[i] = if wet[i] * wet_after[i] > 0.0 { 1.0 } else { 1.0 / theta };
    }
}

/// Couples liquid cells through the open shares of their faces.
#[inline(always)]
pub(super) fn couple(
    diagonal: &mut [f32],
    to_right: &mut [f32],
    to_upper: &mut [f32],
    liquid: Around,
    open: Sides<f32>,
    steep: Sides<f32>,
) {
    let n = diagonal.len();
    let (to_right, to_upper) = (&mut to_right[..n], &mut to_upper[..n]);
    let (liquid, open, steep) = (liquid.first(n), open.first(n), steep.first(n));
    for i in 0..n {
        let along = open.left[i] * steep.left[i] + open.right[i] * steep.right[i];
        let up = open.lower[i] * steep.lower[i] + open.upper[i] * steep.upper[i];
        diagonal[i] = liquid.centre[i] * (along + up);
        // Between liquid cells it falls by 1, or by the lightness of what is on the face.
        to_right[i] = liquid.centre[i] * open.right[i] * liquid.right[i] * steep.right[i];
        to_upper[i] = liquid.centre[i] * open.upper[i] * liquid.upper[i] * steep.upper[i];
    }
}

/// Makes the pressure at faces as much less steep as what is on them is heavier: 1/ρ. `matter` holds density and its
/// inverse, 0 where nothing is: there it is as steep as in the heaviest.
#[inline(always)]
pub(super) fn lighten(steep: &mut [f32], matter: &[[f32; 2]]) {
    for (steep, [_, lightness]) in steep.iter_mut().zip(matter) {
        *steep *= if *lightness > 0.0 { *lightness } else { 1.0 };
    }
}

/// Whether any of the cells has no liquid above it and no way to air on any side.
#[inline(always)]
pub(super) fn may_be_sealed(
    diagonal: &[f32],
    to_right: &[f32],
    to_upper: &[f32],
    liquid: Around,
    open: Sides<f32>,
    steep: Sides<f32>,
) -> bool {
    let (n, mut any) = (diagonal.len(), false);
    let (to_right, to_upper) = (&to_right[..n], &to_upper[..n]);
    let (liquid, open, steep) = (liquid.first(n), open.first(n), steep.first(n));
    for i in 0..n {
        let to_left = liquid.centre[i] * open.left[i] * liquid.left[i] * steep.left[i];
        let to_lower = liquid.centre[i] * open.lower[i] * liquid.lower[i] * steep.lower[i];
        let coupled = to_left + to_lower + to_right[i] + to_upper[i];
        any |= (diagonal[i] > 0.0) & (to_upper[i] == 0.0) & is_sealed(diagonal[i], coupled);
    }
    any
}

/// Most by which a cell may be asked to make up for the change of volume that a move of a substep brings with it.
const MOST_MADE_UP: f32 = 0.1;

/// Asks for the divergence that keeps volumes. A move `x + Δt u` changes a volume by `det(1 + Δt ∇u) = 1 + Δt ∇·u + Δt²
/// det ∇u`, so that not `∇·u = 0` keeps it but `∇·u = −Δt det ∇u`: what turns moves on along its tangents, and would
/// swell, what is sheared apart would shrink. With it the pressure is the one that takes a turning body round (`∇²p = 2
/// ρ det ∇u`), and the leapfrog is of second order in flows, too. The feedback would have to do it otherwise, too late,
/// and at the cost of angular momentum.
///
/// `faces`: weights and mean velocities (d/s) of left and lower faces. A slope is taken from the neighbours that have
/// `whole` particles or more.
#[inline(always)]
pub(super) fn keep_volumes(
    right_side: &mut [f32],
    [u, v]: [&[[f32; 2]]; 2],
    cells: Range<usize>,
    stride: usize,
    dt_per_cell: f32,
    whole: f32,
) {
    let n = right_side.len();
    let Range { start, end } = cells;
    let [below, own, above] = [start - stride, start, start + stride].map(|at| &u[at..at + n + 1]);
    let [lower, upper] = [start - 1..end + 1, start - 1 + stride..end + 1 + stride].map(|row| &v[row]);
    let most = MOST_MADE_UP / dt_per_cell;
    for i in 0..n {
        // Differences across the cell, d/s; the trace is left out: the divergence is to go.
        let stretch = 0.5 * ((own[i + 1][1] - own[i][1]) - (upper[i + 1][1] - lower[i + 1][1]));
        let along_y = slope([below[i], below[i + 1]], [own[i], own[i + 1]], [above[i], above[i + 1]], whole);
        let along_x = slope([lower[i], upper[i]], [lower[i + 1], upper[i + 1]], [lower[i + 2], upper[i + 2]], whole);
        let wanted = dt_per_cell * (stretch * stretch + along_x * along_y);
        let wanted = if wanted < most { wanted } else { most };
        right_side[i] = if wanted > -most { wanted } else { -most };
    }
}

/// Difference of the velocity across a cell, from the faces before it, on it and after it: the mean of those to either
/// side that are known.
#[inline(always)]
fn slope(before: [[f32; 2]; 2], own: [[f32; 2]; 2], after: [[f32; 2]; 2], whole: f32) -> f32 {
    let mean = |[a, b]: [[f32; 2]; 2]| 0.5 * (a[1] + b[1]);
    let known = |[a, b]: [[f32; 2]; 2]| if (a[0] >= whole) & (b[0] >= whole) { 1.0 } else { 0.0 };
    let (has_before, has_after): (f32, f32) = (known(before), known(after));
    let sum = has_before * (mean(own) - mean(before)) + has_after * (mean(after) - mean(own));
    let count = has_before + has_after;
    sum / if count > 1.0 { count } else { 1.0 }
}

/// Share of the heaviest matter's density from which on a cell asks in full for what keeps its volume.
const WEIGHTY: f32 = 0.05;

/// Makes what [`keep_volumes`] asks for as much less as cells are lighter than [`WEIGHTY`]. What turns gas round is a pressure of
/// its own density times its speed squared; asked for to the last bit in a bubble whose slopes the grid does not resolve, it
/// swells the bubble with whatever lies on top: 2 m of mercury were thrown up by hydrogen that turned round at 18 m/s.
///
/// `densities`: of the faces, shares of the heaviest's.
#[inline(always)]
pub(super) fn spare_the_heavy(right_side: &mut [f32], densities: Sides<[f32; 2]>) {
    let n = right_side.len();
    let densities = densities.first(n);
    for i in 0..n {
        let [left, right] = [densities.left[i][0], densities.right[i][0]];
        let [lower, upper] = [densities.lower[i][0], densities.upper[i][0]];
        let share = 0.25 / WEIGHTY * (left + right + lower + upper);
        right_side[i] *= if share < 1.0 { share } else { 1.0 };
    }
}

/// Takes the divergence of the velocities off the right-hand side of liquid cells; 0 in the others.
#[inline(always)]
pub(super) fn subtract_divergence(right_side: &mut [f32], liquid: &[f32], open: Sides<f32>, faces: Sides<[f32; 2]>) {
    let n = right_side.len();
    let (liquid, open, faces) = (&liquid[..n], open.first(n), faces.first(n));
    for i in 0..n {
        let divergence = open.right[i] * faces.right[i][1] - open.left[i] * faces.left[i][1]
            + open.upper[i] * faces.upper[i][1]
            - open.lower[i] * faces.lower[i][1];
        right_side[i] = liquid[i] * (right_side[i] - divergence);
    }
}

/// What a potential changes on faces between the cells before and after each. Closed faces stop the share `stopped` of
/// what they had.
#[inline(always)]
pub(super) fn touch(
    change: &mut [f32],
    [before, after]: [&[f32]; 2],
    open: &[f32],
    steep: &[f32],
    means: &[[f32; 2]],
    stopped: f32,
) {
    let n = change.len();
    let (before, after, open, steep, means) = (&before[..n], &after[..n], &open[..n], &steep[..n], &means[..n]);
    for i in 0..n {
        let (gained, lost) = (steep[i] * (before[i] - after[i]), stopped * means[i][1]);
        change[i] = if open[i] > 0.0 { gained } else { -lost };
    }
}

/// The ways: both changes, or the means of the neighbours' where they are not known.
#[inline(always)]
pub(super) fn fill_in(ways: &mut [Way], changes: [Around; 2], known: Around) {
    let n = ways.len();
    let ([gained, drift], known) = (changes.map(|change| change.first(n)), known.first(n));
    for i in 0..n {
        let around = (known.left[i] + known.right[i]) + (known.lower[i] + known.upper[i]);
        let share = 1.0 / if around > 0.5 { around } else { 0.5 };
        let by_pressure = share * ((gained.left[i] + gained.right[i]) + (gained.lower[i] + gained.upper[i]));
        let by_potential = share * ((drift.left[i] + drift.right[i]) + (drift.lower[i] + drift.upper[i]));
        let (own, is_known) = ([gained.centre[i], drift.centre[i]], known.centre[i] > 0.0);
        let gained = if is_known { own[0] } else { by_pressure };
        let drift = if is_known { own[1] } else { by_potential };
        ways[i] = [gained, drift];
    }
}
