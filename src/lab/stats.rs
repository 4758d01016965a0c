//! Order statistics in f64. Sums run in the order of the values.

use std::borrow::Borrow;

/// The `q`-quantile of `values`, 0 ≤ q ≤ 1, between the two nearest values in proportion; `None` of
/// nothing. Changes the order of `values`.
pub fn quantile(values: &mut [f64], q: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let place = q * last as f64;
    let below = place.floor() as usize;
    let (_, &mut low, above) = values.select_nth_unstable_by(below, f64::total_cmp);
    let high = above.iter().copied().min_by(f64::total_cmp).unwrap_or(low);
    Some(low + (high - low) * (place - below as f64))
}

/// The mean of `values`, `None` of nothing.
pub fn mean(values: impl IntoIterator<Item: Borrow<f64>>) -> Option<f64> {
    let mut count = 0.0;
    let sum: f64 = values.into_iter().inspect(|_| count += 1.0).map(|value| *value.borrow()).sum();
    (count > 0.0).then(|| sum / count)
}

/// Standard error of the mean of `values`, as far as they tell: their standard deviation over √n. `None` of fewer than two.
pub fn standard_error(values: &[f64]) -> Option<f64> {
    let (mean, n) = (mean(values)?, values.len() as f64);
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (n > 1.0).then(|| (squares / (n * (n - 1.0))).sqrt())
}

/// The largest of `values`, `None` of nothing.
pub fn largest(values: impl IntoIterator<Item: Borrow<f64>>) -> Option<f64> {
    values.into_iter().map(|value| *value.borrow()).max_by(f64::total_cmp)
}

/// Least-squares line through the points `(x, y)`: slope and intercept. Needs two different x.
pub fn line(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = points.len() as f64;
    let (sx, sy) = points.iter().fold((0.0, 0.0), |(sx, sy), (x, y)| (sx + x, sy + y));
    let (mx, my) = (sx / n, sy / n);
    let (sxx, sxy) =
        points.iter().fold((0.0, 0.0), |(sxx, sxy), (x, y)| (sxx + (x - mx) * (x - mx), sxy + (x - mx) * (y - my)));
    (sxx > 0.0).then(|| (sxy / sxx, my - sxy / sxx * mx))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_their_neighbours_in_proportion() {
        let mut values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(quantile(&mut values, 0.0), Some(1.0));
        assert_eq!(quantile(&mut values, 0.5), Some(2.5));
        assert_eq!(quantile(&mut values, 1.0), Some(4.0));
        assert_eq!(quantile(&mut [7.0], 0.99), Some(7.0));
        assert_eq!(quantile(&mut [], 0.5), None);
    }

    #[test]
    fn the_mean_is_known_to_its_standard_error() {
        // The variance of 1, 2, 3, 4 is 5/3, so that of their mean 5/12.
        let error = standard_error(&[1.0, 2.0, 3.0, 4.0]).unwrap();
        assert!((error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(standard_error(&[2.0, 2.0]), Some(0.0));
        assert_eq!((standard_error(&[1.0]), standard_error(&[])), (None, None));
    }

    #[test]
    fn a_line_through_its_own_points_is_found() {
        let points: Vec<_> = (0..5).map(|i| (f64::from(i), 3.0 - 2.0 * f64::from(i))).collect();
        let (slope, intercept) = line(&points).unwrap();
        assert!((slope + 2.0).abs() < 1e-12 && (intercept - 3.0).abs() < 1e-12);
        assert_eq!(line(&[(1.0, 1.0), (1.0, 2.0)]), None, "a vertical line has no slope");
    }
}
