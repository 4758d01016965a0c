//! The program as its users see it: exit codes, messages, files.

#![expect(clippy::unwrap_used, reason = "a test that can't go on fails")]

use powder_master::{
    kernel::brush::{BrushShape, Stroke},
    lab::{
        headless::Headless,
        run::{self, Plan},
    },
    scene::{self, blueprint::Effect},
    sim::{
        control,
        intent::Intent,
        recorder::{self, Recorder},
        recording::{Recording, Writer},
        save,
        workers::Workers,
    },
};
use serde_json::Value;
use std::{
    path::{Path, PathBuf},
    process::{Command, Output},
    sync::Arc,
};

/// A folder of its own for a test, empty.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn program(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_powder-master"));
    // No test opens a window.
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(variable);
    }
    command.args(arguments).current_dir(folder).output().unwrap()
}

fn good(folder: &Path, arguments: &[&str]) -> String {
    let output = program(folder, arguments);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments:?}: {stderr}");
    assert_eq!(stderr, "", "{arguments:?} has nothing to say on stderr if that is no terminal");
    String::from_utf8(output.stdout).unwrap()
}

fn metrics(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&good(folder, &[arguments, &["--metrics", "-"]].concat())).unwrap()
}

/// Fails unless the program refuses the arguments with `code` and one line that has all of `says` in it.
fn refused(folder: &Path, arguments: &[&str], code: i32, says: &[&str]) {
    let output = program(folder, arguments);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?} printed results");
    assert_eq!(stderr.lines().count(), 1, "{arguments:?} must say one line, not {stderr}");
    assert!(stderr.starts_with("powder-master: "), "{stderr}");
    for part in says {
        assert!(stderr.contains(part), "{arguments:?} must say {part}, not {stderr}");
    }
}

const SMALL: [&str; 8] = ["run", "dam_break", "--set", "columns=8", "--ticks", "45", "--effect", "viscosity=on"];

