//! Which curve the panel shows: of each scene the one that was measured in this game, the shipped one of the scene that
//! is played, its times scaled to this machine, and where there is neither, a survey that begins of its own accord.

use crate::{
    game::{hud::panels::accuracy::plot::ErrorKind, language::grouped},
    lab::live::{
        accuracy::{Curve, Here, Survey, SurveyRequest},
        shipped,
    },
    scene::{blueprint::Blueprint, effects::Effect},
    sim::{
        effects::{Effects, status},
        ledger::{PassLedger, PassRecord},
        numbers::short,
        state::Setup,
    },
};
use std::collections::{BTreeMap, BTreeSet};
use tr::tr;

/// Ticks at one setting after which the median time of the last ones (as many) is of that setting alone.
const SETTLED: u64 = 64;
/// Change of the scale, as a share, that is followed: less would only make the shipped curve tremble.
const FOLLOWED: f32 = 0.1;

/// The curves, and which of their errors is shown.
#[derive(Default)]
pub struct Curves {
    /// The last measured curve of each scene, by its fingerprint.
    measured: BTreeMap<u64, Curve>,
    /// The scene that is played, by its fingerprint, and the curve that is shipped with it.
    played: Option<(u64, Option<Curve>)>,
    /// Scenes of which a survey was begun, so that none begins of its own accord once more.
    begun: BTreeSet<u64>,
    /// The scene of the survey that began of its own accord.
    unasked: Option<u64>,
    /// The error that the player wants to see, if that was said.
    wanted: Option<ErrorKind>,
    /// Whether a survey is under way.
    surveys: bool,
    steady: Steady,
}

/// The setting that the world runs at, and the number of ticks in the ledger when it began to.
#[derive(Default)]
struct Steady {
    setting: Option<Here>,
    since: u64,
}

/// What a survey that nobody asked for depends on.
#[derive(Clone, Copy, Debug)]
pub struct Situation {
    /// Whether time goes on.
    pub runs: bool,
    /// Movable particles.
    pub particles: usize,
    /// Ticks that were timed.
    pub timed: u64,
}

impl Curves {
    /// The scene that is played, by its fingerprint.
    pub fn turn_to(&mut self, scene: u64, blueprint: &Blueprint) {
        if self.played.as_ref().is_none_or(|(known, _)| *known != scene) {
            self.played = Some((scene, shipped::curve(blueprint)));
            self.steady = Steady::default();
        }
    }

    /// Takes up what was measured.
    pub fn follow(&mut self, survey: &Survey) {
        let of = survey.curve.of;
        if survey.is_running() {
            self.begun.insert(of);
            if !self.surveys {
                // What is measured is what is to be seen.
                self.wanted = Some(ErrorKind::Density);
            }
        }
        self.surveys = survey.is_running();
        if !survey.curve.points.is_empty() && self.measured.get(&of) != Some(&survey.curve) {
            self.measured.insert(of, survey.curve.clone());
        }
    }

    /// Scales the shipped curve to this machine, as soon as a tick's time is that of one setting: what it would take if
    /// nothing slept, as nothing slept when the curve was measured.
    pub fn calibrate(&mut self, setup: &Setup, ledger: &PassLedger, effects: &Effects) {
        let saved = status::saving(Effect::Sleep, effects, ledger, PassRecord::saved_last);
        let tick = ledger.tick();
        let (taken, detail) = (tick.median().as_secs_f64() * 1000.0, f64::from(setup.blueprint.scale.detail));
        // Of a world that sleeps for the most part more would be guessed than is known.
        let awake = saved.filter(|saved| *saved <= taken).map_or(0.0, |saved| taken + saved);
        self.scale(Here { quality: setup.quality, detail, milliseconds: awake as f32 }, tick.calls);
    }

    /// Goes on with the setting that is in force after so many ticks; a time of 0 is unknown.
    fn scale(&mut self, here: Here, ticks: u64) {
        let setting = Some(Here { milliseconds: 0.0, ..here });
        if self.steady.setting != setting || ticks < self.steady.since {
            self.steady = Steady { setting, since: ticks };
        }
        let Some((_, Some(curve))) = &mut self.played else { return };
        if ticks < self.steady.since + SETTLED || here.milliseconds <= 0.0 {
            return;
        }
        let before = curve.here.replace(here);
        let (scale, last) = (curve.scale(), Curve { here: before, ..curve.clone() }.scale());
        let is_near = |scale: f32| last.is_some_and(|last| (scale / last - 1.0).abs() < FOLLOWED);
        // A setting that is not on the curve says nothing about it.
        if scale.is_none_or(is_near) {
            curve.here = before;
        }
    }

