//! `soak`: what it says, and going on where it was stopped.

use crate::{folder, good, refused};
use serde_json::Value;
use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
    time::Duration,
};

/// Four minutes of a small world with water that comes and goes, and wind.
const SMALL: [&str; 6] = ["soak", "--hours", "0.0667", "--detail", "0.2", "--json"];

fn figures(here: &Path, name: &str) -> Value {
    serde_json::from_slice(&fs::read(here.join(name)).unwrap()).unwrap()
}

#[test]
fn a_soak_that_is_killed_goes_on_and_comes_to_the_same() {
    let here = folder("soak");
    let table = good(&here, &[&SMALL[..], &["whole.json", "--threads", "2"]].concat());
    for part in
        ["waterfall at balanced, detail 0.2, settings as shipped, seed 1: 0.07 h", "begun at 0.00 h: ", "2 threads"]
    {
        assert!(table.contains(part), "no {part} in\n{table}");
    }
    assert_eq!(table.matches("not judged: too few periods").count(), 5, "{table}");

    let resumable = [&SMALL[..], &["pieces.json", "--journal", "kept", "--threads", "1"]].concat();
    let journal = here.join("kept");
    let mut child = Command::new(env!("CARGO_BIN_EXE_powder-master"))
        .args(&resumable)
        .current_dir(&here)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // Once it has written its start and then another entry, it dies, perhaps in the middle of the next.
    let kept = || fs::read(&journal).unwrap_or_default();
    let first = loop {
        match kept() {
            bytes if bytes.is_empty() => std::thread::sleep(Duration::from_millis(1)),
            bytes => break bytes,
        }
    };
    while kept() == first && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    assert!(!child.wait().unwrap().success(), "it ended before it was killed");

    let table = good(&here, &resumable);
    assert!(table.contains("resumed at 0.0"), "{table}");
    let (whole, pieces) = (figures(&here, "whole.json"), figures(&here, "pieces.json"));
    assert_eq!((&whole["resumed"], &pieces["resumed"]), (&Value::Bool(false), &Value::Bool(true)));
    for key in ["hash", "minutes", "rock", "counters", "settings", "faults"] {
        assert_eq!(whole[key], pieces[key], "{key}");
    }
    let rows = |report: &Value| {
        let mut rows = report["periods"].as_array().unwrap().clone();
        let noisy = ["ms", "ms_p99", "resident"];
        rows.iter_mut().for_each(|row| row.as_object_mut().unwrap().retain(|key, _| !noisy.contains(&key.as_str())));
        rows
    };
    assert_eq!(rows(&whole), rows(&pieces));
    assert_eq!(rows(&whole).len(), 4);

    let last = kept();
    assert_eq!(good(&here, &resumable), table, "nothing was left to do");
    assert_eq!(kept(), last);
    for (more, says) in [
        (&["--seed", "2"][..], "its seed is 1, this one's 2"),
        (&["--quality", "draft"], "its quality is balanced, this one's draft"),
        (&["--set", "flow=500"], "its settings is as shipped, this one's flow=500"),
    ] {
        refused(
            &here,
            &[&resumable[..], more].concat(),
            2,
            &["kept", says, "allowed: the journal of the same command"],
        );
    }
    let hydrostatic = [&["soak", "hydrostatic"], &resumable[1..]].concat();
    refused(&here, &hydrostatic, 2, &["its scene is waterfall, this one's hydrostatic"]);
    fs::write(&journal, &last[..last.len() / 2]).unwrap();
    refused(&here, &resumable, 2, &["kept", "damaged", "allowed"]);
    assert_eq!(kept(), last[..last.len() / 2], "what was refused is left as it is");
    fs::write(&journal, "a letter").unwrap();
    refused(&here, &resumable, 2, &["kept", "not a soak's journal", "allowed"]);
}

#[test]
fn a_journal_that_cannot_be_kept_is_refused_before_anything_is_simulated() {
    let here = folder("soak_unkept");
    let with = |journal: &str| ["soak", "--hours", "1000", "--journal", journal].map(str::to_owned);
    let refused = |journal: &str, code, says: &[&str]| {
        let arguments = with(journal);
        refused(&here, &arguments.each_ref().map(String::as_str), code, says);
    };
    refused("no/such/file", 2, &["there is no folder no/such"]);
    if cfg!(target_os = "linux") {
        refused("/proc/self/kept", 1, &["can't be written"]);
    }
    let held = fs::File::create(here.join("held")).unwrap();
    held.lock().unwrap();
    refused("held", 2, &["another run writes here", "allowed"]);
}
