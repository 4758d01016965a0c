//! `bench neighbours`: the binning table.

use crate::{
    cli::{failure::Failure, output, progress, threads},
    lab::{
        binning::{self, Growth, ORIGINAL, PRESET, Point, RATES},
        machine::processor,
        markdown,
    },
    sim::{numbers::grouped, workers::Workers},
};
use serde_json::json;
use std::path::Path;

/// Measures how many particles a tick may hold, and prints the table.
pub(in crate::cli) fn neighbours(threads: Option<u64>, json: Option<&Path>) -> Result<(), Failure> {
    output::check(json.as_slice())?;
    threads::start(threads)?;
    let line = progress::status();
    let growths = binning::measure(&Workers::default(), &mut |text| line.set_message(text.to_owned()))?;
    drop(line);
    let value = || {
        json!({
            "processor": processor(),
            "quality": PRESET.name(),
            "rates": RATES,
            "methods": growths,
            "original": { "rates": RATES[1..], "brute force": ORIGINAL[0], "bins": ORIGINAL[1] },
        })
    };
    output::report(json, value, || table(&growths))
}

/// The table in Markdown.
fn table(growths: &[Growth]) -> String {
    let own: String = growths.iter().map(|growth| format!(" | >{}", growth.name)).collect();
    let headings = format!(">ticks a second{own} | >original: brute force | >original: bins");
    let row = |name: &str, cells: Vec<String>| format!("{name} | {}", cells.join(" | "));
    let shown = |count: Option<f64>| count.map_or_else(|| "–".to_owned(), |count| grouped(format!("{count:.0}")));
    let rate = |(k, rate): (usize, &f64)| {
        let ours = growths.iter().map(|growth| growth.particles_at_rate[k]);
        let theirs = ORIGINAL.iter().map(|counts| k.checked_sub(1).map(|k| counts[k]));
        row(&rate.to_string(), ours.chain(theirs).map(shown).collect())
    };
    let ours = growths.iter().map(|growth| growth.exponent);
    let theirs = ORIGINAL.iter().map(|counts| binning::exponent_of(&RATES[1..], counts));
    let exponents = row("cost grows as", ours.chain(theirs).map(power).collect());
    let lines = RATES.iter().enumerate().map(rate).chain([exponents]);
    let point = |point: &Point| format!("{}: {:.3}", grouped(point.particles), point.ms);
    let points = |growth: &Growth| growth.points.iter().map(point).collect::<Vec<_>>().join("; ");
    let measured: Vec<String> =
        growths.iter().map(|growth| format!("- {}: {}\n", growth.name, points(growth))).collect();
    format!(
        "Particles at a tick rate, quality `{}`, {}:\n\n{}\nMeasured (particles: median ms a tick):\n\n{}",
        PRESET.name(),
        processor(),
        markdown::rows(&headings, lines),
        measured.concat()
    )
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
            points: vec![Point { particles: 128, ms: 0.25 }],
        };
        let text = table(&[growth]).split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
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
