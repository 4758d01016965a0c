//! Random worlds, and parts of a work that come together as the whole.

use crate::{folder, good, program, refused};
use serde_json::Value;
use std::{fs, path::Path};

/// Runs the program, which may end with exit code 1 for what it found; gives the code and what it printed.
fn judged(here: &Path, arguments: &[&str]) -> (i32, String) {
    let output = program(here, arguments);
    let (code, stderr) = (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(code == 0 && stderr.is_empty() || code == 1 && stderr.lines().count() == 1, "{arguments:?}: {stderr}");
    (code, String::from_utf8(output.stdout).unwrap())
}

fn json(here: &Path, name: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(here.join(name)).unwrap()).unwrap()
}

/// Without what differs from run to run of the same.
fn timeless(mut value: Value) -> Value {
    let times = ["ms_median", "ms_max", "ms_total", "milliseconds", "time", "late", "seconds"];
    for row in value["rows"].as_array_mut().unwrap() {
        times.iter().for_each(|time| drop(row.as_object_mut().unwrap().remove(*time)));
    }
    value
}

#[test]
fn random_worlds_are_the_same_for_a_seed_whole_or_in_shards() {
    let here = folder("random_worlds");
    let asked = ["gauntlet", "--random", "10", "--seed", "3", "--quality", "draft"];
    let whole = judged(&here, &[&asked[..], &["--json", "whole.json", "--threads", "1"]].concat());
    assert!(whole.1.contains("| energy ") && whole.1.contains("10 worlds of seed 3: "), "{}", whole.1);
    for shard in ["1/3", "2/3", "3/3"] {
        let file = format!("part{}.json", &shard[..1]);
        let (_, said) = judged(&here, &[&asked[..], &["--shard", shard, "--json", &file, "--threads", "2"]].concat());
        assert!(said.contains(&format!("seed 3, shard {shard}: ")), "{said}");
    }
    let parts = ["part3.json", "part1.json", "part2.json"];
    let merged = judged(&here, &[&["merge"][..], &parts, &["--json", "merged.json", "--markdown", "m.md"]].concat());
    assert_eq!(merged, whole, "the same table and the same verdict");
    assert_eq!(json(&here, "merged.json")["tally"], json(&here, "whole.json")["tally"]);
    let document = fs::read_to_string(here.join("m.md")).unwrap();
    assert!(document.starts_with("# The random gauntlet") && document.contains("powder-master merge part3.json"));
    let failures = json(&here, "whole.json")["tally"]["failures"].as_array().unwrap().clone();
    assert_eq!(failures.is_empty(), whole.0 == 0);
    for failure in failures {
        good(&here, &["run", failure["file"].as_str().unwrap(), "--ticks", "2"]);
    }
    let (_, said) = judged(&here, &["gauntlet", "--random", "1", "--quality", "draft"]);
    assert!(said.contains("1 worlds of seed "), "a seed that was made up is printed: {said}");
}

#[test]
fn shards_of_cases_make_the_table_of_all() {
    let here = folder("shards_of_cases");
    let gauntlet =
        ["gauntlet", "--case", "suction", "--case", "two_at_a_point", "--quality", "fast", "--quality", "draft"];
    let exam = ["exam", "--case", "free_fall", "--case", "pulse", "--quality", "draft", "--quality", "balanced"];
    for (asked, kind) in [(gauntlet, "gauntlet"), (exam, "exam")] {
        let (code, _) = judged(&here, &[&asked[..], &["--json", "whole.json"]].concat());
        for (shard, file) in [("1/2", "a.json"), ("2/2", "b.json")] {
            judged(&here, &[&asked[..], &["--shard", shard, "--json", file]].concat());
        }
        let (merged, table) = judged(&here, &["merge", "b.json", "a.json", "--json", "merged.json"]);
        assert_eq!((merged, json(&here, "a.json")["kind"].as_str()), (code, Some(kind)));
        let (merged, whole) = (timeless(json(&here, "merged.json")), timeless(json(&here, "whole.json")));
        assert_eq!(merged, whole);
        let rows = whole["rows"].as_array().unwrap();
        let lines = table.lines().filter(|line| rows.iter().any(|row| line.contains(row["case"].as_str().unwrap())));
        assert!(lines.count() >= rows.len(), "{table}");
        refused(&here, &["merge", "a.json"], 2, &["shard 2/2 is missing", "allowed"]);
        refused(&here, &["merge", "a.json", "a.json"], 2, &["1/2 is there twice"]);
    }
    judged(&here, &["gauntlet", "--case", "suction", "--shard", "2/2", "--json", "other.json"]);
    good(&here, &["exam", "--case", "pulse", "--quality", "draft", "--shard", "1/2", "--json", "one.json"]);
    refused(&here, &["merge", "a.json", "other.json"], 2, &["other.json", "is not of a exam"]);
    refused(&here, &["merge", "one.json", "b.json"], 2, &["b.json", "is not of `powder-master exam --case pulse"]);
}

