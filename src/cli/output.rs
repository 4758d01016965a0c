//! Where results go. Paths are looked at before anything is simulated.

use crate::cli::failure::Failure;
use serde::Serialize;
use std::{
    fs::File,
    io::{self, BufWriter, Write},
    path::Path,
};

/// The path that means stdout.
const STDOUT: &str = "-";

/// Whether a path means stdout.
pub(super) fn is_stdout(path: Option<&Path>) -> bool {
    path == Some(Path::new(STDOUT))
}

/// Whether files can be written at these paths: each in a folder that is there, and each for itself. Stdout always can.
pub(super) fn check(paths: &[&Path]) -> Result<(), Failure> {
    for (k, path) in paths.iter().enumerate().filter(|(_, path)| !is_stdout(Some(path))) {
        let bad = |what: String| Err(Failure::Usage(format!("{}: {what}", path.display())));
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if path.as_os_str().is_empty() {
            return Err(Failure::Usage("the path of an output is empty; allowed: a file in an existing folder".into()));
        }
        if !folder.is_dir() {
            return bad(format!("there is no folder {}; allowed: a file in an existing folder", folder.display()));
        }
        if path.is_dir() {
            return bad("is a folder; allowed: a file".into());
        }
        if paths[..k].contains(path) {
            return bad("is named for two outputs; allowed: a file for each".into());
        }
    }
    Ok(())
}

/// A file to write.
pub(super) fn create(path: &Path) -> Result<BufWriter<File>, Failure> {
    File::create(path).map(BufWriter::new).map_err(|error| Failure::unwritten(path, &error))
}

/// Writes a file.
pub(super) fn write(path: &Path, content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), Failure> {
    let mut file = create(path)?;
    content(&mut file).and_then(|()| file.flush()).map_err(|error| Failure::unwritten(path, &error))
}

/// Writes a value as JSON, to a file or to stdout.
pub(super) fn write_json(path: &Path, value: &impl Serialize) -> Result<(), Failure> {
    let mut text = serde_json::to_string_pretty(value)
        .map_err(|error| Failure::Outcome(format!("{}: can't be written: {error}", path.display())))?;
    text.push('\n');
    if is_stdout(Some(path)) { print(&text) } else { write(path, |file| file.write_all(text.as_bytes())) }
}

/// Writes a report as JSON where that is asked for, and prints it as text unless the JSON has stdout.
pub(super) fn report(
    json: Option<&Path>,
    value: impl FnOnce() -> serde_json::Value,
    text: impl FnOnce() -> String,
) -> Result<(), Failure> {
    if let Some(path) = json {
        write_json(path, &value())?;
    }
    if is_stdout(json) { Ok(()) } else { print(&text()) }
}

/// Says how to get charts, where the program can't draw them.
pub(super) fn note_missing_charts(command: &str) {
    if cfg!(not(feature = "charts")) {
        // A note that can't be written is no failure.
        let _ = writeln!(
            io::stderr(),
            "powder-master: this build draws no charts (it lacks the cargo feature `charts`); `cargo headless {command} …` \
             draws them"
        );
    }
}

/// Prints on stdout. A pipe that its reader has closed is no failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::Outcome(format!("stdout: can't be written: {error}")))
        }
        _ => Ok(()),
    }
}
