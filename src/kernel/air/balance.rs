//! The mass of air that rock shuts in: what rounding takes from a room, the room gets back.
//!
//! Advection moves mass and makes none, but each new pressure is rounded to f32: by at most 8 ε of what is shared to a cell
//! (`tests/scheme`), most of which cancels, though not in a storm that hardly changes, where the roundings are the same
//! again and again. Nothing bounds their sum over many steps. So after each step the mass of every shut room is summed
//! in f64 and compared with that which the room had when its mass was last changed by anything but a step: `rests`, its
//! pressure at rest, times its cells. What differs by more than `MOST_DRIFT` is given back to the cells that are stepped, to
//! each the same part of its own pressure, so that no pressure falls below 0 and no room gives to another.
//!
//! **The bound.** With `u = 2⁻²⁴`, the unit roundoff of f32: `rests` is rounded by u, a drift of up to 14 u is left alone, and
//! pressures that were scaled are each rounded by u once more, so that after any step, whatever the steps before it,
//! the mass of a room differs from what it had by at most **16 u = 2⁻²⁰, less than 10⁻⁶**. Rounding in f64 is far below it.
//! Air that has not drifted by 14 u keeps its bits.
//!
//! Sums are kept by tiles, so that what sleeps costs nothing. They follow from the state: a copy makes them anew and has
//! the same bits.

use super::{
    grid::{Air, Scratch},
    ledger::{Counted, MOST_DRIFT},
    shape::Shape,
};

impl Air {
    /// Gives rooms that are shut back what rounding has taken from them, or takes what it has given.
    pub(super) fn balance(&mut self, shape: &Shape, scratch: &mut Scratch) {
        let Scratch { ledger, watch, .. } = scratch;
        if shape.room_open.iter().all(|open| *open) || self.rests.len() != shape.room_open.len() {
            return;
        }
        let tiling = self.tiling();
        let Counted { rooms, cells } = ledger.count(tiling, shape, &self.pressure, &watch.active);
        // From now on the factor by which a room is scaled.
        for (room, [mass, moving]) in rooms.iter_mut().enumerate() {
            let wanted = f64::from(self.rests[room]) * f64::from(cells[room]);
            let drifts = !shape.room_open[room] && *moving > 0.0 && (*mass - wanted).abs() > MOST_DRIFT * wanted;
            // Where next to nothing moves, not all at once.
            *mass = if drifts { (1.0 + (wanted - *mass) / *moving).clamp(0.5, 2.0) } else { 1.0 };
        }
        if rooms.iter().all(|[factor, _]| *factor == 1.0) {
            return;
        }
        for tile in (0..tiling.count()).filter(|tile| watch.active[*tile]) {
            for k in tiling.cells_of(tile).flatten() {
                if let Some([factor, _]) = rooms.get(shape.room[k] as usize) {
                    self.pressure[k] = (f64::from(self.pressure[k]) * factor) as f32;
                }
            }
        }
        ledger.note(&watch.active);
    }
}
