//! What is known of the accuracy of the running world: its density error, and the curve of error against time that was
//! measured from one of its states. The systems of this module write, HUD and autopilot read; nothing changes a world.

use crate::{
    kernel::params::{Preset, Quality},
    scene::blueprint::Blueprint,
    sim::snapshot::hash_bytes,
};
use bevy::prelude::Resource;
use std::{collections::VecDeque, time::Duration};

/// Ticks from one sample of the running world to the next.
pub const SAMPLE_EVERY: u64 = 3;

/// Samples that the shown error is the mean of: half a second.
const RECENT: usize = 10;

/// Whether the error of the running world is shown or held. Otherwise it is not sampled and costs nothing.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Watched(pub bool);

/// One sample of the density error, as fractions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorSample {
    /// Ticks that the world had done.
    pub tick: u64,
    /// Mean density error (see `lab::density`) of the sampled interior particles; `None` if there were none.
    pub mean: Option<f32>,
    /// Its 99th percentile.
    pub p99: Option<f32>,
    /// Time that taking the sample took.
    pub cost: Duration,
}

/// The density error of the running world over the last half second.
#[derive(Resource, Clone, Debug, Default)]
pub struct LiveError {
    recent: VecDeque<ErrorSample>,
}

impl LiveError {
    /// Notes a sample. An earlier tick than the last one's is another history: what was noted before is forgotten.
    pub fn note(&mut self, sample: ErrorSample) {
        if self.recent.back().is_some_and(|last| sample.tick < last.tick) {
            self.recent.clear();
        }
        if self.recent.len() == RECENT {
            self.recent.pop_front();
        }
        self.recent.push_back(sample);
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.recent.clear();
    }

    /// The last sample.
    pub fn latest(&self) -> Option<&ErrorSample> {
        self.recent.back()
    }

    /// Mean density error; `None` without a liquid inside.
    pub fn mean(&self) -> Option<f32> {
        average(self.recent.iter().filter_map(|sample| sample.mean))
    }

    /// 99th percentile of the density error.
    pub fn p99(&self) -> Option<f32> {
        average(self.recent.iter().filter_map(|sample| sample.p99))
    }

    /// What sampling costs, ms a tick.
    pub fn milliseconds_a_tick(&self) -> f32 {
        let costs = self.recent.iter().map(|sample| sample.cost.as_secs_f32() * 1000.0);
        average(costs).unwrap_or(0.0) / SAMPLE_EVERY as f32
    }
}

fn average(values: impl Iterator<Item = f32>) -> Option<f32> {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / count as f32)
}

/// What one quality costs and gives from a moment of a world on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Its name.
    pub preset: Preset,
    /// Its numbers.
    pub quality: Quality,
    /// Median time of a tick on one thread, ms.
    pub milliseconds: f32,
    /// Mean density error, a fraction; `None` without a liquid inside.
    pub error: Option<f32>,
    /// Its 99th percentile.
    pub p99: Option<f32>,
}

/// Error against time of the presets, all from the same state of a world in which nothing sleeps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Name of the world's scene.
    pub scene: String,
    /// Which scene of that name, with which settings (see [`fingerprint`]).
    pub of: u64,
    /// The world's tick.
    pub tick: u64,
    /// The quality that was in force, and what a tick of the game took at it, ms; `None` where all slept: such a
    /// time belongs to no quality.
    pub here: Option<(Quality, f32)>,
    /// What such a tick took on one thread with the same particles asleep, ms; `None` where none slept.
    pub here_on_one_thread: Option<f32>,
    /// One point a preset that is done, the cheapest first; and the quality that was in force, if it is no preset.
    pub points: Vec<CurvePoint>,
}

impl Curve {
    /// The point of a preset, if it is done.
    pub fn point(&self, preset: Preset) -> Option<&CurvePoint> {
        self.points.iter().find(|point| point.preset == preset && point.quality == preset.quality())
    }

    /// What the measured times are multiplied by to stand for ticks of the game, which may have more threads: the
    /// quality that was in force is known from both. `None` until it is measured.
    pub fn scale(&self) -> Option<f32> {
        let (quality, milliseconds) = self.here?;
        let same = || self.points.iter().find(|point| point.quality == quality).map(|point| point.milliseconds);
        let one_thread = self.here_on_one_thread.or_else(same)?;
        (milliseconds > 0.0 && one_thread > 0.0).then(|| milliseconds / one_thread)
    }
}

