//! What measures and judges.

use super::{
    machine::Machine,
    values::{
        Minutes, cap, case, detail, gallery_scene, hours, minutes, particles, preset, rounds, seed, setting, shard,
        threads, ticks, warmup, worlds,
    },
};
use crate::{
    kernel::params::Preset,
    lab::{
        cases::{Case, Shard},
        gauntlet::GauntletCase,
    },
};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

/// `challenge`.
#[derive(Debug, Args)]
pub(in crate::cli) struct ChallengeArguments {
    /// Its name [default: all of them]
    #[arg(value_name = "NAME")]
    pub(in crate::cli) name: Option<String>,
    /// Quality: a name of `list qualities` [default: balanced]
    #[arg(long, value_name = "QUALITY", value_parser = preset)]
    pub(in crate::cli) quality: Option<Preset>,
    /// Do nothing in it, in place of its solution
    #[arg(long)]
    pub(in crate::cli) idle: bool,
    /// Threads [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(in crate::cli) threads: Option<u64>,
    /// Write the outcomes as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) json: Option<PathBuf>,
}

/// `bench`.
#[derive(Debug, Args)]
#[command(arg_required_else_help = false, disable_help_subcommand = true)]
pub(in crate::cli) struct BenchArguments {
    #[command(subcommand)]
    pub(in crate::cli) what: Bench,
    /// Write the table as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json", global = true)]
    pub(in crate::cli) json: Option<PathBuf>,
}

/// What can be measured.
#[derive(Debug, Subcommand)]
pub(in crate::cli) enum Bench {
    /// What each effect costs in each scene, alone and together, and what running only what is called for saves
    Effects {
        /// Run each choice of effects once
        #[arg(long)]
        quick: bool,
    },
    /// What a frame's picture costs, level by level and pass by pass, drawn into an image by whatever graphics there are
    Frame {
        /// Fewer frames
        #[arg(long)]
        quick: bool,
    },
    /// How much longer a tick of liquids takes in which every lump exchanges heat: one thread, and all
    Heat {
        /// Threads of the last row [default: all]
        #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
        threads: Option<u64>,
    },
    /// How many particles a tick may hold at a tick rate: brute force, bins on one thread, bins on all
    Neighbours {
        /// Threads of the last column [default: all]
        #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
        threads: Option<u64>,
    },
    /// What a tick costs and how exact it is, from 1,458 to 999,698 particles, at every quality of detail 1
    Scaling(ScalingOptions),
    /// What a tick of a world at rest takes, asleep and awake
    Sleep {
        /// One scene, once
        #[arg(long)]
        quick: bool,
    },
    /// What a tick takes on 1, 2, 4 … threads, pass by pass, and what more threads would bring
    Threads {
        /// Most threads [default: all]
        #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
        threads: Option<u64>,
        /// One scene, once
        #[arg(long)]
        quick: bool,
    },
}

/// Options of `bench scaling`.
#[derive(Debug, Args)]
pub(in crate::cli) struct ScalingOptions {
    /// Threads beside one [default: all]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(in crate::cli) threads: Option<u64>,
    /// Draw the curves into a folder: scaling-time.svg, scaling-error.svg, scaling-threads.svg
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) svg: Option<PathBuf>,
    /// Show other programs' figures beside: [{name, figures: [{particles, ms, error_mean, error_p99}]}]
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) beside: Option<PathBuf>,
    /// Take less than a minute: three sizes, one second of each
    #[arg(long)]
    pub(in crate::cli) quick: bool,
    /// Leave larger worlds out
    #[arg(long, value_name = "PARTICLES", allow_negative_numbers = true, value_parser = particles)]
    pub(in crate::cli) up_to: Option<u64>,
    /// Leave a row out that would take longer [default: 40, with --quick 5]
    #[arg(long, value_name = "SECONDS", value_parser = cap, allow_negative_numbers = true)]
    pub(in crate::cli) cap: Option<f64>,
}

