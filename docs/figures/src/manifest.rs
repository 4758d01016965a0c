//! What figures there are: docs/figures/figures.ron.

use crate::fault::Fault;
use serde::Deserialize;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

/// The file, from the root of the repository.
pub const PATH: &str = "docs/figures/figures.ron";

/// All figures of the documents.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Sources that many entries share, by a name that they use as `@name`.
    pub groups: BTreeMap<String, Vec<String>>,
    /// The figures, in the order in which they are made.
    pub entries: Vec<Entry>,
}

/// Figures that are made together and stand in one region of a page.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Its name, in the marks and on the command line.
    pub name: String,
    /// The Markdown file with its region, from the root.
    pub page: String,
    /// How it comes about.
    pub how: How,
    /// Files and folders that it depends on, or groups of them (`@name`). None for what is kept as a record of a decision
    /// between programs that are gone.
    pub sources: Vec<String>,
    /// Other pages whose prose quotes it, to be read again when it was made anew.
    #[serde(default)]
    pub quoted: Vec<String>,
}

/// How figures come about.
#[derive(Debug, Deserialize)]
pub enum How {
    /// By commands.
    Made(Recipe),
    /// By hand, for this reason.
    ByHand(String),
}

/// Commands that make figures.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    /// Commands with their arguments, separated by spaces; they run in the root, one after the other.
    pub commands: Vec<String>,
    /// What stands in the region.
    pub shows: Shows,
    /// Files and folders that the commands write. What they write in Markdown gets the stamp, too.
    #[serde(default)]
    pub files: Vec<String>,
    /// Charts among these that stand above the rest of the region: words for those who don't see them, and the file.
    #[serde(default)]
    pub pictures: Vec<(String, String)>,
    /// How long it takes on the machine that made what stands there.
    pub takes: String,
    /// What is to be said in the stamp beside commit, machine and date: threads, rounds.
    #[serde(default)]
    pub note: String,
}

/// What stands in a region.
#[derive(Debug, Deserialize)]
pub enum Shows {
    /// What the last command prints.
    Output,
    /// What the last command prints: a whole page. Its title stands above the region, and the stamp comes first.
    Document,
    /// A section of a Markdown file that the commands write: the file and the heading.
    Section(String, String),
    /// The table of such a section, without its text.
    Table(String, String),
}

impl Manifest {
    /// The manifest of a repository.
    ///
    /// # Errors
    /// If it can't be read, or does not hold together.
    pub fn read(root: &Path) -> Result<Self, Fault> {
        let path = root.join(PATH);
        Self::parse(&fs::read_to_string(&path).map_err(|error| Fault::unread(&path, &error))?)
    }

