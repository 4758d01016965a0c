//! The rows in words: a table, a summary, the document.

use crate::{
    lab::{
        gauntlet::case::{CASES, Case},
        markdown,
    },
    sim::{
        gauntlet::{Row, Verdict},
        numbers::figure,
    },
};
use std::fmt::Write;

/// Headings of the table.
const HEADINGS: [&str; 11] =
    ["case", "at", "", "particles", "gain, m/s", "density", "at the end", "motion", "work", "clamps", "ms"];

/// The rows as an aligned table in Markdown, and under it what broke.
pub fn table(rows: &[Row]) -> String {
    let lines: Vec<Vec<String>> = rows.iter().map(|row| cells(row).to_vec()).collect();
    let mut text = markdown::table(&HEADINGS, |column| column > 2, &lines);
    for row in rows.iter().filter(|row| !row.broken.is_empty()) {
        // Writing to a string does not fail.
        let _ = write!(text, "\n{} at {}: {}", row.case, row.quality, row.broken.join("; "));
        if let Some(known) = row.known {
            let _ = write!(text, " (known: {known})");
        }
    }
    if rows.iter().any(|row| !row.broken.is_empty()) {
        text.push('\n');
    }
    text
}

fn cells(row: &Row) -> [String; 11] {
    let verdict = match row.verdict {
        Verdict::Pass => "pass",
        Verdict::Known => "known",
        Verdict::Fail => "FAIL",
    };
    let maybe = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), figure);
    [
        row.case.to_owned(),
        row.quality.to_owned(),
        verdict.to_owned(),
        row.particles.to_string(),
        figure(row.gain),
        maybe(row.density_worst),
        maybe(row.density_end),
        figure(row.motion),
        figure(row.work),
        row.clamps.acted().map(|acted| acted.count).sum::<u64>().to_string(),
        format!("{:.2}/{:.1}", row.ms_median, row.ms_max),
    ]
}

/// How many cases came out how, in a line.
pub fn summary(rows: &[Row]) -> String {
    let count = |verdict: Verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    let (pass, known, fail) = (count(Verdict::Pass), count(Verdict::Known), count(Verdict::Fail));
    format!("{} runs: {pass} pass, {known} known of `classic`, {fail} fail", rows.len())
}

/// The document: what happens in each case, what it guards against, what came out.
pub fn document(rows: &[Row], processor: &str, command: &str) -> String {
    let mut text = format!(
        "# The gauntlet\n\n\
         Every hard case at every quality, run by the program as it is shipped. `{command}` writes this file; \
         `powder-master gauntlet` prints the table and ends with exit code 1 if a case fails. What it is for and what it \
         leaves open is told in [stability.md](stability.md).\n\n\
         *gain*: kinetic and potential energy above what was there and was put in, as the speed that all particles \
         together would have of it. *density*: 99th percentile of the density error, the worst after the shock and over \
         the last tenth of the case. *motion*: rms speed over the last tenth, d a tick. *work*: the dearest tick as a \
         multiple of a calm one (candidate pairs a particle × substeps × iterations; the same on every machine). *clamps*: \
         what all limiters did, summed over particles, cells and substeps. *ms*: median and longest tick, one thread \
         ({processor}, all processors busy).\n\n\
         In every case: every value is finite and no pressure below 0 after every tick, nobody is ever outside the box or \
         inside rock, no particle gets lost.\n\n{}.\n",
        summary(rows)
    );
    for case in CASES.iter().filter(|case| rows.iter().any(|row| row.case == case.name)) {
        // Writing to a string does not fail.
        let _ = write!(text, "\n{}", section(case, rows));
    }
    text
}

fn section(case: &Case, rows: &[Row]) -> String {
    let own = || rows.iter().filter(|row| row.case == case.name);
    let lines: Vec<Vec<String>> = own().map(|row| cells(row)[1..].to_vec()).collect();
    let Case { name, title, what, guards, allowed, .. } = case;
    let prose = |text: &str| markdown::fill(text, 120);
    let mut text = format!(
        "## {title} (`{name}`)\n\n{}\n\n{}\n\n{}\n\n{}",
        prose(what),
        prose(&format!("**Guards against:** {guards}")),
        prose(&format!("**Allowed:** {allowed}")),
        markdown::table(&HEADINGS[1..], |column| column > 1, &lines)
    );
    for row in own().filter(|row| !row.broken.is_empty()) {
        let known = row.known.map_or_else(String::new, |known| format!(" Known: {known}"));
        let _ = write!(text, "\n{}\n", prose(&format!("At `{}`: {}.{known}", row.quality, row.broken.join("; "))));
    }
    text
}
