//! A run without the game: for tests that compare worlds and times, in a page or under node.

use crate::{
    lab::{
        headless::Headless,
        run::{self, Plan},
        sampler::Sampler,
    },
    sim::workers::Workers,
    web::{host, link::Link},
};
use std::sync::Arc;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Runs what a link asks for (a JSON list of pairs) for so many ticks, and returns what `run --metrics` writes. Times
/// and samples leave the first `warmup` ticks out.
///
/// # Errors
/// If the link can't be followed.
#[wasm_bindgen]
pub fn measure(link: &str, ticks: u32, warmup: u32) -> Result<String, JsError> {
    host::tell_of_panics();
    let blueprint = Link::read(link)?.build()?;
    let plan = Plan { ticks: ticks.into(), warmup: warmup.into(), ..Plan::default() };
    let mut headless = Headless::new(Arc::new(blueprint), Workers::default());
    let mut sampler = Sampler::new(headless.world(), plan.warmup);
    run::run(&mut headless, &plan, &mut [&mut sampler])?;
    Ok(serde_json::to_string(&sampler.finish(headless.world()))?)
}
