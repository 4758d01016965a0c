//! A row of the curve: all runs of a setting together.

use super::{
    design::Setting,
    error::ErrorMeasure,
    record::{Found, Record},
};
use crate::lab::{experiment::Spread, stats};

/// Most that the energy may grow.
const ENERGY_GAIN: f64 = 0.01;

/// Furthest that the mean density may be off rest density.
const DENSITY_OFF: f64 = 0.02;

/// Errors below this are next to nothing: with it a pool of a thousand layers of particles stands off by one.
pub const NEGLIGIBLE: f64 = 1e-3;

/// What a setting costs and how exact it is.
#[derive(Clone, Debug)]
pub struct Row {
    /// The setting.
    pub setting: Setting,
    /// Number of runs.
    pub runs: usize,
    /// Time of a tick, ms: the median over the runs of their medians.
    pub ms: f64,
    /// The fastest and the slowest run's median, ms.
    pub ms_range: [f64; 2],
    /// 95th percentile of the ticks, ms: the median over the runs.
    pub ms_p95: f64,
    /// The error that counts in this scene: the mean over the runs.
    pub error: f64,
    /// Its standard error, as far as the runs tell; none of one run.
    pub error_scatter: Option<f64>,
    /// Standard error of the true error, likewise.
    pub true_error_scatter: Option<f64>,
    /// Everything that was found.
    pub found: Found,
    /// Hash of the final state of the first run.
    pub hash: String,
    /// What is wrong with the world that came out; nothing in a valid row.
    pub faults: Vec<String>,
    /// Whether no valid row beats it.
    pub front: bool,
    /// Whether no valid row takes less time and has less of a true error.
    pub true_front: bool,
}

impl Row {
    /// The runs of a setting together; `None` without any.
    pub fn new(setting: &Setting, measure: ErrorMeasure, records: &[&Record]) -> Option<Self> {
        let ms = Spread::of(records.iter().map(|record| record.ms))?;
        let all: Vec<&Found> = records.iter().map(|record| &record.found).collect();
        let found = Found::of_all(&all)?;
        let scatter = |of: &dyn Fn(&Found) -> Option<f64>| {
            stats::standard_error(&all.iter().filter_map(|found| of(found)).collect::<Vec<_>>())
        };
        Some(Self {
            setting: setting.clone(),
            runs: records.len(),
            ms: ms.median,
            ms_range: ms.range,
            ms_p95: Spread::of(records.iter().map(|record| record.ms_p95))?.median,
            error: measure.of_found(&found).unwrap_or(f64::NAN),
            error_scatter: scatter(&|found| measure.of_found(found)),
            true_error_scatter: scatter(&Found::true_error),
            faults: faults(measure, &found),
            found,
            hash: records.first()?.hash.clone(),
            front: false,
            true_front: false,
        })
    }

    /// What it is called in texts.
    pub fn title(&self) -> String {
        match self.setting.preset {
            Some(preset) => format!("`{}`", preset.name()),
            None => self.setting.name.clone(),
        }
    }

    /// The true error: share of the liquid that stands elsewhere than in the converged run.
    pub fn true_error(&self) -> Option<f64> {
        self.found.true_error()
    }

    /// Whether its world is sound, so that its error means something.
    pub fn is_valid(&self) -> bool {
        self.faults.is_empty()
    }
}

/// What makes an error meaningless: a fluid that explodes or stands too thin has little of it.
fn faults(measure: ErrorMeasure, found: &Found) -> Vec<String> {
    let mut faults = Vec::new();
    if found.lost > 0 {
        faults.push(format!("{} particles lost or outside", found.lost));
    }
    if measure == ErrorMeasure::Air {
        if found.accuracy.distance.is_none_or(|distance| distance.air.is_none()) {
            faults.push("no air to compare".to_owned());
        }
        return faults;
    }
    if let Some(gain) = found.energy_gain.filter(|gain| *gain > ENERGY_GAIN) {
        faults.push(format!("energy up by {:.1} %", 100.0 * gain));
    }
    match found.accuracy.density_mean {
        None => faults.push("no liquid with an inside".to_owned()),
        Some(density) if (density - 1.0).abs() <= DENSITY_OFF => (),
        Some(density) => faults.push(format!("mean density {density:.3}")),
    }
    faults
}

