//! What `exam` and `gauntlet` have in common: where their rows go.

use crate::cli::{
    failure::Failure,
    output::{self, STDOUT},
};
use crate::{kernel::params::Preset, lab::machine::processor};
use serde::Serialize;
use serde_json::json;
use std::{io::Write, path::Path, thread::available_parallelism};

/// Where rows shall go.
pub(super) struct Report<'a> {
    json: Option<&'a Path>,
    markdown: Option<&'a Path>,
    /// Jobs at a time.
    pub(super) threads: usize,
}

impl<'a> Report<'a> {
    /// A report into these files, both looked at before anything is simulated. `threads`: one a processor unless given.
    pub(super) fn new(
        json: Option<&'a Path>,
        markdown: Option<&'a Path>,
        threads: Option<u64>,
    ) -> Result<Self, Failure> {
        let files = [json, markdown];
        if files.iter().all(|file| *file == Some(Path::new(STDOUT))) {
            return Err(Failure::Usage("--json and --markdown can't both have stdout; allowed: a file for one".into()));
        }
        let on_disk: Vec<&Path> = files.into_iter().flatten().filter(|file| *file != Path::new(STDOUT)).collect();
        output::check(&on_disk)?;
        let threads = threads.map_or_else(|| available_parallelism().map_or(1, usize::from), |n| n as usize);
        Ok(Self { json, markdown, threads })
    }

    /// Writes the rows where they shall go: `document` gives the Markdown for a processor, `table` what is printed unless
    /// a file has stdout.
    pub(super) fn write(
        &self,
        rows: &impl Serialize,
        document: impl FnOnce(&str) -> String,
        table: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        let to_stdout = |file: Option<&Path>| file == Some(Path::new(STDOUT));
        if let Some(path) = self.json {
            output::write_json(path, &json!({ "processor": processor(), "threads": self.threads, "rows": rows }))?;
        }
        if let Some(path) = self.markdown {
            let text = document(&processor());
            if to_stdout(self.markdown) {
                output::print(&text)?;
            } else {
                output::write(path, |file| file.write_all(text.as_bytes()))?;
            }
        }
        if to_stdout(self.json) || to_stdout(self.markdown) { Ok(()) } else { output::print(&table()) }
    }
}

/// The qualities that were asked for, in their order; none stands for all, or with `quick` for `balanced`.
pub(super) fn presets(asked: &[Preset], quick: bool) -> Vec<Preset> {
    let default = if quick { &[Preset::Balanced][..] } else { &Preset::ALL[..] };
    let asked = if asked.is_empty() { default } else { asked };
    Preset::ALL.into_iter().filter(|preset| asked.contains(preset)).collect()
}
