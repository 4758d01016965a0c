//! Open sides: the ring beyond them is the air outside, held at pressure 1.
//!
//! A side held hard at pressure 1 throws sound back upside down, as the end of an organ pipe does. So each face of an
//! open side takes the solution of its own wave between the cell inside (p, u) and the air outside (1, U), u and U along
//! the outward normal:
//! ```text
//! u_face = ½ (u + U) + ½ c (p − P)        p_face = ½ (p + P) + (u − U)/(2c)
//! ```
//! A wave that goes out (p − 1 = u/c) passes without an echo; a lasting pressure other than 1 blows off. U follows u
//! with the time that sound takes across the box: zero gradient, late.
//!
//! The air outside is at rest. What leaves blows into it and is lost, P = 1. What enters was at rest: it comes straight in,
//! with the speed U, to which the lower pressure `P = 1 − ½ U²/c²` has brought it (Bernoulli). So no side feeds a wind: in
//! air that entered at P = 1 and with the sideways speed of the cell it enters, a gust in a box with four open sides grew
//! to a storm.

use super::{grid::Air, law::head, source::FACE_FILTER};

/// A cell at an open side.
struct Edge {
    /// The cell, in the fields.
    inside: usize,
    /// Its neighbour in the ring.
    ring: usize,
    /// Its place in `Air::outside`.
    slot: usize,
    /// Whether the outward normal is along x.
    along_x: bool,
    /// 1 if the outward normal points to larger coordinates, else −1.
    outward: f32,
}

impl Air {
    /// Brings the ring beyond the open sides up to date: what pass 1 takes in from there.
    pub(super) fn refresh_outside(&mut self, active: &[bool], sound_speed: f32) {
        // Pass 1 adds half of the ring's velocity and the filter's part of the pressure; this is the rest of `u_face`.
        let lift = (1.0 - 2.0 * FACE_FILTER) * sound_speed;
        self.for_each_edge(active, |air, edge| {
            let Edge { inside, ring, slot, along_x, outward } = edge;
            let suction = suction(air.outside[slot], sound_speed);
            let normal =
                (air.outside[slot] + lift * (head(air.pushing(inside)) - 1.0) + sound_speed * suction) * outward;
            air.velocity_x[ring] = if along_x { normal } else { 0.0 };
            air.velocity_y[ring] = if along_x { 0.0 } else { normal };
        });
    }

    /// After pass 2: the part `(u − U)/(2c)` of the face's pressure (pass 2 has given the rest), then U follows.
    pub(super) fn settle_edges(&mut self, active: &[bool], sound_speed: f32, dt: f32) {
        let courant = sound_speed * dt / self.cell;
        let follow = (sound_speed * dt / self.size.max_element()).min(1.0);
        self.for_each_edge(active, |air, edge| {
            let velocity = if edge.along_x { &mut air.velocity_x } else { &mut air.velocity_y };
            let normal = velocity[edge.inside] * edge.outward;
            let outside = &mut air.outside[edge.slot];
            let push = sound_speed * suction(*outside, sound_speed) - (normal - *outside);
            velocity[edge.inside] = (normal + push * (0.5 * courant)) * edge.outward;
            *outside += (normal - *outside) * follow;
        });
    }

    /// Calls `act` for each open cell of the active tiles at an open side: left, right, bottom, top.
    fn for_each_edge(&mut self, active: &[bool], mut act: impl FnMut(&mut Self, Edge)) {
        let tiling = self.tiling();
        let (columns, rows, stride) = (self.columns(), self.rows(), self.stride());
        let open = self.params.open;
        let sides = [
            (open.left, true, false, 0),
            (open.right, true, true, rows),
            (open.bottom, false, false, 2 * rows),
            (open.top, false, true, 2 * rows + columns),
        ];
        for (_, along_x, high, first_slot) in sides.into_iter().filter(|(open, ..)| *open) {
            let step = if along_x { 1 } else { stride };
            for i in 0..if along_x { rows } else { columns } {
                let (column, row) = match (along_x, high) {
                    (true, false) => (0, i),
                    (true, true) => (columns - 1, i),
                    (false, false) => (i, 0),
                    (false, true) => (i, rows - 1),
                };
                let inside = self.index(column, row);
                if !self.solid[inside] && active[tiling.of(column, row)] {
                    let (ring, outward) = if high { (inside + step, 1.0) } else { (inside - step, -1.0) };
                    act(self, Edge { inside, ring, slot: first_slot + i, along_x, outward });
                }
            }
        }
    }
}

/// By how much the pressure at a side through which air comes in (U < 0) is below 1: what brings air at rest to the speed
/// with which it enters (Bernoulli).
fn suction(outside: f32, sound_speed: f32) -> f32 {
    let mach = outside.min(0.0) / sound_speed;
    (0.5 * mach * mach).min(1.0)
}
