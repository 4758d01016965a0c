//! What the program says to wrong arguments, and to questions about itself.

use crate::{folder, good, refused};
use powder_master::scene::{self, effects::Effect};

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
            &[
                "NAME is one of air, drag, ",
                ", vorticity, diffusion, fracture, reactions, decay, heat, convection, expansion, sleep",
            ],
        ),
        (&["run", "waterfall", "--effect", "air=perhaps"], &["NAME=auto"]),
        (&["run", "waterfall", "--detail", "0"], &["--detail", "allowed: numbers from 0.125 to 8"]),
        (&["play", "--detail", "nan"], &["--detail", "allowed: numbers from 0.125 to 8"]),
        (&["soak", "waterfall", "--detail", "9"], &["--detail", "allowed: numbers from 0.125 to 8"]),
        (&["sweep", "dam_break", "--out", "x", "--detail", "-1"], &["--detail", "allowed: numbers from 0.125 to 8"]),
        (
            &["run", "dam_break", "--detail", "8", "--set", "columns=300"],
            &["4000000", "particle_limit", "lower detail"],
        ),
        (&["run", "dam_break", "--detail", "0.125", "--set", "columns=2"], &["size", "allowed: 4 to 32768"]),
        (&["run", "waterfall", "--hold-ms", "0"], &["--hold-ms", "allowed: numbers from 0.01"]),
        (&["run", "waterfall", "--hold-ms", "-1"], &["--hold-ms", "allowed"]),
        (&["run", "waterfall", "--hold-error", "nan"], &["--hold-error", "allowed: numbers from 0.0001 to 100"]),
        (&["run", "waterfall", "--hold-error", "1", "--hold-ms", "1"], &["--hold-error", "--hold-ms"]),
        (&["run", "waterfall", "--gauge", "3"], &["--gauge", "allowed: X,Y or X,Y,R in metres"]),
        (&["run", "waterfall", "--gauge", "3,nan", "--readings", "r.csv"], &["--gauge", "X,Y,R"]),
        (&["run", "waterfall", "--gauge", "25,1", "--readings", "r.csv"], &["--gauge", "25,1", "x from 0 to 24.5"]),
        (&["run", "waterfall", "--gauge", "-1,1", "--readings", "r.csv"], &["--gauge", "not in the box", "allowed"]),
        (
            &["run", "waterfall", "--gauge", "1,1,0.01", "--readings", "r.csv"],
            &["--gauge", "a radius", "0.0700 (a spacing)"],
        ),
        (&["run", "waterfall", "--gauge-line", "1,1,2", "--readings", "r.csv"], &["--gauge-line", "X1,Y1,X2,Y2"]),
        (&["run", "waterfall", "--gauge-line", "1,1,1,1", "--readings", "r.csv"], &["--gauge-line", "half a spacing"]),
        (&["run", "waterfall", "--gauge", "1,1"], &["the gauges are read by nobody", "--readings FILE.csv"]),
        (&["run", "waterfall", "--readings", "r.csv"], &["--readings", "allowed", "--gauge"]),
        (&["run", "waterfall", "--gauge", "1,1", "--gauge-element", "water", "--readings", "r.csv"], &["--gauge-line"]),
        (
            &["run", "waterfall", "--gauge-line", "1,1,2,2", "--gauge-element", "watre", "--readings", "r.csv"],
            &["--gauge-element watre", "allowed", "water"],
        ),
        (&["run", "waterfall", "--gauge", "1,1", "--readings", "-", "--metrics", "-"], &["stdout", "allowed"]),
        (&["run", "niagara"], &["niagara", "allowed", "dam_break", "waterfall"]),
        (&["run", "no/such.ron"], &["no/such.ron"]),
        (&["play", "niagara"], &["niagara", "allowed"]),
        (&["list"], &["WHAT"]),
        (&["list", "cats"], &["scenes, elements, effects, qualities, cases"]),
        (&["bench"], &["effects, frame, heat, neighbours, scaling, sleep, threads"]),
        (&["bench", "everything"], &["everything", "powder-master bench --help"]),
        (&["bench", "neighbours", "--quick"], &["--quick", "powder-master bench neighbours --help"]),
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
        (&["study", "rest-density", "--out", ".", "--beside", "x.json"], &["--beside is of study truth only"]),
        (&["study", "truth", "--out", ".", "--threads", "2"], &["--threads is of study rest-density only"]),
        (&["study", "truth", "--out", ".", "--beside", "nothing.json"], &["nothing.json", "can't be read"]),
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
        (&["sweep", "dam_break", "--out", "x", "--check", "--only", "fine"], &["--check", "--only"]),
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
    for option in ["--metrics", "--particles", "--trace", "--reference", "--png", "--wav", "--readings", "--snapshot"] {
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
    for option in ["--metrics", "--particles", "--trace", "--reference", "--png", "--wav", "--snapshot"] {
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
