//! Overpressure: by how much the air presses harder than the surroundings. The model's gas has `P = ρ c² ∫ p dh` (`law`), at
//! the temperature θ it has; here it is in ρ c².

use super::{grid::Air, law::STIFF};
use glam::{IVec2, Vec2};

/// Furthest that open air is looked for from the face of rock, cells.
const REACH: usize = 2;

/// Overpressure of air that pushes with e at the surroundings' temperature, ρ c²: `G = ½ (e² − 1)`, and straight on from the end of
/// the stiff gas.
fn cold(e: f32) -> f32 {
    if e <= STIFF { 0.5 * (e * e - 1.0) } else { 0.5 * (STIFF * STIFF - 1.0) + STIFF * (e - STIFF) }
}

impl Air {
    /// Overpressure of a cell, ρ c².
    pub(super) fn overpressure(&self, k: usize) -> f32 {
        cold(self.pushing(k)) / (1.0 + self.warmth_of(k))
    }

    /// Overpressure at a point in d, ρ c²: that of its cell, or where that is solid of the first that is open on the way `out`
    /// along an axis; 0 where there is none within [`REACH`].
    pub fn overpressure_at(&self, at: Vec2, out: IVec2) -> f32 {
        if !self.is_built() {
            return 0.0;
        }
        let step = out.as_vec2() * self.cell;
        let cells = (0..=REACH).map(|steps| self.cell_at(at + step * steps as f32));
        cells.into_iter().find(|k| !self.solid[*k]).map_or(0.0, |k| self.overpressure(k))
    }

    /// The highest overpressure of all air, ρ c².
    pub fn highest_overpressure(&self) -> f32 {
        if self.is_quiet() {
            return 0.0;
        }
        if self.is_warm() {
            return self.cells().map(|k| self.overpressure(k)).fold(0.0, f32::max);
        }
        let rows = (0..self.rows()).flat_map(|row| self.pressure_row(row));
        cold(rows.copied().fold(1.0, f32::max))
    }
}
