//! The two passes of the exchange of rock with rock: lanes over sites that follow each other in a row, and those at the same
//! distance from each side by side.

use super::{
    exchanged::Exchanged,
    lumps::Lumps,
    sites::{PIECE, REACHED, ROWS},
    weights::weight_between,
};
use crate::simd::{Lanes, Pass};
use glam::Vec2;

/// Sites that a site reaches.
const REACHES: usize = 20;

/// One of them.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    /// Its row, from the lowest that is reached.
    row: usize,
    /// How far before (negative) or behind it stands.
    along: isize,
    weight: f32,
}

/// The sites that a site reaches, with their weights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Steps([Step; REACHES]);

impl Default for Steps {
    fn default() -> Self {
        let reached = REACHED as isize;
        let all = (0..ROWS).flat_map(|row| (-reached..=reached).map(move |along| (row, along)));
        let all = all.filter(|step| *step != (REACHED, 0)).map(|(row, along)| {
            let weight = weight_between(Vec2::ZERO, Vec2::new(along as f32, row as f32 - REACHED as f32));
            Step { row, along, weight }
        });
        let mut steps = all.filter(|step| step.weight > 0.0);
        Self(std::array::from_fn(|_| steps.next().unwrap_or_default()))
    }
}

/// Pieces of sites in which anything flows.
#[derive(Clone, Copy)]
pub(super) struct Lattice<'a> {
    pub lumps: &'a Lumps,
    pub steps: &'a Steps,
    /// Cells in which anything flows.
    pub flows: &'a [bool],
}

impl Lattice<'_> {
    /// Shows `visit` the lanes of so many sites from `base` on: the first of them, and where the sites below and above it are, row by
    /// row from the lowest that it reaches.
    #[inline(always)]
    fn each<L: Lanes>(self, base: usize, len: usize, mut visit: impl FnMut(usize, [usize; ROWS])) {
        for first in (base..base + len).step_by(PIECE) {
            let cells = &self.lumps.cell[first..first + PIECE];
            let Some(rows) = self.lumps.sites.rows_around(first) else { continue };
            if cells.iter().any(|cell| self.flows[*cell as usize]) {
                for lane in (0..PIECE).step_by(L::WIDTH) {
                    visit(first + lane, rows.map(|row| row + lane));
                }
            }
        }
    }

    /// What sites reach: where the first of those is, and their weight.
    #[inline(always)]
    fn reached(self, rows: [usize; ROWS]) -> impl Iterator<Item = (usize, f32)> {
        let Self { steps: Steps(steps), .. } = self;
        steps.iter().map(move |step| (rows[step.row].wrapping_add_signed(step.along), step.weight))
    }
}

/// Finds how much rock is around each site. Pieces in which nothing flows are left as they are.
pub(super) struct LookAcross<'a> {
    pub lattice: Lattice<'a>,
    pub conduction: &'a [f32],
    /// The first site of those that are written.
    pub base: usize,
    /// Out: weights, and weights times √k′, together.
    pub out: [&'a mut [f32]; 2],
}

impl Pass for LookAcross<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { lattice, conduction, base, out: [whole, through] } = self;
        let present = &lattice.lumps.present[..];
        lattice.each::<L>(base, whole.len(), |first, rows| {
            let mut sums = [L::splat(0.0); 2];
            for (at, weight) in lattice.reached(rows) {
                let weight = L::splat(weight);
                sums = [sums[0] + weight * L::of(present, at), sums[1] + weight * L::of(conduction, at)];
            }
            sums[0].put(whole, first - base);
            sums[1].put(through, first - base);
        });
    }
}

/// Finds what flows in a step. Pieces in which nothing flows get nothing.
pub(super) struct FlowAcross<'a> {
    pub lattice: Lattice<'a>,
    pub exchanged: Exchanged<'a>,
    /// The first site of those that are written.
    pub base: usize,
    /// Out: what they gain, quanta.
    pub gained: &'a mut [i32],
}

impl Pass for FlowAcross<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { lattice, exchanged, base, gained } = self;
        gained.fill(0);
        lattice.each::<L>(base, gained.len(), |first, rows| {
            let own = exchanged.own(|field| L::of(field, first));
            let mut sums = L::no_sums();
            for (at, weight) in lattice.reached(rows) {
                let flow = own.flow(&exchanged, L::splat(weight), |field| L::of(field, at));
                sums = flow.add_rounded(sums);
            }
            gained[first - base..first - base + L::WIDTH].copy_from_slice(&L::sums(sums)[..L::WIDTH]);
        });
    }
}
