//! `cargo web`: builds the game for the browser into `dist/` and serves it on this machine.
//!
//! ```text
//! source ─► compile ─► bind ─► optimise ─► pack ─► serve
//! std's     cargo      JS      wasm-opt    dist/   localhost
//! ```

mod bind;
mod compile;
mod fault;
mod optimise;
mod pack;
mod serve;
mod source;
mod tool;

use clap::Parser;
use fault::Fault;
use std::{
    path::{Path, PathBuf},
    process::ExitCode,
    time::Instant,
};

/// Builds Powder Master for the browser into dist/ and serves it on this machine
#[derive(Debug, Parser)]
#[command(name = "cargo web", version)]
struct Options {
    /// Only build
    #[arg(long, conflicts_with = "serve")]
    build: bool,
    /// Only serve what was built before
    #[arg(long)]
    serve: bool,
    /// Leave the module as large as the compiler made it, without compressed copies: builds sooner
    #[arg(long)]
    quick: bool,
    /// Port of the server on this machine; 0 takes a free one
    #[arg(long, value_name = "N", default_value_t = 8080)]
    port: u16,
}

/// Where things are.
struct Places {
    /// The repository.
    root: PathBuf,
    /// What is between source and `dist/`.
    work: PathBuf,
    /// What a host serves.
    dist: PathBuf,
}

fn main() -> ExitCode {
    let options = Options::parse();
    match run(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("{fault}");
            ExitCode::from(fault.code())
        }
    }
}

fn run(options: &Options) -> Result<(), Fault> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = root.canonicalize().map_err(|error| Fault::file(&root, error))?;
    let places = Places { work: root.join("target/wasm/page"), dist: root.join("dist"), root };
    if !options.serve {
        build(&places, options.quick)?;
    }
    if !options.build {
        serve::serve(&places.dist, options.port)?;
    }
    Ok(())
}

fn build(places: &Places, quick: bool) -> Result<(), Fault> {
    let begun = Instant::now();
    source::require()?;
    let module = compile::compile(places, quick)?;
    let bound = bind::bind(&module, places)?;
    let bound = if quick { bound } else { optimise::optimise(&bound, places)? };
    pack::pack(&bound, places, !quick)?;
    eprintln!("dist/ is built, in {} s", begun.elapsed().as_secs());
    Ok(())
}
