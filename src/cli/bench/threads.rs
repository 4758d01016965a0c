//! `bench threads`: what more threads bring, pass by pass, and what still more would bring.

use crate::{
    cli::{
        bench::{SceneSettings, of_each},
        failure::Failure,
        output,
    },
    kernel::params::Preset,
    lab::{
        machine::processor,
        markdown,
        thread_cost::{self, ThreadCost, counts, serial},
    },
    sim::{
        numbers::{fixed, grouped},
        workers::Workers,
    },
};
use serde_json::json;
use std::path::Path;

/// The quality that is measured.
const PRESET: Preset = Preset::Balanced;

/// The scenes, with settings of theirs: 10,082, 100,352 and 999,698 particles that fall, and a scene with air, rock, springs and
/// drains.
const SCENES: [SceneSettings; 4] = [
    ("dam_break", &[("columns", "71")]),
    ("waterfall", &[]),
    ("dam_break", &[("columns", "224")]),
    ("dam_break", &[("columns", "707")]),
];

/// Rounds of a measurement.
const ROUNDS: usize = 5;

/// Numbers of threads for which the speed-up is predicted, whether or not the machine has as many.
const PREDICTED: [usize; 3] = [4, 8, 16];

/// Share of a tick on one thread below which a pass has no row of its own.
const WORTH_A_ROW: f64 = 0.01;

/// Measures each scene on 1, 2, 4 … threads, up to `most` or all, and prints the tables.
pub(in crate::cli) fn threads(most: Option<u64>, quick: bool, json: Option<&Path>) -> Result<(), Failure> {
    output::check(json.as_slice())?;
    let threads = counts(most.map_or_else(|| Workers::default().threads(), |most| most as usize));
    let (scenes, rounds) = if quick { (&SCENES[..1], 1) } else { (&SCENES[..], ROUNDS) };
    let costs = of_each(scenes, |name, settings| thread_cost::measure(name, settings, PRESET, &threads, rounds))?;
    let value = || json!({ "processor": processor(), "quality": PRESET.name(), "scenes": costs });
    output::report(json, value, || text(&costs, rounds))
}

/// The tables in Markdown.
fn text(costs: &[ThreadCost], rounds: usize) -> String {
    let passes: String = costs.iter().map(of_passes).collect();
    format!(
        "At `{}`, {}; mean times of a tick in ms, each tick's the shortest of {rounds}.\n\n{}{passes}",
        PRESET.name(),
        processor(),
        markdown::rows(
            "scene | >particles | >threads | >ms | >speed-up | >predicted | same world",
            costs.iter().flat_map(of_ticks)
        )
    )
}

/// A row for each number of threads, measured or predicted.
fn of_ticks(cost: &ThreadCost) -> Vec<String> {
    let ThreadCost { scene, threads, ms, same_hash, .. } = cost;
    let measured: Vec<(usize, f64, f64)> =
        threads.iter().zip(ms).zip(cost.speedups()).map(|((threads, ms), faster)| (*threads, *ms, faster)).collect();
    let predicted = PREDICTED.into_iter().filter(|threads| cost.predicted(*threads).is_some());
    let mut all: Vec<usize> = threads.iter().copied().chain(predicted).collect();
    all.sort_unstable();
    all.dedup();
    let row = |threads: usize| {
        let here = measured.iter().find(|(count, ..)| *count == threads);
        // What it is predicted from is not predicted.
        let predicted = fixed((threads > 2).then(|| cost.predicted(threads)).flatten(), 2);
        let (ms, faster) = (fixed(here.map(|of| of.1), 3), fixed(here.map(|of| of.2), 2));
        let same = here.map_or("–", |_| if *same_hash { "yes" } else { "NO" });
        format!("`{scene}` | {} | {threads} | {ms} | {faster} | {predicted} | {same}", grouped(cost.particles))
    };
    all.into_iter().map(row).collect()
}

/// The passes of a scene: times on each number of threads, and what of each two threads don't share.
fn of_passes(cost: &ThreadCost) -> String {
    let ThreadCost { scene, particles, threads, ms, passes, .. } = cost;
    let rows = passes.iter().filter(|pass| pass.ms[0] >= WORTH_A_ROW * ms[0]);
    let rows: Vec<_> = rows.map(|pass| (format!("`{}`", pass.pass), pass.ms.clone())).collect();
    let others = (0..ms.len()).map(|k| ms[k] - rows.iter().map(|(_, ms)| ms[k]).sum::<f64>()).collect();
    let whole = serial(ms).filter(|whole| *whole > 0.0);
    let line = |(name, times): (String, Vec<f64>)| {
        let each = times.iter().map(|ms| format!(" | {ms:.3}")).collect::<String>();
        let serial = serial(&times);
        let share = serial.zip(whole).map(|(part, whole)| 100.0 * part / whole);
        format!("{name}{each} | {} | {}", fixed(serial, 3), fixed(share, 0))
    };
    let more = [("other passes, and between them".to_owned(), others), ("tick".to_owned(), ms.clone())];
    let headings = threads.iter().map(|threads| format!(" | >ms, {threads}")).collect::<String>();
    format!(
        "\n`{scene}`, {} particles:\n\n{}",
        grouped(*particles),
        markdown::rows(
            &format!("pass{headings} | >serial, ms | >share of it, %"),
            rows.into_iter().chain(more).map(line)
        )
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::thread_cost::PassTimes;

    #[test]
    fn tables_have_what_was_measured_beside_what_is_predicted() {
        let passes = vec![
            PassTimes { pass: "solve", ms: vec![3.0, 1.5, 1.0] },
            PassTimes { pass: "edit", ms: vec![0.01, 0.01, 0.01] },
        ];
        let cost = ThreadCost {
            scene: "here",
            particles: 10_082,
            threads: vec![1, 2, 4],
            ms: vec![4.0, 2.5, 2.0],
            passes,
            same_hash: true,
        };
        let alone = ThreadCost { threads: vec![1], ms: vec![4.0], ..cost.clone() };
        assert_eq!(
            of_ticks(&alone),
            ["`here` | 10,082 | 1 | 4.000 | 1.00 | – | yes"],
            "nothing is predicted from one thread"
        );
        let rows = of_ticks(&cost);
        assert_eq!(rows.len(), 5, "{rows:?}");
        // A quarter is serial: 1/(1/4 + 3/16).
        assert_eq!(rows[2], "`here` | 10,082 | 4 | 2.000 | 2.00 | 2.29 | yes");
        assert_eq!(rows[4], "`here` | 10,082 | 16 | – | – | 3.37 | –");
        let text = of_passes(&cost);
        assert!(text.contains("| `solve`") && !text.contains("edit"), "{text}");
        // All of what is serial is outside of the solve.
        let cells = |name: &str| {
            let row = text.lines().find(|line| line.contains(name)).unwrap();
            row.split('|').map(|cell| cell.trim().to_owned()).filter(|cell| !cell.is_empty()).collect::<Vec<_>>()
        };
        assert_eq!(cells("other passes")[1..], ["1.000", "1.000", "1.000", "1.000", "100"]);
        assert_eq!(cells("solve")[1..], ["3.000", "1.500", "1.000", "0.000", "0"]);
        assert_eq!(cells("| tick")[1..], ["4.000", "2.500", "2.000", "1.000", "100"]);
    }
}
