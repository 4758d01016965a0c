//! `soak`: hours of a scene with a player that follows a script.

use crate::{
    cli::{
        args::{Minutes, SoakArguments},
        failure::Failure,
        output, progress,
        start::{Start, Wanted},
        threads,
    },
    lab::{
        machine::processor,
        soak::{self, Report},
    },
    sim::{simulation::Simulation, state::Setup, workers::Workers},
};
use bevy::platform::time::Instant;
use serde_json::json;
use std::path::Path;

/// Rows of the table.
const PERIODS: u64 = 24;

/// Soaks the scene and prints what was seen, period by period. A fault fails it. A file of figures is written anew at the
/// end of each period, so that a soak that is stopped leaves what it has seen.
pub(super) fn soak(arguments: &SoakArguments) -> Result<(), Failure> {
    output::check(&arguments.json.as_deref().into_iter().collect::<Vec<_>>())?;
    let SoakArguments { settings, quality, detail, .. } = arguments;
    let wanted = Wanted { settings, quality: *quality, detail: *detail, ..Wanted::default() };
    let start = Start::of_soak(&arguments.scene, wanted)?;
    threads::start(arguments.machine.threads)?;
    let mut simulation =
        Simulation::resume(&start.checkpoint, Workers::default()).with_instructions(arguments.machine.simd);
    let quality = simulation.world().resource::<Setup>().preset.name();
    let (minutes, begun) = (arguments.hours.0, Instant::now());
    let line = progress::bar(minutes).with_message("minutes");
    let seconds = || begun.elapsed().as_secs_f64();
    let most = arguments.within.map_or(f64::INFINITY, |Minutes(minutes)| minutes as f64 * 60.0);
    let file = arguments.json.as_deref().filter(|path| !output::is_stdout(Some(path)));
    let (mut written, mut outcome) = (0, Ok(()));
    let report = soak::soak(&mut simulation, arguments.seed, minutes, PERIODS, |report| {
        line.set_position(report.minutes);
        if report.periods.len() > written {
            written = report.periods.len();
            outcome = file.map_or(Ok(()), |path| write_json(path, arguments, quality, report, seconds()));
        }
        outcome.is_ok() && seconds() < most
    });
    drop(line);
    outcome?;
    let (faults, seconds) = (report.faults(), seconds());
    if let Some(path) = &arguments.json {
        write_json(path, arguments, quality, &report, seconds)?;
    }
    let hours = report.minutes as f64 / 60.0;
    let verdict = if faults.is_empty() { "sound" } else { "NOT sound" };
    output::print(&format!(
        "{}\n{} at {quality}: {hours:.2} h of simulated time in {seconds:.0} s: {verdict}\n",
        report.table(),
        arguments.scene
    ))?;
    match faults.first() {
        None => Ok(()),
        Some(first) => Err(Failure::Outcome(format!("{} faults, the first: {first}", faults.len()))),
    }
}

fn write_json(
    path: &Path,
    SoakArguments { scene, seed, hours, .. }: &SoakArguments,
    quality: &str,
    report: &Report,
    seconds: f64,
) -> Result<(), Failure> {
    let counters = report.counters;
    output::write_json(
        path,
        &json!({
            "scene": scene, "quality": quality, "seed": seed, "minutes": report.minutes, "minutes_wanted": hours.0,
            "wall_seconds": seconds, "processor": processor(), "periods": report.periods,
            "rock": [report.rock_before, report.rock_after], "non_finite": counters.non_finite,
            "escaped": counters.escaped, "speed_clamps": counters.speed_clamps,
            "position_clamps": counters.position_clamps, "air_clamps": counters.air_clamps,
            "refused": counters.refused, "faults": report.faults(),
        }),
    )
}
