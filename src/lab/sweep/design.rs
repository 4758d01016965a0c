//! What a sweep measures: the presets, a plane of substeps × iterations, and around each preset one knob at a time.

use super::error::ErrorMeasure;
use crate::{
    kernel::params::{AirAdvection, Preset, Quality},
    scene::{KNOBS, Knob, Part, Tuning},
};
use std::{fmt::Display, ops::RangeInclusive};

/// The presets that are meant to run in real time: the ones whose neighbours are measured.
pub const REAL_TIME: [Preset; 4] = [Preset::Draft, Preset::Fast, Preset::Balanced, Preset::Fine];

/// Kernel radii, d.
const RADII: [f32; 2] = [2.25, 3.0];

/// Substeps of the plane.
const SUBSTEPS: [u32; 3] = [1, 2, 4];

/// Iterations of the plane.
const ITERATIONS: RangeInclusive<u32> = 1..=4;

/// Substeps and iterations of the plain method: those of `classic` with one of the two turned.
const PLAIN: [(u32, u32); 3] = [(1, 8), (2, 4), (4, 4)];

/// Details at which the presets are measured beside their own, coarsest first.
const DETAILS: [f64; 3] = [0.5, 1.5, 2.0];

/// Air cells where air is what counts, d.
const AIR_CELLS: [f32; 8] = [16.0, 12.0, 8.0, 6.0, 4.0, 3.0, 2.0, 1.5];

/// Courant numbers of the air.
const COURANTS: [f32; 3] = [0.35, 0.7, 0.9];

/// Those of them that cost no more than the presets' own.
const LARGE_COURANTS: [f32; 2] = [COURANTS[1], COURANTS[2]];

/// A full set of knobs to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// What it is called; no two of a sweep have the same name.
    pub name: String,
    /// The preset that it is.
    pub preset: Option<Preset>,
    /// How many times finer than the start of the sweep it is, beside what its preset brings along.
    pub asked_detail: f64,
    /// The knobs.
    pub quality: Quality,
    /// Threads of the kernel.
    pub threads: usize,
}

impl Setting {
    /// A preset by its name.
    pub(super) fn preset(preset: Preset, threads: usize) -> Self {
        Self {
            name: preset.name().to_owned(),
            preset: Some(preset),
            asked_detail: 1.0,
            quality: preset.quality(),
            threads,
        }
    }

    /// The knobs in one word, exact: what the journal knows it by.
    pub fn key(&self) -> String {
        format!("{} threads {}", self.world(), self.threads)
    }

    /// The knobs that the world depends on, in one word: the threads do not count.
    pub(super) fn world(&self) -> String {
        let tuning = Tuning::from(self.quality);
        let knobs: String = Knob::of_quality().map(|knob| format!("{} {} ", knob.name, knob.text(&tuning))).collect();
        format!("{knobs}predictor {} detail {}", self.quality.predictor, self.detail())
    }

    /// How many times finer than the start of the sweep it is.
    pub fn detail(&self) -> f64 {
        self.asked_detail * self.preset.map_or(1.0, Preset::detail)
    }
}

/// How much is measured.
#[derive(Clone, Debug)]
pub struct Scope {
    /// What the error is.
    pub measure: ErrorMeasure,
    /// Whether the scene has air.
    pub has_air: bool,
    /// Threads of all settings but those that stand for threads.
    pub threads: usize,
    /// Other numbers of threads at which the presets are measured, too.
    pub other_threads: Vec<usize>,
    /// Only the presets and a small plane.
    pub quick: bool,
    /// Only these presets, if any.
    pub only: Vec<Preset>,
}

