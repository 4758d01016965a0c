//! What the command line understands.

use crate::{
    kernel::{params::Preset, units::TICKS_PER_SECOND},
    scene::blueprint::{Effect, Mode},
};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Longest run, s; about 28 hours.
const MOST_SECONDS: f64 = 100_000.0;

/// Longest run, ticks.
const MOST_TICKS: u64 = MOST_SECONDS as u64 * TICKS_PER_SECOND as u64;

/// Most threads that can be asked for.
const MOST_THREADS: u64 = 256;

/// A real-time 2-D sandbox of powders and fluids in moving air.
#[derive(Debug, Parser)]
#[command(name = "powder-master", version, args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    #[command(flatten)]
    pub(super) play: PlayOptions,
}

/// A command and what belongs to it.
#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Open the game (the default)
    Play(PlayArguments),
    /// Run a scene without a window, and measure it
    Run(Box<RunArguments>),
    /// Measure what something costs, and print the table
    Bench(BenchArguments),
    /// Repeat an experiment of the report on the original game
    Study(StudyArguments),
    /// Print what there is to choose from, one a line, fields separated by tabs
    List {
        /// What to list
        what: Listing,
    },
}

/// `bench`.
#[derive(Debug, Args)]
pub(super) struct BenchArguments {
    /// What to measure
    pub(super) what: Bench,
    /// Threads of the last column [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
    /// Write the table as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json")]
    pub(super) json: Option<PathBuf>,
}

/// What can be measured.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Bench {
    /// How many particles a tick may hold at a tick rate: brute force, bins on one thread, bins on all
    Neighbours,
}

/// `study`.
#[derive(Debug, Args)]
pub(super) struct StudyArguments {
    /// Which experiment
    pub(super) what: Study,
    /// Folder for its pictures
    #[arg(long, value_name = "DIR")]
    pub(super) out: PathBuf,
    /// Threads of the simulation [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
}

/// Experiments of the report on the original game.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Study {
    /// What a rest density that does not suit the spacing does to a liquid: rest-density.png
    RestDensity,
}

/// What there is to choose from.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Listing {
    /// Name, description, parameters with their ranges
    Scenes,
    /// Name and properties
    Elements,
    /// Name and what it is
    Effects,
    /// Name and the numbers behind it
    Qualities,
}

/// `play`.
#[derive(Debug, Args)]
pub(super) struct PlayArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file or a save file [default: waterfall]
    pub(super) scene: Option<String>,
    #[command(flatten)]
    pub(super) options: PlayOptions,
}

/// Options of `play`.
#[derive(Debug, Args)]
pub(super) struct PlayOptions {
    /// Quality to start with: a name of `list qualities` [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = preset)]
    pub(super) quality: Option<Preset>,
    /// Set a parameter of the scene, or a number of the quality or the liquid
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(super) settings: Vec<(String, String)>,
    /// Threads of the simulation [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
    /// Record what is played, for `run SCENE --replay FILE`
    #[arg(long, value_name = "FILE")]
    pub(super) record: Option<PathBuf>,
}