    /// What is wanted of the survey without being asked for: a curve where there is none, once, of a world in which
    /// something goes on; and no longer one of a scene that was left.
    pub fn wants(&mut self, survey: &Survey, situation: Situation) -> Option<SurveyRequest> {
        let (scene, shipped) = self.played.as_ref()?;
        if let Some(left) = self.unasked.filter(|left| left != scene) {
            self.unasked = None;
            if survey.is_running() && survey.curve.of == left {
                self.begun.remove(&left);
                return Some(SurveyRequest::Cancel);
            }
        }
        let Situation { runs, particles, timed } = situation;
        let goes_on = runs && particles > 0 && timed >= SETTLED;
        if shipped.is_some() || survey.is_running() || self.begun.contains(scene) || !goes_on {
            return None;
        }
        self.begun.insert(*scene);
        self.unasked = Some(*scene);
        Some(SurveyRequest::BeginQuietly)
    }

    /// Shows this error from now on.
    pub fn want(&mut self, kind: ErrorKind) {
        self.wanted = Some(kind);
    }

    /// The curve of the scene that is played, which of its errors is shown, and whether there is another. The true
    /// error is known of shipped curves only; the density error is that of the curve that was measured here, if there
    /// is one.
    pub fn shown(&self) -> (Option<&Curve>, ErrorKind, bool) {
        let Some((scene, shipped)) = &self.played else { return (None, ErrorKind::Density, false) };
        let true_one = shipped.as_ref().filter(|curve| curve.points.iter().any(|point| point.truth.is_some()));
        match (true_one, self.wanted.unwrap_or(ErrorKind::True)) {
            (Some(curve), ErrorKind::True) => (Some(curve), ErrorKind::True, true),
            _ => (self.measured.get(scene).or(shipped.as_ref()), ErrorKind::Density, true_one.is_some()),
        }
    }
}

