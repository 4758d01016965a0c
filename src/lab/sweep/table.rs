//! curve.csv: a line for every setting. A field is empty where a value does not apply.

use super::row::Row;
use crate::kernel::params::{Preset, Quality};
use std::io::{self, Write};

/// Names of the columns with what they hold.
pub const COLUMNS: [(&str, &str); 33] = [
    ("setting", "name of the setting, unique in the table"),
    ("preset", "name of the preset that it is"),
    ("threads", "threads of the kernel"),
    ("substeps", "substeps a tick"),
    ("iterations", "solver iterations a substep"),
    ("kernel_radius", "kernel radius h, d"),
    ("gradient", "gradient kernel: spiky or rational"),
    ("correction_limit", "furthest correction in a substep, d"),
    ("predictor", "whether the pressure predictor runs: true or false"),
    ("air_cell", "edge of an air cell, d"),
    ("air_courant", "Courant number of the air's substeps"),
    ("air_advection", "advection of the air: first_order or second_order"),
    ("runs", "number of runs"),
    ("ms", "time of a tick, ms: the median over the runs of their medians"),
    ("ms_low", "median of the fastest run, ms"),
    ("ms_high", "median of the slowest run, ms"),
    ("ms_p95", "95th percentile of the ticks, ms: the median over the runs"),
    ("error", "the error that counts: error_p99, or distance_air in a scene about air"),
    ("error_mean", "density error: mean over the interior particles, a fraction"),
    ("error_p99", "density error: 99th percentile, a fraction"),
    ("error_max", "density error: largest, a fraction"),
    ("density_mean", "mean density of the interior particles, 1 at rest density"),
    ("volume_error", "room that the liquid takes too much, a fraction"),
    ("residual", "the solver's own mean constraint where it is violated, in the last iteration"),
    ("energy_gain", "highest energy against the start's less 1, without what swelling takes; only in closed scenes"),
    ("lost", "particles that were not finite, and particle-ticks outside the box or in rock"),
    ("distance_share", "distance to the reference: liquid in another coarse cell, a fraction"),
    ("distance_momentum", "distance to the reference: momentum"),
    ("distance_air", "distance to the reference: mean air velocity"),
    ("particles", "particles at the end, rock included"),
    ("front", "whether no valid setting beats it: true or false"),
    ("faults", "what makes the row invalid, separated by semicolons"),
    ("hash", "hash of the final state"),
];

/// Writes the table, fastest setting first.
pub fn write(rows: &[Row], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(COLUMNS.map(|(name, _)| name))?;
    let mut order: Vec<&Row> = rows.iter().collect();
    order.sort_by(|a, b| a.ms.total_cmp(&b.ms));
    for row in order {
        table.write_record(fields(row))?;
    }
    table.flush()
}

fn fields(row: &Row) -> [String; COLUMNS.len()] {
    let Row { setting, found, .. } = row;
    let Quality {
        substeps,
        iterations,
        kernel_radius,
        correction_limit,
        air_cell,
        air_courant,
        air_advection,
        gradient,
        predictor,
    } = setting.quality;
    let ms = |value: f64| format!("{value:.4}");
    let share = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.6}"));
    [
        setting.name.clone(),
        setting.preset.map_or("", Preset::name).to_owned(),
        setting.threads.to_string(),
        substeps.to_string(),
        iterations.to_string(),
        kernel_radius.to_string(),
        gradient.name().to_owned(),
        correction_limit.to_string(),
        predictor.to_string(),
        air_cell.to_string(),
        air_courant.to_string(),
        air_advection.name().to_owned(),
        row.runs.to_string(),
        ms(row.ms),
        ms(row.ms_range[0]),
        ms(row.ms_range[1]),
        ms(row.ms_p95),
        share(Some(row.error).filter(|error| error.is_finite())),
        share(found.error_mean),
        share(found.error_p99),
        share(found.error_max),
        share(found.density_mean),
        share(found.volume_error),
        share(found.residual),
        share(found.energy_gain),
        found.lost.to_string(),
        share(found.distance.share),
        share(found.distance.momentum),
        share(found.distance.air),
        found.particles.to_string(),
        row.front.to_string(),
        row.faults.join("; "),
        row.hash.clone(),
    ]
}

#[cfg(test)]
mod tests {
    use super::{super::row::tests::row, *};

    #[test]
    fn the_document_says_what_every_column_holds() {
        let document = include_str!("../../../docs/accuracy.md");
        for (name, meaning) in COLUMNS {
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
        assert!(lines[1].starts_with("\"fast, h 3\",,1,1,4,2.5,rational,0.1,true,"), "{}", lines[1]);
        assert!(lines[1].contains("energy up by 2.0 %; mean density 0.970"), "{}", lines[1]);
        assert!(lines[2].starts_with("fine,fine,1,"), "{}", lines[2]);
        assert!(lines[2].contains(",1.5000,1.5000,1.5000,1.5000,0.005000,,0.005000,,0.990000,"), "{}", lines[2]);
        assert_eq!(lines[2].split(',').count(), COLUMNS.len());
    }
}
