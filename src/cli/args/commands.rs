//! The commands, and the options of those that open and run worlds.

use super::{
    lab::{
        BenchArguments, CaseArguments, ChallengeArguments, GauntletArguments, MergeArguments, SoakArguments,
        StudyArguments, SweepArguments,
    },
    machine::Machine,
    values::{
        Ticks, detail, effect, frames_per_second, gauge, gauge_line, hold_error, hold_ms, picture_size, preset,
        seconds, setting, ticks, warmup,
    },
};
use crate::{
    kernel::params::Preset,
    lab::exam::ExamCase,
    scene::effects::{Effect, Mode},
};
use clap::{Args, Parser, Subcommand, ValueEnum};
use glam::{UVec2, Vec2};
use std::path::PathBuf;

/// A real-time 2-D sandbox of powders and fluids in moving air.
#[derive(Debug, Parser)]
#[command(name = "powder-master", version, args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
pub(in crate::cli) struct Arguments {
    #[command(subcommand)]
    pub(in crate::cli) command: Option<Command>,
    #[command(flatten)]
    pub(in crate::cli) play: PlayOptions,
}

/// A command and what belongs to it.
#[derive(Debug, Subcommand)]
pub(in crate::cli) enum Command {
    /// Open the game (the default)
    Play(PlayArguments),
    /// Run a scene without a window, and measure it
    Run(Box<RunArguments>),
    /// Run a recording again, and name the first tick that is not what it was
    Replay(ReplayArguments),
    /// Draw a recording and write it as a GIF
    Clip(ClipArguments),
    /// Play challenges by their solutions without a window, and print the stars
    Challenge(ChallengeArguments),
    /// Measure what something costs, and print the table
    Bench(BenchArguments),
    /// Compare the physics with known answers, at each quality
    Exam(CaseArguments<ExamCase>),
    /// Play a scene for hours by a script, and see that nothing grows or gets lost
    Soak(SoakArguments),
    /// Run every hard case, or each scene of the gallery, at each quality, or random worlds, and judge whether they stay stable
    Gauntlet(GauntletArguments),
    /// Put the JSON of all shards of an exam or a gauntlet together
    Merge(MergeArguments),
    /// Make an experiment: a table and pictures
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
pub(in crate::cli) struct ReplayArguments {
    /// The recording
    #[arg(value_name = "FILE")]
    pub(in crate::cli) file: PathBuf,
    #[command(flatten)]
    pub(in crate::cli) machine: Machine,
    /// Write the outcome as JSON; `-` is stdout, in place of the line
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) json: Option<PathBuf>,
}

/// `clip`.
#[derive(Debug, Args)]
pub(in crate::cli) struct ClipArguments {
    /// The recording
    #[arg(value_name = "RECORDING")]
    pub(in crate::cli) file: PathBuf,
    /// The file to write
    #[arg(long, value_name = "FILE.gif")]
    pub(in crate::cli) gif: PathBuf,
    /// Width and height, pixels [default: as the world, 480 along the longer side]
    #[arg(long, value_name = "WxH", value_parser = picture_size)]
    pub(in crate::cli) size: Option<UVec2>,
    /// Frames a second, 1 to 50
    #[arg(long, value_name = "N", default_value_t = 20, allow_negative_numbers = true, value_parser = frames_per_second)]
    pub(in crate::cli) fps: u32,
}

/// What there is to choose from.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum Listing {
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
pub(in crate::cli) struct PlayArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file, a save file, a picture with its world or
    /// a recording [default: the scene played last, at first waterfall]
    pub(in crate::cli) scene: Option<String>,
    #[command(flatten)]
    pub(in crate::cli) options: PlayOptions,
}

/// Options of `play`.
#[derive(Debug, Args)]
pub(in crate::cli) struct PlayOptions {
    /// Quality to start with: a name of `list qualities` [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = preset)]
    pub(in crate::cli) quality: Option<Preset>,
    /// Detail: how many times finer than the scene's own the particle spacing is, 0.125 to 8; 2 takes four times the
    /// particles
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = detail)]
    pub(in crate::cli) detail: Option<f64>,
    /// Set a parameter of the scene, or a number of the quality or the liquid
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(in crate::cli) settings: Vec<(String, String)>,
    #[command(flatten)]
    pub(in crate::cli) machine: Machine,
    /// Record what is played, from the start on, for `replay FILE`
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) record: Option<PathBuf>,
    /// Answer a script: a line of stdin gets a line of stdout (docs/scripts.md)
    #[arg(long, hide = true)]
    pub(in crate::cli) hook: bool,
}