/// `exam` and `gauntlet`.
#[derive(Debug, Args)]
pub(in crate::cli) struct CaseArguments<C: Case> {
    #[arg(long = "case", value_name = "NAME", value_parser = case::<C>, help = C::SUITE.which)]
    pub(in crate::cli) cases: Vec<&'static C>,
    /// Write the rows as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) json: Option<PathBuf>,
    /// Write the rows with what they mean, as a document; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.md")]
    pub(in crate::cli) markdown: Option<PathBuf>,
    /// Quality to run at, again for more: a name of `list qualities` [default: all]
    #[arg(long = "quality", value_name = "QUALITY", value_parser = preset)]
    pub(in crate::cli) qualities: Vec<Preset>,
    /// Detail: how many times finer than each case's own the particle spacing is, 0.125 to 8; 2 takes four times the
    /// particles. The detail of a quality comes on top of it
    #[arg(long, value_name = "N", default_value_t = 1.0, allow_negative_numbers = true, value_parser = detail)]
    pub(in crate::cli) detail: f64,
    /// The cases that take a moment, at `balanced`
    #[arg(long)]
    pub(in crate::cli) quick: bool,
    /// Cases at a time, each on one thread; they never change the result [default: one a processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(in crate::cli) threads: Option<u64>,
    /// Run a part only: every Nth run (or random world, or scene at a quality) from the Kth on; `merge` puts the JSON of all parts together
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub(in crate::cli) shard: Option<Shard>,
}

/// `gauntlet`.
#[derive(Debug, Args)]
pub(in crate::cli) struct GauntletArguments {
    #[command(flatten)]
    pub(in crate::cli) cases: CaseArguments<GauntletCase>,
    /// Judge so many random worlds in place of the cases
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true, value_parser = worlds,
          group = "worlds", conflicts_with_all = ["cases", "quick", "detail"])]
    pub(in crate::cli) random: Option<u64>,
    /// Play scenes of the gallery for some minutes each by a script in place of the cases, and judge them as `soak` does: names of
    /// `list scenes` [default: all]
    #[arg(long, value_name = "SCENE", num_args = 0.., value_parser = gallery_scene, group = "worlds",
          conflicts_with_all = ["cases", "quick"])]
    pub(in crate::cli) scenes: Option<Vec<&'static str>>,
    /// Simulated time of each scene, minutes, 1 to 60
    #[arg(long, value_name = "N", default_value_t = 10, allow_negative_numbers = true, value_parser = minutes,
          requires = "scenes", conflicts_with = "random")]
    pub(in crate::cli) minutes: u64,
    /// Keep each scene that is done in this file: the same command goes on with those that are not
    #[arg(long, value_name = "FILE", requires = "scenes", conflicts_with = "random")]
    pub(in crate::cli) journal: Option<PathBuf>,
    /// Count a tick that takes too long as a fault, too: on a machine that does nothing else
    #[arg(long, conflicts_with = "worlds")]
    pub(in crate::cli) timed: bool,
    /// What the random worlds are made from: the same number, the same worlds [default: a new one, which is printed]; with
    /// `--scenes` random choices of the player [default: 1]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = seed, requires = "worlds")]
    pub(in crate::cli) seed: Option<u64>,
    /// Folder for the random worlds that break a rule, made if it is needed [default: found]
    #[arg(long, value_name = "DIR", requires = "random", conflicts_with = "scenes")]
    pub(in crate::cli) keep: Option<PathBuf>,
}

/// `merge`.
#[derive(Debug, Args)]
pub(in crate::cli) struct MergeArguments {
    /// The JSON that all shards of a run wrote
    #[arg(required = true, value_name = "FILE.json")]
    pub(in crate::cli) files: Vec<PathBuf>,
    /// Write the whole as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) json: Option<PathBuf>,
    /// Write the whole as a document; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.md")]
    pub(in crate::cli) markdown: Option<PathBuf>,
}

