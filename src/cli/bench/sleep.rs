//! `bench sleep`: what it saves to let water sleep.

use crate::{
    cli::{
        bench::{SceneSettings, of_each},
        failure::Failure,
        output,
    },
    kernel::{params::Preset, units::TICKS_PER_SECOND},
    lab::{
        machine::processor,
        markdown,
        sleep_cost::{self, SleepCost},
    },
    sim::numbers::grouped,
};
use serde_json::json;
use std::path::Path;

/// The quality that is measured.
const PRESET: Preset = Preset::Balanced;

/// Rounds of a measurement.
const ROUNDS: usize = 5;

/// The scenes, with settings of theirs.
const SCENES: [SceneSettings; 3] =
    [("hydrostatic", &[]), ("hydrostatic", &[("columns", "400"), ("depth", "250")]), ("communicating_vessels", &[])];

/// Measures each scene and prints the table.
pub(in crate::cli) fn sleep(quick: bool, json: Option<&Path>) -> Result<(), Failure> {
    output::check(json.as_slice())?;
    let (scenes, rounds) = if quick { (&SCENES[..1], 1) } else { (&SCENES[..], ROUNDS) };
    let costs = of_each(scenes, |name, settings| sleep_cost::measure(name, settings, PRESET, rounds))?;
    let value = || json!({ "processor": processor(), "quality": PRESET.name(), "scenes": costs });
    output::report(json, value, || text(&costs, rounds))
}

/// The table in Markdown.
fn text(costs: &[SleepCost], rounds: usize) -> String {
    let row = |cost: &SleepCost| {
        let SleepCost { scene, particles, asleep, ticks, ms_awake, ms_asleep } = cost;
        let after = f64::from(*ticks) / f64::from(TICKS_PER_SECOND);
        let [particles, asleep] = [particles, asleep].map(|count| grouped(*count));
        let ratio = ms_awake / ms_asleep;
        format!("`{scene}` | {particles} | {asleep} | {after:.1} | {ms_awake:.3} | {ms_asleep:.4} | {ratio:.0}")
    };
    format!(
        "At `{}`, one thread, {}; medians of {rounds} runs each in turn, of a tick's ms.\n\n{}",
        PRESET.name(),
        processor(),
        markdown::rows(
            "scene | >particles | >asleep | >after, s | >awake, ms | >asleep, ms | >ratio",
            costs.iter().map(row)
        )
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_both_times_and_their_ratio() {
        let cost =
            SleepCost { scene: "here", particles: 1_600, asleep: 1_600, ticks: 90, ms_awake: 0.5, ms_asleep: 0.005 };
        let table = text(&[cost], 3);
        let row = table.lines().find(|line| line.contains("`here`")).unwrap();
        let cells: Vec<&str> = row.split('|').map(str::trim).filter(|cell| !cell.is_empty()).collect();
        assert_eq!(cells, ["`here`", "1,600", "1,600", "1.5", "0.500", "0.0050", "100"]);
    }
}
