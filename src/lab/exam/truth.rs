//! What truth costs: the true error of the dam break at every quality and at several spacings, its time, and what other
//! programs reach by the same measure.

use crate::{
    kernel::params::Preset,
    lab::{
        cases::{Setting, Stopwatch},
        exam::{
            dam_truth::{CONVERGED, Converged, looks},
            refinement::chance,
            set_up::{SetUp, Start},
        },
        jobs::finish,
        stats,
    },
    scene::SceneError,
};
use serde::Deserialize;
use std::{fs, path::Path};

pub use crate::lab::exam::dam_truth::TIMES;

/// Particles along the base of the block.
pub const COLUMNS: [u32; 4] = [18, 35, 71, 142];

/// Runs of which the median time counts.
const ROUNDS: usize = 3;

/// What came of one quality at one spacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The quality.
    pub preset: Preset,
    /// Particles of the scene's own spacing along the base of the block.
    pub columns: u32,
    /// Share of the liquid that stands elsewhere than in the converged run, the mean of the times.
    pub error: f64,
    /// What of it may be chance.
    pub floor: f64,
    /// Time of one thread up to the last of the times, ms.
    pub ms: f64,
}

/// Particles of the block, twice as high as wide, at the scene's own spacing.
pub fn particles(columns: u32) -> u32 {
    2 * columns * columns
}

/// Runs the dam breaks, one after the other on one thread. `report` is called with the name of each.
pub fn study(columns: &[u32], presets: &[Preset], report: &mut dyn FnMut(&str)) -> Result<Vec<Outcome>, SceneError> {
    report("the converged run");
    let set_up = |preset: Preset| SetUp {
        setting: Setting { name: preset.name().to_owned(), preset, detail: 1.0, binding: false },
        stopwatch: Stopwatch::default(),
    };
    let Some(converged) = finish(Converged::run(&set_up(Preset::Fine), columns), || true) else {
        return Ok(Vec::new());
    };
    let converged = converged?;
    let mut outcomes = Vec::new();
    for &columns in columns {
        // What is as fine as the converged run can't be told from it.
        for &preset in presets.iter().filter(|preset| f64::from(columns) * preset.detail() < f64::from(CONVERGED)) {
            report(&format!("{} columns, {}", columns, preset.name()));
            let run = |start: Start| {
                let set_up = set_up(preset);
                let looks = finish(looks(&set_up, columns, start), || true).transpose()?;
                Ok::<_, SceneError>((looks.unwrap_or_default(), set_up.stopwatch.milliseconds()))
            };
            let (lattice, ms) = run(Start::Lattice)?;
            let mut times = vec![ms];
            for _ in 1..ROUNDS {
                times.push(run(Start::Lattice)?.1);
            }
            let (staggered, _) = run(Start::Staggered)?;
            let apart: Vec<f64> = lattice.iter().zip(&staggered).map(|(a, b)| a.distance(b)).collect();
            let mean = |values: &[f64]| stats::mean(values).unwrap_or(f64::NAN);
            outcomes.push(Outcome {
                preset,
                columns,
                error: mean(&converged.errors(columns, &lattice)),
                floor: chance(mean(&apart)),
                ms: stats::quantile(&mut times, 0.5).unwrap_or(f64::NAN),
            });
        }
    }
    Ok(outcomes)
}

/// Another program's true error, brought along in a file. Its time, on whatever machine, is none of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beside {
    /// Program, version and setting.
    pub name: String,
    /// Who measured it, when, against what.
    pub source: String,
    /// What was measured.
    pub figures: Vec<Figure>,
}

/// The true error of another program at one spacing.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Particles along the base of the block.
    pub columns: u32,
    /// Share of the liquid that stands elsewhere than in the converged run, at each of the times, %.
    pub percent: [f64; 3],
}

impl Beside {
    /// The programs in a JSON file. The error says why there are none.
    pub fn read(path: &Path) -> Result<Vec<Self>, String> {
        let text = fs::read_to_string(path).map_err(|error| format!("can't be read: {error}"))?;
        let allowed = "[{\"name\": …, \"source\": …, \"figures\": [{\"columns\": …, \"percent\": [three numbers]}]}]";
        serde_json::from_str(&text).map_err(|error| format!("{error}; allowed: {allowed}"))
    }
}

impl Figure {
    /// The mean of the times, a share.
    pub fn error(&self) -> f64 {
        self.percent.iter().sum::<f64>() / (100.0 * TIMES.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coarse and cheap; still a quarter of the spacing's error is no chance.
    #[test]
    fn the_error_is_above_its_floor_and_falls_with_the_spacing() {
        let outcomes = study(&[9, 18], &[Preset::Draft], &mut |_| {}).unwrap();
        let [coarse, fine] = outcomes[..] else { panic!("two spacings: {outcomes:?}") };
        assert!(coarse.error > coarse.floor && fine.error > fine.floor, "{outcomes:?}");
        assert!(fine.error < coarse.error && fine.ms > 0.0, "{outcomes:?}");
    }

    #[test]
    fn what_others_reach_is_read_with_its_source() {
        let others = Beside::read(Path::new("docs/truth-others.json")).unwrap();
        assert!(others.iter().all(|other| !other.source.is_empty() && !other.figures.is_empty()));
        let figure = Figure { columns: 71, percent: [1.0, 2.0, 3.0] };
        assert!((figure.error() - 0.02).abs() < 1e-12);
        assert!(Beside::read(Path::new("docs/none.json")).is_err());
    }
}
