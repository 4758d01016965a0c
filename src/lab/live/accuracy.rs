//! What is known of the accuracy of the running world: its density error, and the curve of error against time that was
//! measured from one of its states. The systems of this module write, HUD and autopilot read; nothing changes a world.

use crate::{
    kernel::params::{Preset, Quality},
    lab::dial::is_same_detail,
    scene::blueprint::Blueprint,
    sim::snapshot::hash_bytes,
};
use bevy::prelude::Resource;
use std::{collections::VecDeque, time::Duration};

/// Ticks from one sample of the running world to the next.
pub const SAMPLE_EVERY: u64 = 3;

/// Samples that the shown error is the mean of: half a second.
const RECENT: usize = 10;

/// Interior particles in these samples below which there is no error to speak of: one a sample. The errors of single
/// particles scatter by as much as they are, so that of fewer the mean is unknown by a third and more; and these are
/// droplets, each with a particle inside for a moment.
const FEWEST: usize = RECENT;

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
    /// How many interior particles were in the sample.
    pub interior: usize,
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

    /// Mean density error over the particles that were sampled; `None` if fewer than [`FEWEST`] of them were inside of
    /// a liquid.
    pub fn mean(&self) -> Option<f32> {
        self.over_particles(|sample| sample.mean)
    }

    /// 99th percentile of the density error, its mean over the samples likewise.
    pub fn p99(&self) -> Option<f32> {
        self.over_particles(|sample| sample.p99)
    }

    fn over_particles(&self, of: impl Fn(&ErrorSample) -> Option<f32>) -> Option<f32> {
        let (mut sum, mut count) = (0.0, 0);
        for sample in &self.recent {
            sum += of(sample).unwrap_or(0.0) * sample.interior as f32;
            count += sample.interior;
        }
        (count >= FEWEST).then(|| sum / count as f32)
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
    /// Detail of the run: what was asked for times what the preset brings along.
    pub detail: f64,
    /// Median time of a tick, ms: on one thread, where it is not a shipped curve's.
    pub milliseconds: f32,
    /// Mean density error, a fraction of the run's own: to be compared at one detail only. `None` without a liquid
    /// inside.
    pub error: Option<f32>,
    /// Its 99th percentile.
    pub p99: Option<f32>,
    /// Share of the liquid that stands elsewhere than in a converged run, where that is known.
    pub truth: Option<f32>,
    /// Whether the world came out sound (see `lab::sweep`), so that its errors mean something.
    pub is_sound: bool,
}

impl CurvePoint {
    /// The detail that is asked for to have it.
    pub fn asked_detail(&self) -> f64 {
        self.detail / self.preset.detail()
    }
}

/// The setting that a world runs at, and what a tick takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Here {
    /// The quality.
    pub quality: Quality,
    /// Detail of the run, with what the quality brings along.
    pub detail: f64,
    /// Time of a tick, ms.
    pub milliseconds: f32,
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
    /// The setting that was in force, and what a tick of the game took at it; `None` where all slept: such a time
    /// belongs to no quality. Of a shipped curve, the setting that is in force now and what a tick would take if
    /// nothing slept; `None` until that is known.
    pub here: Option<Here>,
    /// What such a tick took on one thread with the same particles asleep, ms; `None` where none slept.
    pub here_on_one_thread: Option<f32>,
    /// A point for each preset that is done, the cheapest first; some at other details, too; and the quality that was
    /// in force, if it is no preset.
    pub points: Vec<CurvePoint>,
    /// True errors below this are not told apart.
    pub floor: Option<f32>,
    /// Where a curve that was not measured here comes from.
    pub shipped: Option<String>,
}

impl Curve {
    /// The point of a preset at a detail that is asked for, if it is done.
    pub fn point(&self, preset: Preset, asked_detail: f64) -> Option<&CurvePoint> {
        let is_it = |point: &&CurvePoint| point.preset == preset && point.quality == preset.quality();
        self.points.iter().filter(is_it).find(|point| is_same_detail(point.asked_detail(), asked_detail))
    }

    /// The point of a setting, whatever it is called.
    pub fn point_of(&self, quality: &Quality, detail: f64) -> Option<&CurvePoint> {
        self.points.iter().find(|point| point.quality == *quality && is_same_detail(point.detail, detail))
    }

    /// What the measured times are multiplied by to stand for ticks of the game, which may have more threads: the
    /// setting that was in force is known from both. `None` until it is measured.
    pub fn scale(&self) -> Option<f32> {
        let Here { quality, detail, milliseconds } = self.here?;
        let same = || self.point_of(&quality, detail).map(|point| point.milliseconds);
        let measured = self.here_on_one_thread.or_else(same)?;
        (milliseconds > 0.0 && measured > 0.0).then(|| milliseconds / measured)
    }
}

