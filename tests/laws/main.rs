//! Who may import whom, read from the files: kernel, sound ← scene ← sim ← lab ← game ← cli, web, and no cycle of files.

#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a test that can't go on fails")]

mod cycles;
mod program;
mod source;

use cycles::cycles;
use program::{Dependency, Program};
use std::path::Path;

/// Crates: name and folder.
const CRATES: [(&str, &str); 3] =
    [("powder_master", "src"), ("powder_kernel", "src/kernel"), ("powder_sound", "src/sound")];

/// Layers from the lowest on: each may use itself and those before it, and those of one row not each other.
const LAYERS: [&[&str]; 6] = [&["kernel", "sound"], &["scene"], &["sim"], &["lab"], &["game"], &["cli", "web"]];

fn dependencies() -> Vec<Dependency> {
    let dependencies = Program::read(Path::new(env!("CARGO_MANIFEST_DIR")), &CRATES).dependencies();
    assert!(dependencies.len() > 1000, "{} dependencies are too few to be all", dependencies.len());
    dependencies
}

/// The layer that a file belongs to and its height. `lib.rs` and `main.rs` stand above all.
fn layer(file: &str) -> (usize, &str) {
    let name = file.trim_start_matches("src/").split('/').next().unwrap_or_default();
    (LAYERS.iter().position(|layer| layer.contains(&name)).unwrap_or(LAYERS.len()), name)
}

fn is_violation(dependency: &Dependency) -> bool {
    let ((from, user), (to, used)) = (layer(&dependency.from), layer(&dependency.to));
    to > from || to == from && user != used
}

#[test]
fn each_layer_uses_only_those_below_it() {
    let violations: Vec<_> = dependencies()
        .iter()
        .filter(|dependency| is_violation(dependency))
        .map(|dependency| format!("{}:{} uses {}", dependency.from, dependency.line, dependency.to))
        .collect();
    assert!(violations.is_empty(), "against the order {LAYERS:?}:\n{}", violations.join("\n"));
}

/// Tests inside a file may use whatever their layer may.
#[test]
fn no_files_depend_on_each_other() {
    let dependencies: Vec<_> = dependencies().into_iter().filter(|dependency| !dependency.test).collect();
    let ways: Vec<_> = cycles(&dependencies).into_iter().map(|cycle| cycle.to_string()).collect();
    assert!(ways.is_empty(), "files that depend on each other:\n{}", ways.join("\n"));
}

#[test]
fn a_violation_is_seen() {
    let is_violation = |from: &str, to: &str| {
        let [from, to] = [from, to].map(|file| format!("src/{file}.rs"));
        is_violation(&Dependency { from, to, line: 1, test: false })
    };
    for (from, to) in
        [("kernel/a", "sim/b"), ("lab/a", "game/mod"), ("cli/a", "web/b"), ("game/a", "lib"), ("sim/mod", "lab/b")]
    {
        assert!(is_violation(from, to), "{from} may use {to}");
        assert!(!is_violation(to, from) || from.starts_with("cli"), "{to} may not use {from}");
    }
    assert!(!is_violation("lab/a", "lab/b/mod") && !is_violation("main", "cli/mod"));
}