#[test]
fn bad_usage_is_one_line_that_says_what_is_allowed() {
    let here = folder("bad_usage");
    for (arguments, says) in [
        (&["frob"][..], &["frob"][..]),
        (&["run"], &["<SCENE>"]),
        (&["run", "waterfall", "--frob"], &["--frob"]),
        (&["run", "waterfall", "--seconds", "0"], &["--seconds", "allowed", "1/60"]),
        (&["run", "waterfall", "--seconds", "-3"], &["--seconds", "allowed"]),
        (&["run", "waterfall", "--seconds", "nan"], &["--seconds", "allowed"]),
        (&["run", "waterfall", "--seconds", "1e12"], &["--seconds", "100000"]),
        (&["run", "waterfall", "--ticks", "0"], &["--ticks", "allowed", "from 1"]),
        (&["run", "waterfall", "--ticks", "1.5"], &["--ticks", "whole numbers"]),
        (&["run", "waterfall", "--ticks", "5", "--seconds", "1"], &["--ticks", "--seconds"]),
        (&["run", "waterfall", "--threads", "0"], &["--threads", "from 1"]),
        (&["run", "waterfall", "--simd", "avx1024"], &["--simd", "allowed on this processor: auto, ", "scalar"]),
        (&["play", "--simd", "fast"], &["--simd", "allowed on this processor: auto, ", "scalar"]),
        (&["run", "waterfall", "--ticks", "5", "--warmup", "5"], &["--warmup", "allowed: 0 to 4"]),
        (&["run", "waterfall", "--quality", "best"], &["best", "classic, draft, fast, balanced, fine, reference"]),
        (&["run", "waterfall", "--set", "wind"], &["KEY=VALUE"]),
        (&["run", "waterfall", "--set", "wimd=1"], &["wimd", "wind"]),
        (&["run", "waterfall", "--set", "wind=strong"], &["wind=strong"]),
        (&["run", "waterfall", "--set", "wind=1000"], &["wind=1000"]),
        (
            &["run", "waterfall", "--effect", "fire=on"],
            &["air, drag, air_feedback, predictor, tension, viscosity, vorticity, sleep"],
        ),
        (&["run", "waterfall", "--effect", "air=perhaps"], &["NAME=auto"]),
        (&["run", "waterfall", "--hold-ms", "0"], &["--hold-ms", "allowed: numbers from 0.01"]),
        (&["run", "waterfall", "--hold-ms", "-1"], &["--hold-ms", "allowed"]),
        (&["run", "waterfall", "--hold-error", "nan"], &["--hold-error", "allowed: numbers from 0.0001 to 100"]),
        (&["run", "waterfall", "--hold-error", "1", "--hold-ms", "1"], &["--hold-error", "--hold-ms"]),
        (&["run", "niagara"], &["niagara", "allowed", "dam_break", "waterfall"]),
        (&["run", "no/such.ron"], &["no/such.ron"]),
        (&["play", "niagara"], &["niagara", "allowed"]),
        (&["list"], &["WHAT"]),
        (&["list", "cats"], &["scenes, elements, effects, qualities, cases"]),
        (&["bench"], &["WHAT"]),
        (&["bench", "everything"], &["neighbours, scaling"]),
        (&["bench", "neighbours", "--quick"], &["--quick", "bench scaling"]),
        (&["bench", "scaling", "--up-to", "3"], &["--up-to", "from 1458"]),
        (&["bench", "scaling", "--cap", "-1"], &["--cap", "seconds from 0"]),
        (&["bench", "scaling", "--svg", "nowhere"], &["no folder"]),
        (&["bench", "scaling", "--beside", "nothing.json"], &["nothing.json", "can't be read"]),
        (&["bench", "neighbours", "--json", "nowhere/x.json"], &["no folder"]),
        (&["exam", "--case", "cats"], &["--case", "allowed", "free_fall", "dam_break"]),
        (&["exam", "--quality", "best"], &["best", "classic"]),
        (&["gauntlet", "--case", "cats"], &["--case", "allowed", "point_64", "deep_tank"]),
        (&["gauntlet", "--quality", "best"], &["best", "classic"]),
        (&["gauntlet", "--threads", "0"], &["--threads", "from 1"]),
        (&["gauntlet", "--json", "-", "--markdown", "-"], &["stdout"]),
        (&["exam", "--threads", "0"], &["--threads", "from 1"]),
        (&["exam", "--json", "nowhere/x.json"], &["no folder"]),
        (&["exam", "--json", "-", "--markdown", "-"], &["stdout"]),
        (&["exam", "--json", "x", "--markdown", "x"], &["two outputs"]),
        (&["study", "tides", "--out", "."], &["rest-density"]),
        (&["study", "rest-density"], &["--out"]),
        (&["study", "rest-density", "--out", "nowhere"], &["no folder"]),
        (&["sweep", "--out", "x"], &["<SCENE>"]),
        (&["sweep", "dam_break"], &["--out"]),
        (&["sweep", "niagara", "--out", "x"], &["niagara", "allowed"]),
        (&["sweep", "dam_break", "dam_break", "--out", "x"], &["dam_break is named twice", "allowed"]),
        (&["sweep", "dam_break", "--out", "x", "--repeat", "0"], &["--repeat", "from 1"]),
        (&["sweep", "dam_break", "--out", "x", "--ticks", "9", "--warmup", "9"], &["--warmup", "allowed: 0 to 8"]),
        (&["sweep", "dam_break", "--out", "x", "--set", "substeps=3"], &["substeps=3", "the sweep", "rest_density"]),
        (&["sweep", "dam_break", "--out", "x", "--set", "columns=1"], &["columns=1"]),
        (&["sweep", "dam_break", "--out", "x", "--only", "best"], &["best", "balanced"]),
        (&["sweep", "empty", "--out", "x"], &["empty", "nothing moves", "allowed"]),
    ] {
        refused(&here, arguments, 2, says);
    }
}

