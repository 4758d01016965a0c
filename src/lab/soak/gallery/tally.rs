//! What came of the gallery's scenes: the table, and whether all are sound. Tallies of shards add up to that of all.

use super::{plan::Plan, row::Row};
use crate::lab::{cases::Shard, markdown};
use serde::{Deserialize, Serialize};

/// Width of the document, characters.
const WIDTH: usize = 118;

/// What came of the scenes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Names of the scenes.
    pub scenes: Vec<String>,
    /// Simulated time of each scene, minutes.
    pub minutes: u64,
    /// The player's random choices.
    pub seed: u64,
    /// How many times finer than its own the spacing of each scene is.
    pub detail: f64,
    /// Names of the qualities.
    pub qualities: Vec<String>,
    /// Which part this is, if it is not all.
    pub shard: Option<Shard>,
    /// What came of each scene at each quality, scene by scene.
    pub rows: Vec<Row>,
}

impl Tally {
    pub(super) fn new(plan: &Plan, rows: Vec<Row>) -> Self {
        let Plan { minutes, seed, detail, shard, .. } = *plan;
        let scenes = plan.scenes.iter().map(|scene| (*scene).to_owned()).collect();
        let qualities = plan.presets.iter().map(|preset| preset.name().to_owned()).collect();
        Self { scenes, minutes, seed, detail, qualities, shard, rows }.sorted()
    }

    /// With its rows in the order of the plan.
    fn sorted(mut self) -> Self {
        let Self { scenes, qualities, rows, .. } = &mut self;
        let place = |names: &[String], name: &str| names.iter().position(|other| other == name);
        rows.sort_by_key(|row| (place(scenes, &row.scene), place(qualities, &row.quality)));
        self
    }

    /// The tally of all shards together.
    ///
    /// # Errors
    /// If they are not the shards of one run, each once: a line that says what is wrong and what is allowed.
    pub fn merge(parts: Vec<Self>) -> Result<Self, String> {
        Shard::check_complete(parts.iter().map(|part| part.shard))?;
        let mut parts = parts.into_iter();
        let Some(mut all) = parts.next() else { return Err("no tallies; allowed: those of all shards".into()) };
        for part in parts {
            let asked = |tally: &Self| Self { shard: None, rows: Vec::new(), ..tally.clone() };
            if asked(&part) != asked(&all) {
                let (other, what) = (part.asked(), all.asked());
                return Err(format!("scenes {other} beside scenes {what}; allowed: shards of one run"));
            }
            all.rows.extend(part.rows);
        }
        all.shard = None;
        Ok(all.sorted())
    }

    /// What was asked for, but for the shard.
    fn asked(&self) -> String {
        let Self { minutes, seed, detail, qualities, .. } = self;
        let plural = if *minutes == 1 { "" } else { "s" };
        let detail = if *detail == 1.0 { String::new() } else { format!(", detail {detail}") };
        format!("of {minutes} minute{plural} at {}, seed {seed}{detail}", qualities.join(", "))
    }

    fn unsound(&self) -> impl Iterator<Item = String> + '_ {
        self.rows.iter().filter_map(Row::fault)
    }

    /// How many came out how, in a line.
    pub fn summary(&self) -> String {
        let shard = self.shard.map_or_else(String::new, |shard| format!(", shard {shard}"));
        let (all, unsound, asked) = (self.rows.len(), self.unsound().count(), self.asked());
        format!("{all} soaks {asked}{shard}: {} sound, {unsound} not", all - unsound)
    }

    /// A line for each scene with a column for each quality, aligned in Markdown, and what it took, s.
    pub fn table(&self) -> String {
        let cell = |scene: &str, quality: &String| {
            let row = self.rows.iter().find(|row| row.scene == scene && row.quality == *quality);
            // Another shard has it.
            row.map_or_else(|| "–".to_owned(), |row| format!("{}, {:.0} s", row.verdict(), row.seconds))
        };
        let line = |scene: &String| {
            let cells = self.qualities.iter().map(|quality| cell(scene, quality));
            [scene.clone()].into_iter().chain(cells).collect()
        };
        let lines: Vec<Vec<String>> = self.scenes.iter().map(line).collect();
        let headings: Vec<&str> = ["scene"].into_iter().chain(self.qualities.iter().map(String::as_str)).collect();
        markdown::table(&headings, |column| column > 0, &lines)
    }

    /// What is not sound, a line for each scene and quality.
    pub fn failed(&self) -> Vec<String> {
        self.unsound().collect()
    }

    /// What to say if a scene is not sound: how many, and the first.
    pub fn failure(&self) -> Option<String> {
        let (first, all) = (self.unsound().next()?, self.rows.len());
        Some(format!("{} of {all} soaks are not sound, the first is {first}", self.unsound().count()))
    }

    /// The whole as a document: the command that made it, the table, what is not sound.
    pub fn document(&self, command: &str, processor: &str) -> String {
        let head = format!(
            "`{command}` writes this file ({processor}). A player by script pours, builds, blows and presses in each scene; \
             beside what came of it stand the seconds that it took on one thread."
        );
        let item = |line: String| markdown::fill(&format!("- {line}"), WIDTH).replace('\n', "\n  ") + "\n";
        let failed: String = self.unsound().map(item).collect();
        let failed = if failed.is_empty() { "Nothing.\n".to_owned() } else { failed };
        let (head, summary, table) = (markdown::fill(&head, WIDTH), self.summary(), self.table());
        format!("# The gallery's scenes\n\n{head}\n\n{summary}.\n\n{table}\n## What is not sound\n\n{failed}")
    }
}
