//! What pass 1 reads, and the flow through a face.

use super::{law::heads, shape::Shape};
use crate::simd::{InstructionSet, Lanes};

/// Part κ of the wave solution that a face follows, 0 … ½. Raising it kills alternating pressure sooner and damps
/// sound: a wave of 20 cells loses `κ` × 0.8 of its height a wavelength. Changing this affects the stability limit
/// (`pressure`).
pub(super) const FACE_FILTER: f32 = 1.0 / 16.0;

/// What pass 1 reads.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) pressure: &'a [f32],
    pub(super) velocity_x: &'a [f32],
    pub(super) velocity_y: &'a [f32],
    /// How much warmer than the surroundings it is, where any of it is.
    pub(super) warmth: Option<&'a [f32]>,
    pub(super) shape: &'a Shape,
    /// What the left and the lower face of each cell let through, 0 … 1.
    pub(super) open: [&'a [f32]; 2],
    /// Values between a cell and the one above it.
    pub(super) stride: usize,
    /// Columns at hand, counted with the ring, and one more on either side: rows are counted from the first of them.
    pub(super) left: usize,
    /// How many these are.
    pub(super) width: usize,
    /// ½ dt/cell: from the sum of two velocities to a face's flow.
    pub(super) half: f32,
    /// `κ c·dt/cell`.
    pub(super) filter: f32,
    /// Whether shares know how the velocity changes within their cell.
    pub(super) second_order: bool,
    /// Where heads are not the pressures themselves, as one may be too high for that (`law`) or the air is warm: what they are
    /// found on.
    pub(super) strong: Option<InstructionSet>,
}

impl<'a> Source<'a> {
    /// Where the columns at hand of a row begin in the fields.
    #[inline(always)]
    pub(super) fn start(&self, row: usize) -> usize {
        row * self.stride + self.left
    }

    /// Pressures of the columns at hand of a row.
    #[inline(always)]
    pub(super) fn pressures(&self, row: usize) -> &'a [f32] {
        &self.pressure[self.start(row)..][..self.width]
    }

    /// Finds the heads of the columns at hand of a row.
    #[inline(always)]
    pub(super) fn find_heads(&self, instructions: InstructionSet, row: usize, to: &mut [f32]) {
        let warmth = self.warmth.map(|warmth| &warmth[self.start(row)..][..self.width]);
        heads(instructions, self.pressures(row), warmth, to);
    }

    /// Flow through faces from the velocities before and behind them, in cells a substep. No face lets more than half a cell
    /// pass, so that two can't take more than there is. The substep's length keeps the velocities below that; only the
    /// filter can reach it, at a jump of pressure, and the second order, where air rushes together.
    #[inline(always)]
    pub(super) fn face_flow<L: Lanes>(&self, open: L, [before, behind]: [L; 2], drop: L) -> L {
        let mut wind = (before + behind) * L::splat(self.half);
        if self.second_order {
            wind = starting_there(wind, (behind - before) * L::splat(2.0 * self.half));
        }
        let flow = open * (wind + drop * L::splat(self.filter));
        flow.min(L::splat(0.5)).max(L::splat(-0.5))
    }

    /// The same for the faces between the box and the ring: what is in the ring is no velocity of air there (`edges`), so
    /// that nothing is known of how it changes.
    pub(super) fn at_edge(&self) -> Self {
        Self { second_order: false, ..*self }
    }

    /// Whether the faces above a row are inside the box.
    pub(super) fn is_inside(&self, row: usize) -> bool {
        row > 0 && (row + 2) * self.stride < self.pressure.len()
    }
}

/// Each lane's own entry and the two after it.
#[inline(always)]
pub(super) fn three<L: Lanes>(rows: [&[f32]; 3], i: usize) -> [L; 3] {
    [L::of(rows[0], i), L::of(rows[1], i), L::of(rows[2], i)]
}

#[inline(always)]
pub(super) fn store_three<L: Lanes>([mass, x, y]: [L; 3], [to_mass, to_x, to_y]: &mut [&mut [f32]; 3], i: usize) {
    mass.put(to_mass, i);
    x.put(to_x, i);
    y.put(to_y, i);
}

/// Lane by lane.
#[inline(always)]
pub(super) fn product<L: Lanes>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// Sum of what is from left to right, so paired that a mirror image has the same bits.
#[inline(always)]
pub(super) fn sum<L: Lanes>([left, middle, right]: [L; 3]) -> L {
    middle + (left + right)
}

/// Flow `wind` through a face, in cells, of air that starts where it does and not at the face. `stretch` is how many cells
/// faster the air behind the face is than that before it, 1 at most in size.
#[inline(always)]
pub(super) fn starting_there<L: Lanes>(wind: L, stretch: L) -> L {
    wind * (L::splat(1.0) - stretch)
}
