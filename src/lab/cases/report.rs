//! The rows in words: a table, a summary, the document.

use crate::{
    lab::{
        cases::{
            case::{About, Case, Column},
            row::{Figures, Row, Verdict},
        },
        markdown,
    },
    sim::numbers::figure,
};

/// Width of the document, characters.
const WIDTH: usize = 120;

/// The rows as an aligned table in Markdown, and under it what broke.
pub fn table<C: Case>(rows: &[Row<C::Figures>]) -> String {
    let broken: String = (rows.iter().filter(|row| !row.figures.broken().is_empty()))
        .map(|row| {
            let known = row.figures.known().map_or_else(String::new, |known| format!(" (known: {known})"));
            format!("\n{} at {}: {}{known}", row.case, row.setting, row.figures.broken().join("; "))
        })
        .collect();
    let remarks: String = (rows.iter())
        .filter_map(|row| Some(format!("\n{} at {}, {}", row.case, row.setting, row.figures.remark()?)))
        .collect();
    let end = if broken.is_empty() && remarks.is_empty() { "" } else { "\n" };
    align(C::SUITE.columns, rows.iter()) + &broken + &remarks + end
}

fn align<'a, F: Figures>(columns: &[Column<F>], rows: impl Iterator<Item = &'a Row<F>>) -> String {
    let headings: Vec<&str> = columns.iter().map(|column| column.heading).collect();
    let lines: Vec<Vec<String>> = rows.map(|row| columns.iter().map(|column| (column.cell)(row)).collect()).collect();
    markdown::table(&headings, |column| columns[column].is_figure, &lines)
}

/// How many rows came out how, in a line.
pub fn summary<C: Case>(rows: &[Row<C::Figures>]) -> String {
    let count = |verdict: Verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    let excused = C::SUITE.excused.iter().map(|(verdict, words)| format!("{} {words}, ", count(*verdict)));
    let (pass, excused, fail) = (count(Verdict::Pass), excused.collect::<String>(), count(Verdict::Fail));
    format!("{} {}: {pass} pass, {excused}{fail} fail", rows.len(), C::SUITE.rows)
}

/// What to say if a row failed: how many, and the first of them.
pub fn failure<C: Case>(rows: &[Row<C::Figures>]) -> Option<String> {
    let failed: Vec<_> = rows.iter().filter(|row| row.verdict == Verdict::Fail).collect();
    let suite = C::SUITE;
    failed.first().map(|first| {
        let (count, all, first) = (failed.len(), rows.len(), (suite.failure)(first));
        format!("{count} of {all} {} fail{}, the first is {first}", suite.rows, suite.failing)
    })
}

/// What is to be said of a detail that is not the cases' own.
pub fn about_detail(detail: f64) -> Option<String> {
    let [width, count] = [1.0 / detail, detail * detail].map(figure);
    (detail != 1.0).then(|| {
        format!(
            "At detail {detail}: particles {width} times as wide and {count} times as many as otherwise, all else equal. \
             Tolerances and bounds are those of detail 1."
        )
    })
}

/// The document: what happens in each case, what it is for, what came out.
pub fn document<C: Case>(rows: &[Row<C::Figures>], processor: &str, command: &str, detail: f64) -> String {
    let mut introduction = (C::SUITE.introduction)(command, processor);
    introduction.extend(about_detail(detail).map(|text| format!("\n\n{text}")));
    let head = introduction.split("\n\n").map(|text| markdown::fill(text, WIDTH)).collect::<Vec<_>>().join("\n\n");
    let run =
        (C::SUITE.cases)().iter().map(|case| case.about()).filter(|case| rows.iter().any(|row| row.case == case.name));
    let sections: String = run.map(|case| format!("\n{}", section::<C>(&case, rows))).collect();
    format!("{head}\n\n{}.\n{sections}", summary::<C>(rows))
}

fn section<C: Case>(case: &About, rows: &[Row<C::Figures>]) -> String {
    let own = || rows.iter().filter(|row| row.case == case.name);
    let About { name, title, what, why, .. } = case;
    let mut paragraphs = vec![format!("## {title} (`{name}`)"), markdown::fill(what, WIDTH)];
    for (label, text) in C::SUITE.labels.iter().zip(why) {
        paragraphs.push(markdown::fill(&format!("**{label}:** {text}"), WIDTH));
    }
    paragraphs.push(align(&C::SUITE.columns[1..], own()));
    let mut text = paragraphs.join("\n\n");
    for row in own().filter(|row| !row.figures.broken().is_empty()) {
        let known = row.figures.known().map_or_else(String::new, |known| format!(" Known: {known}"));
        let broken = format!("At `{}`: {}.{known}", row.setting, row.figures.broken().join("; "));
        text += &format!("\n{}\n", markdown::fill(&broken, WIDTH));
    }
    for row in own() {
        if let Some(remark) = row.figures.remark() {
            text += &format!("\n{}\n", markdown::fill(&format!("At `{}`, {remark}", row.setting), WIDTH));
        }
    }
    text
}
