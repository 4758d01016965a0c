//! The discrete Poisson equation and its solver against smooth exact solutions.

use super::{
    noise, order,
    rig::{Equation, dot},
    solids,
};
use glam::Vec2;
use std::f64::consts::PI;

/// A full box of `columns` × 1½ `columns` cells.
fn full(columns: u32) -> Equation {
    let (width, height) = (columns, columns * 3 / 2);
    let size = Vec2::new(width as f32, height as f32);
    Equation::new(size, 1.0, &solids(width, height, |_| false), |_, _| true, |_, _| 1.0)
}

#[test]
fn a_smooth_pressure_in_a_sealed_box_is_found_to_second_order() {
    // p = cos πx cos 2πy/H meets every wall level: −∇²p = (π² + (2π/H)²) p on [0, 1] × [0, H], H = 3/2.
    let exact = |[x, y]: [f64; 2]| (PI * x).cos() * (2.0 * PI * y / 1.5).cos();
    let strength = PI * PI + (2.0 * PI / 1.5) * (2.0 * PI / 1.5);
    let errors: Vec<f64> = [16, 32, 64, 128]
        .into_iter()
        .map(|columns| {
            let mut equation = full(columns);
            let unit = f64::from(columns);
            let b = equation.field(unit, |at| strength * exact(at) / (unit * unit));
            let found = equation.solve(&b, true);
            let exact = equation.field(unit, exact);
            equation.liquid().map(|(.., k)| (found[k] - exact[k]).abs()).fold(0.0, f64::max)
        })
        .collect();
    assert!(errors[0] < 0.02, "{errors:?}");
    assert!(order(&errors) >= 1.95, "order {} with errors {errors:?}", order(&errors));
}

#[test]
fn the_solver_reports_the_residual_that_is_left() {
    let mut equation = full(40);
    let mut random = noise(3);
    let mut b: Vec<f64> = vec![0.0; equation.grid.len()];
    equation.liquid().for_each(|(.., k)| b[k] = f64::from(random()));
    equation.centre(&mut b);
    let (x, report) = equation.solve_once(&b);
    let left: Vec<f64> = b.iter().zip(equation.apply(&x)).map(|(b, product)| b - product).collect();
    let residual = (dot(&left, &left) / dot(&b, &b)).sqrt();
    assert!(residual <= 0.101 && report.iterations > 0, "{residual} is left after {} iterations", report.iterations);
    assert!((residual - f64::from(report.residual)).abs() < 1e-4, "{residual} is left, not {}", report.residual);
}

#[test]
fn the_operator_is_symmetric_and_a_constant_costs_nothing_in_a_sealed_box() {
    let size = Vec2::new(60.0, 50.0);
    let rock = solids(60, 50, |at| at.distance(Vec2::new(25.0, 20.0)) < 9.0);
    let mut equation = Equation::new(size, 2.5, &rock, |_, _| true, |_, _| 1.0);
    let mut random = noise(5);
    let [a, b] = [(); 2].map(|()| equation.field(1.0, |_| 0.0).iter().map(|_| f64::from(random())).collect::<Vec<_>>());
    let inside = |field: Vec<f64>, equation: &Equation| -> Vec<f64> {
        field.iter().zip(&equation.conjugate.liquid).map(|(value, liquid)| value * f64::from(*liquid)).collect()
    };
    let (a, b) = (inside(a, &equation), inside(b, &equation));
    let (ab, ba) = (dot(&a, &equation.apply(&b)), dot(&b, &equation.apply(&a)));
    assert!((ab - ba).abs() < 1e-9 * dot(&a, &a), "{ab} and {ba}");
    let one = equation.field(1.0, |_| 1.0);
    let most = equation.apply(&one).iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    assert!(most < 1e-5, "a constant pressure pushes with {most}");
}