#[test]
fn a_bad_output_path_is_refused_before_anything_is_simulated() {
    let here = folder("bad_output");
    // A run of this length would take hours.
    let long = |option: &'static str, path: &'static str| ["run", "waterfall", "--seconds", "90000", option, path];
    for option in ["--metrics", "--particles", "--trace", "--reference", "--png", "--snapshot"] {
        refused(&here, &long(option, "nowhere/out"), 2, &["nowhere/out", "no folder", "allowed"]);
        refused(&here, &long(option, "."), 2, &["is a folder"]);
    }
    refused(&here, &["run", "empty", "--ticks", "1", "--png", "a", "--trace", "a"], 2, &["a:", "two outputs"]);
    std::fs::write(here.join("file"), "").unwrap();
    refused(&here, &["sweep", "dam_break", "--out", "file"], 2, &["file", "can't be made a folder"]);
    std::fs::create_dir_all(here.join("taken/curve.csv")).unwrap();
    refused(&here, &["sweep", "dam_break", "--out", "taken"], 2, &["curve.csv", "is a folder"]);
}

#[cfg(target_os = "linux")]
#[test]
fn an_output_that_cannot_be_written_is_exit_code_1() {
    let here = folder("full_disk");
    for option in ["--metrics", "--particles", "--trace", "--reference", "--png", "--snapshot"] {
        refused(&here, &["run", "empty", "--ticks", "1", option, "/dev/full"], 1, &["/dev/full", "can't be written"]);
    }
}

#[cfg(any(not(feature = "app"), target_os = "linux"))]
#[test]
fn without_a_window_or_a_display_play_names_run() {
    let here = folder("no_window");
    refused(&here, &[], 2, &["no ", "powder-master run waterfall"]);
    refused(&here, &["play", "dam_break"], 2, &["powder-master run dam_break"]);
    refused(&here, &["--quality", "draft", "--set", "wind=0"], 2, &["powder-master run waterfall"]);
}