    /// The manifest that a text is.
    ///
    /// # Errors
    /// If it is none, or does not hold together.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let manifest: Self = ron::from_str(text).map_err(|error| Fault::Usage(format!("{PATH}:{error}")))?;
        let mut names = BTreeSet::new();
        for entry in &manifest.entries {
            let fault = |what: &str| Err(Fault::Usage(format!("{PATH}: {}: {what}", entry.name)));
            let is_plain =
                |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || "-_".contains(letter);
            if entry.name.is_empty() || !entry.name.chars().all(is_plain) {
                return fault("no name of figures; allowed: a–z, 0–9, - and _");
            }
            if !names.insert(&entry.name) {
                return fault("two entries have this name; allowed: one");
            }
            match &entry.how {
                How::Made(recipe) if recipe.commands.iter().all(|command| command.trim().is_empty()) => {
                    return fault("no command; allowed: at least one, or ByHand(reason)");
                }
                How::Made(_) if entry.sources.is_empty() => return fault("no sources; allowed: at least one"),
                How::ByHand(reason) if reason.is_empty() => {
                    return fault("by hand without a reason; allowed: a reason");
                }
                _ => {}
            }
            let unknown = entry.sources.iter().find_map(|source| manifest.missing_group(source));
            if let Some(group) = unknown {
                let groups: Vec<&str> = manifest.groups.keys().map(String::as_str).collect();
                return fault(&format!("no group @{group} of sources; allowed: {}", groups.join(", ")));
            }
        }
        Ok(manifest)
    }

    fn missing_group<'a>(&self, source: &'a str) -> Option<&'a str> {
        source.strip_prefix('@').filter(|group| !self.groups.contains_key(*group))
    }

    /// The entries of these names, in the manifest's order; all if none is named.
    ///
    /// # Errors
    /// If there is none of a name.
    pub fn named(&self, names: &[String]) -> Result<Vec<&Entry>, Fault> {
        let known = |name: &&String| self.entries.iter().any(|entry| entry.name == **name);
        if let Some(name) = names.iter().find(|name| !known(name)) {
            let all: Vec<&str> = self.entries.iter().map(|entry| entry.name.as_str()).collect();
            return Err(Fault::Usage(format!("no figures are called {name}; allowed: {}", all.join(", "))));
        }
        Ok(self.entries.iter().filter(|entry| names.is_empty() || names.contains(&entry.name)).collect())
    }

    /// The files and folders that an entry depends on.
    pub fn sources<'a>(&'a self, entry: &'a Entry) -> Vec<&'a str> {
        let of = |source: &'a String| match source.strip_prefix('@').and_then(|group| self.groups.get(group)) {
            Some(group) => group.iter().map(String::as_str).collect(),
            None => vec![source.as_str()],
        };
        entry.sources.iter().flat_map(of).collect()
    }

    /// Whether a file is written by figures: a page, or what a command writes.
    pub fn writes(&self, file: &str) -> bool {
        self.entries.iter().any(|entry| {
            let files = match &entry.how {
                How::Made(recipe) => recipe.files.as_slice(),
                How::ByHand(_) => &[],
            };
            file == entry.page || files.iter().any(|path| file == path || file.starts_with(&format!("{path}/")))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(more: &str) -> String {
        format!(r#"(name: "a", page: "docs/a.md", sources: ["@physics", "src/x.rs"], {more})"#)
    }

    fn manifest(entries: &[&str]) -> Result<Manifest, String> {
        let text = format!(r#"(groups: {{"physics": ["src/kernel"]}}, entries: [{}])"#, entries.join(", "));
        Manifest::parse(&text).map_err(|fault| fault.to_string())
    }

    const MADE: &str =
        r#"how: Made((commands: ["true"], shows: Output, takes: "1 s", files: ["docs/a", "docs/b.svg"]))"#;

    #[test]
    fn groups_stand_for_their_files() {
        let manifest = manifest(&[&entry(MADE)]).unwrap();
        assert_eq!(manifest.sources(&manifest.entries[0]), ["src/kernel", "src/x.rs"]);
    }

    #[test]
    fn what_figures_write_is_their_page_and_their_files() {
        let manifest = manifest(&[&entry(MADE)]).unwrap();
        assert!(["docs/a.md", "docs/a/b/c.csv", "docs/b.svg"].iter().all(|file| manifest.writes(file)));
        assert!(!["docs/ab.md", "src/x.rs", "docs/b.svg.md"].iter().any(|file| manifest.writes(file)));
    }

    #[test]
    fn what_does_not_hold_together_is_refused_with_a_line() {
        let of = |entries: &[&str]| manifest(entries).unwrap_err();
        let good = entry(MADE);
        assert!(of(&[&good, &good]).contains("a: two entries"));
        assert!(of(&[&good.replace("\"a\"", "\"A b\"")]).contains("no name of figures"));
        assert!(of(&[&good.replace("\"true\"", "")]).contains("no command"));
        assert!(of(&[&good.replace("@physics", "@chemistry")]).contains("@chemistry of sources; allowed: physics"));
        assert!(of(&[&entry(r#"how: ByHand("")"#)]).contains("without a reason"));
        assert!(of(&[&good.replace("takes", "lasts")]).starts_with("docs/figures/figures.ron:1:"));
        assert!(of(&[&good.replace(r#""@physics", "src/x.rs""#, "")]).contains("no sources"));
    }

    #[test]
    fn entries_are_found_by_name_in_their_order() {
        let second = entry(MADE).replace("\"a\"", "\"b\"");
        let manifest = manifest(&[&entry(MADE), &second]).unwrap();
        let names = |asked: &[&str]| {
            let asked: Vec<String> = asked.iter().map(|name| (*name).to_owned()).collect();
            let found = manifest.named(&asked).map_err(|fault| fault.to_string())?;
            Ok::<_, String>(found.iter().map(|entry| entry.name.as_str()).collect::<Vec<_>>())
        };
        assert_eq!(names(&[]).unwrap(), ["a", "b"]);
        assert_eq!(names(&["b", "a"]).unwrap(), ["a", "b"]);
        assert_eq!(names(&["c"]).unwrap_err(), "no figures are called c; allowed: a, b");
    }
}