/// `soak`.
#[derive(Debug, Args)]
pub(in crate::cli) struct SoakArguments {
    /// Scene: a name of `list scenes`, or the path of a scene file [default: waterfall]
    pub(in crate::cli) scene: Option<String>,
    /// Simulated time
    #[arg(long, value_name = "HOURS", value_parser = hours, default_value = "24", allow_negative_numbers = true)]
    pub(in crate::cli) hours: Minutes,
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
    /// End at the first minute of simulated time after this much real time, and judge what there is
    #[arg(long, value_name = "HOURS", value_parser = hours, allow_negative_numbers = true)]
    pub(in crate::cli) within: Option<Minutes>,
    /// Random choices of the player: the same number, the same play
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(in crate::cli) seed: u64,
    /// Write the figures as JSON; `-` is stdout, in place of the table
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) json: Option<PathBuf>,
    /// Keep in this file what it takes to go on, at least once an hour of simulated time: a soak that was stopped, however
    /// that was, goes on from there by the same command, and comes to the same bits
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) journal: Option<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) machine: Machine,
}

/// `study`.
#[derive(Debug, Args)]
pub(in crate::cli) struct StudyArguments {
    /// Which experiment
    pub(in crate::cli) what: Study,
    /// Folder for its pictures
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) out: PathBuf,
    /// Threads of `rest-density` [default: all]; `truth` runs on one
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = threads)]
    pub(in crate::cli) threads: Option<u64>,
    /// Show other programs' true errors in `truth`:
    /// [{name, source, figures: [{columns, percent: [at T = 1, 1.75, 2.5]}]}]
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) beside: Option<PathBuf>,
}

/// Experiments that end in a table and pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Study {
    /// What a rest density that does not suit the spacing does to a liquid: rest-density.png
    RestDensity,
    /// How far the dam break is from a converged run, at each quality and four spacings: truth-particles.svg, truth-time.svg
    Truth,
}

/// `sweep`.
#[derive(Debug, Args)]
pub(in crate::cli) struct SweepArguments {
    /// Scenes: names of `list scenes`, or paths of scene files or save files
    #[arg(required = true, value_name = "SCENE")]
    pub(in crate::cli) scenes: Vec<String>,
    /// Folder for the results, made if it isn't there; with several scenes, each gets a folder in it. A sweep that was
    /// stopped goes on from what it finds there
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) out: PathBuf,
    /// Fewer settings, shorter runs, one of each
    #[arg(long)]
    pub(in crate::cli) quick: bool,
    /// Only this preset; may be repeated [default: all presets and what is around them]
    #[arg(long = "only", value_name = "QUALITY", value_parser = preset)]
    pub(in crate::cli) only: Vec<Preset>,
    /// Measure a part only: every Nth setting from the Kth on. What all parts leave in `runs.jsonl`, put together in
    /// another folder, is all that a sweep into that folder needs
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub(in crate::cli) shard: Option<Shard>,
    /// End with exit code 1 if the presets are not in order: each more expensive and more exact than the one before it, and none
    /// beaten by a margin
    #[arg(long, conflicts_with_all = ["only", "shard"])]
    pub(in crate::cli) check: bool,
    /// Runs of each setting, interleaved, each but the first from a start that is a rounding off [default: 5; with --quick 1]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = rounds)]
    pub(in crate::cli) repeat: Option<u64>,
    /// Threads of the settings that don't stand for a number of threads
    #[arg(long, value_name = "N", default_value_t = 1, allow_negative_numbers = true, value_parser = threads)]
    pub(in crate::cli) threads: u64,
    /// Detail: how many times finer than a scene's own the particle spacing is, 0.125 to 8; 2 takes four times the
    /// particles
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = detail)]
    pub(in crate::cli) detail: Option<f64>,
    /// Set a parameter of the scenes, or a number of the liquid
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = setting)]
    pub(in crate::cli) settings: Vec<(String, String)>,
    /// Ticks of the scene before the moment from which every run sets out [default: 240 with emitters or wind, else 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = warmup)]
    pub(in crate::cli) start: Option<u64>,
    /// Ticks of a run [default: 300; with --quick 120]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = ticks)]
    pub(in crate::cli) ticks: Option<u64>,
    /// Ticks at the start of a run that are left out of times and samples [default: a fifth of the run, less one]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = warmup)]
    pub(in crate::cli) warmup: Option<u64>,
}
