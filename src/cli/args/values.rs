//! The words that options take, and what is allowed.

use crate::{
    kernel::{params::Preset, simd::InstructionSet, units::TICKS_PER_SECOND},
    lab::cases::{Case, Shard},
    scene::{
        self, DETAIL,
        effects::{Effect, Mode},
    },
};
use glam::{UVec2, Vec2};
use std::{fmt::Display, ops::RangeInclusive, str::FromStr};

/// Longest run, s; about 28 hours.
const MOST_SECONDS: f64 = 100_000.0;

/// Longest run, ticks.
const MOST_TICKS: u64 = MOST_SECONDS as u64 * TICKS_PER_SECOND as u64;

/// Longest soak, h.
const MOST_HOURS: u64 = 1000;

/// Most threads that can be asked for.
const MOST_THREADS: u64 = 256;

/// Most runs of a setting in a sweep.
const MOST_ROUNDS: u64 = 1000;

/// A simulated time, in ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Ticks(pub(in crate::cli) u64);

pub(super) fn seconds(text: &str) -> Result<Ticks, String> {
    let allowed = || format!("allowed: seconds from 1/{TICKS_PER_SECOND} (one tick) to {MOST_SECONDS}");
    parts(text, f64::from(TICKS_PER_SECOND), MOST_TICKS).map(Ticks).ok_or_else(allowed)
}

/// A simulated time, in minutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Minutes(pub(in crate::cli) u64);

pub(super) fn hours(text: &str) -> Result<Minutes, String> {
    let allowed = || format!("allowed: hours from 1/60 (a minute) to {MOST_HOURS}");
    parts(text, 60.0, 60 * MOST_HOURS).map(Minutes).ok_or_else(allowed)
}

pub(super) fn gallery_scene(text: &str) -> Result<&'static str, String> {
    let names = scene::builtin_names();
    names.iter().copied().find(|name| *name == text).ok_or_else(|| format!("allowed: {}", names.join(", ")))
}

/// Longest soak of each scene of the gallery, minutes. What goes on is judged by its memory, too, and so needs a process of its
/// own.
const MOST_MINUTES: u64 = 60;

pub(super) fn minutes(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 1..=MOST_MINUTES)
}

/// A number of wholes as parts, from one to `most` of them.
fn parts(text: &str, of_a_whole: f64, most: u64) -> Option<u64> {
    let parts = text.parse::<f64>().ok()? * of_a_whole;
    (0.999..=most as f64).contains(&parts).then(|| parts.round() as u64)
}

/// A number in a range; `kind` says of what kind.
fn number<T: FromStr + PartialOrd + Display>(text: &str, kind: &str, range: RangeInclusive<T>) -> Result<T, String> {
    let number = text.parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("allowed: {kind} from {} to {}", range.start(), range.end()))
}

/// Most random worlds that can be asked for.
const MOST_WORLDS: u64 = 1_000_000_000;

/// What is said of numbers that count.
const WHOLE: &str = "whole numbers";

pub(super) fn ticks(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 1..=MOST_TICKS)
}

pub(super) fn warmup(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 0..=MOST_TICKS - 1)
}

pub(super) fn rounds(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 1..=MOST_ROUNDS)
}

pub(super) fn worlds(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 1..=MOST_WORLDS)
}

pub(super) fn seed(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 0..=u64::MAX)
}

pub(super) fn shard(text: &str) -> Result<Shard, String> {
    Shard::read(text)
}

pub(super) fn threads(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 1..=MOST_THREADS)
}

pub(super) fn particles(text: &str) -> Result<u64, String> {
    number(text, WHOLE, 1_458..=100_000_000)
}

pub(super) fn cap(text: &str) -> Result<f64, String> {
    number(text, "seconds", 0.0..=MOST_SECONDS)
}

pub(super) fn hold_ms(text: &str) -> Result<f32, String> {
    number(text, "numbers", 0.01..=10_000.0)
}

pub(super) fn hold_error(text: &str) -> Result<f32, String> {
    number(text, "numbers", 0.0001..=100.0)
}