/// `run`.
#[derive(Debug, Args)]
pub(in crate::cli) struct RunArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file, a save file, a picture with its world or
    /// a recording (from its last jump on)
    pub(in crate::cli) scene: String,
    /// Simulated time [default: 10, or as long as the recording]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true, conflicts_with = "ticks")]
    pub(in crate::cli) seconds: Option<Ticks>,
    /// Simulated time in ticks of 1/60 s
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = ticks)]
    pub(in crate::cli) ticks: Option<u64>,
    /// Quality: a name of `list qualities` [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = preset)]
    pub(in crate::cli) quality: Option<Preset>,
    /// Detail: how many times finer than the scene's own the particle spacing is, 0.125 to 8; 2 takes four times the
    /// particles
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = detail)]
    pub(in crate::cli) detail: Option<f64>,
    /// Set a parameter of the scene, or a number of the quality or the liquid
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(in crate::cli) settings: Vec<(String, String)>,
    /// Switch an effect of `list effects`
    #[arg(long = "effect", value_name = "NAME=auto|on|off", value_parser = effect)]
    pub(in crate::cli) effects: Vec<(Effect, Mode)>,
    #[command(flatten)]
    pub(in crate::cli) machine: Machine,
    /// Ticks at the start that are left out of times and accuracy samples
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true, allow_negative_numbers = true,
          value_parser = warmup)]
    pub(in crate::cli) warmup: u64,
    /// Write what was measured as JSON; `-` is stdout
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) metrics: Option<PathBuf>,
    /// Write all particles at the end: id, element, position, velocity
    #[arg(long, value_name = "FILE.csv")]
    pub(in crate::cli) particles: Option<PathBuf>,
    /// Write a line for each tick: time, energy, momentum, front, surface
    #[arg(long, value_name = "FILE.csv")]
    pub(in crate::cli) trace: Option<PathBuf>,
    /// Set a gauge at a place, with a radius [default: 3 spacings of the scene], in metres: `--readings` writes what it reads
    /// (docs/gauges.md)
    #[arg(long = "gauge", value_name = "X,Y[,R]", allow_hyphen_values = true, value_parser = gauge)]
    pub(in crate::cli) gauges: Vec<(Vec2, Option<f32>)>,
    /// Measure the flow through a line, in metres; to the right of the way from its first end to its second is positive
    #[arg(long = "gauge-line", value_name = "X1,Y1,X2,Y2", allow_hyphen_values = true, value_parser = gauge_line)]
    pub(in crate::cli) gauge_lines: Vec<(Vec2, Vec2)>,
    /// Also give the flow of this element alone, through each line
    #[arg(long = "gauge-element", value_name = "ELEMENT", requires = "gauge_lines")]
    pub(in crate::cli) gauge_elements: Vec<String>,
    /// Write what the gauges read, a line for each tick; `-` is stdout
    #[arg(long, value_name = "FILE.csv")]
    pub(in crate::cli) readings: Option<PathBuf>,
    /// Run the same start at `reference` quality, too, and write the distance to it over time
    #[arg(long, value_name = "FILE.csv")]
    pub(in crate::cli) reference: Option<PathBuf>,
    /// Draw the world at the end
    #[arg(long, value_name = "FILE.png")]
    pub(in crate::cli) png: Option<PathBuf>,
    /// Write what it sounds like before the whole of its box
    #[arg(long, value_name = "FILE.wav")]
    pub(in crate::cli) wav: Option<PathBuf>,
    /// Save the world at the end, to be run on
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) snapshot: Option<PathBuf>,
    /// Let the autopilot change the quality to hold so many ms a tick; the hash then depends on the machine
    #[arg(long, value_name = "MS", allow_negative_numbers = true, value_parser = hold_ms,
          conflicts_with = "hold_error")]
    pub(in crate::cli) hold_ms: Option<f32>,
    /// Let the autopilot change the quality to hold a mean density error, in percent; the hash does not
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = hold_error)]
    pub(in crate::cli) hold_error: Option<f32>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{CommandFactory, error::ErrorKind};

    #[test]
    fn the_definition_holds_together() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_bench_needs_its_table_and_takes_only_what_belongs_to_it() {
        let kind = |words: &[&str]| {
            let words = ["powder-master", "bench"].iter().chain(words);
            Arguments::try_parse_from(words).err().map(|error| error.kind())
        };
        assert_eq!(kind(&[]), Some(ErrorKind::MissingSubcommand));
        assert_eq!(kind(&["effects", "--svg", "."]), Some(ErrorKind::UnknownArgument));
        assert_eq!(kind(&["neighbours", "--quick"]), Some(ErrorKind::UnknownArgument));
        assert_eq!(kind(&["scaling", "--quick", "--json", "-", "--svg", "."]), None);
    }
}