/// A hash over everything that a scene starts with but its quality and its detail: two scenes with the same one have
/// the same curves, which go over both.
pub fn fingerprint(blueprint: &Blueprint) -> u64 {
    let Blueprint { name, origin, parameters, fluid, elements, effects, particle_limit, .. } = blueprint;
    // Debug writes a number in as many digits as it takes to read it back, so other values are other texts.
    let text = format!("{name} {origin} {parameters:?} {fluid:?} {elements:?} {effects:?} {particle_limit}");
    hash_bytes(text.as_bytes())
}

/// "Measure here", or of its own accord where there is no curve: asked for by the HUD, done by `survey`.
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
    /// The same with less of the machine and of the finer details, as nobody asked for it; not where there is no thread
    /// to spare.
    BeginQuietly,
    /// Give up.
    Cancel,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, effects::EffectModes};

    fn sample(tick: u64, mean: Option<f32>) -> ErrorSample {
        let interior = if mean.is_some() { 20 } else { 0 };
        ErrorSample { tick, mean, p99: mean, interior, cost: Duration::from_micros(300) }
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
    fn the_live_error_is_one_of_particles_and_of_enough_of_them() {
        let mut live = LiveError::default();
        live.note(ErrorSample { interior: FEWEST - 1, ..sample(0, Some(0.01)) });
        assert_eq!(live.mean(), None, "a few particles are no liquid");
        live.note(ErrorSample { interior: 1, ..sample(3, Some(0.51)) });
        let expected = (0.01 * (FEWEST - 1) as f32 + 0.51) / FEWEST as f32;
        assert!(live.mean().is_some_and(|mean| (mean - expected).abs() < 1e-6), "{:?} is not {expected}", live.mean());
    }

    #[test]
    fn a_scene_with_other_settings_is_another_and_at_another_quality_the_same() {
        let build = |text: &str, columns: &str, preset, detail| {
            let settings = [("columns".to_owned(), columns.to_owned())];
            let scene = scene::from_text("pool", text.to_owned()).unwrap().at_detail(detail);
            fingerprint(&scene.build(&settings, preset, &EffectModes::new()).unwrap())
        };
        let text = include_str!("../../../assets/scenes/dam_break.ron");
        let usual = build(text, "24", None, 1.0);
        assert_eq!(usual, build(text, "24", Some(Preset::Reference), 1.0), "the quality is what the curve is over");
        assert_eq!(usual, build(text, "24", None, 0.7), "and so is the detail");
        assert_ne!(usual, build(text, "25", None, 1.0), "a parameter");
        let lower = text.replacen("2 * columns * d", "columns * d", 1);
        assert_ne!(lower, text, "there is no block to change");
        assert_ne!(usual, build(&lower, "24", None, 1.0), "another file of that name");
    }

    /// A point of a preset at a detail of the run.
    fn point(preset: Preset, detail: f64, milliseconds: f32) -> CurvePoint {
        let quality = preset.quality();
        CurvePoint { preset, quality, detail, milliseconds, error: None, p99: None, truth: None, is_sound: true }
    }

    #[test]
    fn the_scale_is_of_ticks_in_which_the_same_sleep() {
        let here = Some(Here { quality: Preset::Fast.quality(), detail: 1.0, milliseconds: 1.0 });
        let curve = Curve { here, points: vec![point(Preset::Fast, 1.0, 4.0)], ..Curve::default() };
        assert_eq!(curve.scale(), Some(0.25));
        let half_asleep = Curve { here_on_one_thread: Some(2.0), ..curve.clone() };
        assert_eq!(half_asleep.scale(), Some(0.5), "four threads of an awake world are not two and sleep");
        assert_eq!(Curve { here: None, ..curve }.scale(), None, "a tick in which all sleep has no quality");
    }

    #[test]
    fn settings_that_differ_in_their_detail_alone_are_told_apart() {
        let points = vec![point(Preset::Fine, 1.0, 2.0), point(Preset::Reference, 2.0, 8.0)];
        let at = |detail| Some(Here { quality: Preset::Fine.quality(), detail, milliseconds: 4.0 });
        let curve = Curve { here: at(2.0), points, ..Curve::default() };
        assert_eq!(curve.scale(), Some(0.5), "`fine` at twice the detail is `reference`");
        assert_eq!(Curve { here: at(1.0), ..curve.clone() }.scale(), Some(2.0));
        assert_eq!(Curve { here: at(0.5), ..curve.clone() }.scale(), None, "what is not on the curve has no scale");
        assert_eq!(curve.point(Preset::Reference, 1.0).map(|point| point.milliseconds), Some(8.0));
        assert_eq!((curve.point(Preset::Fine, 2.0), curve.point(Preset::Reference, 2.0)), (None, None));
    }

    #[test]
    fn another_history_begins_anew() {
        let mut live = LiveError::default();
        live.note(sample(600, Some(5.0)));
        live.note(sample(3, Some(1.0)));
        assert_eq!(live.mean(), Some(1.0));
    }
}
