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

/// Divergence of the moves over `dt` s: of `s r/2` it is s. Least squares over the drop.
fn divergence(before: &Particles, after: &Particles, dt: f32) -> f32 {
    let middle = Vec2::splat(40.0);
    let sums = (0..before.len()).fold((0.0, 0.0), |(along, squares), i| {
        let from = before.position(i) - middle;
        let moved = (after.position(i) - before.position(i)) / dt;
        (along + moved.dot(from), squares + from.length_squared())
    });
    2.0 * sums.0 / sums.1
}

#[test]
fn the_pull_follows_the_error_up_to_its_range_and_no_further() {
    // 0.99 of the range, and ten times it. So short that no move is longer than the feedback's longest.
    let dt = 1.0 / 480.0;
    for (error, expected, cut) in [(0.297, 48.0 * 0.297, false), (3.0, 48.0 * 0.3, true)] {
        let (mut particles, solids) = drop(error);
        let before = particles.clone();
        let report = go_on(&mut Predictor::default(), &mut particles, &solids, (LATTICE, dt));
        let found = divergence(&before, &particles, dt);
        assert!(report.liquid && (report.cuts > 20) == cut, "error {error}: {report:?}");
        assert!((found / expected - 1.0).abs() < 0.2, "error {error}: a divergence of {found}/s, not {expected}");
        assert!(particles.vx.iter().chain(&particles.vy).all(|v| v.abs() < 1e-4), "error {error}: it became speed");
    }
}

#[test]
fn an_error_shrinks_just_below_the_bound_and_stays_bounded_past_it() {
    // f Δt = 0.99, and ten times that: longer than any substep.
    for (product, most) in [(0.99_f32, 0.1), (9.9, 0.3)] {
        let dt = product / 48.0;
        let (mut particles, solids) = drop(0.1);
        let mut errors = Vec::new();
        for _ in 0..6 {
            let before = particles.clone();
            go_on(&mut Predictor::default(), &mut particles, &solids, (LATTICE, dt));
            for i in 0..particles.len() {
                let moved = particles.position(i).distance(before.position(i));
                assert!(moved < 0.708, "f Δt = {product}: thrown {moved} d");
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

#[test]
fn a_film_in_a_crevice_does_not_draw_together_until_it_fills_it() {
    // One row of particles and two, in crevices that have room for one or two more.
    for (depth, height) in [(1, 2), (1, 3), (2, 3), (2, 4)] {
        let crevice = |at: Vec2| at.y < height as f32;
        for (gravity, turned) in [(Vec2::NEG_Y, false), (Vec2::NEG_X, true)] {
            let turn = |at: Vec2| if turned { Vec2::new(at.y, at.x) } else { at };
            let solids = solids(60, 60, |at| !crevice(turn(at)));
            let film = |at: Vec2| (15.0..45.0).contains(&at.x) && at.y < depth as f32;
            let mut particles = lattice(&solids, |at| film(turn(at)).then_some(Vec2::ZERO));
            let mut predictor = Predictor::default();
            let before = particles.clone();
            for _ in 0..10 {
                pull(&mut predictor, &mut particles, &solids, (LATTICE, DT), gravity);
            }
            let drawn = (0..particles.len()).map(|i| particles.position(i).distance(before.position(i)));
            let most = drawn.fold(0.0, f32::max);
            assert!(most < 0.5, "{depth} d in {height} d, gravity {gravity}: drawn together by {most} d");
        }
    }
}