#[test]
fn scenes_are_the_same_whole_in_shards_or_from_a_journal() {
    let here = folder("shards_of_scenes");
    let asked = ["gauntlet", "--scenes", "u_tube", "sealed_air", "--quality", "draft", "--quality", "fast"];
    let asked = [&asked[..], &["--minutes", "1", "--detail", "0.25", "--threads", "1"]].concat();
    let table = good(&here, &[&asked[..], &["--json", "whole.json"]].concat());
    let summary = "4 soaks of 1 minute at draft, fast, seed 1, detail 0.25: 4 sound, 0 not";
    assert!(
        table.contains("| u_tube ") && table.contains("sound, ") && table.ends_with(&format!("{summary}\n")),
        "{table}"
    );
    for (shard, file, journal) in [("1/2", "a.json", "a.jsonl"), ("2/2", "b.json", "b.jsonl")] {
        let more = ["--shard", shard, "--json", file, "--journal", journal];
        let table = good(&here, &[&asked[..], &more].concat());
        assert!(table.contains(&format!(", shard {shard}: 2 sound, 0 not")), "{table}");
    }
    good(&here, &["merge", "b.json", "a.json", "--json", "merged.json", "--markdown", "merged.md"]);
    let tally = |name: &str| timeless(json(&here, name)["tally"].clone());
    assert_eq!(tally("merged.json"), tally("whole.json"));
    let document = fs::read_to_string(here.join("merged.md")).unwrap();
    assert!(document.starts_with("# The gallery's scenes") && document.contains(summary), "{document}");

    let read = |name: &str| fs::read_to_string(here.join(name)).unwrap();
    let kept = read("a.jsonl") + &read("b.jsonl");
    fs::write(here.join("all.jsonl"), &kept).unwrap();
    good(&here, &[&asked[..], &["--journal", "all.jsonl", "--json", "all.json"]].concat());
    assert_eq!((read("all.jsonl"), tally("all.json")), (kept, tally("whole.json")), "nothing was left to play");
    fs::write(here.join("letter"), "a letter").unwrap();
    refused(&here, &[&asked[..], &["--journal", "letter"]].concat(), 2, &["letter: is no journal of", "allowed"]);
    assert_eq!(read("letter"), "a letter", "what was refused is left as it is");
    refused(&here, &["merge", "a.json"], 2, &["shard 2/2 is missing"]);
}

#[test]
fn the_journals_of_shards_are_all_that_a_sweep_needs() {
    let here = folder("shards_of_a_sweep");
    let asked = ["sweep", "dam_break", "--set", "columns=8", "--only", "draft", "--only", "fast", "--ticks", "21"];
    let sweep = |more: &[&str]| good(&here, &[&asked[..], &["--repeat", "2"], more].concat());
    sweep(&["--out", "whole"]);
    for (shard, out) in [("1/2", "one"), ("2/2", "two")] {
        let said = sweep(&["--shard", shard, "--out", out]);
        assert!(said.contains("Order: not judged"), "{said}");
    }
    let read = |name: &str| fs::read_to_string(here.join(name)).unwrap();
    let journals = read("one/runs.jsonl") + &read("two/runs.jsonl");
    fs::create_dir(here.join("all")).unwrap();
    fs::write(here.join("all/runs.jsonl"), &journals).unwrap();
    sweep(&["--out", "all"]);
    assert_eq!(read("all/runs.jsonl"), journals, "nothing was left to run");
    let table = |name: &str| {
        let text = read(name);
        let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let is_time = |k: &usize| header[*k].starts_with("ms");
        let fields = |line: &str| {
            let fields: Vec<String> = line.split(',').map(str::to_owned).collect();
            (0..fields.len()).filter(|k| !is_time(k)).map(|k| fields[k].clone()).collect::<Vec<_>>()
        };
        let mut table: Vec<_> = text.lines().map(fields).collect();
        // Settings stand in the order of their times.
        table[1..].sort();
        table
    };
    let (all, whole) = (table("all/curve.csv"), table("whole/curve.csv"));
    let names = |table: &[Vec<String>]| table.iter().map(|line| line[0].clone()).collect::<Vec<_>>();
    assert_eq!(names(&all), names(&whole));
    // Which setting no other beats depends on the times.
    let front: Vec<usize> = (0..whole[0].len()).filter(|k| whole[0][*k].contains("front")).collect();
    for (all, whole) in all.iter().zip(&whole) {
        let differs = (0..all.len()).filter(|k| all[*k] != whole[*k] && !front.contains(k));
        assert_eq!(differs.collect::<Vec<_>>(), [0; 0], "{all:?} is not {whole:?}");
    }
}

