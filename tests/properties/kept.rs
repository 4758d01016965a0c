//! Every case under `tests/cases`, for ever.

use super::{
    case::{self, Case},
    rules,
};
use std::fs;

#[test]
fn every_case_that_was_kept_holds() {
    let mut files: Vec<_> = fs::read_dir(case::folder())
        .expect("tests/cases is there")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .collect();
    files.sort();
    assert!(files.len() >= 4, "only {} cases", files.len());
    let mut failed = Vec::new();
    for file in files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let case = Case::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        if let Err(fault) = rules::judge(&case) {
            failed.push(format!("{name}: {fault}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn a_case_survives_its_files() {
    let folder = std::env::temp_dir().join(format!("powder-master-case-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a temporary folder");
    let file = folder.join("one.ron");
    let entry = powder_master::sim::recording::Entry { tick: 7, intent: powder_master::sim::intent::Intent::ClearAir };
    fs::write(&file, "(title: \"One\", spacing: 1, size: (8, 8))").expect("can be written");
    fs::write(file.with_extension("jsonl"), serde_json::to_string(&entry).expect("JSON")).expect("can be written");
    let read = Case::read(&file).expect("can be read");
    assert_eq!((read.input, read.ticks), (vec![entry], 67));
    fs::remove_dir_all(folder).expect("can be removed");
}