/// `run`.
#[derive(Debug, Args)]
pub(super) struct RunArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file or a save file
    pub(super) scene: String,
    /// Simulated time [default: 10, or as long as the replay]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true, conflicts_with = "ticks")]
    pub(super) seconds: Option<Ticks>,
    /// Simulated time in ticks of 1/60 s
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = ticks)]
    pub(super) ticks: Option<u64>,
    /// Quality: a name of `list qualities` [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = preset)]
    pub(super) quality: Option<Preset>,
    /// Set a parameter of the scene, or a number of the quality or the liquid
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(super) settings: Vec<(String, String)>,
    /// Switch an effect of `list effects`
    #[arg(long = "effect", value_name = "NAME=auto|on|off", value_parser = effect)]
    pub(super) effects: Vec<(Effect, Mode)>,
    /// Threads of the simulation; they never change the result [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
    /// Ticks at the start that are left out of times and accuracy samples
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true, allow_negative_numbers = true,
          value_parser = warmup)]
    pub(super) warmup: u64,
    /// Write what was measured as JSON; `-` is stdout
    #[arg(long, value_name = "FILE.json")]
    pub(super) metrics: Option<PathBuf>,
    /// Write all particles at the end: id, element, position, velocity
    #[arg(long, value_name = "FILE.csv")]
    pub(super) particles: Option<PathBuf>,
    /// Write a line for each tick: time, energy, momentum, front, surface
    #[arg(long, value_name = "FILE.csv")]
    pub(super) trace: Option<PathBuf>,
    /// Draw the world at the end
    #[arg(long, value_name = "FILE.png")]
    pub(super) png: Option<PathBuf>,
    /// Save the world at the end, to be run on
    #[arg(long, value_name = "FILE")]
    pub(super) snapshot: Option<PathBuf>,
    /// Let the autopilot change the quality to hold so many ms a tick; the hash then depends on the machine
    #[arg(long, value_name = "MS", allow_negative_numbers = true, value_parser = hold_ms,
          conflicts_with_all = ["hold_error", "replay"])]
    pub(super) hold_ms: Option<f32>,
    /// Let the autopilot change the quality to hold a mean density error, in percent; the hash does not
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = hold_error,
          conflicts_with = "replay")]
    pub(super) hold_error: Option<f32>,
    /// Repeat recorded input; it brings its own parameters and quality
    #[arg(long, value_name = "FILE", conflicts_with = "settings")]
    pub(super) replay: Option<PathBuf>,
}

/// A simulated time, in ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Ticks(pub(super) u64);

fn seconds(text: &str) -> Result<Ticks, String> {
    let ticks = text.parse().map_or(f64::NAN, |seconds: f64| seconds * f64::from(TICKS_PER_SECOND));
    // Written so that a NaN is refused, too.
    if (0.999..=MOST_TICKS as f64).contains(&ticks) {
        Ok(Ticks(ticks.round() as u64))
    } else {
        Err(format!("allowed: seconds from 1/{TICKS_PER_SECOND} (one tick) to {MOST_SECONDS}"))
    }
}

fn whole(text: &str, range: std::ops::RangeInclusive<u64>) -> Result<u64, String> {
    let number = text.parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("allowed: whole numbers from {} to {}", range.start(), range.end()))
}

fn ticks(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_TICKS)
}

fn warmup(text: &str) -> Result<u64, String> {
    whole(text, 0..=MOST_TICKS - 1)
}

fn threads(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_THREADS)
}

fn hold_ms(text: &str) -> Result<f32, String> {
    number(text, 0.01..=10_000.0)
}

fn hold_error(text: &str) -> Result<f32, String> {
    number(text, 0.0001..=100.0)
}

fn number(text: &str, range: std::ops::RangeInclusive<f32>) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("allowed: numbers from {} to {}", range.start(), range.end()))
}

fn preset(text: &str) -> Result<Preset, String> {
    Preset::find(text).ok_or_else(|| format!("allowed: {}", Preset::ALL.map(Preset::name).join(", ")))
}

fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() && !value.is_empty() => Ok((key.to_owned(), value.to_owned())),
        _ => Err("allowed: KEY=VALUE, such as substeps=4".to_owned()),
    }
}

fn effect(text: &str) -> Result<(Effect, Mode), String> {
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
    use clap::CommandFactory;

    #[test]
    fn the_definition_holds_together() {
        Arguments::command().debug_assert();
    }

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
    fn settings_and_effects_need_both_sides() {
        assert_eq!(setting("columns=20"), Ok(("columns".to_owned(), "20".to_owned())));
        assert!(["columns", "=20", "columns=", ""].into_iter().all(|text| setting(text).is_err()));
        assert_eq!(effect("air=off"), Ok((Effect::Air, Mode::Off)));
        assert!(["air", "air=", "air=maybe", "fire=on", ""].into_iter().all(|text| effect(text).is_err()));
    }
}
