//! `bench neighbours`: the binning table.

use crate::{
    cli::{
        args::BenchArguments,
        bench::row,
        failure::Failure,
        output::{self, STDOUT},
        progress, threads,
    },
    lab::{
        binning::{self, BinningError, Growth, ORIGINAL, PRESET, RATES},
        machine::processor,
    },
    sim::{numbers::grouped, workers::Workers},
};
use serde_json::json;
use std::{fmt::Write, path::Path};

/// Measures how many particles a tick may hold, and prints the table.
pub(super) fn neighbours(arguments: &BenchArguments) -> Result<(), Failure> {
    if let Some(option) = arguments.scaling.first_given(&[]) {
        return Err(Failure::Usage(format!("{option} belongs to bench scaling; allowed here: --threads, --json")));
    }
    let json = arguments.json.as_deref();
    let to_stdout = json == Some(Path::new(STDOUT));
    output::check(json.filter(|_| !to_stdout).as_slice())?;
    threads::start(arguments.threads)?;
    let line = progress::status();
    let growths =
        binning::measure(&Workers::default(), &mut |text| line.set_message(text.to_owned())).map_err(|error| {
            match error {
                BinningError::Scene(error) => Failure::from(error),
                BinningError::Threads(_) => Failure::Outcome(error.to_string()),
            }
        })?;
    drop(line);
    if let Some(path) = json {
        let report = json!({
            "processor": processor(),
            "quality": PRESET.name(),
            "rates": RATES,
            "methods": growths,
            "original": { "rates": RATES[1..], "brute force": ORIGINAL[0], "bins": ORIGINAL[1] },
        });
        output::write_json(path, &report)?;
    }
    if to_stdout { Ok(()) } else { output::print(&table(&growths)) }
}

/// The table in Markdown.
fn table(growths: &[Growth]) -> String {
    let mut text = format!("Particles at a tick rate, quality `{}`, {}:\n\n", PRESET.name(), processor());
    let names = growths.iter().map(|growth| growth.name.as_str()).chain(["original: brute force", "original: bins"]);
    let names: Vec<&str> = names.collect();
    text += &row(&[&["ticks a second"], &names[..]].concat().iter().map(ToString::to_string).collect::<Vec<_>>());
    text += &format!("|{}\n", "---:|".repeat(names.len() + 1));
    let shown = |count: Option<f64>| count.map_or_else(|| "–".to_owned(), |count| grouped(format!("{count:.0}")));
    for (k, rate) in RATES.iter().enumerate() {
        let ours = growths.iter().map(|growth| growth.particles_at_rate[k]);
        let theirs = ORIGINAL.iter().map(|counts| k.checked_sub(1).map(|k| counts[k]));
        let cells: Vec<String> = std::iter::once(rate.to_string()).chain(ours.chain(theirs).map(shown)).collect();
        text += &row(&cells);
    }
    let mut exponents: Vec<String> = growths.iter().map(|growth| power(growth.exponent)).collect();
    exponents.extend(ORIGINAL.iter().map(|counts| power(binning::exponent_of(&RATES[1..], counts))));
    text += &row(&[&["cost grows as".to_owned()], &exponents[..]].concat());
    text += "\nMeasured (particles: median ms a tick):\n\n";
    for growth in growths {
        let points: Vec<String> =
            growth.points.iter().map(|point| format!("{}: {:.3}", grouped(point.particles), point.ms)).collect();
        // Writing to a string does not fail.
        let _ = writeln!(text, "- {}: {}", growth.name, points.join("; "));
    }
    text
}

fn power(exponent: Option<f64>) -> String {
    exponent.map_or_else(|| "–".to_owned(), |exponent| format!("n^{exponent:.2}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_a_row_for_each_rate_beside_the_originals() {
        let growth = Growth {
            name: "bins".into(),
            threads: 1,
            particles_at_rate: vec![Some(1234.4), None, Some(5.0), Some(999.0), Some(1_234_567.0)],
            exponent: Some(1.0),
            points: vec![binning::Point { particles: 128, ms: 0.25 }],
        };
        let text = table(&[growth]);
        for line in [
            "| ticks a second | bins | original: brute force | original: bins |",
            "| 75 | 1,234 | – | – |",
            "| 70 | – | 170 | 1,500 |",
            "| 30 | 1,234,567 | 260 | 1,750 |",
            "| cost grows as | n^1.00 | n^2.00 | n^5.42 |",
            "- bins: 128: 0.250",
        ] {
            assert!(text.contains(line), "no line {line} in\n{text}");
        }
    }
}
