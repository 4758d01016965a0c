//! The curves that are shipped (docs/accuracy), read back and judged by what judges a sweep.

use super::{
    error::ErrorMeasure,
    presets::{self, Order},
    row::{Row, tests::row},
};
use crate::{
    kernel::params::{AirAdvection, Preset},
    lab::coarse::Distance,
};
use serde::Deserialize;

/// What the judge looks at.
#[derive(Deserialize)]
struct Line {
    setting: String,
    preset: String,
    detail: f64,
    threads: usize,
    air_cell: f32,
    air_advection: String,
    ms: f64,
    ms_low: f64,
    ms_high: f64,
    error: Option<f64>,
    true_error: Option<f64>,
    true_floor: Option<f64>,
    faults: String,
}

fn read(table: &str) -> Vec<Row> {
    let lines = csv::Reader::from_reader(table.as_bytes()).into_deserialize::<Line>();
    let row = |line: Line| {
        let mut row = row(&line.setting, line.ms, line.error.unwrap_or(f64::NAN));
        (row.setting.preset, row.setting.threads) = (Preset::find(&line.preset), line.threads);
        row.setting.asked_detail = line.detail / row.setting.preset.map_or(1.0, Preset::detail);
        row.setting.quality.air_cell = line.air_cell;
        let scheme = AirAdvection::ALL.into_iter().find(|scheme| scheme.name() == line.air_advection);
        row.setting.quality.air_advection = scheme.expect("a scheme of today");
        row.found.accuracy.distance = Some(Distance { share: line.true_error, ..Distance::default() });
        row.found.floor = line.true_floor;
        row.ms_range = [line.ms_low, line.ms_high];
        row.faults = line.faults.split("; ").filter(|fault| !fault.is_empty()).map(str::to_owned).collect();
        row
    };
    lines.map(|line| row(line.unwrap())).collect()
}

#[test]
fn in_the_dam_break_and_in_the_waterfall_each_preset_takes_longer_and_errs_less_than_the_one_before_it() {
    for (scene, air_is_unseen, table) in [
        ("dam_break", false, include_str!("../../../docs/accuracy/dam_break/curve.csv")),
        ("waterfall", true, include_str!("../../../docs/accuracy/waterfall/curve.csv")),
    ] {
        let rows = read(table);
        let order = presets::judge(&rows, ErrorMeasure::Density, air_is_unseen);
        assert!(matches!(order, Order::Ok { front: true, .. }), "{scene}: {order}");
        let error = |preset| rows.iter().find(|row| row.setting.preset == Some(preset)).unwrap().error;
        let errors = presets::STEPS.map(error);
        // The real-time presets differ by more than the smallest difference that can be measured.
        assert!(errors[..4].is_sorted_by(|a, b| a > b), "{scene}: {errors:?}");
    }
}
