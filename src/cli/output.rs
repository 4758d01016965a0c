//! Where results go. Paths are looked at before anything is simulated.

use crate::{cli::failure::Failure, sim::new_file::NewFile};
use serde::Serialize;
use std::{
    io::{self, Write},
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
pub(super) fn create(path: &Path) -> Result<NewFile, Failure> {
    NewFile::create(path).map_err(|error| Failure::unwritten(path, error))
}

/// Writes a file. What was there is lost only if all of the new one is written.
pub(super) fn write(path: &Path, content: impl FnOnce(&mut NewFile) -> io::Result<()>) -> Result<(), Failure> {
    let mut file = create(path)?;
    let written = content(&mut file);
    let written = file.fault().map_or(written, Err);
    written.and_then(|()| file.finish()).map(drop).map_err(|error| Failure::unwritten(path, error))
}

/// Writes a value as JSON, to a file or to stdout.
pub(super) fn write_json(path: &Path, value: &impl Serialize) -> Result<(), Failure> {
    let mut text = serde_json::to_string_pretty(value)
        .map_err(|error| Failure::Outcome(format!("{}: can't be written: {error}", path.display())))?;
    text.push('\n');
    if is_stdout(Some(path)) { print(&text) } else { write(path, |file| file.write_all(text.as_bytes())) }
}

/// Writes a report as JSON where that is asked for, and prints it as text unless the JSON has stdout: also if the JSON can't
/// be written, for it may be the result of hours.
pub(super) fn report(
    json: Option<&Path>,
    value: impl FnOnce() -> serde_json::Value,
    text: impl FnOnce() -> String,
) -> Result<(), Failure> {
    let written = json.map_or(Ok(()), |path| write_json(path, &value()));
    let printed = if is_stdout(json) { Ok(()) } else { print(&text()) };
    written.and(printed)
}

/// Where the results of a command go that writes JSON, a document and a table.
pub(super) struct Outputs<'a> {
    json: Option<&'a Path>,
    markdown: Option<&'a Path>,
}

impl<'a> Outputs<'a> {
    /// These files, if they can be written.
    pub(super) fn new(json: Option<&'a Path>, markdown: Option<&'a Path>) -> Result<Self, Failure> {
        if [json, markdown].into_iter().all(is_stdout) {
            return Err(Failure::Usage("--json and --markdown can't both have stdout; allowed: a file for one".into()));
        }
        check(&[json, markdown].into_iter().flatten().collect::<Vec<_>>())?;
        Ok(Self { json, markdown })
    }

    /// Writes JSON and document where these are asked for, and prints the table unless one of them has stdout. A file that
    /// can't be written keeps none of the others from being so.
    pub(super) fn write(
        &self,
        value: impl FnOnce() -> serde_json::Value,
        document: impl FnOnce() -> String,
        table: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        let (mut printed, mut written) = (None, Ok(()));
        if let Some(path) = self.markdown {
            let text = document();
            if is_stdout(self.markdown) {
                printed = Some(text);
            } else {
                written = write(path, |file| file.write_all(text.as_bytes()));
            }
        }
        written.and(report(self.json, value, || printed.unwrap_or_else(table)))
    }
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