#[test]
fn help_and_version_are_on_stdout() {
    let here = folder("help");
    assert!(good(&here, &["--help"]).contains("run"));
    assert!(good(&here, &["run", "--help"]).contains("--metrics"));
    assert_eq!(good(&here, &["--version"]), format!("powder-master {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn lists_are_one_a_line_with_the_name_first() {
    let here = folder("lists");
    let names = |what: &str| -> Vec<String> {
        let text = good(&here, &["list", what]);
        text.lines().map(|line| line.split('\t').next().unwrap().to_owned()).collect()
    };
    assert_eq!(names("scenes"), scene::builtin_names());
    assert!(
        ["two_at_a_point", "deep_tank", "poison"].iter().all(|case| names("cases").iter().any(|name| name == case))
    );
    assert_eq!(names("qualities"), ["classic", "draft", "fast", "balanced", "fine", "reference"]);
    assert_eq!(names("effects"), Effect::ALL.map(Effect::name));
    assert!(names("elements").contains(&"water".to_owned()));
}

#[test]
fn metrics_have_all_keys() {
    let here = folder("metrics_keys");
    let found = metrics(&here, &SMALL);
    for (group, keys) in [
        ("", "scene quality threads simd ticks sim_seconds wall_seconds hash memory_bytes"),
        ("/particles", "total by_element"),
        ("/particles/by_element", "rock water"),
        ("/ms_per_tick", "median p95 max"),
        ("/stages/solve", "calls ms_total ms_median unit touched spared ms_saved"),
        ("/effects", "air drag tension viscosity vorticity"),
        ("/effects/viscosity", "mode state active_ticks differing_ticks calls ms_total ms_saved why"),
        ("/accuracy", "density_error_mean density_error_p99 density_error_max residual volume_error energy"),
        (
            "/accuracy",
            "air_mass_drift momentum_drift air_divergence_rms density_mean energy_start energy_peak distance",
        ),
        ("/sampling", "ms_total ms_median"),
        ("/stability", "non_finite escaped speed_clamps position_clamps substeps_max"),
    ] {
        for key in keys.split(' ') {
            assert!(found.pointer(&format!("{group}/{key}")).is_some(), "{group}/{key} is missing");
        }
    }
    assert_eq!(found["scene"], "dam_break");
    assert_eq!(found["quality"], "balanced");
    assert_eq!(found["ticks"], 45);
    assert_eq!(metrics(&here, &[&SMALL[..], &["--simd", "scalar"]].concat())["simd"], "scalar");
    assert_eq!(found["sim_seconds"], 0.75);
    assert_eq!(found["particles"]["total"], 8 * 16);
    assert_eq!(found["hash"].as_str().map(str::len), Some(16));
    assert_eq!(found["accuracy"]["samples"], 2, "ticks 20 and 40");
    assert!(found["accuracy"]["density_error_mean"].is_f64());
    assert_eq!(found["accuracy"]["air_mass_drift"], Value::Null, "the scene has no air");
    assert!(found["sampling"]["ms_median"].as_f64().unwrap() > 0.0, "what measuring costs is shown");
    assert_eq!(found["effects"]["air"]["calls"], 0, "what is off is not called");
    assert_eq!(found["effects"]["air"]["state"], "off");
    assert_eq!(found["effects"]["air"]["ms_saved"], Value::Null, "nobody knows what it would have taken");
    assert_eq!(found["effects"]["viscosity"]["active_ticks"], 45);
}

#[test]
fn warmup_is_left_out_of_times_and_samples_but_not_of_the_run() {
    let here = folder("warmup");
    let whole = metrics(&here, &SMALL);
    let part = metrics(&here, &[&SMALL[..], &["--warmup", "30"]].concat());
    assert_eq!(whole["hash"], part["hash"], "the warm-up is run, too");
    assert_eq!(part["ticks"], 45);
    assert_eq!(part["warmup"], 30);
    assert_eq!(part["accuracy"]["samples"], 1, "tick 40");
    assert_eq!(part["effects"]["viscosity"]["active_ticks"], 15);
    assert_eq!(part["stages"]["measure"]["calls"], 15);
    assert_eq!(whole["stages"]["measure"]["calls"], 45);
    let late = metrics(&here, &[&SMALL[..], &["--warmup", "44"]].concat());
    assert_eq!(late["accuracy"]["samples"], 1, "a run too short for a sample is sampled at its end");
}

#[test]
fn tables_have_their_columns_and_the_picture_is_a_picture() {
    let here = folder("outputs");
    let files = ["--particles", "p.csv", "--trace", "t.csv", "--png", "w.png", "--metrics", "m.json"];
    let said = good(&here, &[&SMALL[..], &files].concat());
    assert!(said.contains("scene=dam_break ticks=45"), "{said}");
    let read = |name: &str| std::fs::read_to_string(here.join(name)).unwrap();
    let numbers = |line: &str, from: usize| -> Vec<f64> {
        line.split(',').skip(from).map(|field| field.parse().unwrap_or_else(|_| panic!("{field} in {line}"))).collect()
    };

    let particles = read("p.csv");
    let mut lines = particles.lines();
    assert_eq!(lines.next(), Some("id,element,x,y,vx,vy"));
    let rows: Vec<&str> = lines.collect();
    assert_eq!(rows.len(), 128);
    let (width, height) = (4.0 * 0.8, 2.1 * 0.8);
    for (id, row) in rows.iter().enumerate() {
        assert!(row.starts_with(&format!("{id},water,")), "in the order of the ids: {row}");
        let values = numbers(row, 2);
        assert!((0.0..=width).contains(&values[0]) && (0.0..=height).contains(&values[1]), "in metres: {row}");
    }

    let trace = read("t.csv");
    let mut lines = trace.lines();
    let header = "tick,seconds,ms,substeps,particles,energy,momentum_x,momentum_y,front_x,surface_y,max_speed,air_mass";
    assert_eq!(lines.next(), Some(header));
    let rows: Vec<Vec<f64>> = lines.map(|line| numbers(line, 0)).collect();
    assert_eq!(rows.len(), 45);
    assert_eq!(rows[44][..2], [45.0, 0.75]);
    assert!(rows.iter().all(|row| row[3] >= 1.0 && row[4] == 128.0));
    assert!(rows[44][8] > rows[0][8] + 0.3, "the front moves on");
    assert!(rows[44][5] < rows[0][5] * 1.02, "the energy does not grow");

    let png = std::fs::read(here.join("w.png")).unwrap();
    assert_eq!(&png[1..4], b"PNG");
    let metrics: Value = serde_json::from_str(&read("m.json")).unwrap();
    assert!(said.contains(metrics["hash"].as_str().unwrap()), "stdout and metrics agree on the hash");
}

#[test]
fn watching_and_threads_never_change_the_world() {
    let here = folder("same_hash");
    let hash = |more: &[&str]| {
        let said = good(&here, &[&SMALL[..], more].concat());
        said.trim_end().rsplit_once("hash=").unwrap().1.to_owned()
    };
    let plain = hash(&[]);
    assert_eq!(hash(&[]), plain, "twice the same");
    assert_eq!(hash(&["--threads", "1"]), plain);
    assert_eq!(hash(&["--threads", "3"]), plain);
    assert_eq!(hash(&["--simd", "auto"]), plain);
    assert_eq!(hash(&["--simd", "scalar"]), plain);
    let watched = hash(
        &[
            ["--metrics", "m.json"],
            ["--trace", "t.csv"],
            ["--png", "w.png"],
            ["--particles", "p.csv"],
            ["--reference", "r.csv"],
        ]
        .concat(),
    );
    assert_eq!(watched, plain);
    assert_ne!(hash(&["--set", "columns=9"]), plain, "another world has another hash");
    assert_ne!(hash(&["--effect", "viscosity=off"]), plain);
}

#[test]
fn the_distance_to_the_reference_is_a_table_over_time() {
    let here = folder("reference");
    let found = metrics(&here, &[&SMALL[..], &["--quality", "draft", "--reference", "r.csv"]].concat());
    let table = std::fs::read_to_string(here.join("r.csv")).unwrap();
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0], ["tick", "seconds", "share", "momentum", "air", "energy_ratio"]);
    assert_eq!(lines[1..].iter().map(|line| line[0]).collect::<Vec<_>>(), ["20", "40", "45"]);
    let shares: Vec<f64> = lines[1..].iter().map(|line| line[2].parse().unwrap()).collect();
    assert!(shares.iter().all(|share| (1e-6..0.5).contains(share)), "{shares:?}");
    assert!(lines[1..].iter().all(|line| line[4].is_empty()), "the scene has no air");
    let mean = shares.iter().sum::<f64>() / 3.0;
    assert!((found["accuracy"]["distance"]["share"].as_f64().unwrap() - mean).abs() < 1e-9);
    let own = metrics(&here, &[&SMALL[..], &["--quality", "reference", "--reference", "r.csv"]].concat());
    assert_eq!(own["accuracy"]["distance"]["momentum"], 0.0, "the reference is no distance from itself");
}

