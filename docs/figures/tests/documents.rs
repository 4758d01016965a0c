//! The repository's own documents: all figures are in the manifest, and say where they come from.

#![expect(clippy::unwrap_used, reason = "a test that can't go on fails")]

use figures::{
    manifest::{How, Manifest},
    region::{Region, regions},
};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// Each page that a reader may open, with its text; what commands write as a whole is signed by the tool.
fn pages(manifest: &Manifest) -> Vec<(String, String)> {
    let in_docs = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().file_name());
    let in_docs = in_docs.filter_map(|name| Some(format!("docs/{}", name.to_str()?)));
    let pages = in_docs.filter(|page| page.ends_with(".md")).chain(["README.md", "CHANGELOG.md"].map(str::to_owned));
    let is_page = |page: &String| !manifest.writes(page) || manifest.entries.iter().any(|entry| entry.page == *page);
    let mut pages: Vec<String> = pages.filter(is_page).collect();
    pages.sort();
    assert!(pages.len() > 15, "{pages:?} are too few to be all");
    pages.into_iter().map(|page| (page.clone(), fs::read_to_string(root().join(&page)).unwrap())).collect()
}

/// Tables with a column in which most cells begin with a number: the line at which each begins, counted from 0.
fn tables_of_figures(text: &str) -> Vec<usize> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let is_row = |k: usize| lines.get(k).is_some_and(|line| line.starts_with('|'));
    let begins = (0..lines.len()).filter(|&k| is_row(k) && (k == 0 || !is_row(k - 1)));
    let has_figures = |begin: &usize| {
        let rows: Vec<Vec<&str>> = (begin + 2..)
            .take_while(|&k| is_row(k))
            .map(|k| lines[k].trim_matches('|').split('|').map(str::trim).collect())
            .collect();
        let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
        (0..columns).any(|column| {
            let cells = rows.iter().filter_map(|row| row.get(column)).filter(|cell| !cell.is_empty());
            let (mut all, mut figures) = (0, 0);
            for cell in cells {
                all += 1;
                let digits = cell.trim_start_matches(|letter: char| "+-−±~<>≤≥*".contains(letter));
                figures += usize::from(digits.starts_with(|letter: char| letter.is_ascii_digit()));
            }
            2 * figures > all
        })
    };
    begins.filter(has_figures).collect()
}

#[test]
fn tables_of_words_and_of_figures_are_told_apart() {
    let words = "| name | means |\n|---|---|\n| a | 1 of these |\n| b | none |\n| c | |\n";
    assert_eq!(tables_of_figures(words), []);
    let figures = "text\n\n  | name | ms |\n  |---|---|\n  | a | −1.5 |\n  | b | **2** |\n  | c | – |\n";
    assert_eq!(tables_of_figures(figures), [2]);
    assert_eq!(tables_of_figures("| a |\n|---|"), []);
}

#[test]
fn every_table_of_figures_is_in_a_region() {
    let manifest = Manifest::read(&root()).unwrap();
    let mut outside = Vec::new();
    for (page, text) in pages(&manifest) {
        let regions = regions(&page, &text).unwrap();
        let is_inside = |line: &usize| regions.iter().any(|region| region.lines.contains(line));
        let lines = tables_of_figures(&text).into_iter().filter(|line| !is_inside(line));
        outside.extend(lines.map(|line| format!("{page}:{}", line + 1)));
    }
    assert!(
        outside.is_empty(),
        "tables that no entry of {} makes or accounts for: {outside:?}",
        figures::manifest::PATH
    );
}

#[test]
fn every_region_has_its_entry_and_every_entry_its_region_and_stamp() {
    let manifest = Manifest::read(&root()).unwrap();
    let (mut places, mut unsigned) = (BTreeSet::new(), Vec::new());
    for (page, text) in pages(&manifest) {
        for region in regions(&page, &text).unwrap() {
            if region.stamp(&text).is_none() {
                unsigned.push(format!("{page}: {}", region.name));
            }
            places.insert((page.clone(), region.name));
        }
    }
    let entries: BTreeSet<_> = manifest.entries.iter().map(|entry| (entry.page.clone(), entry.name.clone())).collect();
    assert_eq!(places, entries, "regions in the pages, and entries of the manifest");
    assert!(unsigned.is_empty(), "no line *Commit …; machine; date.* in {unsigned:?}");
}

#[test]
fn all_files_that_the_manifest_names_are_there() {
    let manifest = Manifest::read(&root()).unwrap();
    let is_missing = |path: &&str| !root().join(path).exists();
    for entry in &manifest.entries {
        let mut missing: Vec<&str> = manifest.sources(entry).into_iter().filter(is_missing).collect();
        missing.extend(entry.quoted.iter().map(String::as_str).filter(is_missing));
        if let How::Made(recipe) = &entry.how {
            // What was never made is not there; its folder is.
            let folders = recipe.files.iter().filter_map(|file| Some(file.rsplit_once('/')?.0));
            missing.extend(folders.filter(is_missing));
            let is_lost = |(_, file): &&(String, String)| !manifest.writes(file);
            missing.extend(recipe.pictures.iter().filter(is_lost).map(|(_, file)| file.as_str()));
        }
        assert!(missing.is_empty(), "{}: {missing:?} are not there", entry.name);
    }
}

/// A chart that is shown stands in the region of what makes it. Photographs of the game are no figures.
#[test]
fn every_chart_is_made_by_the_entry_of_its_region() {
    let manifest = Manifest::read(&root()).unwrap();
    let mut lost = Vec::new();
    for (page, text) in pages(&manifest) {
        let regions = regions(&page, &text).unwrap();
        let mut is_code = false;
        for (k, line) in text.lines().enumerate() {
            is_code ^= line.starts_with("```");
            if is_code {
                continue;
            }
            let Some((_, picture)) = line.split_once("![").and_then(|(_, rest)| rest.split_once("](")) else {
                continue;
            };
            let picture = picture.split(')').next().unwrap();
            if picture.contains("images/") {
                continue;
            }
            let of = |region: &&Region| region.lines.contains(&k);
            let entry = regions
                .iter()
                .find(of)
                .and_then(|region| manifest.entries.iter().find(|entry| entry.name == region.name));
            let is_made = entry.is_some_and(|entry| match &entry.how {
                How::Made(recipe) => recipe.pictures.iter().any(|(_, file)| *file == format!("docs/{picture}")),
                How::ByHand(_) => false,
            });
            if !is_made {
                lost.push(format!("{page}:{}: {picture}", k + 1));
            }
        }
    }
    assert!(lost.is_empty(), "charts outside the region of the entry that makes them: {lost:?}");
}
