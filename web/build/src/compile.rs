//! Source → module: cargo, with the standard library built along.

use crate::{Places, fault::Fault, tool};
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

/// Compiles the game, for size or soon, and says where its module is.
pub fn compile(places: &Places, quick: bool) -> Result<PathBuf, Fault> {
    eprintln!("compiling the game for wasm32 (the first time takes a while)");
    let target = places.root.join("target/wasm");
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command
        .current_dir(&places.root)
        // Building the standard library is not stable yet, but this compiler can.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_ENCODED_RUSTFLAGS", FLAGS.join("\x1f"))
        .env_remove("RUSTFLAGS")
        .args(["rustc", "--package", "powder-master", "--lib", "--crate-type", "cdylib", "--profile", "web"])
        .args(["--target", "wasm32-unknown-unknown", "-Zbuild-std=std,panic_abort", "--target-dir"])
        .arg(&target)
        .arg("--")
        .args(MODULE_FLAGS)
        .args((!quick).then_some(ACROSS_CRATES));
    tool::run(&mut command).map_err(|_| Fault::failed("the game does not compile for wasm32 (see above)"))?;
    Ok(target.join("wasm32-unknown-unknown/web/powder_master.wasm"))
}