#[cfg(test)]
pub(super) mod tests {
    use super::{super::summary::Subject, *};
    use crate::{
        kernel::params::Preset,
        lab::{coarse::Distance, metrics::Accuracy},
    };

    /// A sweep of `dam_break`.
    pub(in crate::lab::sweep) fn subject(threads: usize) -> Subject<'static> {
        Subject {
            scene: "dam_break",
            parameters: "",
            measure: ErrorMeasure::Density,
            has_air: false,
            start: 0,
            ticks: 300,
            warmup: 59,
            threads,
        }
    }

    /// A valid row with these figures.
    pub(in crate::lab::sweep) fn row(name: &str, ms: f64, error: f64) -> Row {
        let preset = Preset::find(name);
        let quality = preset.unwrap_or(Preset::Fast).quality();
        let setting = Setting { name: name.to_owned(), preset, asked_detail: 1.0, quality, threads: 1 };
        let accuracy = Accuracy { density_error_mean: Some(error), density_mean: Some(0.99), ..Accuracy::default() };
        let sound = Found { accuracy, ..Found::default() };
        let record = Record { ms, ms_p95: ms, hash: String::new(), found: sound };
        Row::new(&setting, ErrorMeasure::Density, &[&record]).unwrap()
    }

    #[test]
    fn runs_go_together_by_the_median_of_their_times_and_the_mean_of_their_errors() {
        let record = |ms: f64, error: f64, lost: u64| {
            let accuracy = Accuracy {
                density_error_mean: Some(error),
                density_error_max: Some(10.0 * error),
                density_mean: Some(1.0),
                distance: Some(Distance { share: Some(2.0 * error), ..Distance::default() }),
                ..Accuracy::default()
            };
            let found = Found { lost, energy_gain: Some(error), accuracy, ..Found::default() };
            Record { ms, ms_p95: ms + 1.0, hash: error.to_string(), found }
        };
        let records = [record(1.2, 0.02, 0), record(0.9, 0.03, 2), record(3.0, 0.01, 1)];
        let records: Vec<&Record> = records.iter().collect();
        let setting = row("a", 1.0, 1.0).setting;
        let row = Row::new(&setting, ErrorMeasure::Density, &records).unwrap();
        assert_eq!((row.ms, row.ms_range, row.ms_p95, row.runs), (1.2, [0.9, 3.0], 2.2, 3));
        assert_eq!((row.found.lost, row.found.energy_gain, row.hash.as_str()), (3, Some(0.03), "0.02"));
        assert_eq!(row.found.accuracy.density_error_max, Some(0.3));
        let near = |value: Option<f64>, wanted: f64| (value.unwrap() - wanted).abs() < 1e-12;
        // The variance of 1, 2, 3 is 1.
        assert!(near(Some(row.error), 0.02) && near(row.error_scatter, 0.01 / 3.0_f64.sqrt()), "{row:?}");
        assert!(near(row.true_error(), 0.04) && near(row.true_error_scatter, 0.02 / 3.0_f64.sqrt()), "{row:?}");
        assert!(Row::new(&setting, ErrorMeasure::Density, &[]).is_none());
        let one = Row::new(&setting, ErrorMeasure::Density, &records[..1]).unwrap();
        assert_eq!((one.error, one.error_scatter), (0.02, None));
    }

    #[test]
    fn a_world_that_is_not_sound_is_not_valid() {
        let stands = |density_mean| Found {
            energy_gain: Some(0.002),
            accuracy: Accuracy { density_mean, ..Accuracy::default() },
            ..Found::default()
        };
        let sound = stands(Some(0.985));
        assert_eq!(faults(ErrorMeasure::Density, &sound), [""; 0]);
        for (bad, says) in [
            (Found { lost: 3, ..sound.clone() }, "3 particles"),
            (Found { energy_gain: Some(0.013), ..sound.clone() }, "1.3 %"),
            (stands(Some(0.97)), "0.970"),
            (stands(Some(1.05)), "1.050"),
            (stands(Some(f64::NAN)), "NaN"),
            (stands(None), "no liquid"),
        ] {
            let faults = faults(ErrorMeasure::Density, &bad);
            assert!(faults.len() == 1 && faults[0].contains(says), "{faults:?} does not say {says}");
        }
    }
}
