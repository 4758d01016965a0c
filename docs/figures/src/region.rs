//! A part of a page between two marks, which readers don't see:
//!
//! ```text
//! <!-- figures: NAME -->
//! pictures, text, tables
//!
//! *Commit …; machine; date; …*
//! <!-- end of figures -->
//! ```

use crate::{fault::Fault, stamp::Stamp};
use std::ops::Range;

const BEGIN: &str = "<!-- figures: ";
const CLOSE: &str = " -->";
const END: &str = "<!-- end of figures -->";

/// A region of a page.
#[derive(Debug, PartialEq)]
pub struct Region {
    /// The name of its figures.
    pub name: String,
    /// The lines between its marks, counted from 0.
    pub lines: Range<usize>,
}

/// The regions of a text. `page` says where it stands.
///
/// # Errors
/// If marks have no partner, or two regions one name.
pub fn regions(page: &str, text: &str) -> Result<Vec<Region>, Fault> {
    let fault = |line: usize, what: &str| Err(Fault::Usage(format!("{page}:{}: {what}", line + 1)));
    let mut found: Vec<Region> = Vec::new();
    let mut open: Option<(String, usize)> = None;
    let mut is_code = false;
    for (k, line) in text.lines().map(str::trim).enumerate() {
        is_code ^= line.starts_with("```");
        if is_code {
            continue;
        }
        if let Some(name) = line.strip_prefix(BEGIN).and_then(|rest| rest.strip_suffix(CLOSE)) {
            if open.is_some() {
                return fault(k, &format!("figures begin within others; allowed: {END} before"));
            }
            if found.iter().any(|region| region.name == name) {
                return fault(k, &format!("the figures {name} stand here twice; allowed: once"));
            }
            open = Some((name.to_owned(), k));
        } else if line == END {
            match open.take() {
                Some((name, begin)) => found.push(Region { name, lines: begin + 1..k }),
                None => {
                    return fault(k, &format!("figures end that did not begin; allowed: {BEGIN}NAME{CLOSE} before"));
                }
            }
        }
    }
    match open {
        Some((name, begin)) => fault(begin, &format!("the figures {name} have no end; allowed: {END} below")),
        None => Ok(found),
    }
}

/// The region of these figures.
///
/// # Errors
/// If the page has none, or its marks have no partner.
pub fn region(page: &str, text: &str, name: &str) -> Result<Region, Fault> {
    let found = regions(page, text)?.into_iter().find(|region| region.name == name);
    let missing =
        || Fault::Usage(format!("{page}: no place for the figures {name}; allowed: {BEGIN}{name}{CLOSE} and {END}"));
    found.ok_or_else(missing)
}

impl Region {
    /// The text with other parts in this region.
    pub fn replaced(&self, text: &str, parts: &[String]) -> String {
        let lines: Vec<&str> = text.lines().collect();
        let parts = parts.iter().map(|part| part.trim()).filter(|part| !part.is_empty());
        let body = parts.collect::<Vec<_>>().join("\n\n");
        let [before, after] = [&lines[..self.lines.start], &lines[self.lines.end..]].map(|part| part.join("\n"));
        format!("{before}\n\n{body}\n\n{after}\n")
    }

    /// The stamp in this region, if there is one.
    pub fn stamp(&self, text: &str) -> Option<Stamp> {
        text.lines().take(self.lines.end).skip(self.lines.start).find_map(|line| Stamp::parse(line.trim()))
    }
}

/// A Markdown text without the heading of the first level that it begins with.
pub fn without_title(text: &str) -> &str {
    let text = text.trim_start();
    if text.starts_with("# ") { text.split_once('\n').map_or("", |(_, rest)| rest) } else { text }
}