/// Two small settings of a small scene, twice each.
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

/// A person at work in the scene `empty`: a ledge of rock, water placed and poured, some of it taken away, wind. The
/// recording of it and the hash of the world that came out.
fn record() -> (Vec<u8>, u64) {
    let settings = [("columns", "40"), ("rows", "30")].map(|(key, value)| (key.to_owned(), value.to_owned()));
    let blueprint = Arc::new(scene::load("empty").unwrap().build(&settings, None, &Default::default()).unwrap());
    let (rock, water) = (blueprint.elements.find("rock").unwrap(), blueprint.elements.find("water").unwrap());
    let at = |x: f32, y: f32| glam::Vec2::new(x, y);
    let line = |from, to| Stroke { shape: BrushShape::Disc, from, to, radius: 1.2 };
    let tap = line(at(25.0, 25.0), at(25.0, 25.0));
    let mut intents = vec![
        (0, Intent::Draw { element: rock, stroke: line(at(5.0, 5.0), at(30.0, 8.0)) }),
        (0, Intent::Stamp { element: water, stroke: Stroke::rectangle(at(8.0, 15.0), at(20.0, 22.0)) }),
        (30, Intent::Erase { stroke: line(at(3.0, 3.0), at(12.0, 12.0)) }),
        (30, Intent::Blow { stroke: line(at(20.0, 20.0), at(20.0, 20.0)), velocity: at(40.0, 3.7) }),
    ];
    intents.extend((5..40).map(|tick| (tick, Intent::Draw { element: water, stroke: tap })));
    intents.sort_by_key(|(tick, _)| *tick);
    let mut headless =
        Headless::begin_with(Workers::default(), recorder::plugin, |world| control::load(world, blueprint.clone()));
    run::run(&mut headless, &Plan { ticks: 60, intents, ..Plan::default() }, &mut []).unwrap();
    let world = headless.world();
    (world.resource::<Recorder>().last_minute(recorder::end_now(world)), control::hash(world))
}

