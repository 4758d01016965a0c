//! `bench heat`: what heat costs.

use crate::{
    cli::{failure::Failure, output, progress, threads},
    kernel::params::Preset,
    lab::{
        heat_cost::{self, HeatCost},
        machine::processor,
        markdown,
    },
    sim::{numbers::grouped, workers::Workers},
};
use serde_json::json;
use std::path::Path;

/// The quality that is measured.
const PRESET: Preset = Preset::Balanced;

/// Rounds of a measurement.
const ROUNDS: usize = 7;

/// Measures it on one thread and on several, and prints the table.
pub(in crate::cli) fn heat(threads: Option<u64>, json: Option<&Path>) -> Result<(), Failure> {
    output::check(json.as_slice())?;
    threads::start(threads)?;
    let line = progress::status();
    let mut costs = Vec::new();
    for workers in [Workers::single(), Workers::default()] {
        let count = workers.threads();
        line.set_message(format!("threads: {count}"));
        if !costs.iter().any(|cost: &HeatCost| cost.threads == count) {
            costs.push(heat_cost::measure(PRESET, &workers, ROUNDS)?);
        }
    }
    drop(line);
    let value = || json!({ "processor": processor(), "quality": PRESET.name(), "threads": costs });
    output::report(json, value, || text(&costs))
}

/// The table in Markdown.
fn text(costs: &[HeatCost]) -> String {
    let row = |cost: &HeatCost| {
        let HeatCost { threads, particles, ms: [with, without] } = cost;
        format!("{} | {threads} | {with:.3} | {without:.3} | {:.2}", grouped(*particles), cost.ratio())
    };
    format!(
        "At `{}`, {}; medians of a tick in ms.\n\n{}",
        PRESET.name(),
        processor(),
        markdown::rows(">particles | >threads | >with heat | >without | >ratio", costs.iter().map(row))
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_a_row_for_each_number_of_threads() {
        let cost = |threads| HeatCost { threads, particles: 10_000, ms: [2.0, 1.25] };
        let text = text(&[cost(1), cost(2)]);
        assert!(text.contains("10,000 |"), "{text}");
        let rows = text.lines().filter(|line| line.contains("2.000") && line.contains("1.60")).count();
        assert_eq!(rows, 2, "{text}");
    }
}
