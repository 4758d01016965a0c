//! The rows in words: a table, a summary, the document.

use crate::{
    lab::{
        exam::case::{CASES, Case},
        markdown,
    },
    sim::exam::{Row, Verdict},
};
use std::fmt::Write;

/// Headings of the table.
const HEADINGS: [&str; 9] = ["case", "quantity", "at", "expected", "got", "error", "tolerance", "", "ms"];
/// From which column on figures stand at the right.
const FIGURES: std::ops::RangeInclusive<usize> = 3..=6;

/// The rows as an aligned table in Markdown.
pub fn table(rows: &[Row]) -> String {
    align(&HEADINGS, rows.iter().map(|row| cells(row).to_vec()).collect())
}

/// The lines under the last headings, as many as are given.
fn align(headings: &[&str], lines: Vec<Vec<String>>) -> String {
    let skipped = HEADINGS.len() - headings.len();
    markdown::table(headings, |column| FIGURES.contains(&(column + skipped)) || column + 1 == headings.len(), &lines)
}

fn cells(row: &Row) -> [String; 9] {
    let [expected, got, error, tolerance] = row.figures();
    let verdict = match row.verdict {
        Verdict::Pass => "pass",
        Verdict::Miss => "miss",
        Verdict::Fail => "FAIL",
    };
    let (case, quantity) = (row.case.to_owned(), row.quantity.to_owned());
    let milliseconds = format!("{:.0}", row.milliseconds);
    [case, quantity, row.setting.clone(), expected, got, error, tolerance, verdict.to_owned(), milliseconds]
}

/// How many rows passed, and how many did not, in a line.
pub fn summary(rows: &[Row]) -> String {
    let count = |verdict: Verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    let (pass, miss, fail) = (count(Verdict::Pass), count(Verdict::Miss), count(Verdict::Fail));
    format!("{} rows: {pass} pass, {miss} miss below `balanced`, {fail} fail", rows.len())
}

/// The document: what is asked, what is known, what came out.
pub fn document(rows: &[Row], processor: &str, command: &str) -> String {
    let mut text = format!(
        "# The physics exam\n\n\
         Answers that are known from theory or experiment, computed by the program as it is shipped at each quality, and \
         compared. `{command}` writes this file; `powder-master exam` prints the table and ends with exit code 1 if a row \
         at `balanced` or better is beyond its tolerance. Rows beyond it at `classic`, `draft` or `fast` are marked `miss` \
         and stay.\n\n\
         Lengths in m; d = 0.1 m is the spacing of the particles, a tick is 1/60 s. *ms* is the processor time of one \
         thread for the whole simulation of a case in one setting ({processor}, all processors busy); the rows of a case \
         share it.\n\n{}.\n",
        summary(rows)
    );
    for case in CASES.iter().filter(|case| rows.iter().any(|row| row.case == case.name)) {
        // Writing to a string does not fail.
        let _ = write!(text, "\n{}", section(case, rows));
    }
    text
}

fn section(case: &Case, rows: &[Row]) -> String {
    let own: Vec<Vec<String>> =
        rows.iter().filter(|row| row.case == case.name).map(|row| cells(row)[1..].to_vec()).collect();
    let Case { name, title, setup, answer, tolerance, .. } = case;
    let prose = |text: &str| markdown::fill(text, 120);
    format!(
        "## {title} (`{name}`)\n\n{}\n\n{}\n\n{}\n\n{}",
        prose(setup),
        prose(&format!("**Known:** {answer}")),
        prose(&format!("**Tolerance:** {tolerance}")),
        align(&HEADINGS[1..], own)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(got: f64, verdict: Verdict) -> Row {
        Row {
            case: "free_fall",
            title: "Free fall",
            quantity: "speed",
            setting: "fast".into(),
            unit: "m/s",
            expected: 9.81,
            got,
            relative: true,
            error: (got / 9.81 - 1.0).abs(),
            tolerance: 0.02,
            verdict,
            milliseconds: 12.3,
        }
    }

    #[test]
    fn the_table_is_aligned_and_names_what_is_beyond() {
        let text = table(&[row(9.81, Verdict::Pass), row(12.0, Verdict::Miss), row(f64::NAN, Verdict::Fail)]);
        let lines: Vec<&str> = text.lines().collect();
        let width = lines[0].chars().count();
        assert!(lines.iter().all(|line| line.chars().count() == width), "not aligned:\n{text}");
        assert!(lines[2].contains("| 9.81 m/s | ") && lines[2].contains("| pass |"), "{text}");
        assert!(lines[3].contains("22.32 %") && lines[3].contains("2 %") && lines[3].contains("miss"), "{text}");
        assert!(lines[4].contains("none") && lines[4].contains("FAIL"), "{text}");
        assert_eq!(summary(&[row(9.81, Verdict::Pass), row(1.0, Verdict::Fail)]).split(": ").count(), 2);
    }
}