#[test]
fn a_recording_is_the_same_world_again() {
    let here = folder("replay");
    let (bytes, hash) = record();
    std::fs::write(here.join("mine.pmr"), &bytes).unwrap();
    let line = format!("same: 60 ticks, hash {hash:016x}\n");
    assert_eq!(good(&here, &["replay", "mine.pmr"]), line);
    assert_eq!(good(&here, &["replay", "mine.pmr", "--threads", "2", "--simd", "scalar"]), line);
    let outcome: Value = serde_json::from_str(&good(&here, &["replay", "mine.pmr", "--json", "-"])).unwrap();
    assert_eq!((&outcome["same"], &outcome["ticks"]), (&Value::from(true), &Value::from(60)));
    assert_eq!(outcome["hash"], format!("{hash:016x}"));

    let found = metrics(&here, &["run", "mine.pmr"]);
    assert_eq!(found["hash"], format!("{hash:016x}"));
    assert_eq!(found["ticks"], 60, "as long as it was recorded");
    assert_eq!(found["parameters"]["columns"], 40.0, "with the parameters that it was recorded with");
    let finer = metrics(&here, &["run", "mine.pmr", "--quality", "fine"]);
    assert_eq!(finer["quality"], "fine");
    assert_ne!(finer["hash"], found["hash"]);
    refused(&here, &["run", "mine.pmr", "--set", "rows=40"], 2, &["mine.pmr", "no use for --set"]);
    refused(&here, &["run", "mine.pmr", "--hold-ms", "1"], 2, &["mine.pmr", "no use for --hold-ms"]);
    refused(&here, &["play", "mine.pmr", "--quality", "fine"], 2, &["mine.pmr", "no use for --quality"]);
}

#[test]
fn a_replay_names_the_first_tick_that_differs() {
    let here = folder("replay_differs");
    let recording = Recording::decode(&record().0).unwrap();
    let mut writer = Writer::new();
    writer.start(&save::encode(
        Headless::begin(Workers::default(), |world| {
            save::load(world, recording.stretches[0].start().unwrap());
        })
        .world(),
    ));
    let stretch = &recording.stretches[0];
    // One dab of the poured water is missing: that of tick 23, which makes tick 24.
    let entries: Vec<_> = stretch.entries.iter().filter(|entry| entry.tick != 23).copied().collect();
    assert_eq!(entries.len() + 1, stretch.entries.len());
    writer.ticks(&entries, &stretch.marks);
    writer.end(recording.end.unwrap());
    std::fs::write(here.join("changed.pmr"), writer.take()).unwrap();
    let says = ["changed.pmr", "tick 24 is the first that differs (number 24 of the recording)"];
    refused(&here, &["replay", "changed.pmr"], 1, &says);
    refused(&here, &["replay", "changed.pmr", "--json", "out.json"], 1, &says);
    let outcome: Value = serde_json::from_slice(&std::fs::read(here.join("out.json")).unwrap()).unwrap();
    assert_eq!((&outcome["same"], &outcome["difference"]["tick"]), (&Value::from(false), &Value::from(24)));
}

#[test]
fn a_saved_world_goes_on_as_if_it_had_never_stopped() {
    let here = folder("snapshot");
    let scene = ["run", "waterfall", "--set", "flow=900"];
    let whole = metrics(&here, &[&scene[..], &["--ticks", "50"]].concat());
    good(&here, &[&scene[..], &["--ticks", "20", "--snapshot", "half.save"]].concat());
    let rest = metrics(&here, &["run", "half.save", "--ticks", "30"]);
    assert_eq!(rest["hash"], whole["hash"]);
    assert_eq!(rest["scene"], "waterfall");
    assert_eq!(rest["ticks"], 30);
    let other = metrics(&here, &["run", "half.save", "--ticks", "30", "--quality", "draft", "--effect", "air=off"]);
    assert_eq!(other["quality"], "draft");
    assert_eq!(other["effects"]["air"]["mode"], "off");
    assert_ne!(other["hash"], rest["hash"]);

    refused(&here, &["run", "half.save", "--set", "wind=0"], 2, &["half.save", "--set"]);
    let bytes = std::fs::read(here.join("half.save")).unwrap();
    std::fs::write(here.join("torn.save"), &bytes[..bytes.len() / 2]).unwrap();
    refused(&here, &["run", "torn.save"], 2, &["torn.save", "damaged"]);
    std::fs::write(here.join("poem.txt"), "roses are red").unwrap();
    refused(&here, &["run", "poem.txt"], 2, &["poem.txt", "not a save file"]);
}

