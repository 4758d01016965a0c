//! A disk that is full in the middle of a file. The limit on the size of files that a shell can set makes the system refuse
//! the byte behind it, as a full disk does: with an error from the same call, in the middle of a file.

use crate::{folder, good};
use powder_master::sim::checkpoint::Checkpoint;
use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

/// Runs the program where no file may have more than so many KiB.
fn program(folder: &Path, kibibytes: u32, arguments: &[&str]) -> Output {
    let mut command = Command::new("bash");
    // Without the trap the signal that comes first would end the program.
    command.args(["-c", &format!("ulimit -f {kibibytes} && trap '' XFSZ && exec \"$0\" \"$@\"")]);
    command.arg(env!("CARGO_BIN_EXE_powder-master")).args(arguments).current_dir(folder).output().unwrap()
}

/// The one line that the program says as it fails.
fn failure(output: &Output) -> String {
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    said
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

const SMALL: [&str; 6] = ["run", "dam_break", "--set", "columns=8", "--ticks", "45"];

#[test]
fn a_full_disk_leaves_the_old_file_whole_and_says_where_what_and_what_to_do() {
    for option in ["snapshot", "particles", "trace", "png", "wav", "metrics", "reference"] {
        // No room at all, and room for a part of it; the table of distances is smaller than that.
        for kibibytes in if option == "reference" { 0..1 } else { 0..2 } {
            let here = folder(&format!("full_disk_{option}"));
            fs::write(here.join("file"), "what was there").unwrap();
            let output = program(&here, kibibytes, &[&SMALL[..], &[&format!("--{option}"), "file"]].concat());
            let said = failure(&output);
            assert!(said.starts_with("powder-master: file: can't be written: "), "{said}");
            assert!(said.trim_end().ends_with("what was there is kept: make room, or write to another disk"), "{said}");
            assert_eq!(fs::read_to_string(here.join("file")).unwrap(), "what was there", "{option}");
            assert_eq!(names(&here), ["file"], "{option} leaves something behind");
        }
    }
}

#[test]
fn what_can_be_written_is_written_beside_what_can_not() {
    let here = folder("full_disk_beside");
    let whole = good(&here, &SMALL);
    let hash = whole.trim_end().rsplit_once("hash=").unwrap().1;
    let options =
        ["--trace", "/dev/full", "--particles", "/dev/full.d/x", "--metrics", "m.json", "--snapshot", "s.pms"];
    // A folder that is not there is told before anything is simulated.
    assert_eq!(crate::program(&here, &[&SMALL[..], &options].concat()).status.code(), Some(2));
    let output = crate::program(&here, &[&SMALL[..], &options[..2], &options[4..]].concat());
    let said = failure(&output);
    assert!(said.contains("/dev/full: can't be written: No space left on device"), "{said}");
    assert_eq!(names(&here), ["m.json", "s.pms"]);
    let metrics: serde_json::Value = serde_json::from_slice(&fs::read(here.join("m.json")).unwrap()).unwrap();
    assert_eq!((&metrics["hash"], &metrics["ticks"]), (&hash.into(), &45.into()), "the world went on to its end");
    assert_eq!(Checkpoint::decode(&fs::read(here.join("s.pms")).unwrap()).unwrap().state.clock.tick, 45);
}

#[test]
fn a_report_that_can_not_be_filed_is_still_printed() {
    let here = folder("full_disk_report");
    fs::write(here.join("file"), "what was there").unwrap();
    for (command, says) in [
        (&["exam", "--case", "free_fall", "--quality", "draft", "--json", "file"][..], "free_fall"),
        (&["exam", "--case", "free_fall", "--quality", "draft", "--markdown", "file"], "free_fall"),
        (&["soak", "dam_break", "--set", "columns=8", "--hours", "0.02", "--json", "file"], "0.02 h of simulated time"),
    ] {
        let output = program(&here, 0, command);
        // The limit holds for a file, and stdout is a pipe.
        let printed = String::from_utf8(output.stdout.clone()).unwrap();
        assert!(failure(&output).contains("file: can't be written: "), "{command:?}");
        assert!(printed.contains(says), "{command:?} must print its results, not {printed}");
        assert_eq!(fs::read_to_string(here.join("file")).unwrap(), "what was there");
        assert_eq!(names(&here), ["file"]);
    }
}
