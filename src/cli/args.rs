//! What the command line understands.

use crate::{
    kernel::{params::Preset, simd::InstructionSet, units::TICKS_PER_SECOND},
    lab::{exam, gauntlet},
    scene::blueprint::{Effect, Mode},
};
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

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
    /// Run a recording again, and name the first tick that is not what it was
    Replay(ReplayArguments),
    /// Measure what something costs, and print the table
    Bench(BenchArguments),
    /// Compare the physics with known answers, at each quality
    Exam(ExamArguments),
    /// Play a scene for hours by a script, and see that nothing grows or gets lost
    Soak(SoakArguments),
    /// Run every hard case at each quality, and judge whether it stays stable
    Gauntlet(GauntletArguments),
    /// Repeat an experiment of the report on the original game
    Study(StudyArguments),
    /// Measure what accuracy costs in a scene: curve.csv, curve.svg, curve.png, summary.md
    Sweep(SweepArguments),
    /// Print what there is to choose from, one a line, fields separated by tabs
    List {
        /// What to list
        what: Listing,
    },
}

/// `replay`.
#[derive(Debug, Args)]
pub(super) struct ReplayArguments {
    /// The recording
    #[arg(value_name = "FILE")]
    pub(super) file: PathBuf,
    /// Threads of the simulation; they never change the result [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
    /// Instruction set of the simulation: auto, or a narrower one than the processor's best; it never changes the result
    #[arg(long, value_name = "SET", default_value = "auto", hide_default_value = true, value_parser = simd)]
    pub(super) simd: InstructionSet,
    /// Write the outcome as JSON; `-` is stdout, in place of the line
    #[arg(long, value_name = "FILE.json")]
    pub(super) json: Option<PathBuf>,
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
    #[command(flatten)]
    pub(super) scaling: ScalingOptions,
}

/// What can be measured.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Bench {
    /// What each effect costs in each scene, alone and together, and what running only what is called for saves
    Effects,
    /// How many particles a tick may hold at a tick rate: brute force, bins on one thread, bins on all
    Neighbours,
    /// What a tick costs and how exact it is, from 1,458 to 999,698 particles, at every quality
    Scaling,
}

/// Options of `bench scaling`.
#[derive(Debug, Args)]
pub(super) struct ScalingOptions {
    /// Draw the curves into a folder: scaling-time.svg, scaling-error.svg, scaling-threads.svg (bench scaling)
    #[arg(long, value_name = "DIR")]
    pub(super) svg: Option<PathBuf>,
    /// Show other programs' figures beside: [{name, figures: [{particles, ms, error_mean, error_p99}]}] (bench scaling)
    #[arg(long, value_name = "FILE.json")]
    pub(super) beside: Option<PathBuf>,
    /// Take less than a minute: three sizes, one second of each (bench scaling), or one run of each choice (bench effects)
    #[arg(long)]
    pub(super) quick: bool,
    /// Leave larger worlds out (bench scaling)
    #[arg(long, value_name = "PARTICLES", allow_negative_numbers = true, value_parser = particles)]
    pub(super) up_to: Option<u64>,
    /// Leave a row out that would take longer [default: 40, with --quick 5] (bench scaling)
    #[arg(long, value_name = "SECONDS", value_parser = cap, allow_negative_numbers = true)]
    pub(super) cap: Option<f64>,
}

impl ScalingOptions {
    /// The first of these options that was given, but for what is `allowed`.
    pub(super) fn first_given(&self, allowed: &[&str]) -> Option<&'static str> {
        let Self { svg, beside, quick, up_to, cap } = self;
        let given = [
            ("--svg", svg.is_some()),
            ("--beside", beside.is_some()),
            ("--quick", *quick),
            ("--up-to", up_to.is_some()),
            ("--cap", cap.is_some()),
        ];
        given.into_iter().find(|(name, is_given)| *is_given && !allowed.contains(name)).map(|(name, _)| name)
    }
}