/// Browsers show frames of less than two units of a GIF's time, 1/100 s, slowly.
pub(super) fn frames_per_second(text: &str) -> Result<u32, String> {
    number(text, WHOLE, 1..=50)
}

/// Sides of a film, pixels.
const FILM_SIDE: RangeInclusive<u32> = 16..=1920;

pub(super) fn picture_size(text: &str) -> Result<UVec2, String> {
    let side = |text: &str| text.parse().ok().filter(|side| FILM_SIDE.contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| Some(UVec2::new(side(width)?, side(height)?)));
    let (least, most) = (FILM_SIDE.start(), FILM_SIDE.end());
    sides.ok_or_else(|| format!("allowed: WIDTHxHEIGHT, each from {least} to {most}, such as 640x360"))
}

/// `N` numbers with commas between them.
fn numbers<const N: usize>(text: &str) -> Option<[f32; N]> {
    let numbers: Option<Vec<f32>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    numbers?.try_into().ok().filter(|numbers: &[f32; N]| numbers.iter().all(|number| number.is_finite()))
}

/// A place, m, and a radius if that is given.
pub(super) fn gauge(text: &str) -> Result<(Vec2, Option<f32>), String> {
    let place = numbers(text).map(|[x, y]| (Vec2::new(x, y), None));
    let place = place.or_else(|| numbers(text).map(|[x, y, radius]| (Vec2::new(x, y), Some(radius))));
    place.ok_or_else(|| "allowed: X,Y or X,Y,R in metres, such as 2.5,1 or 2.5,1,0.3".to_owned())
}

/// A line through which flow is measured, m.
pub(super) fn gauge_line(text: &str) -> Result<(Vec2, Vec2), String> {
    let line = numbers(text).map(|[x, y, to_x, to_y]| (Vec2::new(x, y), Vec2::new(to_x, to_y)));
    line.ok_or_else(|| "allowed: X1,Y1,X2,Y2 in metres, such as 2,0,2,1.5".to_owned())
}

pub(super) fn detail(text: &str) -> Result<f64, String> {
    number(text, "numbers", DETAIL.min..=DETAIL.max)
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
    let modes = [("auto", Mode::Auto), ("on", Mode::On), ("off", Mode::Off)];
    let mode = modes.into_iter().find(|(word, _)| *word == mode).map(|(_, mode)| mode);
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
    fn sizes_are_two_sides_within_bounds() {
        assert_eq!(picture_size("640x360"), Ok(UVec2::new(640, 360)));
        for bad in ["", "640", "640x", "x360", "640x360x2", "15x360", "640x1921", "-640x360", "640 x 360"] {
            assert!(picture_size(bad).is_err_and(|message| message.contains("640x360")), "{bad} passed");
        }
    }

    #[test]
    fn gauges_are_numbers_with_commas() {
        assert_eq!(gauge("2.5,1"), Ok((Vec2::new(2.5, 1.0), None)));
        assert_eq!(gauge("-1, 0,.3"), Ok((Vec2::new(-1.0, 0.0), Some(0.3))));
        for bad in ["", "1", "1,2,3,4", "1;2", "a,b", "nan,1", "1,inf", "1,2,", "1e99,0"] {
            assert!(gauge(bad).is_err_and(|message| message.contains("X,Y,R")), "{bad} passed");
        }
        assert_eq!(gauge_line("0,1,2,3"), Ok((Vec2::new(0.0, 1.0), Vec2::new(2.0, 3.0))));
        for bad in ["", "1,2,3", "1,2,3,4,5", "1,2,3,x", "nan,0,1,1"] {
            assert!(gauge_line(bad).is_err_and(|message| message.contains("X1,Y1,X2,Y2")), "{bad} passed");
        }
    }

    #[test]
    fn settings_and_effects_need_both_sides() {
        assert_eq!(setting("columns=20"), Ok(("columns".to_owned(), "20".to_owned())));
        assert!(["columns", "=20", "columns=", ""].into_iter().all(|text| setting(text).is_err()));
        assert_eq!(effect("air=off"), Ok((Effect::Air, Mode::Off)));
        assert!(["air", "air=", "air=maybe", "fire=on", ""].into_iter().all(|text| effect(text).is_err()));
    }
}