/// A hash over everything that a scene starts with but its quality: two scenes with the same one have the same curves.
/// The detail that a preset brings along belongs to the quality, that which was asked for does not.
pub fn fingerprint(blueprint: &Blueprint) -> u64 {
    let Blueprint { name, origin, parameters, fluid, elements, effects, particle_limit, .. } = blueprint;
    let detail = f64::from(blueprint.scale.detail) / blueprint.preset.detail();
    // Debug writes a number in as many digits as it takes to read it back, so other values are other texts.
    let text = format!("{name} {origin} {parameters:?} {detail} {fluid:?} {elements:?} {effects:?} {particle_limit}");
    hash_bytes(text.as_bytes())
}

/// "Measure here": asked for by the HUD, done by `survey`.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Survey {
    /// What is to be done next.
    pub request: Option<SurveyRequest>,
    /// Share that is done, 0 … 1, while it runs.
    pub progress: Option<f32>,
    /// The curve of the last survey, or as far as this one is. Empty before the first.
    pub curve: Curve,
}

impl Survey {
    /// Whether one is under way.
    pub fn is_running(&self) -> bool {
        self.progress.is_some()
    }
}

/// What the survey is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurveyRequest {
    /// Measure from the world as it is. One that is under way is given up.
    Begin,
    /// Give up.
    Cancel,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, effects::EffectModes};

    fn sample(tick: u64, mean: Option<f32>) -> ErrorSample {
        ErrorSample { tick, mean, p99: mean, cost: Duration::from_micros(300) }
    }

    #[test]
    fn the_live_error_is_a_mean_that_forgets() {
        let mut live = LiveError::default();
        assert_eq!(live.mean(), None);
        for tick in 0..30 {
            live.note(sample(tick, Some(if tick < 20 { 9.0 } else { 1.0 })));
        }
        assert_eq!(live.mean(), Some(1.0), "only the last {RECENT} count");
        assert!((live.milliseconds_a_tick() - 0.1).abs() < 1e-4);
        live.note(sample(40, None));
        assert_eq!(live.mean(), Some(1.0), "a moment without liquid inside has no error");
    }

    #[test]
    fn a_scene_with_other_settings_is_another_and_at_another_quality_the_same() {
        let build = |text: &str, columns: &str, preset| {
            let settings = [("columns".to_owned(), columns.to_owned())];
            let scene = scene::from_text("pool", text.to_owned()).unwrap();
            fingerprint(&scene.build(&settings, preset, &EffectModes::new()).unwrap())
        };
        let text = include_str!("../../../assets/scenes/dam_break.ron");
        let usual = build(text, "24", None);
        assert_eq!(usual, build(text, "24", Some(Preset::Reference)), "the quality is what the curve is over");
        assert_ne!(usual, build(text, "25", None), "a parameter");
        let lower = text.replacen("2 * columns * d", "columns * d", 1);
        assert_ne!(lower, text, "there is no block to change");
        assert_ne!(usual, build(&lower, "24", None), "another file of that name");
    }

    #[test]
    fn the_scale_is_of_ticks_in_which_the_same_sleep() {
        let point = |milliseconds| CurvePoint {
            preset: Preset::Fast,
            quality: Preset::Fast.quality(),
            milliseconds,
            error: None,
            p99: None,
        };
        let here = Some((Preset::Fast.quality(), 1.0));
        let curve = Curve { here, points: vec![point(4.0)], ..Curve::default() };
        assert_eq!(curve.scale(), Some(0.25));
        let half_asleep = Curve { here_on_one_thread: Some(2.0), ..curve.clone() };
        assert_eq!(half_asleep.scale(), Some(0.5), "four threads of an awake world are not two and sleep");
        assert_eq!(Curve { here: None, ..curve }.scale(), None, "a tick in which all sleep has no quality");
    }

    #[test]
    fn another_history_begins_anew() {
        let mut live = LiveError::default();
        live.note(sample(600, Some(5.0)));
        live.note(sample(3, Some(1.0)));
        assert_eq!(live.mean(), Some(1.0));
    }
}
