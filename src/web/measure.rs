//! A run without the game: for tests that compare worlds and times, in a page or under node.

use crate::{
    kernel::params::Preset,
    lab::{
        challenge::{play, solution},
        run::{self, Plan},
        sampler::Sampler,
    },
    scene::challenges::find,
    sim::{simulation::Simulation, workers::Workers},
    web::{host, link::Link},
};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Runs what a link asks for (a JSON list of pairs) for so many ticks, and returns what `run --metrics` writes. Times
/// and samples leave the first `warmup` ticks out.
///
/// # Errors
/// If the link can't be followed, or there can't be so many ticks.
#[wasm_bindgen]
pub fn measure(link: &str, ticks: f64, warmup: f64) -> Result<String, JsError> {
    host::tell_of_panics();
    let begun = Link::read(link)?.open()?;
    let plan = Plan { ticks: count("ticks", ticks)?, warmup: count("warmup", warmup)?, ..Plan::default() };
    let mut simulation = Simulation::resume(&begun, Workers::default());
    let mut sampler = Sampler::new(simulation.world(), plan.warmup);
    run::run(&mut simulation, &plan, &mut [&mut sampler])?;
    Ok(serde_json::to_string(&sampler.finish(simulation.world()))?)
}

/// Plays a challenge by its solution at a quality, and returns what `challenge --json` writes of it.
///
/// # Errors
/// If there is no such challenge or quality, or it can't be played.
#[wasm_bindgen]
pub fn challenge(name: &str, quality: &str) -> Result<String, JsError> {
    host::tell_of_panics();
    let error = |what: String| JsError::new(&what);
    let preset = Preset::ALL.into_iter().find(|preset| preset.name() == quality);
    let preset = preset.ok_or_else(|| error(format!("no quality `{quality}`")))?;
    let solution = solution(name).map_err(error)?;
    let outcome = play(&*find(name)?, Some(&solution), preset, Workers::default()).map_err(error)?;
    Ok(serde_json::to_string(&outcome)?)
}

/// A number of ticks as a script gives it, which knows only one kind of number.
fn count(name: &str, number: f64) -> Result<u64, JsError> {
    if number.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&number) {
        return Err(JsError::new(&format!("{name} `{number}`: not a whole number from 0 to {}", u32::MAX)));
    }
    Ok(number as u64)
}
