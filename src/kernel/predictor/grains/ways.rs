//! From the stress to the faces, and what they do to grains.

use crate::{
    parallel::{Rows, Sweep, sweep},
    predictor::{
        grains::{bed::Bed, cells::At, friction::Friction, near::Near},
        level::WORTH_A_PIECE,
        pieces::Pieces,
        stencil::Axis,
        transfer::{Faces, Way},
    },
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

/// Pieces of a row, with the padding before the first column.
#[inline(always)]
fn with_padding(pieces: &Pieces, row: usize) -> impl Iterator<Item = Range<usize>> + use<'_> {
    pieces.runs(row).map(|run| if run.start == 1 { 0..run.end } else { run })
}

/// The faces beside a face.
#[inline(always)]
fn around(k: usize, stride: usize) -> [usize; 4] {
    [k.saturating_sub(1), k + 1, k.saturating_sub(stride), k + stride]
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
        let Self { bed, pieces, beside, gained, axis } = self;
        let stride = bed.grid.stride;
        for (j, ways) in rows.zip(ways.each()).filter(|(j, _)| beside.contains(j)) {
            for columns in with_padding(pieces, j) {
                for column in columns {
                    let k = bed.grid.row(j) + column;
                    let is_touched = |k: usize| k >= stride && bed.is_touched(*axis, k);
                    if is_touched(k) {
                        ways[column][0] += gained[k];
                        continue;
                    }
                    let (mut sum, mut count) = (0.0, 0.0);
                    for other in around(k, stride).into_iter().filter(|other| is_touched(*other)) {
                        (sum, count) = (sum + gained[other], count + 1.0);
                    }
                    ways[column][0] += if count > 0.0 { sum / count } else { 0.0 };
                }
            }
        }
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
        let Self { bed, pieces, beside, means, ways, axis } = self;
        let stride = bed.grid.stride;
        let is_moved = |k: usize| k >= stride && bed.is_moved(*axis, k);
        let velocity = |k: usize| means[k][1] + ways[k][0];
        for (j, out) in rows.zip(out.each()) {
            if !beside.contains(&j) {
                with_padding(pieces, j).for_each(|columns| out[columns].fill([0.0; 2]));
                continue;
            }
            for columns in with_padding(pieces, j) {
                for column in columns {
                    let k = bed.grid.row(j) + column;
                    if k >= stride && bed.is_touched(*axis, k) {
                        // A closed face is a wall.
                        let [open] = bed.open::<1>(*axis, At { row: j, column, k });
                        out[column] = [if open > 0.0 { velocity(k) } else { 0.0 }, 1.0];
                        continue;
                    }
                    let (mut sum, mut count) = (0.0, 0.0);
                    for other in around(k, stride).into_iter().filter(|other| is_moved(*other)) {
                        (sum, count) = (sum + velocity(other), count + 1.0);
                    }
                    out[column] = if count > 0.0 { [sum / count, 1.0] } else { [0.0; 2] };
                }
            }
        }
    }
}