/// `exam`.
#[derive(Debug, Args)]
pub(super) struct ExamArguments {
    /// Write the rows as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json")]
    pub(super) json: Option<PathBuf>,
    /// Write the rows with what they mean, as docs/exam.md has them; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.md")]
    pub(super) markdown: Option<PathBuf>,
    /// Quality to examine, again for more: a name of `list qualities` [default: all]
    #[arg(long = "quality", value_name = "QUALITY", value_parser = preset)]
    pub(super) qualities: Vec<Preset>,
    /// Case to examine, again for more [default: all]
    #[arg(long = "case", value_name = "NAME", value_parser = exam_case)]
    pub(super) cases: Vec<String>,
    /// The cases that take a second, at `balanced`
    #[arg(long)]
    pub(super) quick: bool,
    /// Cases at a time, each on one thread; they never change the result [default: one a processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
}

/// `soak`.
#[derive(Debug, Args)]
pub(super) struct SoakArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file
    pub(super) scene: String,
    /// Simulated time
    #[arg(long, value_name = "HOURS", value_parser = hours, default_value = "24", allow_negative_numbers = true)]
    pub(super) hours: Minutes,
    /// Quality: a name of `list qualities` [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = preset)]
    pub(super) quality: Option<Preset>,
    /// Set a parameter of the scene, or a number of the quality or the liquid
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(super) settings: Vec<(String, String)>,
    /// End at the first minute of simulated time after this much real time, and judge what there is
    #[arg(long, value_name = "HOURS", value_parser = hours, allow_negative_numbers = true)]
    pub(super) within: Option<Minutes>,
    /// Whims of the player: the same number, the same play
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) seed: u64,
    /// Write the figures as JSON; `-` is stdout
    #[arg(long, value_name = "FILE.json")]
    pub(super) json: Option<PathBuf>,
    /// Threads of the simulation; they never change the result [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
    /// Instruction set of the simulation: auto, or a narrower one than the processor's best; it never changes the result
    #[arg(long, value_name = "SET", default_value = "auto", hide_default_value = true, value_parser = simd)]
    pub(super) simd: InstructionSet,
}

/// `gauntlet`.
#[derive(Debug, Args)]
pub(super) struct GauntletArguments {
    /// Write the rows as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json")]
    pub(super) json: Option<PathBuf>,
    /// Write the rows with what they mean, as docs/gauntlet.md has them; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.md")]
    pub(super) markdown: Option<PathBuf>,
    /// Quality to run at, again for more: a name of `list qualities` [default: all]
    #[arg(long = "quality", value_name = "QUALITY", value_parser = preset)]
    pub(super) qualities: Vec<Preset>,
    /// Case to run, again for more: a name of `list cases` [default: all]
    #[arg(long = "case", value_name = "NAME", value_parser = gauntlet_case)]
    pub(super) cases: Vec<String>,
    /// The cases that take a moment, at `balanced`
    #[arg(long)]
    pub(super) quick: bool,
    /// Cases at a time, each on one thread; they never change the result [default: one a processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: Option<u64>,
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

/// `sweep`.
#[derive(Debug, Args)]
pub(super) struct SweepArguments {
    /// Scenes: names of `list scenes`, or paths of scene files or save files
    #[arg(required = true, value_name = "SCENE")]
    pub(super) scenes: Vec<String>,
    /// Folder for the results, made if it isn't there; with several scenes, each gets a folder in it. A sweep that was
    /// stopped goes on from what it finds there
    #[arg(long, value_name = "DIR")]
    pub(super) out: PathBuf,
    /// Fewer settings, shorter runs, one of each
    #[arg(long)]
    pub(super) quick: bool,
    /// Only this preset; may be repeated [default: all presets and what is around them]
    #[arg(long = "only", value_name = "QUALITY", value_parser = preset)]
    pub(super) only: Vec<Preset>,
    /// Runs of each setting, interleaved [default: 3; with --quick 1]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = rounds)]
    pub(super) repeat: Option<u64>,
    /// Threads of the settings that don't stand for a number of threads
    #[arg(long, value_name = "N", default_value_t = 1, allow_negative_numbers = true, value_parser = threads)]
    pub(super) threads: u64,
    /// Set a parameter of the scenes, or a number of the liquid
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(super) settings: Vec<(String, String)>,
    /// Ticks of the scene before the moment from which every run sets out [default: 240 with taps or fans, else 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = warmup)]
    pub(super) start: Option<u64>,
    /// Ticks of a run [default: 300; with --quick 120]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = ticks)]
    pub(super) ticks: Option<u64>,
    /// Ticks at the start of a run that are left out of times and samples [default: a fifth of the run, less one]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = warmup)]
    pub(super) warmup: Option<u64>,
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
    /// Hard cases of `gauntlet`: name, what happens
    Cases,
}

/// `play`.
#[derive(Debug, Args)]
pub(super) struct PlayArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file, a save file or a recording [default: waterfall]
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
    /// Instruction set of the simulation: auto, or a narrower one than the processor's best
    #[arg(long, value_name = "SET", default_value = "auto", hide_default_value = true, value_parser = simd)]
    pub(super) simd: InstructionSet,
    /// Record what is played, from the start on, for `replay FILE`
    #[arg(long, value_name = "FILE")]
    pub(super) record: Option<PathBuf>,
}

