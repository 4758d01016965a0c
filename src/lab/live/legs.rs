//! What a survey runs: the presets at the detail in force, and the ends of those that run in real time at half and at
//! twice of it, as far as that can be afforded.

use crate::{
    kernel::params::{Preset, Quality},
    lab::dial::{self, is_same_detail},
    sim::state::Setup,
};

/// Presets that are run at other details, too: the ends of what runs in real time.
const ENDS: [Preset; 2] = [Preset::Draft, Preset::Fine];
/// Details at which they are, multiples of the one that was asked for.
const DETAILS: [f64; 2] = [0.5, 2.0];
/// Most particles, rock included, of a run of them. With as many a tick of `fine` takes some 8 ms, and the run 1 s of
/// work for which half a thread takes twice as long (AMD EPYC: 6.5 ms at 40,328 particles).
const MOST: f64 = 50_000.0;
/// Most particles of any run that is finer than the world, in a survey that nobody asked for.
const MOST_QUIETLY: f64 = 15_000.0;

/// A setting to run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// Its name.
    pub preset: Preset,
    /// Its numbers.
    pub quality: Quality,
    /// The detail that is asked for, beside which the preset has its own.
    pub asked_detail: f64,
    /// Whether the particles that sleep in the game may sleep.
    pub sleep: bool,
}

impl Leg {
    /// The setting in force, with nothing asleep.
    pub fn in_force(setup: &Setup) -> Self {
        let Setup { preset, quality, .. } = *setup;
        Self { preset, quality, asked_detail: setup.asked_detail(), sleep: false }
    }

    /// The detail of the run.
    pub fn detail(&self) -> f64 {
        self.asked_detail * self.preset.detail()
    }

    /// Work of it, in units of an iteration over the particles of detail 1.
    pub fn work(&self) -> f32 {
        dial::work(&self.quality) * (self.detail() * self.detail()) as f32
    }

    /// Whether it is the same run.
    fn is_as(&self, other: &Self) -> bool {
        self.quality == other.quality && is_same_detail(self.detail(), other.detail())
    }
}

/// What is worth a run from a world of `count` particles, rock included; each setting once.
pub(super) fn legs(setup: &Setup, count: f64, quietly: bool) -> Vec<Leg> {
    let here = Leg::in_force(setup);
    let preset = |preset: Preset, factor: f64| Leg {
        preset,
        quality: preset.quality(),
        asked_detail: factor * here.asked_detail,
        sleep: false,
    };
    let own = Preset::ALL.into_iter().map(|of| preset(of, 1.0)).chain([here]);
    let particles = |leg: &Leg| count * (leg.detail() / here.detail()).powi(2);
    let others = ENDS.into_iter().flat_map(|of| DETAILS.map(|factor| preset(of, factor)));
    let others = others.filter(|leg| particles(leg) <= MOST);
    let is_light = |leg: &Leg| !quietly || leg.detail() <= here.detail() || particles(leg) <= MOST_QUIETLY;
    let mut legs: Vec<Leg> = Vec::new();
    for leg in own.chain(others).filter(is_light) {
        if !legs.iter().any(|other| other.is_as(&leg)) {
            legs.push(leg);
        }
    }
    legs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{self, effects::EffectModes},
        sim::checkpoint::Checkpoint,
    };
    use std::sync::Arc;

    /// What is run from a dam break at a detail of `count` particles: names and details of the runs.
    fn runs(preset: Preset, detail: f64, count: f64, quietly: bool) -> Vec<(&'static str, f64)> {
        let scene = scene::load("dam_break").unwrap().at_detail(detail);
        let settings = [("columns".to_owned(), "10".to_owned())];
        let blueprint = scene.build(&settings, Some(preset), &EffectModes::new()).unwrap();
        let legs = legs(&Checkpoint::of_scene(Arc::new(blueprint)).setup, count, quietly);
        legs.iter().map(|leg| (leg.preset.name(), (1e3 * leg.detail()).round() / 1e3)).collect()
    }

    #[test]
    fn the_ends_are_run_at_other_details_each_setting_once() {
        let at = |detail: f64| {
            let own = ["classic", "draft", "fast", "balanced", "fine"].map(|name| (name, detail));
            let others = [("draft", 0.5 * detail), ("draft", 2.0 * detail), ("fine", 0.5 * detail)];
            // `fine` at twice the detail is `reference`.
            own.into_iter().chain([("reference", 2.0 * detail)]).chain(others).collect::<Vec<_>>()
        };
        assert_eq!(runs(Preset::Fast, 1.0, 800.0, false), at(1.0));
        assert_eq!(runs(Preset::Fast, 0.5, 800.0, false), at(0.5));
        assert_eq!(runs(Preset::Reference, 1.0, 3200.0, false), at(1.0), "the quality in force changes nothing");
    }

    #[test]
    fn what_is_too_fine_is_left_out_sooner_where_nobody_asked() {
        let finer = |count, quietly| {
            let runs = runs(Preset::Balanced, 1.0, count, quietly);
            runs.into_iter().filter(|(_, detail)| *detail > 1.0).map(|(name, _)| name).collect::<Vec<_>>()
        };
        assert_eq!(finer(3_000.0, true), ["reference", "draft"]);
        assert_eq!(finer(10_000.0, true), [""; 0]);
        assert_eq!(finer(10_000.0, false), ["reference", "draft"]);
        assert_eq!(finer(40_000.0, false), ["reference"], "asked for, it is measured");
        assert!(runs(Preset::Balanced, 1.0, 1e6, true).len() >= 5, "the presets are run whatever they take");
    }
}
