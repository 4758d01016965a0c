//! The gas law, and that strong air follows it.

use super::super::law::{STIFF, head, inner_energy};
use super::*;

#[test]
fn the_head_is_the_pressure_up_to_the_stiff_one_and_its_logarithm_beyond() {
    let mut last = 0.0;
    for step in 0..=4000_u32 {
        // From 10⁻² to 10⁸.
        let p = 10.0_f64.powf(0.0025 * f64::from(step) - 2.0) as f32;
        let h = head(p);
        assert!(h > last, "it falls at {p}: {h} after {last}");
        last = h;
        let exact = if p <= STIFF { f64::from(p) } else { 16.0 + 16.0 * (f64::from(p) / 16.0).ln() };
        assert!(h == p || p > STIFF, "{h} for {p}");
        assert!((f64::from(h) - exact).abs() <= 4.0 * f64::from(f32::EPSILON) * exact, "{h} for {exact} at {p}");
    }
    assert_eq!((head(0.0), head(STIFF)), (0.0, STIFF));
    // Its energy has the head as its slope.
    for p in [0.5, 15.999, 16.001, 400.0, 1e6] {
        let slope = (inner_energy(p * 1.0001) - inner_energy(p * 0.9999)) / (0.0002 * p);
        let exact = 2.0 * (f64::from(head(p as f32)) - 1.0);
        assert!((slope - exact).abs() < 1e-3 * exact.abs(), "{slope} for {exact} at {p}");
    }
}

#[test]
fn sound_is_no_faster_in_air_of_a_thousand_atmospheres_than_in_that_of_sixteen() {
    for (rest, speed) in [(4.0, 2.0), (16.0, 4.0), (1000.0, 4.0), (1.0e6, 4.0)] {
        // Such a ridge has two crests that part.
        let mut air = closed(400, 3, 2.0);
        for row in 0..air.rows() {
            for (column, k) in air.row_range(row).enumerate() {
                let x = (column as f32 - 199.5) / 5.0;
                air.pressure[k] = rest * (1.0 + 0.01 / (1.0 + x * x) / (1.0 + x * x));
            }
        }
        air.quiet = false;
        let crest = |air: &Air| {
            let row = air.pressure_row(1);
            (200..400).max_by(|a, b| row[*a].total_cmp(&row[*b])).unwrap() as f32 * 2.0
        };
        let pass = |air: &mut Air, seconds: f32| {
            for _ in 0..20 {
                air.step(&[], SCHEME, ALONE, seconds / 20.0);
            }
        };
        pass(&mut air, 40.0 / speed / SOUND);
        let early = crest(&air);
        pass(&mut air, 240.0 / speed / SOUND);
        let measured = (crest(&air) - early) / (240.0 / speed);
        // To a cell, and a crest is faster by up to three quarters of its height.
        assert!((measured - speed).abs() < 0.03 * speed, "{measured} instead of {speed} at {rest}");
    }
}
