//! Every case under `tests/cases`, for ever.

use powder_master::lab::gauntlet::random::{Case, examine};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Where cases are kept.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases")
}

#[test]
fn every_case_that_was_kept_holds() {
    let mut files: Vec<_> = fs::read_dir(folder())
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
        let found = examine(&case);
        failed.extend(found.faults().into_iter().map(|fault| format!("{name}: {fault}")));
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