/// A section of a Markdown text: what stands below a heading of the second level.
pub fn section<'a>(text: &'a str, heading: &str) -> Option<&'a str> {
    let marked = format!("## {heading}\n");
    let begin = if text.starts_with(&marked) { 0 } else { text.find(&format!("\n{marked}"))? + 1 } + marked.len();
    let rest = &text[begin..];
    Some(rest[..rest.find("\n## ").map_or(rest.len(), |end| end + 1)].trim())
}

/// The first table of a Markdown text.
pub fn table(text: &str) -> Option<String> {
    let is_row = |line: &&str| line.starts_with('|');
    let rows: Vec<&str> = text.lines().skip_while(|line| !is_row(line)).take_while(is_row).collect();
    (!rows.is_empty()).then(|| rows.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# Page\n\n<!-- figures: one -->\n![Curve](curve.svg)\n\n| a |\n|---|\n| 1 |\n\n*Commit abc1234; any; May.*\n\
                        <!-- end of figures -->\n\nProse.\n\n<!-- figures: two -->\n<!-- end of figures -->\n";

    #[test]
    fn figures_are_replaced_and_nothing_else() {
        let one = region("p.md", PAGE, "one").unwrap();
        assert_eq!(one.stamp(PAGE).and_then(|stamp| stamp.commit), Some("abc1234".to_owned()));
        let parts = ["![Curve](curve.svg)", "\n| a |\n|---|\n| 2 |\n", "*Commit def5678; any.*"].map(str::to_owned);
        let text = one.replaced(PAGE, &parts);
        let expected = "# Page\n\n<!-- figures: one -->\n\n![Curve](curve.svg)\n\n| a |\n|---|\n| 2 |\n\n*Commit def5678; any.*\n\n\
                        <!-- end of figures -->\n\nProse.\n\n<!-- figures: two -->\n<!-- end of figures -->\n";
        assert_eq!(text, expected);
        assert_eq!(region("p.md", &text, "one").unwrap().replaced(&text, &parts), expected);
        let two = region("p.md", &text, "two").unwrap();
        assert_eq!(two.stamp(&text), None, "the stamp of another region is not its own");
        assert!(
            two.replaced(&text, &["3".to_owned(), parts[2].clone()])
                .ends_with("-->\n\n3\n\n*Commit def5678; any.*\n\n<!-- end of figures -->\n")
        );
    }

    #[test]
    fn marks_without_a_partner_are_named_with_their_line() {
        let fault = |text: &str| regions("p.md", text).unwrap_err().to_string();
        assert!(fault("a\n<!-- figures: x -->\n").starts_with("p.md:2: the figures x have no end"));
        assert!(fault("<!-- end of figures -->").starts_with("p.md:1: figures end"));
        assert!(fault("<!-- figures: x -->\n<!-- figures: y -->").starts_with("p.md:2: figures begin within"));
        let twice = "<!-- figures: x -->\n<!-- end of figures -->\n".repeat(2);
        assert!(fault(&twice).starts_with("p.md:3: the figures x stand here twice"));
        let missing = region("p.md", PAGE, "three").unwrap_err().to_string();
        assert!(
            missing.starts_with("p.md: no place for the figures three; allowed: <!-- figures: three -->"),
            "{missing}"
        );
    }

    #[test]
    fn marks_in_examples_do_not_count() {
        assert_eq!(regions("p.md", "```text\n<!-- figures: x -->\n```\n").unwrap(), []);
    }

    #[test]
    fn a_section_ends_where_the_next_begins() {
        let text = "# T\n\n## A\n\none\n\n### B\n\ntwo\n\n## C\n\n| x |\n|---|\n| 3 |\n\nfour\n";
        assert_eq!(section(text, "A"), Some("one\n\n### B\n\ntwo"));
        assert_eq!(section(text, "C").and_then(table).unwrap(), "| x |\n|---|\n| 3 |");
        assert_eq!(section(text, "B"), None);
        assert!(without_title(text).trim_start().starts_with("## A"));
        assert_eq!(without_title("## A\n"), "## A\n");
        assert_eq!(table("no table"), None);
    }
}
