//! From the command line to the command, and from its outcome to the exit code.

use crate::cli::{
    args::{Arguments, Bench, BenchArguments, Command},
    bench, challenge, clip,
    failure::{self, Failure},
    judge, list, merge, output, play, random, replay, run, scenes, soak, study, sweep,
};
use clap::Parser;
use std::{ffi::OsString, io::Write, process::ExitCode};

/// Runs the program with `arguments` (the first is its own name).
///
/// Exit codes: 0 good, 1 a check failed or an output can't be written, 2 bad usage or input. A failure is one line on
/// stderr.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let outcome = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => dispatch(arguments),
        Err(error) if error.use_stderr() => Err(Failure::Usage(failure::condense(&error))),
        // Help and version.
        Err(error) => output::print(&error.render().to_string()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // If stderr is gone, too, the exit code has to do.
            let _ = writeln!(std::io::stderr(), "powder-master: {failure}");
            failure.exit_code()
        }
    }
}

fn dispatch(arguments: Arguments) -> Result<(), Failure> {
    match arguments.command {
        None => play::play(None, &arguments.play),
        Some(Command::Play(play)) => play::play(play.scene.as_deref(), &play.options),
        Some(Command::Run(run)) => run::run(&run),
        Some(Command::Replay(replay)) => replay::replay(&replay),
        Some(Command::Clip(arguments)) => clip::clip(&arguments),
        Some(Command::Challenge(arguments)) => challenge::challenge(&arguments),
        Some(Command::Bench(BenchArguments { what, json })) => match what {
            Bench::Effects { quick } => bench::effects(quick, json.as_deref()),
            Bench::Frame { quick } => bench::frame(quick, json.as_deref()),
            Bench::Heat { threads } => bench::heat(threads, json.as_deref()),
            Bench::Neighbours { threads } => bench::neighbours(threads, json.as_deref()),
            Bench::Scaling(options) => bench::scaling(&options, json.as_deref()),
            Bench::Sleep { quick } => bench::sleep(quick, json.as_deref()),
            Bench::Threads { threads, quick } => bench::threads(threads, quick, json.as_deref()),
        },
        Some(Command::Exam(arguments)) => judge::judge(&arguments, false),
        Some(Command::Soak(arguments)) => soak::soak(&arguments),
        Some(Command::Gauntlet(arguments)) => match arguments.random {
            Some(count) => random::random(&arguments, count),
            None => match &arguments.scenes {
                Some(named) => scenes::scenes(&arguments, named),
                None => judge::judge(&arguments.cases, arguments.timed),
            },
        },
        Some(Command::Merge(arguments)) => merge::merge(&arguments),
        Some(Command::Study(study)) => study::study(&study),
        Some(Command::Sweep(sweep)) => sweep::sweep(&sweep),
        Some(Command::List { what }) => list::list(what),
    }
}
