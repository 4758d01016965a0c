//! The same air on cells of another size, for a change of quality while playing.

use super::grid::Air;
use crate::params::AirParams;
use glam::Vec2;

/// Cells of a line that a stretch of it overlaps, with the length of the overlap, d.
fn overlaps(low: f64, high: f64, cell: f64, count: usize) -> impl Iterator<Item = (usize, f64)> {
    let first = ((low / cell).floor() as usize).min(count - 1);
    let end = ((high / cell).ceil() as usize).clamp(first + 1, count);
    (first..end).map(move |k| (k, high.min((k + 1) as f64 * cell) - low.max(k as f64 * cell)))
}

impl Air {
    /// The same air on cells of edge `cell` (d). A new cell has the mean pressure of the open air that it covers and the
    /// velocity of its momentum; then, in a closed box, all pressure is scaled by one factor so that the mass is the old
    /// one (the rim of cells beyond the box, and cells that rock covers in part, change the volume). With an open side
    /// the pressure stays as it is.
    ///
    /// A new cell is taken for rock if no open cell is below it. Rock itself is not known here: call
    /// [`Air::set_solids`] next, which keeps the mass in the same way.
    pub fn resized(&self, cell: f32) -> Air {
        if !self.is_built() {
            return Self { pending: self.pending, ..Self::unbuilt(self.size, cell, self.params) };
        }
        let mut air = Self::new(self.size, cell, self.params);
        if self.is_warm() {
            air.warmth = vec![0.0; air.pressure.len()];
        }
        let (old, new) = (f64::from(self.cell), f64::from(cell));
        for row in 0..air.rows() {
            for column in 0..air.columns() {
                let target = air.index(column, row);
                let (mut area, mut mass, mut x, mut y, mut warmth) = (0.0, 0.0, 0.0, 0.0, 0.0);
                let (bottom, left) = (row as f64 * new, column as f64 * new);
                for (from_row, height) in overlaps(bottom, bottom + new, old, self.rows()) {
                    for (from_column, width) in overlaps(left, left + new, old, self.columns()) {
                        let k = self.index(from_column, from_row);
                        if !self.solid[k] && width * height > 0.0 {
                            let part = width * height * f64::from(self.pressure[k]);
                            area += width * height;
                            mass += part;
                            x += part * f64::from(self.velocity_x[k]);
                            y += part * f64::from(self.velocity_y[k]);
                            warmth += part * f64::from(self.warmth_of(k));
                        }
                    }
                }
                let open = area > 0.0;
                air.solid[target] = !open;
                air.pressure[target] = if open { (mass / area) as f32 } else { 0.0 };
                if mass > 0.0 {
                    air.velocity_x[target] = (x / mass) as f32;
                    air.velocity_y[target] = (y / mass) as f32;
                    if self.is_warm() {
                        air.warmth[target] = (warmth / mass) as f32;
                    }
                }
            }
        }
        self.copy_outside(&mut air);
        air.scale_to(self.mass());
        air.keep_mass = true;
        air.wake_all();
        air.scratch.sleeps = self.scratch.sleeps;
        air.scratch.gravity = self.scratch.gravity;
        air.pending = self.pending;
        air
    }

    /// The same air in a world with `factor` new d in one old, whose box is of `size`: the same pressures, and
    /// velocities and cells of the same m/s and m. Their number is no longer that of cells in the box: call
    /// [`Air::resized`] next.
    pub fn rescaled(&self, factor: f32, size: Vec2, params: AirParams) -> Air {
        let scaled = |values: &[f32]| values.iter().map(|value| value * factor).collect();
        Self {
            size,
            cell: self.cell * factor,
            params,
            velocity_x: scaled(&self.velocity_x),
            velocity_y: scaled(&self.velocity_y),
            outside: scaled(&self.outside),
            ..self.clone()
        }
    }

    /// Velocity of the air outside, from the old edge cell at the middle of each new one.
    fn copy_outside(&self, air: &mut Air) {
        let nearest = |k: usize, count: usize| (((k as f32 + 0.5) * air.cell / self.cell) as usize).min(count - 1);
        let (rows, columns) = ((self.rows(), air.rows()), (self.columns(), air.columns()));
        let (mut outside, mut first) = (Vec::with_capacity(air.outside.len()), 0);
        for (count, wanted) in [rows, rows, columns, columns] {
            outside.extend((0..wanted).map(|k| self.outside[first + nearest(k, count)]));
            first += count;
        }
        air.outside = outside;
    }
}
