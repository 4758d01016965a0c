//! How the cost grows.

use crate::lab::{scaling::measure::Row, stats};
use serde::Serialize;

/// The power law through the times of a setting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// Setting.
    pub setting: &'static str,
    /// Threads.
    pub threads: usize,
    /// b of `ms = a nᵇ`, least squares on the logarithms.
    pub exponent: f64,
    /// The fewest and the most particles that were measured.
    pub particles: [usize; 2],
}

/// The settings of the rows, each once, in their order.
pub(super) fn settings(rows: &[Row]) -> Vec<&'static str> {
    let mut settings = Vec::new();
    for row in rows {
        if !settings.contains(&row.setting) {
            settings.push(row.setting);
        }
    }
    settings
}

/// The exponents of all settings that were measured at two sizes or more, in the order of the rows.
pub fn fits(rows: &[Row]) -> Vec<Fit> {
    let mut fits = Vec::new();
    for setting in settings(rows) {
        let own: Vec<&Row> = rows.iter().filter(|row| row.setting == setting).collect();
        for (k, threads) in own[0].threads.iter().enumerate() {
            let points: Vec<(f64, f64)> = own.iter().map(|row| ((row.particles as f64).ln(), row.ms[k].ln())).collect();
            let sizes = own.iter().map(|row| row.particles);
            if let (Some((exponent, _)), Some(least), Some(most)) =
                (stats::line(&points), sizes.clone().min(), sizes.max())
            {
                fits.push(Fit { setting, threads: *threads, exponent, particles: [least, most] });
            }
        }
    }
    fits
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::lab::scaling::measure::Window;

    /// A row of a law of costs.
    pub fn row(setting: &'static str, particles: usize, ms: [f64; 2], error: f64) -> Row {
        Row {
            setting,
            particles,
            threads: vec![1, 2],
            ms: ms.to_vec(),
            ms_range: ms.iter().map(|ms| [0.9 * ms, 1.1 * ms]).collect(),
            speedup: Some(ms[0] / ms[1]),
            error_mean: Some(error / 9.0),
            error_p99: Some(error),
            bytes_per_particle: 100.0,
            escaped: 0,
            hash: "0123456789abcdef".to_owned(),
            same_hash: true,
            window: Window { first: 60, last: 299 },
            rounds: 5,
        }
    }

    #[test]
    fn exponents_of_known_laws_are_found() {
        let law = |n: usize| [1e-3 * (n as f64).powf(1.1), 7e-4 * (n as f64).powf(0.9)];
        let rows: Vec<Row> = [1000, 10_000, 1_000_000].map(|n| row("a", n, law(n), 0.1)).to_vec();
        let fits = fits(&[rows, vec![row("b", 5, [1.0, 1.0], 0.1)]].concat());
        assert_eq!(fits.len(), 2, "one size has no exponent");
        assert!((fits[0].exponent - 1.1).abs() < 1e-9 && (fits[1].exponent - 0.9).abs() < 1e-9, "{fits:?}");
        assert_eq!((fits[1].threads, fits[1].particles), (2, [1000, 1_000_000]));
    }
}
