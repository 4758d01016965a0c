//! Sums over the air, in f64 and in the order of the cells. The unit of mass is the air of 1 d² at pressure 1.

use super::{grid::Air, law::inner_energy, pressure::peak};
use glam::DVec2;

impl Air {
    /// Area of a cell, d².
    pub(super) fn cell_area(&self) -> f64 {
        f64::from(self.cell) * f64::from(self.cell)
    }

    fn open_cells(&self) -> impl Iterator<Item = usize> + '_ {
        self.cells().filter(|k| !self.solid[*k])
    }

    /// Mass of the cells of the box for which `wanted` holds.
    pub(super) fn mass_where(&self, wanted: impl Fn(usize) -> bool) -> f64 {
        self.cells().filter(|k| wanted(*k)).map(|k| f64::from(self.pressure[k])).sum::<f64>() * self.cell_area()
    }

    /// Mass: pressure of the open cells times their area, d². It doesn't depend on the size of the cells.
    /// Air that is not built knows no rock: that of the whole box.
    pub fn mass(&self) -> f64 {
        self.mass_where(|k| !self.solid[k])
    }

    /// What it holds of warmth: the sum of mass times how much warmer it is than the surroundings, over their temperature, d².
    pub fn held_warmth(&self) -> f64 {
        let cells = self.open_cells().map(|k| f64::from(self.pressure[k]) * f64::from(self.warmth_of(k)));
        if self.is_warm() { cells.sum::<f64>() * self.cell_area() } else { 0.0 }
    }

    /// Momentum: the sum of mass times velocity, d³/s.
    pub fn momentum(&self) -> DVec2 {
        let cells = self.open_cells().map(|k| {
            DVec2::new(f64::from(self.velocity_x[k]), f64::from(self.velocity_y[k])) * f64::from(self.pressure[k])
        });
        cells.fold(DVec2::ZERO, |sum, cell| sum + cell) * self.cell_area()
    }

    /// Energy of motion: the sum of half the mass times the square of the speed, d⁴/s².
    pub fn kinetic_energy(&self) -> f64 {
        let cells = self.open_cells().map(|k| {
            let (u, v) = (f64::from(self.velocity_x[k]), f64::from(self.velocity_y[k]));
            0.5 * f64::from(self.pressure[k]) * (u * u + v * v)
        });
        cells.sum::<f64>() * self.cell_area()
    }

    /// Energy of pressure above that of even pressure 1 at the same mass: the sum of `½ c² (p − 1)²` over the area, less
    /// in strong air (`law`), d⁴/s². Together with the kinetic energy it can only fall in a closed box.
    pub fn pressure_energy(&self) -> f64 {
        let stiffness = 0.5 * f64::from(self.params.sound_speed) * f64::from(self.params.sound_speed);
        self.open_cells().map(|k| inner_energy(f64::from(self.pressure[k]))).sum::<f64>() * stiffness * self.cell_area()
    }

    /// Root of the mean square of the divergence of the velocity over the open cells, 1/s, from the velocities at the
    /// faces (a closed face has none). 0 where there is no open cell.
    pub fn divergence_rms(&self) -> f64 {
        if !self.is_built() {
            return 0.0;
        }
        let stride = self.stride();
        let face = |field: &[f32], low: usize, high: usize| {
            let closed = |k: usize| self.solid[k] && !(self.in_ring(k) && self.lets_out(k));
            if closed(low) || closed(high) { 0.0 } else { 0.5 * (f64::from(field[low]) + f64::from(field[high])) }
        };
        let (mut sum, mut count) = (0.0, 0_u32);
        for k in self.open_cells() {
            let x = face(&self.velocity_x, k, k + 1) - face(&self.velocity_x, k - 1, k);
            let y = face(&self.velocity_y, k, k + stride) - face(&self.velocity_y, k - stride, k);
            let divergence = (x + y) / f64::from(self.cell);
            sum += divergence * divergence;
            count += 1;
        }
        if count == 0 { 0.0 } else { (sum / f64::from(count)).sqrt() }
    }

    /// Whether a cell of the ring is beyond an open side.
    fn lets_out(&self, k: usize) -> bool {
        let (i, j) = (k % self.stride(), k / self.stride());
        let open = self.params.open;
        (i == 0 && open.left)
            || (i > self.columns() && open.right)
            || (j == 0 && open.bottom)
            || (j > self.rows() && open.top)
    }

    /// Largest speed along an axis in the box, d/s.
    pub fn max_speed(&self) -> f32 {
        let rows = (0..self.rows()).map(|row| peak(self.velocity_x_row(row)).max(peak(self.velocity_y_row(row))));
        rows.fold(0.0, f32::max)
    }
}