/// The settings of a sweep, each once.
pub fn settings(scope: &Scope) -> Vec<Setting> {
    let presets = if scope.only.is_empty() { &Preset::ALL[..] } else { &scope.only };
    let mut all: Vec<Setting> = presets.iter().map(|preset| Setting::preset(*preset, scope.threads)).collect();
    if scope.only.is_empty() {
        let named = match scope.measure {
            ErrorMeasure::Density => liquid(scope),
            ErrorMeasure::Air => air(scope.quick),
        };
        let setting =
            |(name, quality)| Setting { name, preset: None, asked_detail: 1.0, quality, threads: scope.threads };
        all.extend(named.into_iter().map(setting));
        all.extend(details(scope));
        if !scope.quick {
            all.extend(threads(scope));
        }
    }
    let effect = |setting: &Setting| (effective(setting.quality, scope.has_air), setting.detail(), setting.threads);
    let mut settings: Vec<Setting> = Vec::new();
    for setting in all {
        if !settings.iter().any(|other| effect(other) == effect(&setting)) {
            settings.push(setting);
        }
    }
    settings
}

/// A quality and its name.
type Named = (String, Quality);

fn liquid(scope: &Scope) -> Vec<Named> {
    let fast = Preset::Fast.quality();
    let (most_substeps, most_iterations) = if scope.quick { (2, 3) } else { (u32::MAX, u32::MAX) };
    let mut named = Vec::new();
    for substeps in SUBSTEPS.into_iter().filter(|substeps| *substeps <= most_substeps) {
        for iterations in ITERATIONS.filter(|iterations| *iterations <= most_iterations) {
            named.push((format!("{substeps}×{iterations}"), Quality { substeps, iterations, ..fast }));
        }
    }
    if !scope.quick {
        named.extend(PLAIN.map(|(substeps, iterations)| {
            let quality = Quality { substeps, iterations, ..Preset::Classic.quality() };
            (format!("classic, {substeps}×{iterations}"), quality)
        }));
        named.extend(REAL_TIME.into_iter().flat_map(|preset| neighbours(preset, scope.has_air)));
    }
    named
}

/// One knob at a time around a preset.
fn neighbours(preset: Preset, has_air: bool) -> Vec<Named> {
    let own = preset.quality();
    let mut named = Vec::new();
    let mut add = |what: String, quality: Quality| named.push((format!("{}, {what}", preset.name()), quality));
    for iterations in [own.iterations - 1, own.iterations + 1].into_iter().filter(|iterations| *iterations > 0) {
        add(format!("{iterations} iterations"), Quality { iterations, ..own });
    }
    let substeps = 2 * own.substeps;
    add(format!("{substeps} substeps"), Quality { substeps, ..own });
    for kernel_radius in RADII {
        add(format!("h {kernel_radius}"), Quality { kernel_radius, ..own });
    }
    for correction_limit in [0.5 * own.correction_limit, 2.0 * own.correction_limit] {
        add(format!("limit {correction_limit}"), Quality { correction_limit, ..own });
    }
    add("no predictor".to_owned(), Quality { predictor: false, ..own });
    if has_air {
        for air_cell in [2.0 * own.air_cell, 0.5 * own.air_cell] {
            add(format!("air cell {air_cell}"), Quality { air_cell, ..own });
        }
        for air_courant in LARGE_COURANTS {
            add(format!("Courant {air_courant}"), Quality { air_courant, ..own });
        }
        for air_advection in AirAdvection::ALL {
            add(air_advection.words().to_owned(), Quality { air_advection, ..own });
        }
    }
    named
}

fn air(quick: bool) -> Vec<Named> {
    let mut named = Vec::new();
    for air_cell in AIR_CELLS.into_iter().filter(|cell| !quick || cell.fract() == 0.0) {
        let quality = Quality { air_cell, ..Preset::Fast.quality() };
        let mut add = |what: &dyn Display, quality| named.push((format!("air cell {air_cell}, {what}"), quality));
        for air_advection in AirAdvection::ALL {
            add(&air_advection.words(), Quality { air_advection, ..quality });
        }
        for air_courant in COURANTS.into_iter().filter(|_| !quick) {
            add(&format_args!("Courant {air_courant}"), Quality { air_courant, ..quality });
        }
    }
    named
}

