//! The words that options take, and what is allowed.

use crate::{
    kernel::{params::Preset, simd::InstructionSet, units::TICKS_PER_SECOND},
    lab::cases::Case,
    scene::effects::{Effect, Mode},
};

/// Longest run, s; about 28 hours.
const MOST_SECONDS: f64 = 100_000.0;

/// Longest run, ticks.
const MOST_TICKS: u64 = MOST_SECONDS as u64 * TICKS_PER_SECOND as u64;

/// Longest soak, h.
const MOST_HOURS: f64 = 1000.0;

/// Most threads that can be asked for.
const MOST_THREADS: u64 = 256;

/// Most runs of a setting in a sweep.
const MOST_ROUNDS: u64 = 1000;

/// A simulated time, in ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Ticks(pub(in crate::cli) u64);

pub(super) fn seconds(text: &str) -> Result<Ticks, String> {
    let ticks = text.parse().map_or(f64::NAN, |seconds: f64| seconds * f64::from(TICKS_PER_SECOND));
    // Written so that a NaN is refused, too.
    if (0.999..=MOST_TICKS as f64).contains(&ticks) {
        Ok(Ticks(ticks.round() as u64))
    } else {
        Err(format!("allowed: seconds from 1/{TICKS_PER_SECOND} (one tick) to {MOST_SECONDS}"))
    }
}

/// A simulated time, in minutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Minutes(pub(in crate::cli) u64);

pub(super) fn hours(text: &str) -> Result<Minutes, String> {
    let minutes = text.parse().map_or(f64::NAN, |hours: f64| hours * 60.0);
    // Written so that a NaN is refused, too.
    if (0.999..=MOST_HOURS * 60.0).contains(&minutes) {
        Ok(Minutes(minutes.round() as u64))
    } else {
        Err(format!("allowed: hours from 1/60 (a minute) to {MOST_HOURS}"))
    }
}

fn whole(text: &str, range: std::ops::RangeInclusive<u64>) -> Result<u64, String> {
    let number = text.parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("allowed: whole numbers from {} to {}", range.start(), range.end()))
}

pub(super) fn ticks(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_TICKS)
}

pub(super) fn warmup(text: &str) -> Result<u64, String> {
    whole(text, 0..=MOST_TICKS - 1)
}

pub(super) fn rounds(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_ROUNDS)
}

pub(super) fn threads(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_THREADS)
}

pub(super) fn particles(text: &str) -> Result<u64, String> {
    whole(text, 1_458..=100_000_000)
}

pub(super) fn cap(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds| (0.0..=MOST_SECONDS).contains(seconds));
    seconds.ok_or_else(|| format!("allowed: seconds from 0 to {MOST_SECONDS}"))
}

pub(super) fn simd(text: &str) -> Result<InstructionSet, String> {
    if text == "auto" {
        return Ok(InstructionSet::detect());
    }
    let sets = InstructionSet::available();
    sets.iter().copied().find(|set| set.name() == text).ok_or_else(|| {
        let names: Vec<&str> = sets.into_iter().map(InstructionSet::name).collect();
        format!("allowed on this processor: auto, {}", names.join(", "))
    })
}

pub(super) fn hold_ms(text: &str) -> Result<f32, String> {
    number(text, 0.01..=10_000.0)
}

pub(super) fn hold_error(text: &str) -> Result<f32, String> {
    number(text, 0.0001..=100.0)
}

fn number(text: &str, range: std::ops::RangeInclusive<f32>) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("allowed: numbers from {} to {}", range.start(), range.end()))
}

pub(super) fn preset(text: &str) -> Result<Preset, String> {
    Preset::find(text).ok_or_else(|| format!("allowed: {}", Preset::ALL.map(Preset::name).join(", ")))
}

pub(super) fn case<C: Case>(text: &str) -> Result<&'static C, String> {
    let cases = (C::SUITE.cases)();
    let names = || cases.iter().map(|case| case.about().name).collect::<Vec<_>>().join(", ");
    cases.iter().find(|case| case.about().name == text).ok_or_else(|| format!("allowed: {}", names()))
}

pub(super) fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() && !value.is_empty() => Ok((key.to_owned(), value.to_owned())),
        _ => Err("allowed: KEY=VALUE, such as substeps=4".to_owned()),
    }
}

pub(super) fn effect(text: &str) -> Result<(Effect, Mode), String> {
    let (name, mode) = text.split_once('=').unwrap_or((text, ""));
    let mode = match mode {
        "auto" => Some(Mode::Auto),
        "on" => Some(Mode::On),
        "off" => Some(Mode::Off),
        _ => None,
    };
    Effect::find(name).zip(mode).ok_or_else(|| {
        format!("allowed: NAME=auto, NAME=on or NAME=off; NAME is one of {}", Effect::ALL.map(Effect::name).join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_become_ticks_and_nothing_else_passes() {
        assert_eq!(seconds("1"), Ok(Ticks(60)));
        assert_eq!(seconds("0.0166667"), Ok(Ticks(1)));
        assert_eq!(seconds("2.51"), Ok(Ticks(151)));
        assert_eq!(seconds("100000"), Ok(Ticks(6_000_000)));
        for bad in ["0", "-1", "0.001", "nan", "inf", "-inf", "1e300", "100001", "", "ten"] {
            assert!(seconds(bad).is_err_and(|message| message.contains("allowed")), "{bad} passed");
        }
    }

    #[test]
    fn only_sets_that_the_processor_has_can_be_asked_for() {
        assert_eq!(simd("auto"), Ok(InstructionSet::detect()));
        for set in InstructionSet::available() {
            assert_eq!(simd(set.name()), Ok(set));
        }
        for bad in ["", "AVX2", "avx1024", "neon2"] {
            assert!(
                simd(bad).is_err_and(|message| message.contains("auto") && message.contains("scalar")),
                "{bad} passed"
            );
        }
        #[cfg(target_arch = "x86_64")]
        assert_eq!(
            simd("avx512").is_ok(),
            is_x86_feature_detected!("avx512f"),
            "the passes would meet no such registers"
        );
    }

    #[test]
    fn settings_and_effects_need_both_sides() {
        assert_eq!(setting("columns=20"), Ok(("columns".to_owned(), "20".to_owned())));
        assert!(["columns", "=20", "columns=", ""].into_iter().all(|text| setting(text).is_err()));
        assert_eq!(effect("air=off"), Ok((Effect::Air, Mode::Off)));
        assert!(["air", "air=", "air=maybe", "fire=on", ""].into_iter().all(|text| effect(text).is_err()));
    }
}
