//! `study truth`: the true error of the dam break against particles and time, beside other programs.

#[cfg(feature = "charts")]
use crate::lab::exam::truth_charts;
use crate::{
    cli::{failure::Failure, output, progress},
    kernel::params::Preset,
    lab::{
        exam::truth::{self, Beside, COLUMNS, Outcome, TIMES},
        markdown,
    },
    sim::numbers::{figure, grouped},
};
use std::path::{Path, PathBuf};

/// Names of the pictures.
const CHARTS: [&str; 2] = ["truth-particles.svg", "truth-time.svg"];

/// Runs the study, draws, and prints what it found.
pub(super) fn truth(folder: &Path, beside: Option<&Path>) -> Result<(), Failure> {
    let read = |path: &Path| Beside::read(path).map_err(|error| Failure::Usage(format!("{}: {error}", path.display())));
    let beside = beside.map_or(Ok(Vec::new()), read)?;
    let paths = CHARTS.map(|name| folder.join(name));
    output::check(&paths.each_ref().map(|path| path.as_path()))?;
    output::note_missing_charts("study truth");
    let line = progress::status();
    let outcomes = truth::study(&COLUMNS, &Preset::ALL, &mut |text| line.set_message(text.to_owned()))?;
    drop(line);
    draw(&paths, &outcomes, &beside)?;
    output::print(&text(&outcomes))
}

#[cfg(feature = "charts")]
fn draw(paths: &[PathBuf; 2], outcomes: &[Outcome], beside: &[Beside]) -> Result<(), Failure> {
    for (path, chart) in paths.iter().zip(truth_charts::charts(outcomes, beside)) {
        output::write(path, |file| std::io::Write::write_all(file, chart.svg()?.as_bytes()))?;
    }
    Ok(())
}

/// Without charts only the table is printed.
#[cfg(not(feature = "charts"))]
fn draw(_: &[PathBuf; 2], _: &[Outcome], _: &[Beside]) -> Result<(), Failure> {
    Ok(())
}

/// The tables in Markdown.
fn text(outcomes: &[Outcome]) -> String {
    let times = TIMES.map(figure).join(", ");
    let names: String = Preset::ALL.iter().map(|preset| format!(" | >`{}`", preset.name())).collect();
    let headings = format!(">columns | >particles{names}");
    let rows = |cell: &dyn Fn(&Outcome) -> String| {
        let row = |columns: u32| {
            let cells = Preset::ALL.map(|preset| {
                let found = outcomes.iter().find(|outcome| (outcome.columns, outcome.preset) == (columns, preset));
                found.map_or_else(|| "–".to_owned(), cell)
            });
            format!("{columns} | {} | {}", grouped(truth::particles(columns)), cells.join(" | "))
        };
        markdown::rows(&headings, COLUMNS.map(row))
    };
    let errors = rows(&|outcome| format!("{} ({})", figure(100.0 * outcome.error), figure(100.0 * outcome.floor)));
    let costs = rows(&|outcome| figure(outcome.ms));
    format!(
        "Liquid that stands elsewhere than in the converged run, %, the mean of T = {times}; in brackets what of it may be \
         chance:\n\n{errors}\nTime of one thread up to the last T, ms, the median of three:\n\n{costs}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_quality_has_its_column() {
        let outcome =
            |preset, columns| Outcome { preset, columns, error: 0.0123, floor: 0.001, ms: f64::from(columns) };
        let text = text(&[outcome(Preset::Draft, 18), outcome(Preset::Fine, 71)]);
        let plain = text.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
        for line in ["| 18 | 648 | – | 1.23 (0.1) | – | – | – | – |", "| 71 | 10,082 | – | – | – | – | 71 | – |"]
        {
            assert!(plain.contains(line), "no line {line} in\n{text}");
        }
    }
}
