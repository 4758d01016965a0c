//! Every file of the corpus through its reader, so that what the fuzzer once found stays found; and every file of each
//! through all the others.

#[path = "support/readers.rs"]
mod readers;

use powder_master::sim::{
    recorder::{self, Recorder},
    recording::Recording,
    save,
};
use readers::{READERS, small_world};
use std::{
    fs,
    panic::catch_unwind,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

/// Longest that a file may take, on a slow machine and without optimisation.
const LONGEST: Duration = Duration::from_secs(20);

fn corpus(name: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(name);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    files
}

#[test]
fn no_file_of_the_corpus_breaks_its_reader_or_any_other() {
    let mut failed = Vec::new();
    for (of, _) in READERS {
        let files = corpus(of);
        assert!(!files.is_empty(), "the corpus of {of} is empty");
        for file in files {
            let bytes = fs::read(&file).expect("can be read");
            assert!(bytes.len() <= 8192, "{}: a seed is small", file.display());
            for (name, read) in READERS {
                let begun = Instant::now();
                let result = catch_unwind(|| read(&bytes));
                if result.is_err() || begun.elapsed() > LONGEST {
                    failed.push(format!("{name} with {} after {:?}", file.display(), begun.elapsed()));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn what_is_cut_or_changed_anywhere_breaks_no_reader() {
    for (name, read) in READERS {
        for file in corpus(name) {
            let bytes = fs::read(&file).expect("can be read");
            let step = (bytes.len() / 12).max(1);
            for at in (0..bytes.len()).step_by(step) {
                read(&bytes[..at]);
                let mut changed = bytes.clone();
                changed[at] ^= 0x81;
                read(&changed);
            }
        }
    }
}

/// The seed `file` of the corpus, written anew if that is wanted (`WRITE_CORPUS=1 cargo test --test readers`).
fn seed(file: &str, bytes: &[u8]) -> Vec<u8> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(file);
    if std::env::var_os("WRITE_CORPUS").is_some() {
        fs::write(&file, bytes).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }
    fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

#[test]
fn the_seeds_of_saves_and_recordings_are_of_this_format() {
    let mut world = small_world(recorder::plugin);
    (0..3).for_each(|_| world.tick());
    let kept = seed("save/small", &save::encode(world.world()));
    save::decode(&kept).unwrap_or_else(|error| panic!("{error}"));
    let world = world.world();
    let recorded = world.resource::<Recorder>().last_minute(recorder::end_now(world));
    let kept = seed("recording/small", &recorded);
    Recording::decode(&kept).unwrap_or_else(|error| panic!("{error}"));
}
