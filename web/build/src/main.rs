//! `cargo web`: builds the game for the browser into `dist/` and serves it on this machine, or runs the library's tests as a
//! module.
//!
//! ```text
//! source ─► compile ─► bind ─► optimise ─► pack ─► serve
//! std's     cargo      JS      wasm-opt    dist/   localhost
//!                       └► suite
//!                          node
//! ```

mod bind;
mod compile;
mod fault;
mod optimise;
mod pack;
mod serve;
mod source;
mod suite;
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
    #[arg(long, conflicts_with_all = ["serve", "test"])]
    build: bool,
    /// Only serve what was built before
    #[arg(long, conflicts_with = "test")]
    serve: bool,
    /// Only run the library's tests as a module under node; of those whose name has NAME in it, if it is given
    #[arg(long, value_name = "NAME", num_args = 0..=1, default_missing_value = "")]
    test: Option<String>,
    /// Leave the module as large as the compiler made it, without compressed copies: builds sooner
    #[arg(long, conflicts_with = "test")]
    quick: bool,
    /// Port of the server on this machine; 0 takes a free one
    #[arg(long, value_name = "N", default_value_t = 8080)]
    port: u16,
}

/// Where things are.
struct Places {
    /// The repository.
    root: PathBuf,
    /// What is compiled.
    target: PathBuf,
    /// The module of the tests and its script.
    suite: PathBuf,
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
    let target = root.join("target/wasm");
    let (suite, work) = (target.join("suite"), target.join("page"));
    let places = Places { dist: root.join("dist"), suite, work, target, root };
    if let Some(name) = &options.test {
        source::require()?;
        return suite::test(name, &places);
    }
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
    let sound = compile::compile_sound(places)?;
    let bound = bind::bind(&module, places)?;
    let bound = if quick { bound } else { optimise::optimise(&bound, places)? };
    pack::pack(&bound, &sound, places, !quick)?;
    eprintln!("dist/ is built, in {} s", begun.elapsed().as_secs());
    Ok(())
}
