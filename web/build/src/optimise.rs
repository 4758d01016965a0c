//! Module → smaller module: Binaryen's wasm-opt.

use crate::{Places, bind::Bound, fault::Fault, tool};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Oldest wasm-opt that is trusted: 108, which Debian 12 has, confuses tables of references with tables of functions.
const OLDEST: u32 = 119;
/// The version that is taken from npm where there is none.
const FROM_NPM: &str = "binaryen@132";

/// What the module uses of WebAssembly, beyond the first version.
const FEATURES: [&str; 8] = [
    "--enable-simd",
    "--enable-threads",
    "--enable-bulk-memory",
    "--enable-mutable-globals",
    "--enable-nontrapping-float-to-int",
    "--enable-sign-ext",
    "--enable-reference-types",
    "--enable-multivalue",
];

/// Makes the module small.
pub fn optimise(bound: &Bound, places: &Places) -> Result<Bound, Fault> {
    let program = find(places)?;
    eprintln!("optimising it for size (takes minutes)");
    let small = places.work.join("small.wasm");
    let mut command = Command::new(program);
    command.arg("-Oz").args(FEATURES).arg(&bound.wasm).arg("-o").arg(&small);
    tool::run(&mut command)?;
    let size = |path| fs::metadata(path).map(|file| file.len() as f64 / 1e6).map_err(|error| Fault::file(path, error));
    eprintln!("{:.1} MB, of {:.1}", size(&small)?, size(&bound.wasm)?);
    Ok(Bound { wasm: small, script: bound.script.clone() })
}

/// The wasm-opt of this machine if it is new enough, else npm's.
fn find(places: &Places) -> Result<PathBuf, Fault> {
    let on_path = PathBuf::from("wasm-opt");
    if is_fit(&on_path) {
        return Ok(on_path);
    }
    let tools = places.target.join("tools");
    let from_npm = tools.join("node_modules/.bin/wasm-opt");
    if !is_fit(&from_npm) && tool::exists("npm") {
        eprintln!("getting wasm-opt: {FROM_NPM}");
        fs::create_dir_all(&tools).map_err(|error| Fault::file(&tools, error))?;
        let mut npm = Command::new("npm");
        npm.args(["install", "--silent", "--no-fund", "--no-audit", "--no-save", "--no-package-lock", "--prefix"]);
        tool::run(npm.arg(&tools).arg(FROM_NPM))?;
    }
    if is_fit(&from_npm) {
        return Ok(from_npm);
    }
    Err(Fault::missing(
        format!("wasm-opt {OLDEST} or newer, which makes the module small"),
        "get Binaryen: `brew install binaryen`, its own release, or Node with npm, which gets it; \
         `cargo web --quick` does without",
    ))
}

fn is_fit(program: &Path) -> bool {
    tool::output(Command::new(program).arg("--version")).is_ok_and(|about| version(&about) >= Some(OLDEST))
}

/// The number in `wasm-opt version 132 (version_132)`.
fn version(about: &str) -> Option<u32> {
    about.split_whitespace().find_map(|word| word.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_read() {
        assert_eq!(version("wasm-opt version 108"), Some(108));
        assert_eq!(version("wasm-opt version 132 (version_132)"), Some(132));
        assert!(version("none") < Some(OLDEST));
    }
}
