//! `cargo figures`: makes the tables and charts of the documents, or lists those that are out of date.

use clap::{Parser, Subcommand};
use figures::{
    fault::Fault,
    make,
    manifest::{How, Manifest},
    repository::Repository,
    stale,
};
use std::{
    fmt::Write as _,
    io::{self, Write as _},
    path::Path,
    process::ExitCode,
};

/// The tables and charts of the documents (docs/figures.md)
#[derive(Debug, Parser)]
#[command(name = "cargo figures", disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    command: Task,
}

/// What to do.
#[derive(Debug, Subcommand)]
enum Task {
    /// Make all figures that commands make, or the named ones, and put them into their pages
    Make {
        /// Names of `list` [default: all]
        names: Vec<String>,
        /// Make them from what is not committed, too; it is noted beside them
        #[arg(long)]
        dirty: bool,
    },
    /// List the figures whose sources have changed since they were made
    Stale {
        /// End with exit code 1 if there are any
        #[arg(long)]
        check: bool,
    },
    /// Print all figures: name, page, how long they take, what makes them, separated by tabs
    List,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(code) => code,
        Err(fault) => {
            eprintln!("figures: {fault}");
            ExitCode::from(fault.code())
        }
    }
}

fn run(arguments: &Arguments) -> Result<ExitCode, Fault> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = root.canonicalize().map_err(|error| Fault::unread(&root, &error))?;
    let (manifest, repository) = (Manifest::read(&root)?, Repository { root: &root });
    let mut is_good = true;
    match &arguments.command {
        Task::Make { names, dirty } => {
            let entries = manifest.named(names)?;
            let by_hand = entries.iter().find(|entry| matches!(entry.how, How::ByHand(_)));
            if let Some((entry, How::ByHand(why))) =
                by_hand.filter(|_| !names.is_empty()).map(|entry| (entry, &entry.how))
            {
                return Err(Fault::Usage(format!("{} is made by hand: {why}", entry.name)));
            }
            let failed = make::make(&repository, &manifest, &entries, *dirty, &mut |line| eprintln!("{line}"))?;
            failed.iter().for_each(|line| eprintln!("figures: {line}"));
            is_good = failed.is_empty();
        }
        Task::Stale { check } => {
            let (mut list, mut count) = (String::new(), 0);
            for entry in &manifest.entries {
                if let Some(reason) = stale::reason(&repository, &manifest, entry)? {
                    _ = writeln!(list, "{}", stale::lines(entry, &reason));
                    count += 1;
                }
            }
            _ = writeln!(list, "{count} of {} figures are out of date", manifest.entries.len());
            print(&list)?;
            is_good = count == 0 || !check;
        }
        Task::List => {
            let mut list = String::new();
            for entry in &manifest.entries {
                let (takes, how) = match &entry.how {
                    How::Made(recipe) => (recipe.takes.as_str(), recipe.commands.join("; ")),
                    How::ByHand(why) => ("–", format!("by hand: {why}")),
                };
                _ = writeln!(list, "{}\t{}\t{takes}\t{how}", entry.name, entry.page);
            }
            print(&list)?;
        }
    }
    Ok(if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Prints on stdout. A pipe that its reader has closed (`| head`) is no failure.
fn print(text: &str) -> Result<(), Fault> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Fault::unwritten(Path::new("stdout"), &error)),
        _ => Ok(()),
    }
}
