//! What `exam` and `gauntlet` have in common: which cases they run, how far they are, where their rows go.

use crate::{
    cli::{
        args::ReportOptions,
        failure::Failure,
        output::{self, STDOUT},
        progress,
    },
    kernel::params::Preset,
    lab::machine::processor,
};
use serde::Serialize;
use serde_json::json;
use std::{
    io::Write,
    path::{Path, PathBuf},
    thread::available_parallelism,
};

/// Where rows shall go.
pub(super) struct Report<'a> {
    json: Option<&'a Path>,
    markdown: Option<&'a Path>,
    /// Jobs at a time.
    pub(super) threads: usize,
}

impl<'a> Report<'a> {
    /// A report into the files that are asked for, both looked at before anything is simulated.
    pub(super) fn new(options: &'a ReportOptions) -> Result<Self, Failure> {
        let (json, markdown) = (options.json.as_deref(), options.markdown.as_deref());
        let files = [json, markdown];
        if files.iter().all(|file| *file == Some(Path::new(STDOUT))) {
            return Err(Failure::Usage("--json and --markdown can't both have stdout; allowed: a file for one".into()));
        }
        let on_disk: Vec<&Path> = files.into_iter().flatten().filter(|file| *file != Path::new(STDOUT)).collect();
        output::check(&on_disk)?;
        let threads = options.threads.map_or_else(|| available_parallelism().map_or(1, usize::from), |n| n as usize);
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

/// Does a long work that says how many jobs are done, of how many, and which one is begun.
pub(super) fn watched<R>(work: impl FnOnce(&(dyn Fn(usize, usize, &str) + Sync)) -> R) -> R {
    let line = progress::bar(0);
    work(&|done, of, title| {
        line.set_length(of as u64);
        line.set_position(done as u64);
        line.set_message(title.to_owned());
    })
}

impl ReportOptions {
    /// Whether a case is wanted: one that is named, or where none is, any; with `--quick` one that is quick.
    pub(super) fn wants(&self, named: &[String], case: &str, is_quick: bool) -> bool {
        match named {
            [] => is_quick || !self.quick,
            named => named.iter().any(|name| name == case),
        }
    }

    /// The command that was given, with its options, to be written where its results are.
    pub(super) fn command(&self, name: &str, cases: &[String]) -> String {
        let mut words = vec!["powder-master".to_owned(), name.to_owned()];
        let mut option = |name: &str, value: &str| {
            words.push(name.to_owned());
            // What a shell would take apart stands in quotes.
            let is_plain = value.chars().all(|char| char.is_alphanumeric() || "-_./,+=:@".contains(char));
            words.push(if is_plain { value.to_owned() } else { format!("'{}'", value.replace('\'', r"'\''")) });
        };
        cases.iter().for_each(|case| option("--case", case));
        self.qualities.iter().for_each(|quality| option("--quality", quality.name()));
        let path = |file: &Option<PathBuf>| file.as_ref().map(|path| path.display().to_string());
        if let Some(threads) = self.threads {
            option("--threads", &threads.to_string());
        }
        if let Some(file) = path(&self.json) {
            option("--json", &file);
        }
        if let Some(file) = path(&self.markdown) {
            option("--markdown", &file);
        }
        if self.quick {
            words.push("--quick".to_owned());
        }
        words.join(" ")
    }

    /// The qualities that were asked for, in their order; none stands for all, or with `quick` for `balanced`.
    pub(super) fn presets(&self) -> Vec<Preset> {
        let default = if self.quick { &[Preset::Balanced][..] } else { &Preset::ALL[..] };
        let asked = if self.qualities.is_empty() { default } else { &self.qualities };
        Preset::ALL.into_iter().filter(|preset| asked.contains(preset)).collect()
    }
}
