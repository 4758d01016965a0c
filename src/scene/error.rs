//! What can be wrong with a scene or with what the command line sets in it: one line each.

use std::fmt::Display;

/// A fault in a scene, in the elements or in a setting: one line that says where, what is wrong and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {what}")]
pub struct SceneError {
    place: String,
    what: String,
}

impl SceneError {
    /// The text is not what the format asks for, at a line and a column in characters, from 1.
    pub(super) fn text(file: &str, line: usize, column: usize, what: impl Display) -> Self {
        Self::file(format_args!("{file}:{line}:{column}"), what)
    }

    /// A value is not allowed. `field` is its path, such as `contents[2].disc.radius`, or `--set KEY=VALUE`.
    pub(super) fn value(file: &str, field: impl Display, what: impl Display) -> Self {
        Self::file(format_args!("{file}: {field}"), what)
    }

    /// The file can't be taken.
    pub(super) fn file(place: impl Display, what: impl Display) -> Self {
        Self { place: one_line(place), what: one_line(what) }
    }
}

/// Longest part of a message, characters: a fault in a huge file must not fill the terminal.
const LONGEST: usize = 600;

/// Keeps what a file or a player wrote from breaking the line.
fn one_line(text: impl Display) -> String {
    let text = text.to_string();
    let mut line: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(LONGEST).collect();
    if text.chars().nth(LONGEST).is_some() {
        line.push('…');
    }
    line
}

/// `did you mean …? allowed: …` for a name that isn't among `allowed`.
pub(super) fn choices<'a>(name: &str, allowed: impl IntoIterator<Item = &'a str>) -> String {
    let allowed: Vec<&str> = allowed.into_iter().collect();
    let list = if allowed.is_empty() { "none".to_owned() } else { allowed.join(", ") };
    match closest(name, &allowed) {
        Some(near) => format!("did you mean `{near}`? allowed: {list}"),
        None => format!("allowed: {list}"),
    }
}

/// The allowed name that fewest typing mistakes lie between, if they are few for its length.
fn closest<'a>(name: &str, allowed: &[&'a str]) -> Option<&'a str> {
    let name: Vec<char> = name.chars().take(64).collect();
    let near =
        allowed.iter().map(|candidate| (distance(&name, candidate), *candidate)).min_by_key(|(edits, _)| *edits)?;
    (near.0 <= 1 + near.1.len() / 4).then_some(near.1)
}

/// Edits (insert, remove, change) between two names: Levenshtein's distance, one row at a time.
fn distance(a: &[char], b: &str) -> usize {
    let mut row: Vec<usize> = (0..=a.len()).collect();
    for (j, cb) in b.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = j + 1;
        for (i, ca) in a.iter().enumerate() {
            let change = diagonal + usize::from(*ca != cb);
            diagonal = row[i + 1];
            row[i + 1] = change.min(row[i] + 1).min(diagonal + 1);
        }
    }
    row[a.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typing_mistakes_find_the_name_meant() {
        let allowed = ["substeps", "iterations", "columns"];
        assert!(choices("substep", allowed).starts_with("did you mean `substeps`?"));
        assert!(choices("colunms", allowed).starts_with("did you mean `columns`?"));
        assert_eq!(choices("zzz", allowed), "allowed: substeps, iterations, columns");
    }

    #[test]
    fn a_message_stays_on_one_line_and_short() {
        let error = SceneError::value("a\nb.ron", "x\r\n", "y".repeat(10_000));
        assert!(!error.to_string().contains(['\n', '\r']));
        assert!(error.to_string().chars().count() < 2 * LONGEST);
    }
}
