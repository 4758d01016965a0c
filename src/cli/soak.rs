//! `soak`: hours of a scene with a player that follows a script.

use crate::{
    cli::{
        args::{Minutes, SoakArguments},
        failure::Failure,
        output,
        progress::{StatusLine, bar},
        start::Start,
        threads,
    },
    lab::{headless::Headless, machine::processor, soak},
    sim::{state::Setup, workers::Workers},
};
use bevy::platform::time::Instant;
use serde_json::json;

/// Rows of the table.
const PERIODS: u64 = 24;

/// Soaks the scene and prints what was seen, period by period. A fault fails it.
pub(super) fn soak(arguments: &SoakArguments) -> Result<(), Failure> {
    output::check(&arguments.json.as_deref().into_iter().collect::<Vec<_>>())?;
    let start = Start::of_soak(&arguments.scene, &arguments.settings, arguments.quality)?;
    threads::start(arguments.threads)?;
    let mut headless = Headless::begin(Workers::default(), |world| start.load(world, arguments.simd));
    let minutes = arguments.hours.0;
    let (begun, line) = (Instant::now(), StatusLine::new());
    let most = arguments.within.map_or(f64::INFINITY, |Minutes(minutes)| minutes as f64 * 60.0);
    let report = soak::soak(&mut headless, arguments.seed, minutes, PERIODS, |done| {
        line.say(&format!("{} minute {done} of {minutes}", bar(done as usize, minutes as usize)));
        begun.elapsed().as_secs_f64() < most
    });
    drop(line);
    let (world, faults, seconds) = (headless.world(), report.faults(), begun.elapsed().as_secs_f64());
    let quality = world.resource::<Setup>().preset.name();
    if let Some(path) = &arguments.json {
        let counters = report.counters;
        output::write_json(
            path,
            &json!({
                "scene": arguments.scene, "quality": quality, "seed": arguments.seed, "minutes": report.minutes,
                "wall_seconds": seconds, "processor": processor(), "periods": report.periods,
                "rock": [report.rock_before, report.rock_after], "non_finite": counters.non_finite,
                "escaped": counters.escaped, "speed_clamps": counters.speed_clamps,
                "position_clamps": counters.position_clamps, "air_clamps": counters.air_clamps,
                "refused": counters.refused, "faults": faults,
            }),
        )?;
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
