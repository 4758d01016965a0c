//! From the stress to the faces, and what they do to grains.

use crate::{
    parallel::{Rows, Sweep, sweep},
    predictor::{
        grains::{bed::Bed, fields::Fields, friction::Friction},
        level::WORTH_A_PIECE,
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
    pub fn hand_over(&mut self, bed: &Bed, faces: &mut Faces, ways: &mut [Vec<GrainWay>; 2]) {
        let grid = bed.grid;
        let Faces { u, v, ways: [ways_u, ways_v], reached, area, .. } = faces;
        let near = (bed.rows.start - 1)..(bed.rows.end + 2).min(grid.rows + 2);
        let all = reached.start.min(near.start)..reached.end.max(near.end);
        let columns = grid.padded(area);
        for (axis, means, own, out) in [(Axis::U, &*u, ways_u, 0), (Axis::V, &*v, ways_v, 1)] {
            let out = &mut ways[out];
            out.resize(grid.len(), [0.0; 2]);
            let Self { lightness, gained, .. } = &*self;
            let work = AddGains { bed, columns: columns.clone(), near: near.clone(), gained, axis };
            sweep(&work, all.clone(), Rows::new(own, grid.stride, &all), columns.len(), WORTH_A_PIECE, bed.team);
            let work = Draw { bed, columns: columns.clone(), near: near.clone(), lightness, means, ways: own, axis };
            sweep(&work, all.clone(), Rows::new(out, grid.stride, &all), columns.len(), WORTH_A_PIECE, bed.team);
        }
    }
}

/// The faces beside a face.
#[inline(always)]
fn around(k: usize, stride: usize) -> [usize; 4] {
    [k.saturating_sub(1), k + 1, k.saturating_sub(stride), k + stride]
}

/// Adds what friction changes, beside the bed the mean of it.
struct AddGains<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    near: Range<usize>,
    gained: &'a Fields,
    axis: Axis,
}

impl Sweep<Rows<'_, Way>> for AddGains<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut ways: Rows<Way>) {
        let Self { bed, columns, near, gained, axis } = self;
        let (gained, stride) = (&gained[*axis as usize], bed.grid.stride);
        for (j, ways) in rows.zip(ways.each()).filter(|(j, _)| near.contains(j)) {
            for column in columns.clone() {
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

/// Finds what grains are drawn to.
struct Draw<'a> {
    bed: &'a Bed<'a>,
    columns: Range<usize>,
    near: Range<usize>,
    lightness: &'a Fields,
    means: &'a [[f32; 2]],
    ways: &'a [Way],
    axis: Axis,
}

impl Sweep<Rows<'_, GrainWay>> for Draw<'_> {
    #[inline(always)]
    fn run(&self, rows: Range<usize>, mut out: Rows<GrainWay>) {
        let Self { bed, columns, near, lightness, means, ways, axis } = self;
        let (lightness, stride) = (&lightness[*axis as usize], bed.grid.stride);
        let velocity = |k: usize| means[k][1] + ways[k][0];
        for (j, out) in rows.zip(out.each()) {
            if !near.contains(&j) {
                out[columns.clone()].fill([0.0; 2]);
                continue;
            }
            for column in columns.clone() {
                let k = bed.grid.row(j) + column;
                if lightness[k] > 0.0 {
                    out[column] = [velocity(k), 1.0];
                    continue;
                }
                if k >= stride && bed.is_touched(*axis, k) {
                    // A wall.
                    out[column] = [0.0, 1.0];
                    continue;
                }
                let (mut sum, mut count) = (0.0, 0.0);
                for other in around(k, stride).into_iter().filter(|other| lightness[*other] > 0.0) {
                    (sum, count) = (sum + velocity(other), count + 1.0);
                }
                out[column] = if count > 0.0 { [sum / count, 1.0] } else { [0.0; 2] };
            }
        }
    }
}
