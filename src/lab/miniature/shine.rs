//! Light of what glows, on a grid some pixels wide: it lies as a halo over all around it.

use glam::Vec2;

/// Edge of a cell, pixels.
const CELL: usize = 8;
/// Passes of the blur: three boxes of three cells make nearly a bell.
const PASSES: usize = 3;

/// The grid.
pub(super) struct Shine {
    columns: usize,
    rows: usize,
    light: Vec<[f32; 3]>,
    blurred: Vec<[f32; 3]>,
    /// Whether anything glows.
    shines: bool,
}

impl Shine {
    /// Darkness over so many pixels.
    pub(super) fn new(width: usize, height: usize) -> Self {
        // A cell beyond each edge, so that there is always one to the right and below.
        let (columns, rows) = (width / CELL + 2, height / CELL + 2);
        let dark = vec![[0.0; 3]; columns * rows];
        Self { columns, rows, light: dark.clone(), blurred: dark, shines: false }
    }

    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.light.fill([0.0; 3]);
        self.shines = false;
    }

    /// Adds what glows at a place, pixels.
    pub(super) fn add(&mut self, at: Vec2, light: [f32; 3]) {
        let cell = (at / CELL as f32).max(Vec2::ZERO);
        let (column, row) = ((cell.x as usize).min(self.columns - 1), (cell.y as usize).min(self.rows - 1));
        for (sum, light) in self.light[row * self.columns + column].iter_mut().zip(light) {
            *sum += light;
        }
        self.shines = true;
    }

    /// Lets the light spread.
    pub(super) fn spread(&mut self) {
        if !self.shines {
            return;
        }
        for _ in 0..PASSES {
            for row in 0..self.rows {
                for column in 0..self.columns {
                    self.blurred[row * self.columns + column] = self.mean(column, row);
                }
            }
            std::mem::swap(&mut self.light, &mut self.blurred);
        }
    }

    /// Mean of a cell and its eight neighbours; beyond the edge it is dark.
    fn mean(&self, column: usize, row: usize) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for y in row.saturating_sub(1)..(row + 2).min(self.rows) {
            for x in column.saturating_sub(1)..(column + 2).min(self.columns) {
                let light = self.light[y * self.columns + x];
                (0..3).for_each(|k| sum[k] += light[k] / 9.0);
            }
        }
        sum
    }

    /// Light at a pixel, smooth between the cells.
    pub(super) fn at(&self, x: usize, y: usize) -> [f32; 3] {
        if !self.shines {
            return [0.0; 3];
        }
        let place = (Vec2::new(x as f32, y as f32) / CELL as f32 - 0.5).max(Vec2::ZERO);
        let (column, row) = (place.x as usize, place.y as usize);
        let (right, down) = (place.x.fract(), place.y.fract());
        let light = |column: usize, row: usize| self.light[row * self.columns + column];
        let [a, b] = [light(column, row), light(column + 1, row)];
        let [c, d] = [light(column, row + 1), light(column + 1, row + 1)];
        std::array::from_fn(|k| {
            (a[k] * (1.0 - right) + b[k] * right) * (1.0 - down) + (c[k] * (1.0 - right) + d[k] * right) * down
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_falls_off_with_distance_and_goes_when_it_is_cleared() {
        let mut shine = Shine::new(160, 80);
        shine.spread();
        assert_eq!(shine.at(20, 40), [0.0; 3]);
        shine.add(Vec2::new(20.0, 40.0), [9.0, 3.0, 0.0]);
        shine.spread();
        let reds: Vec<f32> = [20, 30, 40, 100].map(|x| shine.at(x, 40)[0]).to_vec();
        assert!(reds.is_sorted_by(|a, b| a > b) && reds[3] == 0.0, "{reds:?}");
        assert!((shine.at(159, 79)[0]).abs() < f32::EPSILON, "the last pixel has a cell");
        shine.clear();
        assert_eq!(shine.at(20, 40), [0.0; 3]);
    }
}
