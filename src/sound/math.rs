//! Functions that every machine rounds alike: polynomials in place of those of a platform's library.

use std::f32::consts::{FRAC_PI_2, LN_2, LOG2_E};

/// sin 2πt, to 10⁻⁶.
pub(crate) fn sine(turns: f32) -> f32 {
    // In quarters of a turn from the nearest zero, folded so that −1 ≤ z ≤ 1.
    let whole = (turns + 0.5).floor();
    let quarters = 4.0 * (turns - whole);
    let z = if quarters > 1.0 {
        2.0 - quarters
    } else if quarters < -1.0 {
        -2.0 - quarters
    } else {
        quarters
    };
    let s = z * z;
    z * (FRAC_PI_2 + s * (-0.645_963_7 + s * (0.079_689_68 + s * (-0.004_673_77 + s * 0.000_151_48))))
}

/// tan 2πt, to 10⁻⁵ below an eighth of a turn, 10⁻⁴ below a fifth. −1/4 < t < 1/4.
pub(crate) fn tangent(turns: f32) -> f32 {
    sine(turns) / sine(turns + 0.25)
}

/// 2ˣ, to 2·10⁻⁶ of it; 0 below 2⁻¹²⁶, and no more than 2¹²⁷.
pub(crate) fn exp2(x: f32) -> f32 {
    if x < -126.0 {
        return 0.0;
    }
    let x = x.min(127.0);
    let whole = x.floor();
    let part = x - whole;
    let power = f32::from_bits(((whole as i32 + 127) as u32) << 23);
    power
        * (1.0
            + part * (LN_2 + part * (0.240_226_5 + part * (0.055_504_1 + part * (0.009_618_1 + part * 0.001_503_4)))))
}

/// e⁻ˣ.
pub(crate) fn decay(x: f32) -> f32 {
    exp2(-x * LOG2_E)
}

/// How loud a sound of equal power is on the left and on the right: `pan` from −1, only left, to 1, only right.
pub(crate) fn pan_gains(pan: f32) -> [f32; 2] {
    let eighths = (1.0 + pan) * 0.125;
    [sine(eighths + 0.25), sine(eighths)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_what_they_are_called() {
        for k in -4000..=4000_i32 {
            let x = f64::from(k) / 1000.0;
            let sin = (x * std::f64::consts::TAU).sin();
            assert!(
                (f64::from(sine(x as f32)) - sin).abs() < 5e-6,
                "sin of {x} turns is {sin}, not {}",
                sine(x as f32)
            );
            let power = f64::from(exp2(x as f32)) / x.exp2();
            assert!((power - 1.0).abs() < 1e-5, "2^{x} is off by {power}");
        }
        assert_eq!((exp2(-200.0), decay(0.0)), (0.0, 1.0));
        assert!(exp2(1e9).is_finite());
        assert!((tangent(0.125) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_pan_keeps_the_power() {
        for k in -10..=10_i16 {
            let [left, right] = pan_gains(f32::from(k) / 10.0);
            assert!((left * left + right * right - 1.0).abs() < 1e-5);
            assert_eq!(left > right, k < 0, "{k}");
        }
        assert!(pan_gains(-1.0)[1].abs() < 1e-6 && pan_gains(1.0)[0].abs() < 1e-6);
    }
}