#[test]
fn what_cannot_be_random_or_a_shard_is_refused() {
    let here = folder("shards_refused");
    fs::write(here.join("file"), "{}").unwrap();
    for (arguments, says) in [
        (&["gauntlet", "--random", "0"][..], &["--random", "allowed", "from 1"][..]),
        (&["gauntlet", "--random", "-5"], &["--random", "allowed: whole numbers from 1"]),
        (&["gauntlet", "--random", "5", "--seed", "x"], &["--seed", "allowed: whole numbers from 0"]),
        (&["gauntlet", "--random", "5", "--case", "pool"], &["--random", "--case"]),
        (&["gauntlet", "--random", "5", "--detail", "2"], &["--random", "--detail"]),
        (&["gauntlet", "--random", "5", "--shard", "1/2"], &["--shard 1/2 without --seed", "allowed: the same --seed"]),
        (&["gauntlet", "--random", "5", "--keep", "file"], &["--keep file: is a file", "allowed: a folder"]),
        (&["gauntlet", "--seed", "5"], &["--random"]),
        (&["gauntlet", "--keep", "x"], &["--random"]),
        (&["gauntlet", "--scenes", "cats"], &["--scenes", "cats", "allowed: waterfall, acid"]),
        (&["gauntlet", "--scenes", "--minutes", "61"], &["--minutes", "allowed: whole numbers from 1 to 60"]),
        (&["gauntlet", "--scenes", "--minutes", "0"], &["--minutes", "allowed: whole numbers from 1 to 60"]),
        (&["gauntlet", "--minutes", "5"], &["--scenes"]),
        (&["gauntlet", "--journal", "x"], &["--scenes"]),
        (&["gauntlet", "--scenes", "--random", "5"], &["--scenes", "--random"]),
        (&["gauntlet", "--scenes", "--case", "pool"], &["--scenes", "--case"]),
        (&["gauntlet", "--scenes", "--timed"], &["--scenes", "--timed"]),
        (&["gauntlet", "--scenes", "--keep", "x"], &["--scenes", "--keep"]),
        (&["gauntlet", "--random", "5", "--minutes", "5"], &["--random", "--minutes"]),
        (&["gauntlet", "--random", "5", "--journal", "x"], &["--random", "--journal"]),
        (&["gauntlet", "--scenes", "--journal", "no/such"], &["there is no folder no"]),
        (&["gauntlet", "--scenes", "--detail", "0.25"], &["wind_tunnel", "too small", "allowed"]),
        (&["gauntlet", "--shard", "3/2"], &["--shard", "allowed: K/N", "K from 1 to N"]),
        (&["sweep", "dam_break", "--out", "x", "--shard", "0/2"], &["--shard", "allowed: K/N"]),
        (&["sweep", "dam_break", "--out", "x", "--shard", "1/2", "--check"], &["--check", "--shard"]),
        (&["merge"], &["<FILE.json>"]),
        (&["merge", "nothing.json"], &["nothing.json: can't be read"]),
        (&["merge", "file"], &["file: `kind`", "allowed: the JSON that a shard wrote"]),
    ] {
        refused(&here, arguments, 2, says);
    }
    assert!(!here.join("found").exists(), "nothing was run");
}
