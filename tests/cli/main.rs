//! The program as its users see it: exit codes, messages, files.

#![expect(clippy::unwrap_used, reason = "a test that can't go on fails")]

mod full_disk;
mod judges;
mod recordings;
mod run;
mod shards;
mod soak;
mod sweep;
// 29,000 ticks: too slow where the solver is not optimised.
#[cfg(not(debug_assertions))]
mod usage;

use serde_json::Value;
use std::{
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// A folder of its own for a test, empty.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn program(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_powder-master"));
    // No test opens a window.
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(variable);
    }
    command.args(arguments).current_dir(folder).output().unwrap()
}

fn good(folder: &Path, arguments: &[&str]) -> String {
    let output = program(folder, arguments);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments:?}: {stderr}");
    // A build without charts says how to get them.
    let is_note = |line: &str| cfg!(not(feature = "charts")) && line.contains("`charts`");
    let said: Vec<&str> = stderr.lines().filter(|line| !is_note(line)).collect();
    assert_eq!(said, [""; 0], "{arguments:?} has nothing to say on stderr if that is no terminal");
    String::from_utf8(output.stdout).unwrap()
}

fn metrics(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&good(folder, &[arguments, &["--metrics", "-"]].concat())).unwrap()
}

/// Fails unless the program refuses the arguments with `code` and one line that has all of `says` in it.
fn refused(folder: &Path, arguments: &[&str], code: i32, says: &[&str]) {
    let output = program(folder, arguments);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?} printed results");
    assert_eq!(stderr.lines().count(), 1, "{arguments:?} must say one line, not {stderr}");
    assert!(stderr.starts_with("powder-master: "), "{stderr}");
    for part in says {
        assert!(stderr.contains(part), "{arguments:?} must say {part}, not {stderr}");
    }
}