#[test]
fn a_bad_recording_is_refused_in_one_line() {
    let here = folder("bad_replay");
    let (bytes, _) = record();
    let mut changed = bytes.clone();
    changed[2000] ^= 4;
    let mut newer = bytes.clone();
    newer[23] = 77;
    let mut huge = bytes[..25].to_vec();
    huge.extend(b"S\xff\xff\xff\xff and then nothing");
    for (name, bytes, says) in [
        ("empty", &b""[..], &["not a recording"][..]),
        ("poem", b"roses are red", &["not a recording"]),
        ("half", &bytes[..bytes.len() / 2], &["damaged", "breaks off"]),
        ("short", &bytes[..bytes.len() - 1], &["damaged"]),
        ("changed", &changed, &["damaged", "checksum"]),
        ("newer", &newer, &["format 77; this program reads format 3"]),
        ("old", b"{\"powder_master_replay\":1,\"scene\":\"empty\"}\n", &["format 1; this program reads format 3"]),
        ("huge", &huge, &["damaged", "breaks off"]),
    ] {
        std::fs::write(here.join(name), bytes).unwrap();
        refused(&here, &["replay", name], 2, &[&[name], says].concat());
    }
    for name in ["half", "changed", "newer", "old"] {
        refused(&here, &["run", name], 2, &[name, "recording"]);
        refused(&here, &["play", name], 2, &[name, "recording"]);
    }
    refused(&here, &["replay", "nothing.pmr"], 2, &["nothing.pmr", "can't be read"]);
    refused(&here, &["replay", "half", "--json", "nowhere/x"], 2, &["no folder"]);
    refused(&here, &["replay"], 2, &["<FILE>"]);
}

#[test]
fn bench_scaling_writes_table_json_and_curves() {
    let here = folder("scaling");
    std::fs::write(
        here.join("others.json"),
        r#"[{"name": "another program", "figures": [{"particles": 1500, "ms": 9, "error_p99": 0.2}, {"particles": 1e4, "ms": 61}]}]"#,
    )
    .unwrap();
    refused(
        &here,
        &["bench", "scaling", "--quick", "--beside", "others.json"],
        2,
        &["others.json", "10000", "allowed"],
    );
    let good_one = r#"[{"name": "another program", "figures": [{"particles": 1500, "ms": 9, "error_p99": 0.2}]}]"#;
    std::fs::write(here.join("others.json"), good_one).unwrap();
    // The smallest size only.
    let options =
        ["--quick", "--up-to", "1458", "--threads", "2", "--json", "out.json", "--svg", ".", "--beside", "others.json"];
    let table = good(&here, &[&["bench", "scaling"], &options[..]].concat());
    let report: Value = serde_json::from_slice(&std::fs::read(here.join("out.json")).unwrap()).unwrap();
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 7, "the presets and the plain method at its best");
    for row in rows {
        assert_eq!(row["particles"], 1458);
        assert_eq!(row["threads"], serde_json::json!([1, 2]));
        assert_eq!(row["same_hash"], true);
        assert_eq!(row["escaped"], 0);
        assert!(row["ms"].as_array().unwrap().iter().all(|ms| ms.as_f64().unwrap() > 0.0));
        assert!(row["error_p99"].as_f64().unwrap() < 0.5);
        let name = row["setting"].as_str().unwrap();
        assert!(
            table.lines().any(|line| line.starts_with(&format!("| 1,458 | `{name}` |"))),
            "no row of {name} in\n{table}"
        );
    }
    let error = |name: &str| rows.iter().find(|row| row["setting"] == name).unwrap()["error_p99"].as_f64().unwrap();
    assert!(error("fine") < error("draft") && error("reference") < error("fine"), "accuracy is bought");
    for name in ["scaling-time.svg", "scaling-error.svg", "scaling-threads.svg"] {
        let svg = std::fs::read_to_string(here.join(name)).unwrap();
        assert!(svg.contains("balanced") && svg.ends_with("</svg>\n"), "{name}");
    }
    assert!(std::fs::read_to_string(here.join("scaling-time.svg")).unwrap().contains("another program"));
}

