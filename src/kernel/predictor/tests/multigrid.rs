//! The multigrid cycle as a preconditioner: symmetric, positive, and as good on a fine grid as on a coarse one.

use super::{
    noise,
    rig::{Equation, coarsen, dot},
    solids,
};
use crate::predictor::level::Level;
use glam::Vec2;

/// A tank of `cells` × `cells` cells with a wavy surface and two rocks in it.
fn tank(cells: u32) -> Equation {
    let side = cells as f32 * 2.5;
    let columns = side as u32;
    let rock = solids(columns, columns, |at| {
        at.distance(Vec2::new(0.3, 0.3) * side) < 0.11 * side || at.distance(Vec2::new(0.75, 0.2) * side) < 0.07 * side
    });
    let height = move |column: usize| f64::from(cells) * (0.62 + 0.1 * (column as f64 * 9.0 / f64::from(cells)).sin());
    let filled = move |column: usize, row: usize| (height(column) - row as f64).clamp(0.0, 1.0) as f32;
    Equation::new(Vec2::splat(side), 2.5, &rock, move |column, row| filled(column, row) >= 0.5, filled)
}

fn random_field(equation: &Equation, seed: u32) -> Vec<f64> {
    let mut random = noise(seed);
    let mut field = vec![0.0; equation.grid.len()];
    equation.liquid().for_each(|(.., k)| field[k] = f64::from(random()));
    field
}

#[test]
fn the_cycle_is_symmetric_and_positive() {
    for cells in [6, 23, 64] {
        let mut equation = tank(cells);
        for seed in 1..5 {
            let (a, b) = (random_field(&equation, seed), random_field(&equation, 100 + seed));
            let (of_a, of_b) = (equation.precondition(&a), equation.precondition(&b));
            let (ab, ba, aa, bb) = (dot(&a, &of_b), dot(&b, &of_a), dot(&a, &of_a), dot(&b, &of_b));
            assert!(aa > 0.0 && bb > 0.0, "{cells}: {aa} and {bb}");
            assert!((ab - ba).abs() < 1e-5 * (aa * bb).sqrt(), "{cells}: {ab} and {ba}");
        }
    }
}

/// What an iteration of conjugate gradients with the cycle as a preconditioner leaves of the residual, on the mean of
/// several.
fn factor(equation: &mut Equation) -> f64 {
    let iterations = 10;
    let mut residual = random_field(equation, 9);
    let start = dot(&residual, &residual);
    let mut direction = equation.precondition(&residual);
    let mut last = dot(&residual, &direction);
    for _ in 0..iterations {
        let product = equation.apply(&direction);
        let step = last / dot(&direction, &product);
        residual.iter_mut().zip(&product).for_each(|(residual, product)| *residual -= step * product);
        let preconditioned = equation.precondition(&residual);
        let next = dot(&residual, &preconditioned);
        direction.iter_mut().zip(&preconditioned).for_each(|(direction, z)| *direction = z + next / last * *direction);
        last = next;
    }
    (dot(&residual, &residual) / start).powf(0.5 / f64::from(iterations))
}

#[test]
fn convergence_hardly_depends_on_the_size_of_the_grid() {
    // Plain aggregation loses a little with every level: from 16² to 256² cells, what an iteration leaves grows from a
    // ninth to a third. That is one iteration more a tick for 256 times the cells.
    let factors = [16, 32, 64, 128, 256].map(|cells| factor(&mut tank(cells)));
    assert!(factors[0] < 0.15, "an iteration leaves {factors:?} of the residual");
    for pair in factors.windows(2) {
        assert!(pair[1] < pair[0] + 0.09, "an iteration leaves {factors:?} of the residual on finer and finer grids");
    }
}

#[test]
fn a_tick_needs_hardly_more_iterations_on_a_fine_grid_than_on_a_coarse_one() {
    let iterations = [16, 64, 256].map(|cells| {
        let mut equation = tank(cells);
        // A smooth right-hand side is the hard one: pressure has to cross the whole tank.
        let b = equation.field(f64::from(cells), |[x, y]| 1.0 + (3.0 * x).sin() * y);
        equation.solve_once(&b).1.iterations
    });
    assert!(iterations[0] <= 3 && iterations[2] <= iterations[0] + 2, "{iterations:?} iterations");
}

#[test]
fn what_is_dry_is_left_out_to_the_bit() {
    // Of each, columns of liquid as deep as they say, some of them with drops above.
    type Shape = fn(usize, usize) -> bool;
    let shapes: [Shape; 5] = [
        |column, row| (130..190).contains(&column) && row < 9 + column % 7,
        |column, row| column % 100 < 3 && row < 12,
        |column, row| (column + 2 * row) % 61 < 5,
        |column, row| column > 290 && row > 15,
        |column, row| column < 2 && row == 7,
    ];
    for wet in shapes {
        let mut equation =
            Equation::new(Vec2::new(750.0, 50.0), 2.5, &solids(750, 50, |_| false), wet, |column, row| {
                if wet(column, row) { 1.0 } else { 0.2 }
            });
        let b = random_field(&equation, 3);
        let (columns, stride, len) = (equation.grid.columns, equation.grid.stride, equation.grid.len());
        let rows = 1..equation.grid.rows + 1;
        equation.hierarchy.finest().wet.find(&vec![1.0; len], stride, rows.clone(), 1..columns + 1);
        coarsen(&mut equation.hierarchy);
        let whole = equation.precondition(&b);

        equation.hierarchy.finest().wet.find(&equation.conjugate.liquid, stride, rows, 1..columns + 1);
        for (depth, level) in equation.hierarchy.levels().iter_mut().enumerate() {
            // What is dry is left from before, whatever it was; the padding is always 0.
            let Level { columns, stride, wet, operator, x, work, .. } = level;
            let [diagonal, damped, right, upper] = operator.fields_mut();
            let is_wet = |k: usize| depth == 0 && wet.runs(k / *stride).any(|run| run.contains(&(k % *stride)));
            let kept: Vec<bool> = (0..x.len()).map(|k| is_wet(k) || !(1..=*columns).contains(&(k % *stride))).collect();
            let dry = kept.iter().filter(|kept| !**kept).count();
            assert!(depth > 0 || 2 * dry > len, "{dry} of {len} cells are dry");
            for field in [diagonal, damped, right, upper, x, work] {
                field.iter_mut().zip(&kept).filter(|(_, kept)| !**kept).for_each(|(field, _)| *field = f32::NAN);
            }
        }
        equation.hierarchy.finest().take();
        coarsen(&mut equation.hierarchy);
        assert!(equation.precondition(&b) == whole, "not the same as with all that is dry");
    }
}
