//! How hard the predictor pulls at a density that is wrong.

use super::*;

/// A round drop in the middle of a box, `1 + e` times as dense as the predictor wants it, at rest.
fn drop(error: f32) -> (Particles, Solids) {
    let solids = solids(80, 80, |_| false);
    let spacing = 1.0 / (1.0 + error).sqrt();
    let (mut particles, middle) = (Particles::default(), Vec2::splat(40.0));
    let reach = (14.0 / spacing) as i32;
    for y in -reach..=reach {
        for x in -reach..=reach {
            let from = Vec2::new(x as f32 + 0.3, y as f32 - 0.2) * spacing;
            if from.length() < 14.0 {
                particles.push(particles.len() as u32, ElementId(1), middle + from, Vec2::ZERO);
            }
        }
    }
    (particles, solids)
}

/// The divergence of the velocities: of `s r/2` it is s. Least squares over the drop.
fn divergence(particles: &Particles) -> f32 {
    let middle = Vec2::splat(40.0);
    let sums = (0..particles.len()).fold((0.0, 0.0), |(along, squares), i| {
        let from = particles.position(i) - middle;
        (along + particles.velocity(i).dot(from), squares + from.length_squared())
    });
    2.0 * sums.0 / sums.1
}

#[test]
fn the_pull_follows_the_error_up_to_its_range_and_no_further() {
    // 0.99 of the range, and ten times it.
    for (error, expected, cut) in [(0.297, 12.0 * 0.297, false), (3.0, 12.0 * 0.3, true)] {
        let (mut particles, solids) = drop(error);
        let report = predict(&mut particles, &solids, LATTICE);
        let found = divergence(&particles);
        assert!(report.liquid && (report.cuts > 20) == cut, "error {error}: {report:?}");
        assert!((found / expected - 1.0).abs() < 0.2, "error {error}: a divergence of {found}/s, not {expected}");
    }
}

#[test]
fn an_error_shrinks_just_below_the_bound_and_stays_bounded_past_it() {
    // f Δt = 0.99, and ten times that: far longer than any substep.
    for (product, most) in [(0.99_f32, 0.1), (9.9, 0.3)] {
        let dt = product / 12.0;
        let (mut particles, solids) = drop(0.1);
        let mut errors = Vec::new();
        for _ in 0..6 {
            (0..particles.len()).for_each(|i| (particles.vx[i], particles.vy[i]) = (0.0, 0.0));
            predict(&mut particles, &solids, LATTICE);
            for i in 0..particles.len() {
                let speed = particles.velocity(i).length();
                assert!(speed <= 12.0 * 0.3 * 14.0 * 2.0, "f Δt = {product}: thrown out at {speed} d/s");
                particles.x[i] = (particles.x[i] + particles.vx[i] * dt).clamp(0.3, 79.7);
                particles.y[i] = (particles.y[i] + particles.vy[i] * dt).clamp(0.3, 79.7);
            }
            let inner = |at: Vec2| (at - Vec2::splat(40.0)).length() < 8.0;
            let count = (0..particles.len()).filter(|i| inner(particles.position(*i))).count();
            errors.push(count as f32 / (std::f32::consts::PI * 64.0) - 1.0);
        }
        let last = errors[errors.len() - 1];
        assert!(last < most, "f Δt = {product}: errors {errors:?}");
        if product < 1.0 {
            assert!(last > -0.1, "f Δt = {product}: overshot to {errors:?}");
        }
    }
}