#[test]
fn the_exam_prints_its_rows_and_fails_if_one_does() {
    let here = folder("exam");
    let arguments = ["exam", "--case", "free_fall", "--case", "pulse", "--quality", "draft", "--quality", "balanced"];
    let table = good(&here, &[&arguments[..], &["--json", "rows.json", "--markdown", "rows.md"]].concat());
    assert!(table.contains("| free_fall") && table.contains("| balanced") && table.contains("0 fail"), "{table}");
    let rows: Value = serde_json::from_str(&std::fs::read_to_string(here.join("rows.json")).unwrap()).unwrap();
    let rows = rows["rows"].as_array().unwrap();
    assert_eq!(
        rows.len(),
        table.lines().filter(|line| line.starts_with("| free_fall") || line.starts_with("| pulse")).count()
    );
    for row in rows {
        let [expected, got, error] = ["expected", "got", "error"].map(|key| row[key].as_f64().unwrap());
        let error_of = (got - expected).abs() / if row["relative"] == true { expected.abs() } else { 1.0 };
        assert!((error - error_of).abs() <= 1e-12 && row["milliseconds"].as_f64().unwrap() > 0.0, "{row}");
        assert_eq!(row["verdict"] == "pass", error <= row["tolerance"].as_f64().unwrap(), "{row}");
    }
    let document = std::fs::read_to_string(here.join("rows.md")).unwrap();
    assert!(document.contains("## Free fall (`free_fall`)") && document.contains("**Tolerance:**"), "{document}");
    let json = good(&here, &[&arguments[..], &["--json", "-"]].concat());
    assert!(serde_json::from_str::<Value>(&json).is_ok(), "stdout has the JSON alone: {json}");
}

#[test]
fn the_gauntlet_prints_its_rows_and_writes_them() {
    let here = folder("gauntlet");
    let arguments =
        ["gauntlet", "--case", "two_at_a_point", "--case", "suction", "--quality", "draft", "--quality", "fast"];
    let table = good(&here, &[&arguments[..], &["--json", "rows.json", "--markdown", "rows.md"]].concat());
    assert!(table.contains("| two_at_a_point") && table.contains("4 runs: 4 pass, 0 known"), "{table}");
    let rows: Value = serde_json::from_str(&std::fs::read_to_string(here.join("rows.json")).unwrap()).unwrap();
    let rows = rows["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for row in rows {
        assert_eq!(row["verdict"], "pass", "{row}");
        assert!(row["broken"].as_array().unwrap().is_empty(), "{row}");
    }
    assert!(rows[2]["clamps"]["air_clamps"].as_u64().unwrap() > 0, "suction is cut at a vacuum: {}", rows[2]);
    let document = std::fs::read_to_string(here.join("rows.md")).unwrap();
    assert!(document.contains("(`suction`)") && document.contains("**Guards against:**"), "{document}");
    let json = good(&here, &[&arguments[..], &["--json", "-"]].concat());
    assert!(serde_json::from_str::<Value>(&json).is_ok(), "stdout has the JSON alone: {json}");
}

#[test]
fn an_error_is_held_the_same_way_each_time_and_a_time_says_how_it_went() {
    let here = folder("hold");
    let run = |arguments: &[&str]| {
        let text = good(&here, &[&["run", "dam_break", "--set", "columns=16", "--ticks", "150"], arguments].concat());
        let field = |name: &str| {
            let value = text.split_whitespace().find_map(|field| field.strip_prefix(name)).map(str::to_owned);
            value.unwrap_or_else(|| panic!("no {name} in {text}"))
        };
        (field("hash="), field("held="), field("moves=").parse::<u32>().unwrap())
    };
    let (hash, held, moves) = run(&["--hold-error", "0.0001"]);
    assert!(moves > 0, "a bound this tight calls for another quality; held={held}");
    assert_eq!(run(&["--hold-error", "0.0001"]).0, hash, "nothing of it depends on the machine");
    assert_eq!(run(&["--hold-ms", "0.01"]).1, "no", "no machine is as fast as that");
}
