//! `sweep`: its curve, and going on where it was stopped.

use crate::{folder, good, metrics};

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
    let read = |name: &str| std::fs::read_to_string(here.join("sw").join(name)).unwrap();
    assert_eq!(said, read("summary.md"));
    for part in ["# dam_break", "128 particles", "## What to choose", "| `draft` |", "Order: "] {
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
        let quality = field(line, "preset");
        let alone = ["run", "dam_break", "--set", "columns=8", "--ticks", "21", "--warmup", "3", "--quality", &quality];
        let run = metrics(&here, &alone);
        for (column, key) in [("error_max", "density_error_max"), ("density_mean", "density_mean")] {
            let expected = format!("{:.6}", run["accuracy"][key].as_f64().unwrap());
            assert_eq!(field(line, column), expected, "{quality} is in the sweep what it is by itself");
        }
    }
    assert!(read("curve.svg").starts_with("<svg"));
    assert_eq!(&std::fs::read(here.join("sw/curve.png")).unwrap()[1..4], b"PNG");

    let runs = read("runs.jsonl");
    assert_eq!(runs.lines().count(), 4);
    std::fs::write(here.join("sw/runs.jsonl"), &runs[..runs.len() - 9]).unwrap();
    good(&here, &SMALL_SWEEP);
    let again = read("runs.jsonl");
    assert_eq!(again.lines().count(), 4, "the half run was run again, and only that");
    let whole: usize = runs.lines().take(3).map(|line| line.len() + 1).sum();
    assert_eq!(again[..whole], runs[..whole]);
    good(&here, &SMALL_SWEEP);
    assert_eq!(read("runs.jsonl"), again, "nothing was left to do");
    assert_eq!(std::fs::read_to_string(here.join("sw/curve.csv")).unwrap().lines().count(), 3);
}

#[test]
fn several_scenes_have_a_folder_each() {
    let here = folder("sweep_scenes");
    let tiny = ["--only", "draft", "--ticks", "2", "--start", "1", "--repeat", "1", "--out", "all"];
    good(&here, &[&["sweep", "sealed_air", "rest_density"][..], &tiny[..]].concat());
    for scene in ["sealed_air", "rest_density"] {
        let summary = std::fs::read_to_string(here.join("all").join(scene).join("summary.md")).unwrap();
        assert!(summary.starts_with(&format!("# {scene}")), "{summary}");
    }
}
