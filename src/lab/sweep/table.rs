//! curve.csv: a line for every setting. A field is empty where a value does not apply.

use super::row::Row;
use crate::{
    kernel::params::Preset,
    lab::metrics::Accuracy,
    scene::{KNOBS, Knob, Part, Tuning},
};
use std::io::{self, Write};

/// A column: its name, what it holds, and its field.
type Column = (&'static str, &'static str, Field);

/// What makes the field of a column.
enum Field {
    /// The value of a knob.
    Knob(&'static Knob),
    /// This text.
    Text(fn(&Row) -> String),
    /// This share, if it applies, to six digits.
    Share(fn(&Accuracy) -> Option<f64>),
}
use Field::{Share, Text};

const SETTING: [Column; 4] = [
    ("setting", "name of the setting, unique in the table", Text(|row| row.setting.name.clone())),
    ("preset", "name of the preset that it is", Text(|row| row.setting.preset.map_or("", Preset::name).to_owned())),
    ("detail", "how many times finer than the scene it is", Text(|row| row.setting.detail().to_string())),
    ("threads", "threads of the kernel", Text(|row| row.setting.threads.to_string())),
];

const PREDICTOR: Column = (
    "predictor",
    "whether the pressure predictor runs: true or false",
    Text(|row| row.setting.quality.predictor.to_string()),
);

const RESULTS: [Column; 25] = [
    ("runs", "number of runs", Text(|row| row.runs.to_string())),
    ("ms", "time of a tick, ms: the median over the runs of their medians", Text(|row| ms(row.ms))),
    ("ms_low", "median of the fastest run, ms", Text(|row| ms(row.ms_range[0]))),
    ("ms_high", "median of the slowest run, ms", Text(|row| ms(row.ms_range[1]))),
    ("ms_p95", "95th percentile of the ticks, ms: the median over the runs", Text(|row| ms(row.ms_p95))),
    (
        "error",
        "the error that counts: error_mean, or distance_air in a scene about air",
        Text(|row| share(Some(row.error).filter(|error| error.is_finite()))),
    ),
    ("error_scatter", "standard error of it over the runs", Text(|row| share(row.error_scatter))),
    ("error_mean", "density error: mean over the interior particles, a fraction", Share(|of| of.density_error_mean)),
    ("error_p99", "density error: 99th percentile, a fraction", Share(|of| of.density_error_p99)),
    ("error_max", "density error: largest, a fraction", Share(|of| of.density_error_max)),
    ("density_mean", "mean density of the interior particles, 1 at rest density", Share(|of| of.density_mean)),
    ("volume_error", "room that the liquid takes too much, a fraction", Share(|of| of.volume_error)),
    (
        "residual",
        "the solver's own mean constraint where it is violated, in the last iteration",
        Share(|of| of.residual),
    ),
    (
        "energy_gain",
        "highest energy against the start's less 1, without what swelling takes; only in closed scenes",
        Text(|row| share(row.found.energy_gain)),
    ),
    (
        "lost",
        "particles that were not finite, and particle-ticks outside the box or in rock",
        Text(|row| row.found.lost.to_string()),
    ),
    (
        "true_error",
        "share of the liquid that stands elsewhere than in the converged run",
        Text(|row| share(row.true_error())),
    ),
    ("true_scatter", "standard error of it over the runs", Text(|row| share(row.true_error_scatter))),
    ("true_floor", "what of it may be the converged run's own", Text(|row| share(row.found.floor))),
    ("distance_momentum", "distance to the converged run: momentum", Share(|of| of.distance?.momentum)),
    ("distance_air", "distance to the converged run: mean air velocity", Share(|of| of.distance?.air)),
    ("particles", "particles at the end, rock included", Text(|row| row.found.particles.to_string())),
    ("front", "whether no valid setting beats it: true or false", Text(|row| row.front.to_string())),
    ("true_front", "whether none does by the true error: true or false", Text(|row| row.true_front.to_string())),
    ("faults", "what makes the row invalid, separated by semicolons", Text(|row| row.faults.join("; "))),
    ("hash", "hash of the final state of the first run", Text(|row| row.hash.clone())),
];

/// All columns in their order.
fn columns() -> Vec<Column> {
    let knobs = |part: Part| {
        let knobs = KNOBS.iter().filter(move |knob| knob.part == part);
        knobs.map(|knob| (knob.name, knob.meaning, Field::Knob(knob)))
    };
    SETTING.into_iter().chain(knobs(Part::Solver)).chain([PREDICTOR]).chain(knobs(Part::Air)).chain(RESULTS).collect()
}

fn ms(value: f64) -> String {
    format!("{value:.4}")
}

fn share(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:.6}"))
}

/// Writes the table, fastest setting first.
pub fn write(rows: &[Row], out: impl Write) -> io::Result<()> {
    let columns = columns();
    let mut table = csv::Writer::from_writer(out);
    table.write_record(columns.iter().map(|(name, ..)| name))?;
    let mut order: Vec<&Row> = rows.iter().collect();
    order.sort_by(|a, b| a.ms.total_cmp(&b.ms));
    for row in order {
        let tuning = Tuning::from(row.setting.quality);
        table.write_record(columns.iter().map(|(.., field)| match field {
            Field::Knob(knob) => knob.text(&tuning),
            Text(text) => text(row),
            Share(of) => share(of(&row.found.accuracy)),
        }))?;
    }
    table.flush()
}

#[cfg(test)]
mod tests {
    use super::{super::row::tests::row, *};

    #[test]
    fn the_document_says_what_every_column_holds() {
        let document = include_str!("../../../docs/accuracy.md");
        for (name, meaning, _) in columns().into_iter().filter(|(.., field)| !matches!(field, Field::Knob(_))) {
            let line = format!("| `{name}` | {meaning} |");
            assert!(document.contains(&line), "docs/accuracy.md has no line {line}");
        }
    }

    #[test]
    fn a_line_has_a_field_for_each_column_and_the_fastest_is_first() {
        let mut rows = [row("fine", 1.5, 0.005), row("fast, h 3", 0.5, 0.03)];
        rows[1].faults = vec!["energy up by 2.0 %".to_owned(), "mean density 0.970".to_owned()];
        let mut text = Vec::new();
        write(&rows, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[1].starts_with("\"fast, h 3\",,1,1,1,2,2.5,rational,0.2,"), "{}", lines[1]);
        assert!(lines[1].contains("energy up by 2.0 %; mean density 0.970"), "{}", lines[1]);
        assert!(lines[2].starts_with("fine,fine,1,1,"), "{}", lines[2]);
        assert!(lines[2].contains(",1.5000,1.5000,1.5000,1.5000,0.005000,,0.005000,,,0.990000,"), "{}", lines[2]);
        assert_eq!(lines[2].split(',').count(), columns().len());
    }
}
