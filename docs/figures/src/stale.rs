//! Which figures are out of date.

use crate::{
    fault::Fault,
    manifest::{Entry, How, Manifest},
    region::region,
    repository::Repository,
};
use std::{
    fmt::{self, Display, Formatter},
    fs,
};

/// Names of changed files that are told.
const TOLD: usize = 3;

/// Why figures are out of date.
#[derive(Debug, PartialEq)]
pub enum Reason {
    /// The commit was never noted.
    NoCommit,
    /// The commit is none of this history: a shallow clone lacks most, and what never landed is in none.
    NotHere(String),
    /// They were made with changes that no commit has.
    WithChanges(String),
    /// Since that commit these files changed.
    Changed(String, Vec<String>),
}

impl Display for Reason {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoCommit => formatter.write_str("its commit was not noted"),
            Self::NotHere(commit) => write!(formatter, "made at {commit}, which is not in this history"),
            Self::WithChanges(commit) => write!(formatter, "made at {commit} with changes that no commit has"),
            Self::Changed(commit, files) => {
                let told = files[..files.len().min(TOLD)].join(", ");
                let more = if files.len() > TOLD { ", …" } else { "" };
                write!(formatter, "since {commit} {} of its sources changed: {told}{more}", files.len())
            }
        }
    }
}

/// Why an entry is out of date, if it is.
///
/// # Errors
/// If its region or its stamp is missing.
pub fn reason(repository: &Repository<'_>, manifest: &Manifest, entry: &Entry) -> Result<Option<Reason>, Fault> {
    let path = repository.root.join(&entry.page);
    let text = fs::read_to_string(&path).map_err(|error| Fault::unread(&path, &error))?;
    let Entry { name, page, .. } = entry;
    let allowed = "allowed: a line *Commit abc1234; machine; date.*";
    let stamp = region(page, &text, name)?.stamp(&text);
    let stamp = stamp
        .ok_or_else(|| Fault::Usage(format!("{page}: the figures {name} don't say where they come from; {allowed}")))?;
    let sources = manifest.sources(entry);
    // A record of programs that are gone.
    if sources.is_empty() {
        return Ok(None);
    }
    let Some(commit) = stamp.commit else { return Ok(Some(Reason::NoCommit)) };
    if stamp.with_changes {
        return Ok(Some(Reason::WithChanges(commit)));
    }
    if !repository.knows(&commit) {
        return Ok(Some(Reason::NotHere(commit)));
    }
    let changed = repository.changed_since(&commit, &sources)?;
    Ok((!changed.is_empty()).then_some(Reason::Changed(commit, changed)))
}

/// Lines about an entry that is out of date: why, and what to do.
pub fn lines(entry: &Entry, reason: &Reason) -> String {
    let remedy = match &entry.how {
        How::Made(recipe) => format!("cargo figures make {} ({})", entry.name, recipe.takes),
        How::ByHand(why) => format!("by hand: {why}"),
    };
    format!("{}, {}: {reason}\n    {remedy}", entry.name, entry.page)
}
