//! What the command line understands: the commands, and what opens and runs worlds. `lab`: what measures and judges;
//! `values`: the words that options take.

mod lab;
mod values;

use crate::{
    kernel::{params::Preset, simd::InstructionSet},
    lab::{exam::ExamCase, gauntlet::GauntletCase},
    scene::blueprint::{Effect, Mode},
};
use clap::{Args, Parser, Subcommand, ValueEnum};
pub(super) use lab::{Bench, BenchArguments, CaseArguments, SoakArguments, Study, StudyArguments, SweepArguments};
use std::path::PathBuf;
pub(super) use values::{Minutes, Ticks};
use values::{effect, hold_error, hold_ms, preset, seconds, setting, simd, threads, ticks, warmup};

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
    Exam(CaseArguments<ExamCase>),
    /// Play a scene for hours by a script, and see that nothing grows or gets lost
    Soak(SoakArguments),
    /// Run every hard case at each quality, and judge whether it stays stable
    Gauntlet(CaseArguments<GauntletCase>),
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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_holds_together() {
        Arguments::command().debug_assert();
    }
}
