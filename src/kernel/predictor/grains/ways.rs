//! From the stress to the faces, and what they do to grains.

use crate::{
    parallel::{Rows, Sweep, sweep},
    predictor::{
        grains::{
            bed::{At, Bed},
            friction::Friction,
            near::Near,
        },
        level::WORTH_A_PIECE,
        pieces::Pieces,
        stencil::Axis,
        transfer::{Faces, Way},
        wide::{Wide, in_lanes, load},
    },
    simd::each_lane,
};
use std::ops::Range;

/// What grains near a face are drawn to: a velocity, d/s, and 1 where it is known, else twice 0.
pub(in crate::predictor) type GrainWay = [f32; 2];

impl Friction {
    /// Adds what the stress changes to the faces' ways, and finds what grains are drawn to: the velocity of what moves together,
    /// with a layer around it.
    pub fn hand_over(&mut self, bed: &Bed, near: &Near, faces: &mut Faces, ways: &mut [Vec<GrainWay>; 2]) {
        let grid = bed.grid;
        let Faces { u, v, ways: [ways_u, ways_v], .. } = faces;
        let beside = (bed.rows.start - 1)..(bed.rows.end + 2).min(grid.rows + 2);
        let [stressed, reached] = [near.now(), near.reached()];
        for (axis, means, own, out) in [(Axis::U, &*u, ways_u, 0), (Axis::V, &*v, ways_v, 1)] {
            let rows = stressed.rows();
            let work = AddGains { bed, pieces: stressed, beside: &beside, gained: &self.gained[axis as usize], axis };
            let band = Rows::new(own, grid.stride, &rows);
            sweep(&work, rows.clone(), band, near.per_row(), WORTH_A_PIECE, bed.team);
            let (out, rows) = (&mut ways[out], reached.rows());
            out.resize(grid.len(), [0.0; 2]);
            let work = Draw { bed, pieces: reached, beside: &beside, means, ways: own, axis };
            let band = Rows::new(out, grid.stride, &rows);
            sweep(&work, rows.clone(), band, reached.per_row().max(1), WORTH_A_PIECE, bed.team);
        }
    }
}

/// Runs of faces of a row, with the padding before the first column as one of its own.
#[inline(always)]
fn with_padding(pieces: &Pieces, row: usize) -> impl Iterator<Item = Range<usize>> + use<'_> {
    pieces.runs(row).flat_map(|run| [if run.start == 1 { 0..1 } else { 0..0 }, run])
}

/// The faces of a cell that has a pressure, 1, and others, 0: some faces side by side and those beside them.
struct Touched<const N: usize> {
    own: [f32; N],
    left: [f32; N],
    right: [f32; N],
    lower: [f32; N],
    upper: [f32; N],
}

impl<const N: usize> Touched<N> {
    #[inline(always)]
    fn new(bed: &Bed, axis: Axis, At { row, column, k }: At) -> Self {
        let (stride, none) = (bed.grid.stride, [0.0; N]);
        // There is nothing below the padding and before it.
        Self {
            own: if row > 0 { bed.touched(axis, k) } else { none },
            left: if row > 0 && column > 0 { bed.touched(axis, k - 1) } else { none },
            right: if row > 0 { bed.touched(axis, k + 1) } else { none },
            lower: if row > 1 { bed.touched(axis, k - stride) } else { none },
            upper: bed.touched(axis, k + stride),
        }
    }

    /// Those of the faces beside that are open.
    #[inline(always)]
    fn moved(self, bed: &Bed, axis: Axis, at: At) -> Self {
        let At { row, column, .. } = at;
        let moved = |touched: [f32; N], at: At| {
            let open = bed.open::<N>(axis, at);
            each_lane(|i| if open[i] > 0.0 { touched[i] } else { 0.0 })
        };
        Self {
            own: self.own,
            left: if column > 0 { moved(self.left, At { column: column - 1, ..at }) } else { self.left },
            right: moved(self.right, At { column: column + 1, ..at }),
            lower: if row > 0 { moved(self.lower, At { row: row - 1, ..at }) } else { self.lower },
            upper: moved(self.upper, At { row: row + 1, ..at }),
        }
    }

