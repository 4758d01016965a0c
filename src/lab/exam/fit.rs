//! What is read off a curve.

/// When a curve `(t, y)` last crosses zero and first does, and how often it does: the times between neighbouring points
/// in proportion. `None` with fewer than two crossings.
pub(super) fn half_period(curve: &[(f64, f64)]) -> Option<f64> {
    let crossings: Vec<f64> = curve
        .windows(2)
        .filter(|pair| (pair[0].1 < 0.0) != (pair[1].1 < 0.0))
        .map(|pair| pair[0].0 + (pair[1].0 - pair[0].0) * pair[0].1 / (pair[0].1 - pair[1].1))
        .collect();
    match crossings.as_slice() {
        [first, .., last] => Some((last - first) / (crossings.len() - 1) as f64),
        _ => None,
    }
}

/// When a falling curve `(t, y)` first comes down to `level`, between two points in proportion.
pub(super) fn falls_to(curve: &[(f64, f64)], level: f64) -> Option<f64> {
    let pair = curve.windows(2).find(|pair| pair[0].1 > level && pair[1].1 <= level)?;
    Some(pair[0].0 + (pair[1].0 - pair[0].0) * (pair[0].1 - level) / (pair[0].1 - pair[1].1))
}

/// When a rising curve `(t, y)` first comes up to `level`, between two points in proportion.
pub(super) fn rises_to(curve: &[(f64, f64)], level: f64) -> Option<f64> {
    let falling: Vec<_> = curve.iter().map(|(t, y)| (*t, -y)).collect();
    falls_to(&falling, -level)
}

/// The points with `from ≤ x ≤ to`.
pub(super) fn between(points: &[(f64, f64)], from: f64, to: f64) -> Vec<(f64, f64)> {
    points.iter().copied().filter(|(x, _)| (from..=to).contains(x)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_period_of_a_damped_sine_is_found() {
        let curve: Vec<_> =
            (0..500).map(|k| f64::from(k) / 60.0).map(|t| (t, (-0.1 * t).exp() * (2.0 * t).cos())).collect();
        let half = half_period(&curve).unwrap();
        assert!((half / std::f64::consts::FRAC_PI_2 - 1.0).abs() < 1e-3, "{half}");
        assert_eq!(half_period(&curve[..20]), None, "it has not crossed zero twice");
    }

    #[test]
    fn the_moment_at_a_level_lies_between_its_points() {
        let curve = [(0.0, 3.0), (1.0, 2.0), (2.0, 1.0)];
        assert_eq!(falls_to(&curve, 1.25), Some(1.75));
        assert_eq!(falls_to(&curve, 0.5), None);
        assert_eq!(rises_to(&[(0.0, 1.0), (1.0, 3.0)], 2.0), Some(0.5));
        assert_eq!(between(&curve, 0.5, 2.0).len(), 2);
    }
}
