//! Student's t: how far the mean of few figures may be off by chance (Abramowitz & Stegun, 26.7.3 and 26.7.4: sums that are
//! exact for whole degrees of freedom).

use std::f64::consts::{FRAC_2_PI, PI};

/// The chance that t is above `t` ≥ 0 at `freedom` ≥ 1 degrees of freedom. Good to some 10⁻¹⁵, so to eight figures where it is
/// 10⁻⁷.
pub fn tail(t: f64, freedom: usize) -> f64 {
    let angle = (t / (freedom as f64).sqrt()).atan();
    let (sine, cosine) = angle.sin_cos();
    // Terms of the sum: each is the one before times cos² θ and the next pair of its double factorials.
    let odd = freedom % 2;
    let (mut term, mut sum) = if odd == 1 { (cosine, 0.0) } else { (1.0, 0.0) };
    for k in (odd + 1..freedom).step_by(2) {
        sum += term;
        term *= cosine * cosine * k as f64 / (k + 1) as f64;
    }
    let inside = if odd == 1 { FRAC_2_PI * (angle + sine * sum) } else { sine * sum };
    0.5 * (1.0 - inside)
}

/// The t that is exceeded with the chance `p`, 0 < p ≤ 1/2, at `freedom` ≥ 1 degrees of freedom.
pub fn quantile(p: f64, freedom: usize) -> f64 {
    // The angle of the sums above, halved until it is as fine as f64 has it.
    let (mut low, mut high) = (0.0, 0.5 * PI);
    let t = |angle: f64| angle.tan() * (freedom as f64).sqrt();
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if tail(t(middle), freedom) > p { &mut low } else { &mut high }) = middle;
    }
    t(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // Abramowitz & Stegun, table 26.10: t for A(t|ν) = 1 − 2p.
        for (p, freedom, t) in [
            (0.25, 1, 1.0),
            (0.025, 1, 12.706),
            (0.025, 2, 4.303),
            (0.005, 3, 5.841),
            (0.025, 4, 2.776),
            (0.005, 10, 3.169),
            (0.0005, 21, 3.819),
            (0.0005, 30, 3.646),
            (0.0005, 120, 3.373),
        ] {
            assert!((quantile(p, freedom) - t).abs() < 6e-4, "{p}, {freedom}: {}", quantile(p, freedom));
        }
    }

    #[test]
    fn a_quantile_undoes_the_tail_far_out_too() {
        for freedom in [1, 2, 7, 21, 22] {
            for p in [0.4, 1e-3, 1e-7] {
                let back = tail(quantile(p, freedom), freedom);
                assert!((back / p - 1.0).abs() < 1e-6, "{freedom}, {p}: {back}");
            }
        }
        // Without an even number of degrees of freedom there is a closed form: Cauchy's.
        assert!((tail(3.0, 1) - (0.5 - 3.0_f64.atan() / PI)).abs() < 1e-15);
        assert!((tail(0.0, 5) - 0.5).abs() < 1e-15);
    }
}
