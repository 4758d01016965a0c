//! The free surface in the pressure equation: p = 0 where it lies within its cell.

use super::{order, rig::Equation, solids};
use glam::Vec2;
use std::f64::consts::{FRAC_PI_2, PI};

/// Errors of a level pool's pressure on ever finer grids. The surface lies `part` of a cell over the edge of a row.
fn errors_of_a_pool(part: f64) -> Vec<f64> {
    [16_u32, 32, 64, 128]
        .into_iter()
        .map(|cells| {
            let whole = cells as usize * 5 / 8;
            let (unit, depth) = (f64::from(cells), (whole as f64 + part) / f64::from(cells));
            let size = Vec2::splat(cells as f32);
            let filled = |row: usize| match row {
                row if row < whole => 1.0,
                row if row == whole => part as f32,
                _ => 0.0,
            };
            let empty = solids(cells, cells, |_| false);
            let mut equation = Equation::new(size, 1.0, &empty, |_, row| filled(row) >= 0.5, |_, row| filled(row));
            // p = cos πx cos(πy/2D): level at the walls and the bottom, 0 at the surface y = D.
            let exact = |[x, y]: [f64; 2]| (PI * x).cos() * (FRAC_PI_2 * y / depth).cos();
            let strength = PI * PI + (FRAC_PI_2 / depth) * (FRAC_PI_2 / depth);
            let b = equation.field(unit, |at| strength * exact(at) / (unit * unit));
            let found = equation.solve(&b, false);
            let exact = equation.field(unit, exact);
            equation.liquid().map(|(.., k)| (found[k] - exact[k]).abs()).fold(0.0, f64::max)
        })
        .collect()
}

#[test]
fn under_a_level_surface_the_pressure_is_found_to_second_order() {
    for part in [0.0, 0.1, 0.3, 0.45, 0.55, 0.6, 0.75, 0.8, 0.95] {
        let errors = errors_of_a_pool(part);
        assert!(order(&errors) >= 1.9, "{part}: order {} with errors {errors:?}", order(&errors));
    }
}

#[test]
fn a_surface_just_over_a_centre_is_found_to_first_order() {
    // There it is taken to be a twentieth of a cell away, so that the equation stays bounded.
    for part in [0.5, 0.52, 0.54] {
        let errors = errors_of_a_pool(part);
        assert!(order(&errors) >= 0.9, "{part}: order {} with errors {errors:?}", order(&errors));
        assert!(errors[0] < 0.02, "{part}: {errors:?}");
    }
}

#[test]
fn the_error_of_the_pressure_in_a_round_drop_falls_with_the_cells() {
    // p = R² − r² with −∇²p = 4.
    let (radius, samples) = (0.37, 16);
    let errors: Vec<f64> = [16_u32, 32, 64, 128]
        .into_iter()
        .map(|cells| {
            let unit = f64::from(cells);
            let filled = |column: usize, row: usize| {
                let at =
                    |cell: usize, sample: i32| (cell as f64 + (f64::from(sample) + 0.5) / f64::from(samples)) / unit;
                let inside = |k: i32| (at(column, k % samples) - 0.5).hypot(at(row, k / samples) - 0.5) < radius;
                (0..samples * samples).filter(|k| inside(*k)).count() as f32 / (samples * samples) as f32
            };
            let empty = solids(cells, cells, |_| false);
            let size = Vec2::splat(cells as f32);
            let mut equation = Equation::new(size, 1.0, &empty, |i, j| filled(i, j) >= 0.5, filled);
            let b = equation.field(unit, |_| 4.0 / (unit * unit));
            let found = equation.solve(&b, false);
            let exact = equation.field(unit, |[x, y]| radius * radius - (x - 0.5).powi(2) - (y - 0.5).powi(2));
            let worst = equation.liquid().map(|(.., k)| (found[k] - exact[k]).abs()).fold(0.0, f64::max);
            worst / (radius * radius)
        })
        .collect();
    // How full a cell is says where a slanting surface lies only roughly, so the errors come and go from grid to grid.
    assert!(errors.iter().all(|error| *error < 0.005), "{errors:?}");
    assert!(errors[3] < errors[0] / 2.5, "the error does not fall: {errors:?}");
}