/// The presets at other details.
fn details(scope: &Scope) -> impl Iterator<Item = Setting> {
    let (details, threads) = (if scope.quick { &DETAILS[..1] } else { &DETAILS[..] }, scope.threads);
    REAL_TIME.into_iter().flat_map(move |preset| {
        details.iter().map(move |&detail| {
            let name = format!("{}, detail {detail}", preset.name());
            Setting { name, preset: None, asked_detail: detail, ..Setting::preset(preset, threads) }
        })
    })
}

/// The presets on other numbers of threads.
fn threads(scope: &Scope) -> impl Iterator<Item = Setting> {
    REAL_TIME.into_iter().flat_map(|preset| {
        scope.other_threads.iter().map(move |&threads| {
            let name = format!("{}, {threads} thread{}", preset.name(), if threads == 1 { "" } else { "s" });
            Setting { name, preset: None, ..Setting::preset(preset, threads) }
        })
    })
}

/// Numbers of threads worth a look beside `chosen`: 1, 2, 4, … and all of `available`.
pub fn other_threads(chosen: usize, available: usize) -> Vec<usize> {
    let powers = (0..usize::BITS).map(|k| 1 << k).take_while(|threads| *threads < available);
    powers.chain([available]).filter(|threads| *threads != chosen).collect()
}

/// The knobs that make a difference: without air its own do not.
pub(super) fn effective(quality: Quality, has_air: bool) -> Quality {
    let (mut tuning, any) = (Tuning::from(quality), Tuning::from(Preset::Reference.quality()));
    for knob in KNOBS.iter().filter(|knob| !has_air && knob.part == Part::Air) {
        knob.set(&mut tuning, knob.get(&any));
    }
    tuning.quality
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn scope(measure: ErrorMeasure, has_air: bool) -> Scope {
        Scope { measure, has_air, threads: 1, other_threads: vec![2], quick: false, only: Vec::new() }
    }

    #[test]
    fn no_setting_is_measured_twice_and_the_design_stays_small() {
        for scope in [
            scope(ErrorMeasure::Density, false),
            scope(ErrorMeasure::Density, true),
            scope(ErrorMeasure::Air, true),
            Scope { quick: true, ..scope(ErrorMeasure::Density, true) },
        ] {
            let settings = settings(&scope);
            let keys: BTreeSet<String> = settings.iter().map(Setting::key).collect();
            let names: BTreeSet<&str> = settings.iter().map(|setting| setting.name.as_str()).collect();
            assert_eq!((keys.len(), names.len()), (settings.len(), settings.len()), "{scope:?}");
            assert!(settings.len() < 80, "{} settings for {scope:?}", settings.len());
            let presets = settings.iter().filter(|setting| setting.preset.is_some()).count();
            assert_eq!(presets, Preset::ALL.len(), "every preset is there by its name");
        }
    }

    #[test]
    fn air_knobs_are_turned_only_where_there_is_air() {
        let named = |scope: &Scope| settings(scope).iter().filter(|setting| setting.name.contains("air cell")).count();
        assert_eq!(named(&scope(ErrorMeasure::Density, false)), 0);
        assert!(named(&scope(ErrorMeasure::Density, true)) > 0);
        assert!(named(&scope(ErrorMeasure::Air, true)) >= 20);
    }

    #[test]
    fn only_what_is_asked_for_is_measured() {
        let only =
            Scope { only: vec![Preset::Draft, Preset::Draft, Preset::Fine], ..scope(ErrorMeasure::Density, true) };
        let names: Vec<String> = settings(&only).into_iter().map(|setting| setting.name).collect();
        assert_eq!(names, ["draft", "fine"]);
    }

    #[test]
    fn threads_go_up_by_doubling() {
        assert_eq!(other_threads(1, 2), [2]);
        assert_eq!(other_threads(1, 12), [2, 4, 8, 12]);
        assert_eq!(other_threads(4, 8), [1, 2, 8]);
        assert_eq!(other_threads(1, 1), [0_usize; 0]);
    }
}