/// Where a curve comes from, in one line.
pub fn source(curve: &Curve, scale: Option<f32>) -> String {
    if let Some(on) = &curve.shipped {
        return match scale.map(short) {
            Some(scale) => tr!("shipped, {on}, times × {scale} as here", on, scale),
            None => tr!("shipped, {on}, times as there", on),
        };
    }
    let (scene, tick) = (&curve.scene, grouped(curve.tick));
    match scale.filter(|scale| (scale - 1.0).abs() > 0.005).map(short) {
        Some(scale) => tr!(
            "{scene} from tick {tick} on, one thread, all awake, times × {scale} as in the game",
            scene,
            tick,
            scale
        ),
        None => tr!("{scene} from tick {tick} on, one thread, all awake", scene, tick),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{kernel::params::Preset, lab::live::accuracy::CurvePoint};

    /// A curve of `draft`, of 1 ms, and `fine`, of 4 ms.
    fn curve(of: u64, truth: Option<f32>) -> Curve {
        let point = |preset: Preset, milliseconds| CurvePoint {
            preset,
            quality: preset.quality(),
            detail: 1.0,
            milliseconds,
            error: Some(0.01),
            p99: None,
            truth,
            is_sound: true,
        };
        Curve { of, points: vec![point(Preset::Draft, 1.0), point(Preset::Fine, 4.0)], ..Curve::default() }
    }

    /// The curves while a scene is played that comes with this one.
    fn playing(scene: u64, shipped: Option<Curve>) -> Curves {
        Curves { played: Some((scene, shipped)), ..Curves::default() }
    }

    fn at(preset: Preset, milliseconds: f32) -> Here {
        Here { quality: preset.quality(), detail: 1.0, milliseconds }
    }

    fn scale(curves: &Curves) -> Option<f32> {
        curves.shown().0.and_then(Curve::scale)
    }

    const GOES_ON: Situation = Situation { runs: true, particles: 100, timed: 1000 };

    #[test]
    fn a_shipped_curve_is_scaled_once_the_time_is_that_of_one_setting() {
        let mut curves = playing(1, Some(curve(1, None)));
        for ticks in 0..SETTLED {
            curves.scale(at(Preset::Draft, 9.0), ticks);
            assert_eq!(scale(&curves), None, "after {ticks} ticks some may be of another setting");
        }
        curves.scale(at(Preset::Draft, 1.3), SETTLED);
        assert_eq!(scale(&curves), Some(1.3));
        curves.scale(at(Preset::Draft, 1.35), SETTLED + 1);
        assert_eq!(scale(&curves), Some(1.3), "it trembles");
        curves.scale(at(Preset::Fine, 1.3), SETTLED + 2);
        assert_eq!(scale(&curves), Some(1.3), "a new setting has to settle first");
        curves.scale(at(Preset::Fine, 8.0), 2 * SETTLED + 2);
        assert_eq!(scale(&curves), Some(2.0));
        curves.scale(at(Preset::Fine, 0.0), 2 * SETTLED + 3);
        assert_eq!(scale(&curves), Some(2.0), "a world that sleeps says nothing");
        for ticks in 0..2 * SETTLED {
            curves.scale(at(Preset::Balanced, 5.0), ticks);
        }
        assert_eq!(scale(&curves), Some(2.0), "and neither does what is not on the curve");
        for ticks in 0..2 * SETTLED {
            curves.scale(Here { detail: 2.0, ..at(Preset::Fine, 50.0) }, ticks);
        }
        assert_eq!(scale(&curves), Some(2.0), "nor the same quality at another detail");
    }

    #[test]
    fn a_survey_begins_of_its_own_accord_once_and_only_where_something_goes_on() {
        let mut curves = playing(1, None);
        let idle = Survey::default();
        for still in [
            Situation { runs: false, ..GOES_ON },
            Situation { particles: 0, ..GOES_ON },
            Situation { timed: 3, ..GOES_ON },
        ] {
            assert_eq!(curves.wants(&idle, still), None, "{still:?}");
        }
        assert_eq!(curves.wants(&idle, GOES_ON), Some(SurveyRequest::BeginQuietly));
        assert_eq!(curves.wants(&idle, GOES_ON), None, "it was given up");
        curves.played = Some((2, Some(curve(2, None))));
        assert_eq!(curves.wants(&idle, GOES_ON), None, "there is a curve");
        let asked = Survey { progress: Some(0.1), curve: curve(3, None), ..Survey::default() };
        curves.played = Some((3, None));
        curves.follow(&asked);
        assert_eq!(curves.wants(&asked, GOES_ON), None, "one is under way");
        assert_eq!(curves.wants(&idle, GOES_ON), None, "the player gave it up");
    }

    #[test]
    fn a_survey_that_nobody_asked_for_ends_with_its_scene_and_may_begin_again() {
        let mut curves = playing(1, None);
        assert_eq!(curves.wants(&Survey::default(), GOES_ON), Some(SurveyRequest::BeginQuietly));
        let under_way = Survey { progress: Some(0.1), curve: Curve { of: 1, ..Curve::default() }, request: None };
        curves.follow(&under_way);
        curves.played = Some((2, Some(curve(2, None))));
        assert_eq!(curves.wants(&under_way, GOES_ON), Some(SurveyRequest::Cancel));
        assert_eq!(curves.wants(&Survey::default(), GOES_ON), None);
        curves.played = Some((1, None));
        assert_eq!(curves.wants(&Survey::default(), GOES_ON), Some(SurveyRequest::BeginQuietly));
    }

    #[test]
    fn truth_comes_first_where_it_is_known_and_density_from_here_where_it_was_measured() {
        let tells = |curves: &Curves| {
            let (curve, kind, has_both) = curves.shown();
            (curve.map(|curve| curve.shipped.is_some()), kind, has_both)
        };
        assert_eq!(tells(&Curves::default()), (None, ErrorKind::Density, false));
        let shipped = |truth| Some(Curve { shipped: Some("there".to_owned()), ..curve(1, truth) });
        let mut curves = playing(1, shipped(None));
        assert_eq!(tells(&curves), (Some(true), ErrorKind::Density, false));
        curves.played = Some((1, shipped(Some(0.05))));
        assert_eq!(tells(&curves), (Some(true), ErrorKind::True, true));
        curves.want(ErrorKind::Density);
        assert_eq!(tells(&curves), (Some(true), ErrorKind::Density, true));
        curves.follow(&Survey { curve: curve(1, None), ..Survey::default() });
        assert_eq!(tells(&curves), (Some(false), ErrorKind::Density, true), "what was measured here is newer");
        curves.want(ErrorKind::True);
        assert_eq!(tells(&curves), (Some(true), ErrorKind::True, true), "only the shipped one has it");
        curves.played = Some((7, None));
        assert_eq!(tells(&curves), (None, ErrorKind::Density, false), "another scene");
        curves.played = Some((1, shipped(Some(0.05))));
        curves.follow(&Survey { progress: Some(0.1), curve: curve(1, None), ..Survey::default() });
        assert_eq!(tells(&curves), (Some(false), ErrorKind::Density, true), "what is measured is what is to be seen");
    }

    #[test]
    fn a_curve_says_where_it_comes_from() {
        let measured = Curve { scene: "pool".to_owned(), tick: 1200, ..Curve::default() };
        assert_eq!(source(&measured, Some(1.0)), "pool from tick 1,200 on, one thread, all awake");
        assert!(source(&measured, Some(0.5)).ends_with(", times × 0.5 as in the game"));
        let shipped = Curve { shipped: Some("AMD EPYC, 1 thread".to_owned()), ..measured };
        assert_eq!(source(&shipped, None), "shipped, AMD EPYC, 1 thread, times as there");
        assert_eq!(source(&shipped, Some(1.3)), "shipped, AMD EPYC, 1 thread, times × 1.3 as here");
    }
}