/// `run`.
#[derive(Debug, Args)]
pub(super) struct RunArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file, a save file or a recording (from its last jump on)
    pub(super) scene: String,
    /// Simulated time [default: 10, or as long as the recording]
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
    /// Instruction set of the simulation: auto, or a narrower one than the processor's best; it never changes the result
    #[arg(long, value_name = "SET", default_value = "auto", hide_default_value = true, value_parser = simd)]
    pub(super) simd: InstructionSet,
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
    /// Run the same start at `reference` quality, too, and write the distance to it over time
    #[arg(long, value_name = "FILE.csv")]
    pub(super) reference: Option<PathBuf>,
    /// Draw the world at the end
    #[arg(long, value_name = "FILE.png")]
    pub(super) png: Option<PathBuf>,
    /// Save the world at the end, to be run on
    #[arg(long, value_name = "FILE")]
    pub(super) snapshot: Option<PathBuf>,
    /// Let the autopilot change the quality to hold so many ms a tick; the hash then depends on the machine
    #[arg(long, value_name = "MS", allow_negative_numbers = true, value_parser = hold_ms,
          conflicts_with = "hold_error")]
    pub(super) hold_ms: Option<f32>,
    /// Let the autopilot change the quality to hold a mean density error, in percent; the hash does not
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = hold_error)]
    pub(super) hold_error: Option<f32>,
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

/// A simulated time, in minutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Minutes(pub(super) u64);

fn hours(text: &str) -> Result<Minutes, String> {
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

fn ticks(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_TICKS)
}

fn warmup(text: &str) -> Result<u64, String> {
    whole(text, 0..=MOST_TICKS - 1)
}

fn rounds(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_ROUNDS)
}

fn threads(text: &str) -> Result<u64, String> {
    whole(text, 1..=MOST_THREADS)
}

fn particles(text: &str) -> Result<u64, String> {
    whole(text, 1_458..=100_000_000)
}

fn cap(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds| (0.0..=MOST_SECONDS).contains(seconds));
    seconds.ok_or_else(|| format!("allowed: seconds from 0 to {MOST_SECONDS}"))
}

fn simd(text: &str) -> Result<InstructionSet, String> {
    if text == "auto" {
        return Ok(InstructionSet::detect());
    }
    let sets = InstructionSet::available();
    sets.iter().copied().find(|set| set.name() == text).ok_or_else(|| {
        let names: Vec<&str> = sets.into_iter().map(InstructionSet::name).collect();
        format!("allowed on this processor: auto, {}", names.join(", "))
    })
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

fn exam_case(text: &str) -> Result<String, String> {
    name_among(text, exam::CASES.iter().map(|case| case.name))
}

fn gauntlet_case(text: &str) -> Result<String, String> {
    name_among(text, gauntlet::CASES.iter().map(|case| case.name))
}

fn name_among(text: &str, names: impl Iterator<Item = &'static str> + Clone) -> Result<String, String> {
    match names.clone().find(|name| *name == text) {
        Some(name) => Ok(name.to_owned()),
        None => Err(format!("allowed: {}", names.collect::<Vec<_>>().join(", "))),
    }
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