    /// The mean of what `of` says of those beside by their index, and how many that are.
    #[inline(always)]
    fn mean(&self, k: usize, stride: usize, of: impl Fn(usize) -> [f32; N]) -> [[f32; N]; 2] {
        let Self { left, right, lower, upper, .. } = self;
        let (at_left, at_right) = (of(k.saturating_sub(1)), of(k + 1));
        let (at_lower, at_upper) = (of(k.saturating_sub(stride)), of(k + stride));
        let of_side = |touched: f32, value: f32| if touched > 0.0 { value } else { 0.0 };
        let counts = each_lane::<N, _>(|i| ((left[i] + right[i]) + lower[i]) + upper[i]);
        let means = each_lane(|i| {
            let sum = (of_side(left[i], at_left[i]) + of_side(right[i], at_right[i])) + of_side(lower[i], at_lower[i]);
            let sum = sum + of_side(upper[i], at_upper[i]);
            if counts[i] > 0.0 { sum / counts[i] } else { 0.0 }
        });
        [means, counts]
    }
}

/// Adds what friction changes, beside the bed the mean of it.
struct AddGains<'a> {
    bed: &'a Bed<'a>,
    pieces: &'a Pieces,
    /// Rows of the bed, with one on either side.
    beside: &'a Range<usize>,
    gained: &'a [f32],
    axis: Axis,
}

impl Sweep<Rows<'_, Way>> for AddGains<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut ways: Rows<Way>) {
        for (row, ways) in rows.zip(ways.each()).filter(|(row, _)| self.beside.contains(row)) {
            for columns in with_padding(self.pieces, row) {
                in_lanes(columns, AddToRow { work: self, row, ways });
            }
        }
    }
}

struct AddToRow<'a> {
    work: &'a AddGains<'a>,
    row: usize,
    ways: &'a mut [Way],
}

impl Wide for AddToRow<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, column: usize) {
        let AddGains { bed, gained, axis, .. } = self.work;
        let (row, k) = (self.row, bed.grid.row(self.row) + column);
        let touched = Touched::<N>::new(bed, *axis, At { row, column, k });
        let own = load::<N>(gained, k);
        let [beside, _] = touched.mean(k, bed.grid.stride, |k| load(gained, k));
        let more = each_lane::<N, _>(|i| if touched.own[i] > 0.0 { own[i] } else { beside[i] });
        self.ways[column..column + N].iter_mut().zip(more).for_each(|(way, more)| way[0] += more);
    }
}

/// Finds what grains are drawn to.
struct Draw<'a> {
    bed: &'a Bed<'a>,
    pieces: &'a Pieces,
    /// Rows of the bed, with one on either side.
    beside: &'a Range<usize>,
    means: &'a [[f32; 2]],
    ways: &'a [Way],
    axis: Axis,
}

impl Sweep<Rows<'_, GrainWay>> for Draw<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut out: Rows<GrainWay>) {
        for (row, out) in rows.zip(out.each()) {
            for columns in with_padding(self.pieces, row) {
                if self.beside.contains(&row) {
                    in_lanes(columns, DrawRow { work: self, row, out });
                } else {
                    out[columns].fill([0.0; 2]);
                }
            }
        }
    }
}

struct DrawRow<'a> {
    work: &'a Draw<'a>,
    row: usize,
    out: &'a mut [GrainWay],
}

impl Wide for DrawRow<'_> {
    #[inline(always)]
    fn run<const N: usize>(&mut self, column: usize) {
        let Draw { bed, means, ways, axis, .. } = self.work;
        let at = At { row: self.row, column, k: bed.grid.row(self.row) + column };
        let velocity = |k: usize| -> [f32; N] {
            let (means, ways) = (&means[k..k + N], &ways[k..k + N]);
            each_lane(|i| means[i][1] + ways[i][0])
        };
        let touched = Touched::<N>::new(bed, *axis, at).moved(bed, *axis, at);
        let (own, open) = (velocity(at.k), bed.open::<N>(*axis, at));
        let [beside, counts] = touched.mean(at.k, bed.grid.stride, velocity);
        for (i, out) in self.out[column..column + N].iter_mut().enumerate() {
            // A closed face is a wall.
            let own = if open[i] > 0.0 { own[i] } else { 0.0 };
            let is_touched = touched.own[i] > 0.0;
            *out = [if is_touched { own } else { beside[i] }, if is_touched | (counts[i] > 0.0) { 1.0 } else { 0.0 }];
        }
    }
}
