//! What a storm costs, in cells times substeps: the same figure on every machine.

use super::*;
use crate::params::Preset;
use crate::sources::Wind;

/// Work of the dearest of some ticks of air on `size` m of a world of spacing .1 m at a quality, each in `substeps` of the
/// particles, and of a tick of air at rest.
fn work(preset: Preset, size: Vec2, growth: u32, strike: impl Fn(&mut Air, f32) -> Vec<Wind>) -> [u64; 2] {
    let (quality, detail) = (preset.quality(), preset.detail() as f32);
    // Metres to d.
    let scale = 10.0 * detail;
    let params = AirParams { sound_speed: 40.0 * scale, ..params(OpenSides::default()) };
    let mut air = Air::new(size * scale, quality.air_cell, params);
    let winds = strike(&mut air, scale);
    let substeps = quality.substeps * growth;
    let tick = |air: &mut Air| -> u64 {
        let steps = (0..substeps).map(|_| air.step(&winds, quality.air_scheme(), ALONE, DT / substeps as f32).worked);
        steps.sum()
    };
    let dearest = (0..20).map(|_| tick(&mut air)).max().unwrap_or(0);
    let calm = air.substeps_at_rest(quality.air_courant, DT / quality.substeps as f32) * quality.substeps;
    [dearest, u64::from(calm) * (air.columns() * air.rows()) as u64]
}

#[test]
fn a_storm_costs_at_most_ten_calm_ticks_at_every_quality() {
    let pressed = |air: &mut Air, scale: f32| {
        air.press(air.size() * 0.5, 0.3 * scale, 1e6);
        Vec::new()
    };
    let blown = |air: &mut Air, scale: f32| {
        let area = rect(0.0, 0.0, air.size().x, air.size().y);
        vec![Wind { area, velocity: Vec2::new(1000.0, 200.0) * scale, rate: 100.0 }]
    };
    for preset in Preset::ALL {
        // The gauntlet's box, and one of four times its size; fast particles divide a tick in up to four times as many
        // substeps, and as many times more as it is finer.
        for (size, growth) in [(Vec2::new(8.0, 6.0), 1), (Vec2::new(8.0, 6.0), 4), (Vec2::new(16.0, 12.0), 3)] {
            let growth = growth * preset.detail() as u32;
            let storms = [work(preset, size, growth, pressed), work(preset, size, growth, blown)];
            for [storm, calm] in storms {
                let what = format!("{}, {size} m, {growth}-fold: {storm} for {calm}", preset.name());
                println!("{what}: {:.2}", storm as f64 / calm as f64);
                assert!(storm <= 10 * calm, "{what}");
                assert!(storm > 2 * calm, "{what}: that is no storm");
            }
        }
    }
}
