//! Source → module: cargo, with the standard library built along.

use crate::{Places, fault::Fault, tool};
use serde_json::Value;
use std::{env, path::PathBuf, process::Command};

/// For all crates. `embed-bitcode` lets the last step optimise across crates, whatever cargo's profile says.
const FLAGS: [&str; 3] = [
    "-Ctarget-feature=+simd128,+atomics,+bulk-memory,+mutable-globals",
    "--cfg=getrandom_backend=\"wasm_js\"",
    "-Cembed-bitcode=yes",
];

/// For the module as a whole: a memory that threads can share, of at most 2 GiB, and what starts a thread.
const MODULE_FLAGS: [&str; 8] = [
    "-Clink-arg=--shared-memory",
    "-Clink-arg=--import-memory",
    "-Clink-arg=--max-memory=2147483648",
    "-Clink-arg=--export=__wasm_init_tls",
    "-Clink-arg=--export=__tls_size",
    "-Clink-arg=--export=__tls_align",
    "-Clink-arg=--export=__tls_base",
    "-Clink-arg=--export=__heap_base",
];

/// For a small module: what no crate needs of another goes. Takes minutes and spares one part in twenty.
const ACROSS_CRATES: &str = "-Clto=fat";

/// The tests are built as the game is, so they share its crates; only their own has the checks of a debug build, and is
/// compiled in pieces side by side.
const SUITE: [&str; 2] = ["debug-assertions=true", "codegen-units=16"];

/// The package that is the game.
const PROGRAM: &str = "powder-master";
/// The package that is the module of the audio thread.
const SOUND: &str = "web-sound";

/// Compiles the game, for size or soon, and says where its module is.
pub fn compile(places: &Places, quick: bool) -> Result<PathBuf, Fault> {
    eprintln!("compiling the game for wasm32 (the first time takes a while)");
    let mut command = cargo("rustc", PROGRAM, places);
    command.args(["--crate-type", "cdylib", "--"]).args(MODULE_FLAGS).args((!quick).then_some(ACROSS_CRATES));
    tool::run(&mut command).map_err(|_| Fault::failed("the game does not compile for wasm32 (see above)"))?;
    Ok(places.target.join("wasm32-unknown-unknown/web/powder_master.wasm"))
}

/// Compiles the sound, and says where its module is: it has a memory of its own, which nobody shares.
pub fn compile_sound(places: &Places) -> Result<PathBuf, Fault> {
    eprintln!("compiling the sound for wasm32");
    let mut command = cargo("rustc", SOUND, places);
    command.args(["--crate-type", "cdylib", "--", ACROSS_CRATES, "-Cstrip=symbols"]);
    tool::run(&mut command).map_err(|_| Fault::failed("the sound does not compile for wasm32 (see above)"))?;
    Ok(places.target.join("wasm32-unknown-unknown/web/web_sound.wasm"))
}

/// Compiles the tests of a package's library, and says where their module is.
pub fn compile_suite(package: &str, places: &Places) -> Result<PathBuf, Fault> {
    eprintln!("compiling the tests of {package} for wasm32 (the first time takes a while)");
    let mut command = cargo("test", package, places);
    // Cargo would compile all crates anew, for tests that unwind, which a module can't.
    command.arg("-Zpanic-abort-tests").args(["--no-run", "--message-format", "json-render-diagnostics"]);
    let flags = format!("rustflags={MODULE_FLAGS:?}");
    for setting in SUITE.into_iter().chain([flags.as_str()]) {
        command.arg("--config").arg(format!("profile.web.package.{package}.{setting}"));
    }
    let messages = tool::output_of_loud(command.arg("-Zprofile-rustflags"))
        .map_err(|_| Fault::failed("the tests do not compile for wasm32 (see above)"))?;
    let mut messages = messages.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    messages
        .find_map(|message| message.get("executable")?.as_str().map(PathBuf::from))
        .ok_or_else(|| Fault::failed("cargo does not say where the module of the tests is"))
}

/// A command of cargo about a package's library for wasm32, with the standard library built along.
fn cargo(command: &str, package: &str, places: &Places) -> Command {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo
        .current_dir(&places.root)
        // Building the standard library is not stable yet, but this compiler can.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_ENCODED_RUSTFLAGS", FLAGS.join("\x1f"))
        .env_remove("RUSTFLAGS")
        .args([command, "--package", package, "--lib", "--profile", "web"])
        // `test` is for the tests; it is not in the game, but so the crates are the same for both.
        .args(["--target", "wasm32-unknown-unknown", "-Zbuild-std=std,panic_abort,test", "--target-dir"])
        .arg(&places.target);
    cargo
}
