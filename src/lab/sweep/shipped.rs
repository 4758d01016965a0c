//! The curves that are shipped (docs/accuracy), read back and judged by what judges a sweep: what their summaries and
//! docs/accuracy.md say of the presets is what the figures say.

use super::{
    ErrorMeasure, design::Setting, front, journal::Found, presets, presets::Order, row::Row, row::tests::row, table,
};
use crate::{
    kernel::params::{AirAdvection, GradientKernel, Preset, Quality},
    lab::coarse::Distance,
};
use std::collections::BTreeMap;

struct Curve {
    scene: &'static str,
    measure: ErrorMeasure,
    air_is_unseen: bool,
    table: &'static str,
    summary: &'static str,
}

macro_rules! curve {
    ($scene:literal, $measure:ident, $air_is_unseen:literal) => {
        Curve {
            scene: $scene,
            measure: ErrorMeasure::$measure,
            air_is_unseen: $air_is_unseen,
            table: include_str!(concat!("../../../docs/accuracy/", $scene, "/curve.csv")),
            summary: include_str!(concat!("../../../docs/accuracy/", $scene, "/summary.md")),
        }
    };
}

const DOCUMENT: &str = include_str!("../../../docs/accuracy.md");

const CURVES: [Curve; 4] = [
    curve!("dam_break", Density, false),
    curve!("hydrostatic", Density, false),
    curve!("waterfall", Density, true),
    curve!("wind_tunnel", Air, false),
];

impl Curve {
    fn order(&self) -> Order {
        presets::judge(&read(self.table), self.measure, self.air_is_unseen)
    }
}

/// The fields of a line, of which any may be in quotes.
fn split(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    let mut rest = line.chars().peekable();
    while let Some(char) = rest.next() {
        let last = fields.len() - 1;
        match char {
            '"' if quoted && rest.next_if_eq(&'"').is_some() => fields[last].push('"'),
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            char => fields[last].push(char),
        }
    }
    fields
}

const LATE_COLUMN: &str = "air_advection";

/// The rows of a table.
fn read(table: &str) -> Vec<Row> {
    let mut lines = table.lines();
    let columns = split(lines.next().unwrap());
    // A curve without air that was measured before there was a choice of its scheme has no column for it.
    let expected = table::COLUMNS.map(|(name, _)| name);
    let expected =
        expected.into_iter().filter(|name| *name != LATE_COLUMN || columns.iter().any(|column| column == name));
    assert!(expected.eq(columns.iter().map(String::as_str)), "the columns of a sweep, not {columns:?}");
    let fields = lines.map(|line| columns.iter().map(String::as_str).zip(split(line)).collect());
    fields.map(|fields| row_of(&fields)).collect()
}

fn row_of(fields: &BTreeMap<&str, String>) -> Row {
    let text = |name: &str| fields[name].as_str();
    let figure = |name: &str| Some(text(name)).filter(|text| !text.is_empty()).map(|text| text.parse::<f64>().unwrap());
    let number = |name: &str| figure(name).unwrap();
    let quality = Quality {
        substeps: number("substeps") as u32,
        iterations: number("iterations") as u32,
        kernel_radius: number("kernel_radius") as f32,
        correction_limit: number("correction_limit") as f32,
        predictor: text("predictor") == "true",
        gradient: GradientKernel::ALL.into_iter().find(|kernel| kernel.name() == text("gradient")).unwrap(),
        air_cell: number("air_cell") as f32,
        air_courant: number("air_courant") as f32,
        air_advection: match fields.get(LATE_COLUMN) {
            Some(text) => AirAdvection::ALL.into_iter().find(|scheme| scheme.name() == text).unwrap(),
            None => Preset::Balanced.quality().air_advection,
        },
    };
    Row {
        setting: Setting {
            name: text("setting").to_owned(),
            preset: Preset::find(text("preset")),
            quality,
            threads: number("threads") as usize,
        },
        runs: number("runs") as usize,
        ms: number("ms"),
        ms_range: [number("ms_low"), number("ms_high")],
        ms_p95: number("ms_p95"),
        error: figure("error").unwrap_or(f64::NAN),
        found: Found {
            particles: number("particles") as usize,
            error_mean: figure("error_mean"),
            error_p99: figure("error_p99"),
            error_max: figure("error_max"),
            density_mean: figure("density_mean"),
            volume_error: figure("volume_error"),
            residual: figure("residual"),
            energy_gain: figure("energy_gain"),
            lost: number("lost") as u64,
            distance: Distance {
                share: figure("distance_share"),
                momentum: figure("distance_momentum"),
                air: figure("distance_air"),
            },
        },
        hash: text("hash").to_owned(),
        faults: text("faults").split("; ").filter(|fault| !fault.is_empty()).map(str::to_owned).collect(),
        front: text("front") == "true",
    }
}

