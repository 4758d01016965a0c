//! What the command line understands. `commands`: the commands, and what opens and runs worlds; `lab`: what measures and
//! judges; `values`: the words that options take.

mod commands;
mod lab;
mod machine;
mod values;

pub(super) use commands::{Arguments, ClipArguments, Command, Listing, PlayOptions, ReplayArguments, RunArguments};
pub(super) use lab::{
    Bench, BenchArguments, CaseArguments, ChallengeArguments, GauntletArguments, MergeArguments, ScalingOptions,
    SoakArguments, Study, StudyArguments, SweepArguments,
};
pub(super) use values::{Minutes, Ticks};
