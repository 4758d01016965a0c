//! Names on tiles: in one line or two, never smaller than the smallest text. What fits in neither way ends in dots; the whole
//! name is what a tile is called for screen readers, and stands in its card.

use crate::game::hud::style;
use bevy_egui::egui::{
    Color32, FontId, Galley, Painter,
    text::{LayoutJob, TextFormat},
};
use std::sync::Arc;

/// How much nearer letters may come to each other, so that they fit into a line, points.
const NEARER: f32 = 0.5;
/// By how much a line that was made to fit may be too long, points.
const ROUNDING: f32 = 0.25;
/// Letters at least that stand before a hyphen, and behind it.
const BEFORE: usize = 2;
const BEHIND: usize = 2;
/// Letters that stay together at the start of a syllable, in English and German.
const TOGETHER: [&str; 26] = [
    "schl", "schm", "schn", "schr", "schw", "sch", "str", "ch", "ck", "ph", "qu", "sh", "st", "th", "bl", "br", "dr",
    "fl", "fr", "gl", "gr", "kl", "kr", "pl", "pr", "tr",
];

/// The lines of a name in a `room` of points. Lengths are times `unit` points.
pub fn lines(painter: &Painter, name: &str, room: f32, unit: f32, colour: Color32) -> Vec<Arc<Galley>> {
    let set = |text: &str, nearer: f32| {
        let font_id = FontId::proportional(style::SMALL * unit);
        let format = TextFormat { font_id, color: colour, extra_letter_spacing: -nearer, ..TextFormat::default() };
        painter.layout_job(LayoutJob::single_section(text.to_owned(), format))
    };
    let snug = |text: &str| {
        let wide = set(text, 0.0);
        let nearer = ((wide.size().x - room) / text.chars().count().max(1) as f32).min(NEARER * unit);
        if nearer > 0.0 { set(text, nearer) } else { wide }
    };
    fit(name, room + ROUNDING * unit, |text| snug(text).size().x).iter().map(|line| snug(line)).collect()
}

/// A name in one line or two, cut if it must be, as wide as the room at most.
fn fit(name: &str, room: f32, width: impl Fn(&str) -> f32) -> Vec<String> {
    let fits = |line: &str| width(line) <= room;
    if fits(name) {
        return vec![name.to_owned()];
    }
    let at_spaces: Vec<[String; 2]> =
        name.match_indices(' ').map(|(at, _)| [name[..at].to_owned(), name[at + 1..].to_owned()]).collect();
    let at_syllables: Vec<[String; 2]> =
        syllables(name).into_iter().map(|at| [format!("{}-", &name[..at]), name[at..].to_owned()]).collect();
    // The most even one of those that fit.
    let wider = |[a, b]: &[String; 2]| width(a).max(width(b));
    for ways in [&at_spaces, &at_syllables] {
        let whole = ways.iter().filter(|[a, b]| fits(a) && fits(b));
        if let Some(lines) = whole.min_by(|a, b| wider(a).total_cmp(&wider(b))) {
            return lines.to_vec();
        }
    }
    // As much as there is room for.
    if let Some([a, b]) = at_spaces.first() {
        return vec![cut(a, fits), cut(b, fits)];
    }
    match at_syllables.iter().rfind(|[a, _]| fits(a)) {
        Some([a, b]) => vec![a.clone(), cut(b, fits)],
        None => vec![cut(name, fits)],
    }
}

/// A text, or as much of its beginning as fits before dots.
fn cut(text: &str, fits: impl Fn(&str) -> bool) -> String {
    if fits(text) {
        return text.to_owned();
    }
    let ends = text.char_indices().map(|(at, _)| at).rev();
    let cuts = ends.map(|end| format!("{}…", text[..end].trim_end()));
    cuts.into_iter().find(|cut| fits(cut)).unwrap_or_default()
}

/// Where a hyphen may come in: before the last consonant ahead of a vowel, and before those that stay together with it. It is right
/// for most words of English and German, and for those of others no worse than a cut.
fn syllables(name: &str) -> Vec<usize> {
    let is_vowel = |letter: char| "aeiouyäöü".contains(letter.to_lowercase().next().unwrap_or(letter));
    let letters: Vec<(usize, char)> = name.char_indices().collect();
    let mut found = Vec::new();
    for k in 1..letters.len() {
        let (at, letter) = letters[k - 1];
        if !is_vowel(letters[k].1) || is_vowel(letter) || !letter.is_alphabetic() {
            continue;
        }
        let before = name[..letters[k].0].to_lowercase();
        // Lower case has the same length in the alphabets that have these letters.
        let together = TOGETHER.iter().find(|together| before.ends_with(*together) && before.len() == letters[k].0);
        let at = together.map_or(at, |together| letters[k].0 - together.len());
        let (head, tail) = name.split_at(at);
        let word = head.rsplit(|letter: char| !letter.is_alphabetic()).next().unwrap_or_default();
        let rest = tail.split(|letter: char| !letter.is_alphabetic()).next().unwrap_or_default();
        let is_long = word.chars().count() >= BEFORE && rest.chars().count() >= BEHIND;
        if is_long && word.chars().any(is_vowel) {
            found.push(at);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All letters as wide as one another.
    fn fit_in(letters: usize, name: &str) -> Vec<String> {
        fit(name, letters as f32, |text| text.chars().count() as f32)
    }

    #[test]
    fn a_long_name_takes_two_lines_at_a_space_or_at_a_syllable() {
        for (name, parts) in [
            ("nasser Sand", ["nasser", "Sand"]),
            ("Quecksilber", ["Queck-", "silber"]),
            ("Schießpulver", ["Schieß-", "pulver"]),
            ("Zündschnur", ["Zünd-", "schnur"]),
            ("Pflanze", ["Pflan-", "ze"]),
            ("löschen", ["lö-", "schen"]),
            ("mercury", ["mer-", "cury"]),
            ("pressure", ["pres-", "sure"]),
            ("degrees", ["de-", "grees"]),
            ("charcoal", ["char-", "coal"]),
        ] {
            assert_eq!(fit_in(parts.map(|part| part.chars().count()).into_iter().max().unwrap(), name), parts);
        }
    }

    #[test]
    fn what_fits_in_no_way_ends_in_dots() {
        assert_eq!(fit_in(5, "brennendes Holz"), ["bren…", "Holz"]);
        assert_eq!(fit_in(6, "Quecksilberdampf"), ["Queck-", "silbe…"]);
        assert_eq!(fit_in(4, "Strumpf"), ["Str…"]);
        assert_eq!(fit_in(0, "Strumpf"), [""]);
    }
}
