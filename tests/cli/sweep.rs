//! `sweep`: its curve, and going on where it was stopped.

use crate::{folder, good, metrics, refused};
use serde_json::Value;
use std::{
    collections::{BTreeSet, HashMap},
    fs::{self, File},
};

/// A sweep of a few particles.
const SMALL_SWEEP: [&str; 14] = [
    "sweep",
    "dam_break",
    "--set",
    "columns=8",
    "--only",
    "draft",
    "--only",
    "fast",
    "--ticks",
    "21",
    "--repeat",
    "2",
    "--out",
    "sw",
];

#[test]
fn a_sweep_leaves_a_curve_and_goes_on_where_it_was_stopped() {
    let here = folder("sweep");
    let said = good(&here, &SMALL_SWEEP);
    let read = |name: &str| fs::read_to_string(here.join("sw").join(name)).unwrap();
    assert_eq!(said, read("summary.md"));
    for part in ["# dam_break", "128 particles", "## What to choose", "| `draft` |", "Order: not judged. "] {
        assert!(said.contains(part), "no {part} in\n{said}");
    }
    let table = read("curve.csv");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 3);
    let header: Vec<&str> = lines[0].split(',').collect();
    let field = |line: &str, name: &str| {
        let k = header.iter().position(|column| *column == name).unwrap();
        line.split(',').nth(k).unwrap().to_owned()
    };
    for line in &lines[1..] {
        assert_eq!(field(line, "runs"), "2");
        let number = |name: &str| field(line, name).parse::<f64>().unwrap();
        assert!(number("ms_low") <= number("ms") && number("ms") <= number("ms_high"), "{line}");
    }
    if cfg!(feature = "charts") {
        assert!(read("curve.svg").starts_with("<svg"));
        assert_eq!(&fs::read(here.join("sw/curve.png")).unwrap()[1..4], b"PNG");
    }

    let runs = read("runs.jsonl");
    let ends: BTreeSet<String> =
        runs.lines().map(|run| serde_json::from_str::<Value>(run).unwrap()["hash"].to_string()).collect();
    assert_eq!((runs.lines().count(), ends.len()), (4, 4), "each round sets out a rounding off: {ends:?}");
    let half = &runs[..runs.len() - 9];
    fs::write(here.join("sw/runs.jsonl"), half).unwrap();
    good(&here, &SMALL_SWEEP);
    let again = read("runs.jsonl");
    assert_eq!(again.lines().count(), 5, "the half run was run again, and only that");
    assert!(again.starts_with(&format!("{half}\n")), "nothing of what was there is lost");
    good(&here, &SMALL_SWEEP);
    assert_eq!(read("runs.jsonl"), again, "nothing was left to do");
    assert_eq!(fs::read_to_string(here.join("sw/curve.csv")).unwrap().lines().count(), 3);
}

#[test]
fn a_quality_is_in_the_sweep_what_it_is_by_itself() {
    let here = folder("sweep_alone");
    let once = [&SMALL_SWEEP[..10], &["--repeat", "1", "--out", "sw"]].concat();
    good(&here, &once);
    let mut table = csv::Reader::from_path(here.join("sw/curve.csv")).unwrap();
    let rows: Vec<HashMap<String, String>> = table.deserialize().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 2);
    for row in rows {
        let alone =
            ["run", "dam_break", "--set", "columns=8", "--ticks", "21", "--warmup", "3", "--quality", &row["preset"]];
        let run = metrics(&here, &alone);
        for (column, key) in [("error_max", "density_error_max"), ("density_mean", "density_mean")] {
            assert_eq!(row[column], format!("{:.6}", run["accuracy"][key].as_f64().unwrap()), "{row:?}");
        }
        assert_eq!(row["hash"], run["hash"].as_str().unwrap());
        assert_eq!(row["error_scatter"], "", "nothing is known of one run");
    }
}

