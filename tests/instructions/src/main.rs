//! Guards how many instructions the hot kernels take, as counted by callgrind: time that no other program on the machine
//! can disturb.
//!
//! ```text
//! cargo instructions check       compare with figures.json; exit code 1 if a kernel is more than 5 % off
//! cargo instructions update      keep what is counted now as the figures
//! ```

extern crate instructions as powder_master;

mod kernels;
#[path = "../../../benches/tank/mod.rs"]
mod tank;
mod warm;

use std::{
    collections::BTreeMap,
    env, fs,
    path::Path,
    process::{Command, ExitCode},
};

/// Share by which a kernel may be off its figure.
const TOLERANCE: f64 = 0.05;

/// Instructions by kernel.
type Figures = BTreeMap<String, u64>;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let outcome = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["check"] => count().and_then(check),
        ["update"] => count().and_then(|counts| update(&counts)),
        // What callgrind runs.
        ["run", name] => kernels::counted_set()
            .filter(|set| kernels::run(name, *set))
            .map(|_| true)
            .ok_or_else(|| format!("can't run {name}: no such kernel, or no AVX2")),
        _ => Err("allowed: check, update".to_owned()),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(line) => {
            eprintln!("instructions: {line}");
            ExitCode::from(2)
        }
    }
}

fn figures_path() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("figures.json")
}

/// Counts all kernels.
fn count() -> Result<Figures, String> {
    if kernels::counted_set().is_none() {
        return Err("the figures are those of AVX2, which this processor lacks".to_owned());
    }
    kernels::NAMES.into_iter().map(|name| Ok((name.to_owned(), callgrind(name)?))).collect()
}

/// Instructions that a kernel takes.
fn callgrind(name: &str) -> Result<u64, String> {
    let program = env::current_exe().map_err(|error| format!("can't find this program: {error}"))?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=*kernels::counted*"])
        .arg(program)
        .args(["run", name])
        .output()
        .map_err(|error| format!("can't run valgrind ({error}); on Debian: apt-get install valgrind"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let collected = said.lines().find_map(|line| line.split_once("Collected : ")?.1.trim().parse().ok());
    match collected {
        Some(instructions) if output.status.success() && instructions > 0 => Ok(instructions),
        _ => Err(format!("callgrind counted nothing of {name}: {}", said.trim().replace('\n', " / "))),
    }
}

/// Compares with the figures that are kept.
fn check(counts: Figures) -> Result<bool, String> {
    let path = figures_path();
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let figures: Figures = serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut good = true;
    for (name, count) in counts {
        let (change, verdict) = match figures.get(&name) {
            None => (f64::NAN, "has no figure"),
            Some(&figure) => {
                let change = count as f64 / figure as f64 - 1.0;
                let verdict = if change > TOLERANCE {
                    "takes too many"
                } else if change < -TOLERANCE {
                    "takes fewer: lower its figure"
                } else {
                    ""
                };
                (change, verdict)
            }
        };
        println!("{name:<10} {count:>12} {:>+7.2} % {verdict}", 100.0 * change);
        good &= verdict.is_empty();
    }
    if !good {
        println!("if that is meant: cargo instructions update, and commit the figures with the change");
    }
    Ok(good)
}

fn update(counts: &Figures) -> Result<bool, String> {
    let path = figures_path();
    let text = serde_json::to_string_pretty(counts).map_err(|error| error.to_string())?;
    fs::write(&path, text + "\n").map_err(|error| format!("{}: {error}", path.display()))?;
    for (name, count) in counts {
        println!("{name:<10} {count:>12}");
    }
    Ok(true)
}
