//! The pressure that arrives.

use super::{audible::Audible, listener::Listener, wind::heard_cells};
use glam::Vec2;

/// Places along each axis at which it is measured, in the middle half of the view.
const PLACES: usize = 6;

/// What is heard of pressure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Blast {
    /// Effective value of the change of pressure since it was last listened to, Pa.
    pub(super) change: f32,
    /// Where it changed most, −1 … 1.
    pub(super) pan: f32,
}

/// The pressures that were there before.
#[derive(Clone, Debug, Default)]
pub(super) struct Pressures {
    /// Column, row and pressure of each place, in that of the surroundings.
    places: Vec<(usize, usize, f32)>,
    /// Columns and rows of the grid.
    cells: (usize, usize),
}

impl Pressures {
    /// Forgets them.
    pub(super) fn clear(&mut self) {
        self.places.clear();
    }

    /// Listens to what changed where it listened before, and goes where the listener is now.
    pub(super) fn listen(&mut self, audible: &Audible, listener: Listener) -> Blast {
        let air = audible.air;
        let cells = (air.columns(), air.rows());
        if cells != self.cells || air.is_quiet() {
            self.places.clear();
            self.cells = cells;
        }
        if air.is_quiet() {
            return Blast::default();
        }
        let cell = air.cell() * audible.scale.spacing;
        let (mut squares, mut sides) = (0.0, 0.0);
        for (column, row, before) in &self.places {
            let now = air.pressure_at_cell(*column, *row);
            // Rock that came or went is no change of pressure.
            if now > 0.0 && *before > 0.0 {
                let change = (now - before) * audible.stiffness;
                let at = Vec2::new(*column as f32 + 0.5, *row as f32 + 0.5) * cell;
                squares += change * change;
                sides += change * change * listener.hears(at).pan;
            }
        }
        let heard = self.places.len().max(1) as f32;
        self.places.clear();
        let quarter = 0.25 * listener.width;
        let columns = heard_cells(listener.centre.x, quarter, cell, air.columns(), PLACES);
        for row in heard_cells(listener.centre.y, quarter, cell, air.rows(), PLACES) {
            self.places.extend(columns.clone().map(|column| (column, row, air.pressure_at_cell(column, row))));
        }
        let pan = if squares > 0.0 { sides / squares } else { 0.0 };
        Blast { change: (squares / heard).sqrt(), pan }
    }
}