#[test]
fn several_scenes_have_a_folder_each() {
    let here = folder("sweep_scenes");
    let tiny = ["--only", "draft", "--ticks", "2", "--start", "1", "--repeat", "1", "--out", "all"];
    good(&here, &[&["sweep", "sealed_air", "rest_density"][..], &tiny[..]].concat());
    for scene in ["sealed_air", "rest_density"] {
        let summary = fs::read_to_string(here.join("all").join(scene).join("summary.md")).unwrap();
        assert!(summary.starts_with(&format!("# {scene}")), "{summary}");
    }
}

#[test]
fn a_second_sweep_into_the_same_folder_is_refused() {
    let here = folder("sweep_twice");
    fs::create_dir(here.join("sw")).unwrap();
    let journal = here.join("sw/runs.jsonl");
    fs::write(&journal, "a line\n").unwrap();
    let first = File::open(&journal).unwrap();
    first.lock().unwrap();
    refused(&here, &SMALL_SWEEP, 2, &["runs.jsonl", "another run writes here", "allowed", "another --out"]);
    assert_eq!(fs::read_to_string(&journal).unwrap(), "a line\n");
    drop(first);
    good(&here, &SMALL_SWEEP);
    assert_eq!(fs::read_to_string(&journal).unwrap().lines().count(), 5);
}

/// Ticks that would take hours.
const LONG: [&str; 4] = ["--start", "1000000", "--only", "draft"];

#[test]
fn every_scene_is_looked_at_before_any_is_simulated() {
    let here = folder("sweep_looks");
    refused(
        &here,
        &[&["sweep", "hydrostatic", "empty", "--out", "m"][..], &LONG].concat(),
        2,
        &["empty", "nothing moves"],
    );
    assert!(!here.join("m").exists(), "nothing is written, either");
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_is_found_before_anything_is_simulated() {
    let here = folder("sweep_unwritable");
    let into_proc = ["sweep", "hydrostatic", "--out", "/proc/self"];
    refused(&here, &[&into_proc[..], &LONG].concat(), 1, &["/proc/self/runs.jsonl", "can't be written"]);
}

#[test]
fn a_sweep_from_a_save_file_counts_from_its_tick() {
    let here = folder("sweep_save");
    good(&here, &["run", "dam_break", "--set", "columns=8", "--ticks", "24", "--snapshot", "saved"]);
    let tiny = ["sweep", "saved", "--only", "draft", "--ticks", "2", "--repeat", "1"];
    for (more, says) in [
        (&["--out", "at_once"][..], "from the same moment (tick 24 of the scene)"),
        (&["--out", "later", "--start", "3"], "from the same moment (tick 27 of the scene)"),
    ] {
        let said = good(&here, &[&tiny[..], more].concat());
        assert!(said.contains(says), "no {says} in\n{said}");
    }
}

#[test]
fn presets_out_of_order_fail_the_sweep_only_if_that_is_asked_for() {
    let here = folder("sweep_check");
    // So little water is mostly surface, where another iteration buys nothing.
    let thin = ["sweep", "dam_break", "--set", "columns=12", "--quick", "--out", "thin"];
    assert!(good(&here, &thin).contains("\nOrder: not ok.\n"));
    let summary = fs::read_to_string(here.join("thin/summary.md")).unwrap();
    let says = ["dam_break: the presets are out of order", "error rises"];
    let output = crate::program(&here, &[&thin[..], &["--check"]].concat());
    let stderr = String::from_utf8(output.stderr).unwrap();
    // A build without charts says so in a line of its own.
    let lines = if cfg!(feature = "charts") { 1 } else { 2 };
    assert_eq!((output.status.code(), stderr.lines().count()), (Some(1), lines), "{stderr}");
    assert!(says.iter().all(|part| stderr.contains(part)), "{stderr}");
    assert_eq!(String::from_utf8(output.stdout).unwrap(), summary, "the results are there all the same");
}