fn written(rows: &[Row]) -> String {
    let mut text = Vec::new();
    table::write(rows, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn a_table_is_read_back_as_it_was_written() {
    let mut rows = [row("fast, h \"3\"", 0.5, 0.03), row("fine", 1.5, 0.005)];
    rows[0].faults = vec!["energy up by 2.0 %".to_owned(), "mean density 0.970".to_owned()];
    assert_eq!(split("a,\"b, \"\"c\"\"\",,d"), ["a", "b, \"c\"", "", "d"]);
    let again = read(&written(&rows));
    assert_eq!(again[0].setting, rows[0].setting);
    assert_eq!((&again[0].faults, &again[0].found), (&rows[0].faults, &rows[0].found));
    for curve in CURVES.iter().filter(|curve| curve.table.contains(LATE_COLUMN)) {
        assert_eq!(written(&read(curve.table)), curve.table, "{}", curve.scene);
    }
}

#[test]
fn in_the_dam_break_and_in_the_waterfall_each_preset_is_dearer_and_exacter_than_the_one_before_it() {
    for curve in CURVES.iter().filter(|curve| ["dam_break", "waterfall"].contains(&curve.scene)) {
        let order = curve.order();
        assert!(matches!(order, Order::Ok { front: true, .. }), "{}: {order}", curve.scene);
        let errors = presets::STEPS.map(|preset| {
            let rows = read(curve.table);
            rows.into_iter().find(|row| row.setting.preset == Some(preset)).unwrap().error
        });
        // What the real-time presets are told apart by is more than what can't be told.
        assert!(errors[..4].is_sorted_by(|a, b| a > b), "{}: {errors:?}", curve.scene);
    }
}

#[test]
fn the_summaries_say_of_the_order_what_the_tables_say() {
    for curve in &CURVES {
        let order = curve.order().to_string();
        assert!(curve.summary.contains(&format!("\n\n{order}\n")), "{} has no\n{order}", curve.scene);
    }
}

#[test]
fn the_front_is_that_of_the_figures_and_the_document_names_the_presets_that_miss_it() {
    let section = DOCUMENT.split("\n## ").find(|section| section.starts_with("The presets\n")).unwrap();
    for curve in &CURVES {
        let rows = read(curve.table);
        let mut again = rows.clone();
        front::mark(&mut again, curve.air_is_unseen);
        for (row, again) in rows.iter().zip(&again) {
            let (name, step) = (&row.setting.name, row.setting.preset.filter(|preset| presets::STEPS.contains(preset)));
            // Figures that are rounded in the table may tie: next to no error is one error.
            if row.error > super::row::NEGLIGIBLE {
                assert_eq!(row.front, again.front, "{}, {name}", curve.scene);
            }
            if let Some(preset) = step
                && !row.front
                && ["dam_break", "waterfall"].contains(&curve.scene)
            {
                let line = format!("| `{}` | `{}` |", curve.scene, preset.name());
                assert!(section.contains(&line), "docs/accuracy.md does not say why {line} is not on the front");
            }
        }
    }
}
